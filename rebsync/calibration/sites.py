"""The times in a model: each `delay`, `after`, `deadline` and period, by its instruction."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rebsync.calibration.times import Kind, TimeSite
from rebsync.checker.program import Program
from rebsync.model import Call, Constructor, Expression, MessageServer, Method, Model, walk
from rebsync.source import Source


class Sites:
    """The calls of a model that take time, or send with one."""

    def __init__(self, source: Source, model: Model, program: Program) -> None:
        self._source = source
        self._program = program
        self._calls: dict[tuple[int, int], tuple[Call, str]] = dict(_calls(model))

    def call(self, pc: int) -> Call:
        """The call that an instruction is of."""
        return self._of(pc)[0]

    def site(self, pc: int, kind: Kind) -> TimeSite:
        """The time of an instruction."""
        call, body = self._of(pc)
        expression = time_of(call, kind)
        assert expression is not None
        span = expression.span
        line = self._source.position(span.start).line
        return TimeSite(kind, span, line, self._source.text[span.start : span.end], body)

    def line(self, pc: int) -> int:
        """The line of an instruction."""
        return self._source.position(self._program.spans[pc].start).line

    def _of(self, pc: int) -> tuple[Call, str]:
        span = self._program.spans[pc]
        return self._calls[span.start, span.end]

    @property
    def pcs(self) -> Mapping[str, tuple[int, ...]]:
        """The instructions of delays, and of sends."""
        code = self._program.code
        delays = tuple(pc for pc, i in enumerate(code) if i.op == "DELAY")
        sends = tuple(pc for pc, i in enumerate(code) if i.op in ("SEND", "SENDBY"))
        return {"delay": delays, "send": sends}


def time_of(call: Call, kind: Kind) -> Expression | None:
    """The expression of a time."""
    match kind:
        case "delay":
            return call.arguments[0]
        case "after" | "period":
            return call.after
        case "deadline":
            return call.deadline


def _calls(model: Model) -> Iterator[tuple[tuple[int, int], tuple[Call, str]]]:
    for declared in model.classes:
        for node in walk(declared):
            if isinstance(node, (MessageServer, Method, Constructor)) and node.body is not None:
                for call in walk(node.body):
                    if isinstance(call, Call):
                        place = (call.span.start, call.span.end)
                        yield place, (call, f"{declared.name}.{node.name}")
