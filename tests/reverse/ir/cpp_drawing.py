"""Draws texts of C++ whose `run()` computes in integers of all widths, branches, and ends objects.

A full-expression has one call that tells something, so that no order is left open between two.
"""

from __future__ import annotations

from random import Random

_HEAD = """
int say(int x) { note(x); return x; }
struct Guard {
  int n; int& out;
  Guard(int n, int& out) : n(n), out(out) { note(n); }
  Guard(const Guard& o) : n(o.n + 1), out(o.out) { note(n); }
  ~Guard() { out += n; note(-n); }
  int get(int k = 3) const { return n * k; }
};
struct P {
  int x; uint8_t small = 7; long long wide{1}; short parts[2] = {1, 2};
  P operator+(const P& o) const { P r = *this; r.x += o.x; r.small += o.small; return r; }
  P& operator-=(int k) { wide -= k; return *this; }
  bool operator<(const P& o) const { return x < o.x; }
};
struct Base {
  int a; static int shared;
  explicit Base(int a) : a(a) { note(v(1)); }
  virtual ~Base() { note(v(2)); }
  virtual int v(int k) { return a + k; }
  int twice(int k) { return v(k) * 2; }
};
int Base::shared = 4;
struct Derived : Base {
  unsigned b; P p{3};
  Derived(int a, unsigned b) : Base(a * 2), b(b) { note(v(3)); }
  int v(int k) override { ++shared; return a - k + p.x; }
};
int narrow(int8_t a, unsigned b = 9) { return a + b; }
int narrow(double a) { return static_cast<int>(a) + 1000; }
void change(int& x, const P& p) { x += p.x; }
P made(int x) { P p{x, 200}; p.wide = x * 3; return p; }
unsigned counted() { static unsigned n = 3; return n += 2; }
enum class Mode : uint8_t { A = 254, B, C = 3 };
enum Plain { ONE = 1, FOUR = 4, FIVE };
"""
_TYPES = (
    *("int8_t", "uint8_t", "int16_t", "uint16_t", "int", "unsigned", "long", "unsigned long"),
    *("bool", "size_t", "char", "int64_t"),
)
_START = """
  int total = 1; int8_t i8 = -3; uint8_t u8 = 250; int16_t i16 = 300; uint16_t u16 = 65530;
  int i = 5; unsigned u = 4000000000u; long l = -9; unsigned long ul = 3; bool t = true;
  double d = 2.5; float f = 0.3f; char c = 'q'; P p{4}; P q = made(6); P& r = p;
  std::vector<int> list = {3, 1, 2}; std::map<int, int> table = {{1, 2}, {5, 6}};
  Mode m = Mode::B; Derived der(2, 7); Base& base = der; int& alias = i; std::string s = "ab";
"""
_PLACES = (
    *("total", "i8", "u8", "i16", "u16", "i", "u", "l", "ul", "c", "p.x", "q.small", "r.small"),
    *("p.wide", "r.x", "alias", "list[1]", "table[1]", "table[8]", "Base::shared", "der.b"),
    *("q.parts[1]", "base.a"),
)
_VALUES = (
    *_PLACES,
    *("t", "list.size()", "static_cast<int>(m)", "Plain::FIVE", "FOUR", "'a'", "7u", "0x80L"),
    *("-1", "s.size()", "sizeof(short)", "(i > 3 ? u8 : l)", "list.back()", "p.parts[0]"),
)
_EFFECTS = (
    *("say({})", "base.v({})", "der.twice({})", "narrow({})", "counted()", "base.Base::v({})"),
    *(
        "Guard({}, total).get()",
        "by_value({})",
        "by_reference({})",
        "made({}).x",
        "narrow(0.5 + i8)",
    ),
)
_SIGNS = ("+", "-", "*", "&", "|", "^")
_COMPARED = ("<", "<=", ">", ">=", "==", "!=")

_SIMPLE = (
    ("{place}++;", "--{place};", "note({place}--);", "note(++{place});"),
    ("q = p;", "p = q + r;", "r -= i8;", "q = made(u8);", "p = P{{1, 2}};"),
    ("P {x} = p; {x}.x += 5; note({x}.small);", "P {x} = p + q; {x}.x += 5; note({x}.small);"),
    ("change(total, p);", "change(i, made(2));", "change(p.x, r);", "change(list[0], q);"),
    ("d = l * 0.5;", "d = u8 * f;", "d = i * d;"),
    ("d = d > 1e6 || d < -1e6 ? 1 : d; f = d; note((int)d); note(f == d);",),
    ("s += s.size() > 9 ? s.substr(0, 1) : s; s[0] = 'z'; note(s);", "s += std::to_string(u8);"),
)
# In these X is a name, TEST a condition and BODY a block.
_LOOPS = (
    "for (int X = 0; X < 3; ++X) BODY",
    "{ int X = 3; while (X-- > 0) BODY }",
    "{ uint8_t X = 254; do BODY while (++X > 250); }",
)
_SCOPES = (
    "{ Guard X(i8, total); BODY note(X.get()); }",
    "{ Guard X(3, i), Xb(X); BODY note(Xb.get()); }",
    "try { Guard X(4, total); BODY if (TEST) throw 5; note(2); } catch (int k) { note(k); }",
    "try { Guard X(4, i); BODY if (TEST) throw P{8}; } catch (const P& k) { note(k.x); }",
    "try { if (TEST) throw P{8}; BODY } catch (...) { note(say(1)); }",
    "for (auto& X : list) { X += i8; note(X); total ^= X; }",
    "for (auto& [kX, vX] : table) { vX += kX; note(vX); }",
    "{ std::unique_ptr<Base> X(new Derived(i8, u)); note(X->v(2)); BODY }",
)


class Drawing:
    """Draws with the choices of a `Random`."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.names = 0
        self.calls = 0

    def text(self) -> str:
        """One text with its `run()`."""
        body = "".join(self.statement(3, False) for _ in range(self.random.randint(4, 9)))
        lambdas = (
            "  auto by_value = [=](int k) { return k + i + u8; };\n"
            "  auto by_reference = [&, h = i16 * 2](int k) mutable { total += k; return h++; };\n"
        )
        return f"{_HEAD}int run() {{{_START}{lambdas}{body}{_END}}}\n"

    def name(self) -> str:
        self.names += 1
        return f"x{self.names}"

    def pick(self, options: tuple[str, ...]) -> str:
        return self.random.choice(options)

    # --- expressions -----------------------------------------------------------------------------

    def full(self, depth: int = 2) -> str:
        """A full-expression, with one call that tells something at most."""
        self.calls = 1
        return self.number(depth)

    def number(self, depth: int) -> str:
        kind = self.random.randrange(13) if depth else 0
        if kind < 3:
            return self.pick(_VALUES)
        if kind == 3 and self.calls:
            self.calls = 0
            inner = f"static_cast<int8_t>({self.number(0)})"
            return self.pick(_EFFECTS).format(inner)
        if kind == 4:
            return (
                f"({self.number(depth - 1)} {self.pick(('/', '%'))} (({self.number(0)} & 7) + 1))"
            )
        if kind == 5:
            return f"({self.number(depth - 1)} {self.pick(('<<', '>>'))} ({self.number(0)} & 5))"
        if kind == 6:
            return f"static_cast<{self.pick(_TYPES)}>({self.number(depth - 1)})"
        if kind == 7:
            return f"{self.pick(('-', '~', '+'))}({self.number(depth - 1)})"
        if kind == 8:
            return f"({self.test(depth - 1)} ? {self.number(depth - 1)} : {self.number(depth - 1)})"
        if kind == 9:
            return f"(({self.pick(_TYPES)})({self.number(depth - 1)}))"
        return f"({self.number(depth - 1)} {self.pick(_SIGNS)} {self.number(depth - 1)})"

    def test(self, depth: int) -> str:
        kind = self.random.randrange(7) if depth else 0
        if kind < 2:
            return f"({self.number(depth)} {self.pick(_COMPARED)} {self.number(depth)})"
        if kind == 2:
            return f"!({self.test(depth - 1)})"
        if kind == 3:
            return self.pick(("m == Mode::B", "p < q", "d > 2 * f", "t", 's == "ab"', "d / 2 < u8"))
        if kind == 4:
            return f"!!({self.number(depth - 1)})"
        sign = self.pick(("&&", "||"))
        return f"({self.test(depth - 1)} {sign} {self.test(depth - 1)})"

    # --- statements ------------------------------------------------------------------------------

    def block(self, depth: int, in_loop: bool) -> str:
        count = self.random.randint(1, 3)
        return "{ " + "".join(self.statement(depth - 1, in_loop) for _ in range(count)) + "}\n"

    def statement(self, depth: int, in_loop: bool) -> str:
        if depth and self.random.random() < 0.4:
            return self.nested(depth, in_loop)
        if in_loop and self.random.random() < 0.1:
            return f"if ({self.test(1)}) {self.pick(('break', 'continue'))};\n"
        return self.simple()

    def simple(self) -> str:
        """A statement without others in it."""
        name, place = self.name(), self.pick(_PLACES)
        if (kind := self.random.randrange(12)) < len(_SIMPLE):
            return self.pick(_SIMPLE[kind]).format(x=name, place=place) + "\n"
        sign = self.pick(("=", *(f"{sign}=" for sign in _SIGNS)))
        return self.pick(
            (
                f"note({self.full()});\n",
                f"{place} {sign} {self.full()};\n",
                f"{self.pick(_TYPES)} {name} = {self.full()}; note({name});\n",
                f"m = static_cast<Mode>({self.full(1)}); note(static_cast<int>(m));\n",
                f"list.push_back({self.full(1)}); note(list.size());\n",
            )
        )

    def nested(self, depth: int, in_loop: bool) -> str:
        """A statement with others in it."""
        name, test = self.name(), self.test(1)
        kind = self.random.randrange(11)
        if kind < 2:
            self.calls = 1
            other = f"else {self.block(depth, in_loop)}" if self.random.random() < 0.5 else ""
            return f"if ({self.test(2)}) {self.block(depth, in_loop)}{other}"
        if kind == 2:
            return self.switch(depth, in_loop)
        is_loop = kind < 6
        text = self.pick(_LOOPS if is_loop else _SCOPES)
        body = self.block(depth, is_loop or (in_loop and "try" not in text))
        return text.replace("BODY", body).replace("TEST", test).replace("X", name) + "\n"

    def switch(self, depth: int, in_loop: bool) -> str:
        end = self.pick(("break;", "", "break;"))
        cases = "".join(
            f"case {n}: {self.block(depth, in_loop).rstrip()} {end}\n" for n in (0, 1, 2)
        )
        value = f"static_cast<unsigned>({self.full(1)}) % 5"
        return f"switch ({value}) {{ {cases}default: {self.block(depth, in_loop)}}}\n"


_END = """
  note(total); note(i8); note(u8); note(i16); note(u16); note(i); note(u); note(l); note(ul);
  note(p.x); note(p.small); note(q.wide); note(q.small); note(list[0]); note(table[1]); note(s);
  return r.x + (d > 1e9 || d < -1e9 ? 0 : (int)d) + base.a;
"""


def text_of(random: Random) -> str:
    """A drawn text."""
    return Drawing(random).text()
