"""What an interpreted program reads, writes and runs, held against its effects."""

from __future__ import annotations

from collections.abc import Generator
from types import ModuleType
from typing import Any

from rebsync.reverse.analysis.effects import EffectAnalysis
from rebsync.reverse.analysis.library_effects import (
    IMPORT,
    RECEIVER,
    WITH,
    LibraryEffect,
    LibraryTable,
)
from rebsync.reverse.analysis.locations import (
    CapturedVariable,
    Elements,
    GlobalVariable,
    Location,
    Member,
)
from rebsync.reverse.ir.program import Program
from tests.reverse.ir.evaluation import Frame, Value
from tests.reverse.ir.interpreter import Interpreter

_CALLS = LibraryEffect()
_PLAIN = LibraryEffect(calls=False)
_APPLIES = LibraryEffect(applies=True)
_CHANGES = LibraryEffect(frozenset({RECEIVER}), calls=False)
TABLE: dict[str, LibraryEffect] = {
    **{f"builtins.{name}": _CALLS for name in ("len", "int", "str", "abs", "sum", "list", "any")},
    **{f"builtins.{name}": _CALLS for name in ("tuple", "dict", "set", "zip", "range", "divmod")},
    **{f"builtins.{name}": _CALLS for name in ("enumerate", "next", "iter", "isinstance", "vars")},
    **{f"builtins.{name}": _CALLS for name in ("ValueError", "KeyError", "AttributeError")},
    **{f"builtins.{name}": _PLAIN for name in ("type", "object", "property", "staticmethod")},
    **{f"builtins.{name}": _APPLIES for name in ("sorted", "max", "min", "map", "filter")},
    "builtins.print": LibraryEffect(acts=True),
    ".append": _CHANGES,
    ".items": _PLAIN,
    ".sort": LibraryEffect(frozenset({RECEIVER}), applies=True),
    ".send": _CALLS,
    ".close": _CALLS,
    ".setdefault": LibraryEffect(frozenset({RECEIVER})),
    WITH: LibraryEffect(acts=True),
    IMPORT: _PLAIN,
}


class Tracer(Interpreter):
    """Notes for each function that runs what happens meanwhile."""

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self.seen: set[tuple[str, str, Location | str]] = set()

    def note(self, kind: str, holder: Value, name: Value) -> None:
        how, _, what = kind.partition(" ")
        location: Location
        match what:
            case "global":
                location = GlobalVariable(holder, name)
            case "captured":
                location = CapturedVariable(holder, name)
            case "attribute":
                location = Member(name)
            case _:
                location = Elements()
        if what == "attribute" and isinstance(holder, ModuleType):
            self._add(how, GlobalVariable(holder.__name__, name))
        self._add(how, location)

    def _add(self, how: str, what: Location | str) -> None:
        self.seen.update((function, how, what) for function in set(self.calls))

    def _function(self, frame: Frame) -> Generator[Any, Any, Any]:
        self._add("run", frame.function.name)
        try:
            return (yield from super()._function(frame))
        except Exception:
            self.seen.add((frame.function.name, "raise", ""))
            raise


def unsound(
    tracer: Tracer, table: LibraryTable = TABLE.get
) -> list[tuple[str, str, Location | str]]:
    """What happened though the effects say that it cannot."""
    analysis = EffectAnalysis(tracer.program, table)
    found = []
    for function, how, what in sorted(tracer.seen, key=str):
        effects = analysis.of(function)
        if isinstance(what, str):
            is_allowed = effects.may_raise if how == "raise" else effects.may_run(what)
        elif how == "read":
            is_allowed = effects.may_read(what)
        else:
            is_allowed = effects.may_write(what)
        if not is_allowed:
            found.append((function, how, what))
    return found


def share_of_anything(program: Program) -> float:
    """How many functions may do anything, as far as the analysis knows."""
    analysis = EffectAnalysis(program, TABLE.get)
    return sum(analysis.of(f).anything for f in program.functions) / len(program.functions)
