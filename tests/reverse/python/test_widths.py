"""Sums of generated Python that do not wrap as the model's: extraction tells these and no other."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from random import Random

import pytest

from rebsync import model as m
from rebsync.config import Config
from rebsync.printing import print_model
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.python.generated.widths import hint_of
from rebsync.reverse.recovery import Extracted, extract
from rebsync.source import Source
from tests.forward.compiling import CASES, case_files, generated, written
from tests.forward.python_packages import imported
from tests.forward.test_python import after
from tests.ros1.test_arithmetic import drawn_bodies, expected_values, model_of

TARGETS = ("ros1-py", "ros2-py")
_DRAWN = 200
_TARGET = Config(target="ros1-py")
MODEL = """
reactiveclass A(5) {
  knownrebecs { A other; }
  statevars { int n; byte b; short s; int[3] list; double d; float f; float[2] fs; boolean ok; }
  A() { self.go(1, 2); }
  msgsrv go(int k, byte small) { BODY }
  msgsrv take(byte c) { b = c; }
  msgsrv any(int x, short y) { n = x; s = y; list[1] = x; }
  int twice(int x) { return x; }
}
main { A a(a):(); }
"""


def _sources(name: str, target: str) -> dict[str, Source]:
    files = case_files(CASES / f"{name}.rebeca", target)
    return {path: Source(path, text) for path, text in files.items()}


@pytest.mark.parametrize("name", ["control", "moves", "arrays", "order", "inheritance"])
@pytest.mark.parametrize("target", TARGETS)
def test_fresh_code_wraps(name: str, target: str) -> None:
    assert [f for f in extract(_sources(name, target)).findings if "number" in f.why] == []


# What is written in the body of `go(self, k: int, small: Byte)`, and what of it is told.
BODIES = [
    (["self._n = self._n + 1"], ["self._n + 1"]),
    (["self._n = 0 + self.twice(k)"], []),
    (["self._b = 0 + small"], []),
    (["self._b = ~small"], []),
    (["self._b = -small"], ["-small"]),
    (["self._n += 1"], ["self._n += 1"]),
    (["self._n = int32(self._n + k - 3 * self._n)"], []),
    (["self._n = int32((self._n + 1) & 255)"], []),
    (["self._n = (self._n + 1) & 255"], []),
    (["self._n = -self._n"], ["-self._n"]),
    (["self._n = ~self._n"], []),
    (["self._n = self._s + self._b"], []),
    (["self._n = self._s * self._s * 2"], ["self._s * self._s * 2"]),
    (["self._b = self._s"], ["self._s"]),
    (["self._b = int8(self._s)"], []),
    (["self._b = self._b + 1"], ["self._b + 1"]),
    (["self._b += 1"], ["self._b += 1"]),
    (["self._b = int8.add(self._b, self._n + 1)"], []),
    (["self._s = int8(self._n)"], []),
    (["self._b = int16(self._n)"], ["int16(self._n)"]),
    (["self._n = 3000000000"], ["3000000000"]),
    (["if self._n < 10:", "    self._n = self._n + 1"], []),
    (["if self._n < 10:", "    self._n += 1"], []),
    (["if int32(self._n + 1) < 10:", "    self._n = self._n + 1"], ["self._n + 1"]),
    (["if int8(self._n) < 10:", "    self._n = self._n + 1"], ["self._n + 1"]),
    (["if self._n + 1 < 10:", "    self._n = 3"], ["self._n + 1"]),
    (["self._ok = self._n - k > 0"], ["self._n - k"]),
    (["self._ok = int32(self._n - k) > 0"], []),
    (["self._n = divide(self._n + k, 2)"], ["self._n + k"]),
    (["self._ok = self._n % 3 == 0"], []),  # a multiple is one, however is rounded
    (["self._ok = 0 != (k % 3)"], []),
    (["self._ok = not self._n % 3"], []),
    (["self._ok = self._n % 3 == 1"], ["self._n % 3"]),
    (["self._ok = self._n % k == 0"], ["self._n % k"]),
    (["self._ok = (self._n + k) % 3 == 0"], ["self._n + k"]),
    (["self._ok = self._n // 3 == 0"], ["self._n // 3", "self._n // 3"]),
    (["self._n = shift_left(self._n, k)"], []),
    (["self._n = int32(self._n << 3)"], []),
    (["self._n = int32(self._n << k)"], ["k"]),
    (["self._n = self._n >> k"], ["self._n >> k", "k"]),
    (["self._n = self._n >> 3"], []),
    (["self._n = int32(self._n + 1) >> 3"], []),
    (["self._n = (self._n + 1) >> 3"], ["self._n + 1"]),
    (["self._d = self._n + 1"], ["self._n + 1"]),
    (["self._d = self._d + 1.5"], []),
    (["self._d = self._d + (self._n + k)"], ["self._n + k"]),
    (["self._d += self._n + k"], ["self._n + k"]),
    (["self._n = to_int(self._n + k)"], []),
    (["self._b = to_byte(self._n + k)"], []),
    (["self._d = to_double(self._n + k)"], ["self._n + k"]),
    (["self.send_self_go(k + 1, small)"], ["k + 1"]),
    (["self.send_self_go(k, k)"], ["k"]),
    (["self.send_self_go(k, small, When(after=k + 1))"], ["k + 1"]),
    (["self._n = self.twice(k + 1)"], ["k + 1"]),
    (["self._b = self.twice(k)"], ["self.twice(k)"]),
    (["self._mailbox.delay(2 * k)"], ["2 * k"]),
    (["self._list[0] = self._list[1] + 1"], ["self._list[1] + 1"]),
    (["self._list[0] += 1"], ["self._list[0] += 1"]),
    (["self._n = self._list[k + 1]"], []),  # cut or not, it is no index where it has no 32 bits
    (["self._n = self._list[k * 2]"], ["k * 2"]),
    (["self._n = sum(self._list)"], ["sum(self._list)"]),
    (["self._n = int32(sum(self._list))"], []),
    (["self._n = abs(k)"], ["abs(k)"]),
    (["self._n = abs(small)"], []),
    (["self._n = max(k, 3)"], []),
    (["self._n = k if self._ok else k + 1"], ["k + 1"]),
    (["self._n = int32(k if self._ok else k + 1)"], []),
    (["local = k + 1", "self._n = int32(local)"], ["k + 1"]),
    (["for i in range(3):", "    self._n = i + 1"], []),
    (["for i in range(k):", "    self._n = i + 1"], []),
    (["for i in range(0, k, 3):", "    self._n = i"], ["for i in range(0, k, 3): self._n = i"]),
    (["while self._n < k:", "    self._n = self._n + 1"], []),
    (["self._n = self._d"], ["self._d"]),
    (["self._n = self._n * 1.5"], ["self._n", "self._n * 1.5", "self._n * 1.5"]),
    (["self._n = int32(self._d * 1.5)"], []),
    (["self._n = int32(float32(self._s * 1.5))"], []),
    (["self._n += self._d"], ["self._n += self._d"]),
    (["self.send_self_go(self._d, small)"], ["self._d"]),
    (["self._f = self._d"], ["self._d"]),
    (["self._f = float32(self._d)"], []),
    (["self._f = self._fs[0]"], []),
    (["self._f = self._f + self._fs[1]"], ["self._f + self._fs[1]"]),
    (["self._f = float32(self._f + self._fs[1])"], []),
    (["self._d = self._f + self._fs[1]"], ["self._f + self._fs[1]"]),
    (["self._d = self._f * self._d"], []),
    (["self._f = 0.5"], []),
    (["self._f = 0.1"], ["0.1"]),
    (["self._f = float32(0.1)"], []),
    (["self._d = float64(0.1)"], []),
    (["self._d = 0.1"], []),
    (["self._f = small"], []),
    (["self._f = k"], ["k"]),
    (["self._f = float32(k)"], []),
    (["self._f += 1"], ["self._f += 1"]),
    (["self._f = float32.add(self._f, 1)"], []),
    (["self._ok = self._f > self._d"], []),
    (["while self._n != k:", "    self._n = self._n + 1"], ["self._n + 1"]),
]


@pytest.mark.parametrize(("body", "told"), BODIES, ids=lambda each: "; ".join(each) or "-")
def test_a_body(body: list[str], told: list[str], fresh: dict[str, Source]) -> None:
    old = "        self._n = int32(self._n + 1)\n"
    path = "src/widths/a.py"
    text = fresh[path].text
    assert old in text
    new = "".join(f"        {line}\n" for line in body)
    names = "divide, float32, float64, int8, int16, int32, shift_left, to_byte, to_double, to_int"
    text = text.replace(old, new).replace("int32, text", f"{names}, text")
    findings: tuple[Finding, ...] = extract({**fresh, path: Source(path, text)}).findings
    assert [f.text for f in findings] == told, findings
    assert all(f.grade is Grade.UNREADABLE and f.within == "A.go" for f in findings)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("self._b = to_byte(b)", "self._b = b", ["b"]),
        ("self._f = float32(f)", "self._f = f", ["f"]),
        ("self._n = int32(self._n + n)", "self._n = self._n + n", ["self._n + n"]),
        ("self._n = int32(self._n + n)", "self._n = n + 6", []),
    ],
)
def test_state_variables_that_others_hide(
    old: str, new: str, told: list[str], tmp_path: Path
) -> None:
    model = tmp_path / "hidden.rebeca"
    model.write_text("""
        reactiveclass A(5) {
          statevars { byte b; float f; int n; }
          A() { self.set(1, 2); }
          msgsrv set(int b, int f) {
            self.b = (byte) b;
            self.f = f;
            int n = 5;
            self.n = self.n + n;
          }
        }
        main { A a():(); }
    """)
    files = {path: Source(path, text) for path, text in case_files(model, "ros1-py").items()}
    path = "src/hidden/a.py"
    assert extract(files).findings == ()
    assert files[path].text.count(old) == 1
    edited = Source(path, files[path].text.replace(old, new))
    assert [f.text for f in extract({**files, path: edited}).findings] == told


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Source]:
    model = tmp_path_factory.mktemp("model") / "widths.rebeca"
    model.write_text(MODEL.replace("BODY", "n = n + 1;"))
    files = case_files(model, "ros1-py")
    return {path: Source(path, text) for path, text in files.items()}


def test_what_to_write_is_said() -> None:
    assert hint_of("k + 1", "not cut to 8 bits") == "write int8(k + 1)"
    assert hint_of("self._k += 1", "not cut to 32 bits") == "write self._k = int32(self._k + 1)"
    assert hint_of("k *= a + b", "not cut to 8 bits") == "write k = int8(k * (a + b))"
    assert hint_of("k = a + b", "not cut to 8 bits") == "write k = int8(a + b)"
    assert "int32(...)" in hint_of("k //= 2", "not cut to 32 bits")
    assert "int32(...)" in hint_of("for i in range(k): pass", "not cut to 32 bits")
    assert "int32(...)" in hint_of("k", "shifted by any distance")


# --- code that runs -----------------------------------------------------------------------------


@pytest.mark.parametrize("pattern", [r"\bint(?:8|16|32)\((?!\))", r"\b(?:int|float)\d+\((?!\))"])
def test_what_is_not_told_is_the_number_of_the_model(pattern: str, tmp_path: Path) -> None:
    """Drawn bodies without their cuts: those that are in step do what they did with them."""
    bodies = drawn_bodies(_DRAWN)
    files = generated(model_of(bodies), "calc", _TARGET)
    path = "src/calc/calc.py"
    uncut = {**files, path: _without_cuts(pattern, files[path])}
    before, now = (extract({p: Source(p, t) for p, t in f.items()}) for f in (files, uncut))
    told = {f.within for f in now.findings}
    today = _methods(now)
    told |= {f"Calc.{name}" for name, body in _methods(before).items() if today[name] != body}
    edited = _edited(files[path], uncut[path])
    tried = [n for n in edited if f"Calc.m{n}" not in told]
    assert len(tried) > 5 and len(told) > 10
    package = written(uncut, tmp_path, "calc", _TARGET)
    with imported(package, "calc") as module:
        broken = (sys.modules["calc.values"].Violation, IndexError)
        for number, wanted in enumerate(expected_values(bodies)):
            if number in tried:
                assert wanted is not None
                assert after(module.Calc(), number, broken) == wanted, bodies[number]


def _methods(extracted: Extracted) -> dict[str, str]:
    """The text of each method, without the parentheses that are left of cuts."""
    (calc,) = (c for c in extracted.model.classes if isinstance(c, m.ReactiveClass))
    text = print_model(m.Model((), (calc,), None))
    found = re.split(r"^  void (?=m\d+\()", text, flags=re.MULTILINE)[1:]
    return {each.partition("(")[0]: re.sub(r"[()]", "", each) for each in found}


def _without_cuts(pattern: str, text: str) -> str:
    """The text with some of the cuts in its bodies gone."""
    random = Random(3)
    head, first, bodies = text.partition("    def m0(")
    return head + first + re.sub(pattern, lambda m: "(" if random.random() < 0.5 else m[0], bodies)


def _edited(before: str, now: str) -> list[int]:
    parts = [re.split(r"^    def m(?=\d+\()", text, flags=re.MULTILINE) for text in (before, now)]
    return [int(b.partition("(")[0]) for a, b in zip(*parts, strict=True) if a != b]


def test_how_far_a_robot_moves_wraps_too() -> None:
    files = _sources("moves", "ros1-py")
    (path,) = (p for p in files if p.endswith("/bot.py"))
    text = files[path].text
    assert "-int32((self._dx + 1))" in text
    files[path] = Source(path, text.replace("-int32((self._dx + 1))", "-(self._dx + 1)"))
    assert [f for f in extract(files).findings if "not cut to 32 bits" in f.why]
