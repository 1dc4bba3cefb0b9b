"""The model as tables for the monitor: what the checker runs, written down in Python or in C++.

The meaning of a statement is decided once, where bodies are lowered to instructions; the monitor
of a package has the same list of instructions, and a small machine for it in its language.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rebsync.checker.lowering.system import lower
from rebsync.checker.program import Body, Instruction, Program, RebecInfo, Server
from rebsync.forward.templating import fill
from rebsync.model import Type
from rebsync.names import node_name
from rebsync.package import Package, StateType
from rebsync.records import dataclass
from rebsync.static import Analysis

# Operands that only the checker looks at: marks of constants, branches, live cells, sends.
_ONE_OPERAND = frozenset({"CALL", "CONST", "DELAY", "JUMPF", "JUMPT"})
_NO_TABLE = frozenset({"DELAY", "SEND", "SENDBY"})


@dataclass(frozen=True, slots=True)
class Variable:
    """A parameter, or a state variable by its field of the state message."""

    name: str
    kind: str
    lengths: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class MonitoredServer:
    """A message server, the parameters by which its messages are shown, and if it uses `sender`."""

    server: Server
    parameters: tuple[Variable, ...]
    reads_sender: bool


@dataclass(frozen=True, slots=True)
class MonitoredRebec:
    """A rebec with its node, the type of its state message, and the fields of that."""

    rebec: RebecInfo
    node: str
    state_type: str
    state: tuple[Variable, ...]


@dataclass(frozen=True, slots=True)
class MonitorModel:
    """All of a model that the monitor needs."""

    program: Program
    code: tuple[Instruction, ...]
    bodies: tuple[tuple[Body, int], ...]
    servers: tuple[MonitoredServer, ...]
    rebecs: tuple[MonitoredRebec, ...]


def monitor_model(package: Package, analysis: Analysis) -> MonitorModel:
    """The tables of a model without errors."""
    program, _ = lower(analysis)
    servers = tuple(_server(s, program) for s in program.servers)
    rebecs = tuple(_rebec(r, package.node_class(r.class_name).state) for r in program.rebecs)
    bodies = tuple((b, sum(p.size for p in b.parameters)) for b in program.bodies)
    return MonitorModel(program, tuple(map(_plain, program.code)), bodies, servers, rebecs)


def _server(server: Server, program: Program) -> MonitoredServer:
    parameters = program.bodies[server.body].parameters
    variables = tuple(_variable(p.name, p.type) for p in parameters)
    return MonitoredServer(server, variables, _reads_sender(program, server.body))


def _reads_sender(program: Program, number: int) -> bool:
    """Whether a body, or a method that it calls, uses `sender`."""
    seen: set[int] = set()
    waiting = [number]
    while waiting:
        body = program.bodies[waiting.pop()]
        code = program.code[body.entry : body.end]
        if any(i.op == "SENDER" for i in code):
            return True
        called = {i.a for i in code if i.op == "CALL"} - seen
        seen |= called
        waiting += called
    return False


def _rebec(rebec: RebecInfo, state: StateType) -> MonitoredRebec:
    fields = zip(rebec.state, state.fields, strict=True)
    variables = tuple(_variable(field.name, slot.type) for slot, field in fields)
    return MonitoredRebec(rebec, node_name(rebec.name), state.name, variables)


def _variable(name: str, type_: Type) -> Variable:
    known = ("byte", "short", "int", "float", "double", "boolean")
    return Variable(name, type_.name if type_.name in known else "rebec", type_.dimensions)


def _plain(i: Instruction) -> Instruction:
    """An instruction without what only the checker looks at."""
    b = 0 if i.op in _ONE_OPERAND else i.b
    if i.op == "TABLE":
        return Instruction(i.op, 0, 0, i.constants)
    return Instruction(i.op, i.a, b, () if i.op in _NO_TABLE else i.constants)


# --- Python -------------------------------------------------------------------------------------


def python_tables(model: MonitorModel, package: str, name: str) -> str:
    """`monitor_model.py`."""
    return fill(
        "py/monitor_model.py.j2",
        package=package,
        name=name,
        model=model,
        tables=_PythonTables(),
    )


class _PythonTables:
    """Values of the tables as Python writes them."""

    def instruction(self, i: Instruction) -> str:
        return f'("{i.op}", {i.a}, {i.b}, {self.numbers(i.constants)})'

    def numbers(self, values: Iterable[int]) -> str:
        items = [str(v) for v in values]
        return f"({', '.join(items)}{',' if len(items) == 1 else ''})"

    def text(self, text: str) -> str:
        return _quoted(text)

    def variable(self, variable: Variable) -> str:
        return f'Variable("{variable.name}", "{variable.kind}", {self.numbers(variable.lengths)})'


# --- C++ ----------------------------------------------------------------------------------------


def cpp_tables(model: MonitorModel, package: str, name: str, guard: str, header: str) -> str:
    """`monitor_model.h`; `header` is how the names of headers end."""
    return fill(
        "cpp/monitor_model.h.j2",
        package=package,
        name=name,
        model=model,
        guard=guard,
        header=header,
        tables=_CppTables(),
    )


class _CppTables:
    """Values of the tables as C++ writes them."""

    def operation(self, op: str) -> str:
        return f"Op::k{op.title()}"

    def instruction(self, i: Instruction) -> str:
        table = ", ".join(_cell(c) for c in i.constants)
        return f"{{{self.operation(i.op)}, {_cell(i.a)}, {i.b}, {{{table}}}}}"

    def numbers(self, values: Iterable[int]) -> str:
        return f"{{{', '.join(_cell(v) for v in values)}}}"

    def text(self, text: str) -> str:
        return _quoted(text)

    def variables(self, variables: Sequence[Variable]) -> str:
        items = [
            f'{{"{v.name}", Kind::k{v.kind.title()}, {self.numbers(v.lengths)}}}' for v in variables
        ]
        return f"{{{', '.join(items)}}}"


def _cell(cell: int) -> str:
    """A number as C++ writes it: what an int does not hold needs its width."""
    if cell == -(2**63):
        return "INT64_MIN"
    if not -(2**31) < cell < 2**31:
        return f"INT64_C({cell})"
    return str(cell)


def _quoted(text: str) -> str:
    """A text as a literal of both languages."""
    known = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t"}
    return '"' + "".join(known.get(c, c) for c in text) + '"'
