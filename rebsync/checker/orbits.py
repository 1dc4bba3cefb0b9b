"""Canonical states of orbits, and runs through them as runs of the model itself.

Of the states that permutations make of one, the canonical one is the least: by the colours of its
rebecs (one round of colour refinement, which nearly always decides), then by all of it. A step is
known by its *code*: its ordinal in a canonical state, and by which permutation of the group what it
leads to became canonical.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, TypeAlias

from rebsync.checker.program import Cell
from rebsync.checker.state import Frame, Local, Message, Point, State
from rebsync.checker.steps import Failure, Semantics, Step
from rebsync.checker.symmetry import Permutation, Symmetry, inverse
from rebsync.checker.views import Views

_Order: TypeAlias = tuple[object, ...]


class Run(NamedTuple):
    """A run of the model; `names` are its rebecs by their numbers in the last canonical state."""

    path: tuple[int, ...]
    failing: int
    loop: int | None
    names: Permutation


class Orbits:
    """The states of a program under its symmetries."""

    def __init__(self, semantics: Semantics, symmetry: Symmetry) -> None:
        self.symmetry = symmetry
        self._sorted = semantics != "core"
        self._inverses = tuple(map(inverse, symmetry.group))
        self._maps = (*symmetry.group, *symmetry.blinds)
        self._orbit = {rebec: n for n, orbit in enumerate(symmetry.orbits) for rebec in orbit}
        self._colours: dict[object, int] = {}
        self._known: dict[tuple[int, int, Local], Local] = {}

    def representative(self, state: State) -> tuple[State, int]:
        """The canonical state of an orbit, and the number of a permutation that leads to it."""
        movable, order = self.symmetry.movable, self.symmetry.order
        if order == 1:
            return state, 0
        colours = {r: self._colour(state, r, order + n) for n, r in enumerate(movable)}
        images = [tuple(colours[back[r]] for r in movable) for back in self._inverses]
        least = min(images)
        candidates = [turn for turn, image in enumerate(images) if image == least]
        return min(
            ((self.image(state, turn), turn) for turn in candidates),
            key=lambda image: tuple(map(_order, image[0])),
        )

    def image(self, state: State, turn: int) -> State:
        """What a permutation of the group makes of a state."""
        back = self._inverses[turn]
        return tuple(self._renamed(rebec, state[rebec], turn) for rebec in back)

    def _colour(self, state: State, rebec: int, blind: int) -> int:
        """What tells a rebec apart whatever rebecs are called: its own state, and those of others
        as they speak of it."""
        own = self._renamed(rebec, state[rebec], blind)
        others = [
            self._number((self._orbit.get(r, -1 - r), self._renamed(r, local, blind)))
            for r, local in enumerate(state)
            if r != rebec
        ]
        return self._number((self._number(own), tuple(sorted(others))))

    def _number(self, key: object) -> int:
        return self._colours.setdefault(key, len(self._colours))

    # --- renaming

    def _renamed(self, rebec: int, local: Local, number: int) -> Local:
        """A local state whose rebecs have got other numbers."""
        key = number, rebec, local
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = self._rename(rebec, local, self._maps[number])
        return found

    def _rename(self, rebec: int, local: Local, names: Permutation) -> Local:
        references = self.symmetry.references
        variables = _renamed_cells(local.variables, references.variables[rebec], names)
        bag = tuple(self._message(message, names) for message in local.bag)
        if self._sorted:
            bag = tuple(sorted(bag))
        point = local.point
        if point is not None:
            frames = (
                Frame(f.pc, _renamed_cells(f.cells, references.frames[f.pc], names))
                for f in point.frames
            )
            point = Point(self._message(point.message, names), tuple(frames))
        return Local(variables, bag, local.busy, point, local.clock)

    def _message(self, message: Message, names: Permutation) -> Message:
        sender = names[message.sender] if message.sender >= 0 else message.sender
        arguments = message.arguments
        if message.server >= 0:
            cells = self.symmetry.references.arguments[message.server]
            arguments = _renamed_cells(arguments, cells, names)
        return message._replace(sender=sender, arguments=arguments)


def _renamed_cells(
    cells: tuple[Cell, ...], places: Sequence[int], names: Permutation
) -> tuple[Cell, ...]:
    if not places:
        return cells
    renamed = list(cells)
    for place in places:
        if renamed[place] >= 0:
            renamed[place] = names[renamed[place]]
    return tuple(renamed)


def _order(local: Local) -> _Order:
    return local.variables, local.bag, local.busy, local.point or (), local.clock


# --- runs ----------------------------------------------------------------------------------------


def run_of(
    view: Views, orbits: Orbits, codes: Sequence[int], failing: int = -1, loop: int | None = None
) -> Run:
    """A run of the model for one through canonical states, as `Teller.trace` takes them.

    What is a cycle of orbits is gone through until the rebecs have their own names again.
    """
    walk = _Walk(view, orbits)
    for code in codes:
        walk.follow(code)
    if loop is not None:
        cycle = codes[loop + 1 :]
        while walk.states[-1] != walk.states[loop]:
            for code in cycle:
                walk.follow(code)
    ordinal = walk.fail(failing) if failing >= 0 else failing
    return Run(tuple(walk.path), ordinal, loop, walk.names)


class _Walk:
    """A run of the model beside the canonical states: `names` lead from these to its states."""

    def __init__(self, view: Views, orbits: Orbits) -> None:
        self.path: list[int] = []
        self.states: list[State] = []
        self._view = view
        self._orbits = orbits
        self._canonical: State = ()
        self.names: Permutation = tuple(range(len(view.actors)))

    def follow(self, code: int) -> None:
        """Takes the step that leads where that of the code leads."""
        group = self._orbits.symmetry.group
        ordinal, turn = divmod(code, len(group))
        before = self.states[-1] if self.states else ()
        steps, step = self._steps(before), self._steps(self._canonical)[ordinal]
        assert not isinstance(step.result, Failure)
        state = self._orbits.image(step.result, group.index(self.names))
        found = next(
            n for n, each in enumerate(steps) if (each.result, each.time) == (state, step.time)
        )
        self.path.append(found)
        self.states.append(state)
        self._canonical = self._orbits.image(step.result, turn)
        self.names = tuple(self.names[rebec] for rebec in inverse(group[turn]))

    def _steps(self, state: State) -> Sequence[Step]:
        return self._view.steps(state) if self.path else self._view.initial_states()

    def fail(self, ordinal: int) -> int:
        """The ordinal of the step that fails as one of the canonical state does."""
        before = self.states[-1] if self.states else ()
        failure = self._steps(self._canonical)[ordinal].result
        assert isinstance(failure, Failure)
        renamed = replace(failure, rebec=self.names[failure.rebec])
        return next(n for n, each in enumerate(self._steps(before)) if each.result == renamed)
