"""Which numbers of generated Python are cut or rounded to the width that they have in the model.

`int32(...)`, `float32(...)` and their kin say so, and so do the functions that divide and shift as
the model does. The model has no words for them: its numbers always have their width.
"""

from __future__ import annotations

from dataclasses import field, replace

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval
from rebsync.records import dataclass

_WIDTHS = {"int8": INTEGERS["byte"], "int16": INTEGERS["short"], "int32": INT32}
FUNCTIONS = {"/": "divide", "//": "divide", "%": "remainder"}
_OPERATIONS = frozenset({"divide", "remainder", "shift_left", "shift_right"})


@dataclass(frozen=True, slots=True)
class Cut:
    """An expression whose value is brought into bounds; `by_function` says that it is an operation
    of the run-time part, which takes any distance of a shift as the model does.
    """

    expression: m.Expression
    bounds: Interval
    by_function: bool


@dataclass(eq=False, slots=True)
class Cuts:
    """The expressions of a body that are cut, and those that are rounded, by their ids.

    `called` has the functions of the code that calls and sends of the model are: of overloads one.
    `floored` are the divisions that Python does its own way, by the last ids that they had.
    """

    of: dict[int, Cut] = field(default_factory=dict)
    rounded: dict[int, m.Expression] = field(default_factory=dict)
    called: dict[int, tuple[m.Expression, str]] = field(default_factory=dict)
    floored: dict[int, m.Binary] = field(default_factory=dict)

    def passing(self, call: m.Expression, function: str) -> m.Expression:
        """A call or send, which is one of a function of the code."""
        self.called[id(call)] = call, function
        return call

    def converted(self, format_: str, read: m.Expression, *, update: bool = False) -> m.Expression:
        """What a format makes of an expression; of a variable, if it is an update (`int32.add`)."""
        if format_ == "float32":
            return self._rounded(read)
        bounds = _WIDTHS.get(format_)
        return read if bounds is None else self._marked(read, bounds, by_function=update)

    def operated(self, function: str, read: m.Expression) -> m.Expression:
        """An operation by its function."""
        if function not in _OPERATIONS:
            return read
        return self._marked(read, INT32, by_function=True)

    def divided(self, read: m.Binary) -> m.Binary:
        """A division of Python's own, which rounds to the lower number."""
        self.floored[id(read)] = read
        return read

    def _marked(self, read: m.Expression, bounds: Interval, *, by_function: bool) -> m.Expression:
        """A copy: what it is read from may stand elsewhere, where nothing cuts it."""
        if isinstance(read, m.Paren):
            inner = self._marked(read.inner, bounds, by_function=by_function)
            return replace(read, inner=inner)
        before = self.of.get(id(read))
        own = by_function or (before is not None and before.by_function)
        copied = self._rounded(read) if id(read) in self.rounded else self._copied(read)
        self.of[id(copied)] = Cut(copied, bounds, own)
        return copied

    def _rounded(self, read: m.Expression) -> m.Expression:
        if isinstance(read, m.Paren):
            return replace(read, inner=self._rounded(read.inner))
        copied = self._copied(read)
        self.rounded[id(copied)] = copied
        if (cut := self.of.get(id(read))) is not None:
            self.of[id(copied)] = replace(cut, expression=copied)
        return copied

    def _copied(self, read: m.Expression) -> m.Expression:
        copied = replace(read)
        if isinstance(copied, m.Binary) and self.floored.pop(id(read), None) is not None:
            self.floored[id(copied)] = copied
        return copied


def other_division(operator: str) -> str:
    """Why a division of Python is none of the model."""
    return f'"{operator}" of Python is not the model\'s, which is {FUNCTIONS[operator]}(a, b)'
