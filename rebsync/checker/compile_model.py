"""A program as C: its bodies, and the tables that the search reads."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rebsync.checker.build import Unit, header
from rebsync.checker.compile_bodies import bodies, branches, number
from rebsync.checker.program import NULL, Program, RebecInfo
from rebsync.records import dataclass

_LARGEST = 2**31 - 1  # capacity that C holds; no bag of so many messages fits any memory


@dataclass(frozen=True, slots=True)
class _RebecText:
    figures: str
    arguments: str
    blank: str
    cells: int


class ModelText:
    """The C text of a program; it includes machine.h."""

    def __init__(self, program: Program) -> None:
        self._template = header("model.c.j2")
        self._context = _context(program)

    @property
    def parts(self) -> tuple[str, ...]:
        """What the text is made from; jinja2 is imported only to make it."""
        return self._template, repr(self._context)

    def render(self) -> str:
        return rendered(self._template, self._context)


def model_unit(program: Program) -> Unit:
    """A program as a library."""
    text = ModelText(program)
    return Unit("model", text.render, (*text.parts, header("machine.h")), "-O1")


def rendered(template: str, context: Mapping[str, object]) -> str:
    """A template of C with the values of its names."""
    from jinja2 import Environment, StrictUndefined

    environment = Environment(
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    return environment.from_string(template).render(context)


def message_cells(program: Program) -> int:
    """How many cells a message takes: its times, server and sender, and the most arguments."""
    bodies_of = (program.bodies[server.body] for server in program.servers)
    return 4 + max((sum(p.size for p in body.parameters) for body in bodies_of), default=0)


def _context(program: Program) -> dict[str, object]:
    known = [r.known for r in program.rebecs]
    dispatch = [r.dispatch for r in program.rebecs]
    body_of = [-1] * len(program.code)
    for index, body in enumerate(program.bodies):
        body_of[body.entry : body.end] = [index] * (body.end - body.entry)
    live = [i.b if i.op in ("CALL", "DELAY") else 0 for i in program.code]
    return {
        "classes": _list(r.class_index for r in program.rebecs),
        "known": [_list(row) for row in known],
        "known_width": max(1, *(len(row) for row in known)),
        "dispatch": [_list(row) for row in dispatch],
        "dispatch_width": max(1, *(len(row) for row in dispatch)),
        "bodies": bodies(program),
        "body_of": _list(body_of),
        "live": _list(live),
        "rebecs": [_rebec(r) for r in program.rebecs],
        "servers": [_list(_server(program, s)) for s in range(len(program.servers))] or ["0"],
        "predicates": _list(program.observers),
        "observed": _list(_observed(program)),
        "figures": _list(_figures(program)),
    }


def _figures(program: Program) -> tuple[int, ...]:
    return (
        len(program.rebecs),
        len(program.servers),
        len(program.bodies),
        len(program.predicates),
        len(branches(program)),
        message_cells(program),
        int(program.global_ranks),
        int(program.reads_clock),
        len(program.measures),
    )


def _rebec(rebec: RebecInfo) -> _RebecText:
    figures = (
        rebec.cells,
        min(rebec.capacity, _LARGEST),
        rebec.priority,
        rebec.constructor,
        len(rebec.arguments),
    )
    return _RebecText(_list(figures), _cells(rebec.arguments), _blank(rebec), max(1, rebec.cells))


def _blank(rebec: RebecInfo) -> str:
    """The variables before the constructor; only what is not 0 is written, arrays as ranges."""
    ranges = [
        f"[{s.offset} ... {s.offset + s.size - 1}] = {number(NULL)}"
        for s in rebec.state
        if s.kind == "rebec"
    ]
    return ", ".join(ranges) or "0"


def _server(program: Program, number: int) -> tuple[int, int, int, int]:
    server = program.servers[number]
    arguments = sum(p.size for p in program.bodies[server.body].parameters)
    return server.body, server.priority, arguments, server.depth


def _observed(program: Program) -> list[int]:
    """For each rebec whether a predicate or measure reads its variables."""
    read: set[int] = set()
    for observer in program.observers:
        body = program.bodies[observer]
        code = program.code[body.entry : body.end]
        read.update(i.a for i in code if i.op in ("STATE", "STATEAT"))
    return [int(i in read) for i in range(len(program.rebecs))]


def _list(values: Iterable[int]) -> str:
    return ", ".join(map(str, values)) or "0"


def _cells(values: Iterable[int]) -> str:
    return ", ".join(map(number, values)) or "0"
