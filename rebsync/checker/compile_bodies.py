"""Instructions as C: one function for each body, which stops at calls and goes on after them.

Operands lie in the frame above its cells; how many there are at an instruction is known here, so
each has a fixed place. What an instruction means is said in machine.py.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rebsync.checker.program import Body, Instruction, Program
from rebsync.records import dataclass

_JUMPS = ("JUMP", "JUMPF", "JUMPT")
_ENDS = ("JUMP", "RET")
_PUSHES = [
    "CONST",
    "VAR",
    "LOCAL",
    "STATE",
    "KNOWN",
    "SELF",
    "SENDER",
    "NOW",
    "ARRIVAL",
    "DEADLINE",
    "WAITING",
    "CHOICE",
]
_POPS = [
    "SETVAR",
    "SETLOCAL",
    "POP",
    "JUMPF",
    "JUMPT",
    "DELAY",
    "ASSERT",
    "ADD",
    "SUB",
    "MUL",
    "DIV",
    "MOD",
    "AND",
    "OR",
    "XOR",
    "SHL",
    "SHR",
    "EQ",
    "NE",
    "LT",
    "LE",
    "GT",
    "GE",
    "FADD",
    "FSUB",
    "FMUL",
    "FDIV",
    "POW",
    "FEQ",
    "FNE",
    "FLT",
    "FLE",
    "FGT",
    "FGE",
]
_CHANGES = {**dict.fromkeys(_PUSHES, 1), **dict.fromkeys(_POPS, -1)}
_CHANGES |= {"SETVARAT": -2, "SETLOCALAT": -2}


@dataclass(frozen=True, slots=True)
class BodyText:
    """A body in C; `need` is how many cells it takes with all its operands."""

    name: str
    entry: int
    frame: int
    need: int
    lines: tuple[str, ...]


def number(cell: int) -> str:
    """A cell as a constant of C."""
    return f"INT64_C({cell})" if cell > -(2**63) else "INT64_MIN"


def branches(program: Program) -> dict[int, int]:
    """The jumps that are branches of the model, with their numbers."""
    places = [pc for pc, i in enumerate(program.code) if i.op in ("JUMPF", "JUMPT") and not i.b]
    return {pc: n for n, pc in enumerate(places)}


def bodies(program: Program) -> tuple[BodyText, ...]:
    """All bodies of a program, in its order."""
    numbers = branches(program)
    return tuple(_Writer(program, body, numbers).text() for body in program.bodies)


def stack_change(program: Program, i: Instruction) -> int:
    """By how many operands an instruction changes their number."""
    match i.op:
        case "SEND":
            return -2 - i.b
        case "SENDBY":
            return -3 - i.b
        case "CALL":
            called = program.bodies[i.a]
            code = program.code[called.entry : called.end]
            results = next(i.a for i in reversed(code) if i.op == "RET")
            return results - sum(p.size for p in called.parameters)
        case _:
            return _CHANGES.get(i.op, 0)


class _Writer:
    """Writes one body."""

    def __init__(self, program: Program, body: Body, numbers: dict[int, int]) -> None:
        self.program = program
        self.body = body
        self.numbers = numbers
        self.depths = self._depths()
        reached = (program.code[pc] for pc in self.depths)
        self.targets = {i.a for i in reached if i.op in _JUMPS}

    # --- how many operands there are

    def _depths(self) -> dict[int, int]:
        """The number of operands before each instruction that can be reached."""
        depths: dict[int, int] = {}
        waiting = [(self.body.entry, 0)]
        while waiting:
            pc, depth = waiting.pop()
            if pc in depths:
                assert depths[pc] == depth, f"{self.body.name}: {pc}"
                continue
            depths[pc] = depth
            i = self.program.code[pc]
            depth += stack_change(self.program, i)
            if i.op in _JUMPS:
                waiting.append((i.a, depth))
            if i.op not in _ENDS:
                waiting.append((pc + 1, depth))
        return depths

    def _arguments(self, body: int) -> int:
        return sum(p.size for p in self.program.bodies[body].parameters)

    # --- the text

    def text(self) -> BodyText:
        lines = tuple(line for pc in sorted(self.depths) for line in self._lines(pc))
        need = self.body.frame + max(self.depths.values()) + 2
        return BodyText(self.body.name, self.body.entry, self.body.frame, need, lines)

    def _lines(self, pc: int) -> Iterator[str]:
        i = self.program.code[pc]
        if pc == self.body.entry or self._goes_on(pc - 1):
            yield f"case {pc}:"
        if pc in self.targets:
            yield f"L{pc}:"
        if self._leads(pc):
            count = self._block(pc)
            top = self.body.frame + self.depths[pc]
            more = f"m->more(m, {pc}, {count}, {top})"
            yield f"    if ((m->budget -= {count}) < 0 && !{more}) return ENDLESS;"
        yield f"    {self._statement(pc, i)}"

    def _goes_on(self, pc: int) -> bool:
        return pc in self.depths and self.program.code[pc].op in ("CALL", "DELAY")

    def _leads(self, pc: int) -> bool:
        """Whether a block of instructions without jumps begins here."""
        before = pc - 1
        ended = before not in self.depths or self.program.code[before].op in (*_JUMPS, "RET")
        return ended or self._goes_on(before) or pc in self.targets

    def _block(self, pc: int) -> int:
        end = pc + 1
        while end in self.depths and not self._leads(end):
            end += 1
        return end - pc

    def _statement(self, pc: int, i: Instruction) -> str:
        top = self.body.frame + self.depths[pc]
        if i.op in _JUMPS:
            return self._jump(pc, i, top)
        match i.op:
            case "CALL":
                count = self._arguments(i.a)
                base = top - count
                return f"return call(m, {i.a}, {pc + 1}, m->base + {base}, {count});"
            case "RET":
                return f"return leave(m, f, f + {top - i.a}, {i.a});"
            case _:
                return _STATEMENTS[i.op](i, top, pc)

    def _jump(self, pc: int, i: Instruction, top: int) -> str:
        if i.op == "JUMP":
            return f"goto L{i.a};"
        test = f"f[{top - 1}]" if i.op == "JUMPT" else f"!f[{top - 1}]"
        if pc not in self.numbers:
            return f"if ({test}) goto L{i.a};"
        first = 2 * self.numbers[pc]
        return (
            f"if ({test}) {{ m->covered[{first + 1}] = 1; goto L{i.a}; }} m->covered[{first}] = 1;"
        )


# --- single instructions: `top` is the cell above the operands -----------------------------------

_Statement = Callable[[Instruction, int, int], str]


def _push(value: str) -> _Statement:
    """`A` and `B` stand for the operands of the instruction."""
    return lambda i, top, pc: f"f[{top}] = {_filled(value, i, top)};"


def _set(value: str) -> _Statement:
    """Replaces the top operand; `X` is its place."""
    return lambda i, top, pc: f"f[{top - 1}] = {_filled(value, i, top)};"


def _two(value: str) -> _Statement:
    """Replaces two operands, the places `Y` and `X`, by one."""
    return lambda i, top, pc: f"f[{top - 2}] = {_filled(value, i, top)};"


def _do(text: str) -> _Statement:
    return lambda i, top, pc: _filled(text, i, top).replace("PC", str(pc))


def _filled(text: str, i: Instruction, top: int) -> str:
    values = {"$A": number(i.a), "$B": str(i.b), "$X": f"f[{top - 1}]", "$Y": f"f[{top - 2}]"}
    for name, value in values.items():
        text = text.replace(name, value)
    return text


def _table(i: Instruction) -> str:
    return ", ".join(number(c) for c in i.constants)


def _choice(i: Instruction, top: int, pc: int) -> str:
    options = f"static const cell options[] = {{ {_table(i)} }};"
    return f"{{ {options} f[{top}] = options[choose(m, {len(i.constants)})]; }}"


def _look_up(i: Instruction, top: int, pc: int) -> str:
    table = f"static const cell table[] = {{ {_table(i)} }};"
    return f"{{ {table} f[{top - 1}] = table[f[{top - 1}]]; }}"


def _is(i: Instruction, top: int, pc: int) -> str:
    tests = " || ".join(f"class == {c}" for c in i.constants) or "0"
    rebec = f"f[{top - 1}]"
    return f"{{ cell class = {rebec} == -1 ? -1 : class_of[{rebec}]; {rebec} = {tests}; }}"


def _send(i: Instruction, top: int, pc: int) -> str:
    timed = i.op == "SENDBY"  # with the deadline above the time
    after = top - 2 if timed else top - 1
    due = f"f[{top - 1}]" if timed else "NO_DEADLINE"
    sent = f"put(m, f + {after - i.b - 1}, {i.b}, {i.a}, f[{after}], {due}, {pc})"
    return f"if ((status = {sent})) FAIL(status, {pc});"


def _pairs() -> dict[str, _Statement]:
    texts = {"ADD": "wrap($Y + $X)", "SUB": "wrap($Y - $X)", "MUL": "wrap($Y * $X)"}
    texts |= {"AND": "$Y & $X", "OR": "$Y | $X", "XOR": "$Y ^ $X"}
    texts |= {"SHL": "wrap((cell)((uint64_t)$Y << ($X & 31)))", "SHR": "$Y >> ($X & 31)"}
    compare = {"EQ": "==", "NE": "!=", "LT": "<", "LE": "<=", "GT": ">", "GE": ">="}
    texts |= {name: f"$Y {sign} $X" for name, sign in compare.items()}
    texts |= {f"F{name}": f"real($Y) {sign} real($X)" for name, sign in compare.items()}
    reals = {"FADD": "+", "FSUB": "-", "FMUL": "*", "FDIV": "/"}
    texts |= {name: f"cell_of(real($Y) {sign} real($X))" for name, sign in reals.items()}
    texts["POW"] = "cell_of(pow(real($Y), real($X)))"
    return {name: _two(text) for name, text in texts.items()}


def _singles() -> dict[str, _Statement]:
    texts = {"NEG": "wrap(-$X)", "INV": "~$X", "NOT": "!$X", "BYTE": "(int8_t)$X"}
    texts |= {"SHORT": "(int16_t)$X", "FNEG": "cell_of(-real($X))", "REAL": "cell_of((double)$X)"}
    texts |= {"WHOLE": "whole(real($X))", "SINGLE": "cell_of((double)(float)real($X))"}
    texts["SQRT"] = "cell_of(sqrt(real($X)))"
    texts |= {"VARAT": "v[$A + $X]", "LOCALAT": "f[$A + $X]", "STATEAT": "m->states[$A][$B + $X]"}
    return {name: _set(text) for name, text in texts.items()}


def _pushes() -> dict[str, _Statement]:
    texts = {"CONST": "$A", "VAR": "v[$A]", "LOCAL": "f[$A]", "STATE": "m->states[$A][$B]"}
    texts |= {"KNOWN": "known[m->index][$A]", "SELF": "m->index", "SENDER": "m->message[SENDER]"}
    texts |= {
        "NOW": "wrap(m->clock + m->elapsed)",
        "ARRIVAL": "wrap(m->clock + m->message[ARRIVAL])",
        "DEADLINE": "m->message[DUE] == NO_DEADLINE ? FOREVER : wrap(m->clock + m->message[DUE])",
        "WAITING": "wrap(m->elapsed - m->message[ARRIVAL])",
    }
    return {name: _push(text) for name, text in texts.items()}


def _actions() -> dict[str, _Statement]:
    texts = {"SETVAR": "v[$A] = $X;", "SETVARAT": "v[$A + $Y] = $X;", "POP": ";"}
    texts |= {"SETLOCAL": "f[$A] = $X;", "SETLOCALAT": "f[$A + $Y] = $X;"}
    texts["OFFSET"] = "if ($X < 0 || $X >= $A) FAIL(INDEX, PC); $X *= $B;"
    texts["DIV"] = "if (!$X) FAIL(DIVISION, PC); $Y = wrap($Y / $X);"
    texts["MOD"] = "if (!$X) FAIL(DIVISION, PC); $Y = $Y % $X;"
    texts["ASSERT"] = "if (!$X) FAIL(ASSERTION, PC);"
    return {name: _do(text) for name, text in texts.items()}


def _delay(i: Instruction, top: int, pc: int) -> str:
    time = f"f[{top - 1}]"
    splits = f"m->delayed = {time}; m->pc = {pc + 1}; m->top = m->base + {top - 1}; return DELAYED;"
    return f"if ({time} < 0) FAIL(TIME, {pc}); if (m->splits) {{ {splits} }} m->elapsed += {time};"


_STATEMENTS: dict[str, _Statement] = {
    **_pairs(),
    **_singles(),
    **_pushes(),
    **_actions(),
    "CHOICE": _choice,
    "TABLE": _look_up,
    "IS": _is,
    "SEND": _send,
    "SENDBY": _send,
    "DELAY": _delay,
}
