"""What members and globals may hold after the functions that give them a value."""

from __future__ import annotations

from dataclasses import field
from functools import partial

from rebsync.records import dataclass
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_index import CppClass, CppFunction
from rebsync.reverse.syntax.cpp_initialisers import hands_on
from rebsync.reverse.values.cpp_assignments import CppAssignments
from rebsync.reverse.values.cpp_flow_types import Variable
from rebsync.reverse.values.cpp_flow_writes import Key, key_of
from rebsync.reverse.values.cpp_values_plain import Frame, Nothing, Value, choice

# Where functions read parameters into one variable, what stands in for a parameter is what the
# others left in it, and so on: so many of them one within the other say all that is known.
_MOST_WITHIN = 2


@dataclass(slots=True)
class Afterwards:
    """Finds the values of members and globals, wherever they are used.

    A function that nobody in the files calls, such as a callback, counts only where there are no
    others; constructors only where nothing else surely gives a value.
    """

    variables: CppAssignments
    # What is known by how many questions for the variable it was asked within.
    _known: dict[tuple[int, int, Key], Value] = field(default_factory=dict)
    _active: set[tuple[int, Key]] = field(default_factory=set)

    def value(self, variable: Variable, path: str, frame: Frame) -> Value:
        """What it may hold where a function begins; that function itself does not count."""
        own = frame.function.node.id if frame.function is not None else 0
        held = key_of(variable, path)
        within = sum(of == held for _, of in self._active)
        if (own, held) in self._active or within >= _MOST_WITHIN:
            self.variables.values.cuts += 1
            return Nothing()
        key = within, own, held
        if key in self._known:
            return self._known[key]
        self._active.add((own, held))
        before = self.variables.values.cuts
        try:
            value = self._after_all(variable, path, own)
        finally:
            self._active.discard((own, held))
        if self.variables.values.cuts == before or len(self._active) == within:
            self._known[key] = value
        return value

    def _after_all(self, variable: Variable, path: str, own: int) -> Value:
        """As `value`; `own` is the function that asks, before it gives a value itself."""
        writers = [w for w in self.variables.writes.writing(variable, path) if w.node.id != own]
        owner = variable.owner.name if variable.owner is not None else ""
        makers = self._makers(variable, writers)
        others = [w for w in writers if not owner or w.name != w.owner]
        called = [w for w in others if self._is_called(w)]
        at_first = self._after(makers, variable, path)[0] if makers else Nothing()
        if not makers:
            at_first = self.variables.initial(variable, path)
        if not called and not isinstance(at_first, Nothing):
            return at_first
        later, sure = self._after(called or others, variable, path)
        return choice([later]) if sure else choice([later, at_first])

    def _makers(self, variable: Variable, writers: list[CppFunction]) -> list[CppFunction]:
        """The constructors of the class of a member: those that are used, if some are.

        One that leaves all to another of them says nothing of a member that it does not name.
        """
        if variable.owner is None:
            return []
        calls = self.variables.values.calls
        own = {w.node.id for w in writers}
        found = calls.bodies(variable.owner, variable.owner.name)
        found = [f for f in found if f.node.id in own or not _delegates(variable.owner, f)] or found
        return [f for f in found if calls.uses(f)] or found

    def _after(
        self, functions: list[CppFunction], variable: Variable, path: str
    ) -> tuple[Value, bool]:
        """What a variable holds at the ends of functions; whether one of them sets it for sure."""
        found: list[Value] = []
        always = False
        frames = [Frame(f.cpp, f) for f in functions]
        for function, values, sure in self.variables.values.settle_all(
            frames, partial(self._end, variable, path)
        ):
            always = always or sure
            if not sure and function is not None and function.name == function.owner:
                values = [*values, self.variables.initial(variable, path)]
            found.append(choice(values))
        return choice(found), always

    def _end(
        self, variable: Variable, path: str, frame: Frame
    ) -> tuple[CppFunction | None, list[Value], bool]:
        values, sure = self.variables.ways_to(variable, path, None, frame)
        return frame.function, values, sure

    def _is_called(self, function: CppFunction) -> bool:
        return (
            function.name in libraries.entries()
            or not function.parameters
            or any(not u.handed for u in self.variables.values.calls.uses(function))
        )


def _delegates(owner: CppClass, constructor: CppFunction) -> bool:
    """Whether a constructor calls another one of its class first."""
    listed = constructor.initialisers
    given = listed.named_children if listed is not None else ()
    return any(hands_on(owner, n) for n in given if n.type == "field_initializer")
