"""Symmetry reduction: states that differ only by an exchange of equal rebecs are one.

A permutation of the rebecs is an *automorphism* when it keeps classes, priorities and bindings.
Bodies can do nothing with a rebec but compare it, send to it and keep it, and see only their own
rebec; so renaming all rebecs of a state along an automorphism renames its steps, and nothing else.
The automorphisms under which every predicate is invariant are a group, and the states modulo its
orbits are bisimilar to all states (Clarke, Enders, Filkorn & Jha 1996; Emerson & Sistla 1996):
failures, deadlocks, standing time and formulas over such predicates have one verdict in both.

Constructors and their arguments only make the initial states, which need not be symmetric: what is
reached from a state is, up to renaming, what is reached from any other of its orbit.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rebsync.checker.exploration import Exploration
from rebsync.checker.invariance import Invariance
from rebsync.checker.problem import Options, Problem
from rebsync.checker.program import NULL, Program
from rebsync.checker.references import References, references_of
from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass

LARGEST = 5040  # permutations, as seven equal rebecs have: each new state is compared under all

OWN, OTHER = -2, -3  # what stands for rebecs in a blind

Permutation = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Symmetry:
    """A group of automorphisms of a program, the identity first; of order 1 it reduces nothing."""

    group: tuple[Permutation, ...] = ((),)
    references: References = References((), (), {}, ())

    @property
    def order(self) -> int:
        """How many permutations there are."""
        return len(self.group)

    @property
    def orbits(self) -> tuple[tuple[int, ...], ...]:
        """The rebecs that are exchanged, together with those that take their places."""
        orbits = (tuple(sorted(set(images))) for images in zip(*self.group, strict=True))
        return tuple(dict.fromkeys(orbit for orbit in orbits if len(orbit) > 1))

    @property
    def movable(self) -> tuple[int, ...]:
        """The rebecs that are exchanged, in the order of main."""
        return tuple(sorted(rebec for orbit in self.orbits for rebec in orbit))

    @property
    def blinds(self) -> tuple[Permutation, ...]:
        """For each movable rebec what tells it from the other movable ones, and not those apart."""
        movable = self.movable
        return tuple(
            tuple(
                OWN if r == rebec else OTHER if r in movable else r
                for r in range(len(self.group[0]))
            )
            for rebec in movable
        )


def inverse(permutation: Permutation) -> Permutation:
    """The permutation that undoes one."""
    return tuple(sorted(range(len(permutation)), key=permutation.__getitem__))


def symmetry_of(program: Program, problem: Problem, options: Options) -> Symmetry:
    """The symmetries under which what is asked is invariant, if they are asked for.

    Raises RebsyncError when there are none, or something tells rebecs apart in a way of its own.
    """
    if not options.symmetry:
        return Symmetry()
    found = symmetry_or_reason(program, problem, options)
    if isinstance(found, Symmetry):
        return found
    message, hint = f"no symmetry reduction: {found}", "leave --symmetry out"
    raise RebsyncError.of(problem.source.path, "RS932", message, hint)


def symmetry_or_reason(
    program: Program, problem: Problem, options: Options, largest: int = LARGEST
) -> Symmetry | str:
    """Up to `largest` symmetries under which what is asked is invariant; else why none are."""
    if reason := _obstacle(program, problem, options):
        return reason
    candidates = _largest_group(program, largest)
    if len(candidates) == 1:
        return "no two rebecs have one class, one priority and equal known rebecs"
    invariance = Invariance(problem, program)
    group = tuple(p for p in candidates if invariance.holds(p))
    if len(group) == 1:
        names = ", ".join(invariance.broken(candidates))
        return f"equal rebecs are told apart by {names}"
    references = references_of(program)
    if program.has_delay and references.mixed:
        return f"{', '.join(references.mixed)} has over a delay what may be a rebec or a number"
    return Symmetry(group, references)


def _obstacle(program: Program, problem: Problem, options: Options) -> str | None:
    """What does not go with symmetries, if there is any."""
    if options.reduce:
        return "--reduce goes by the order of rebecs"
    if problem.properties.ltl and options.fairness == "weak":
        return "weak fairness is about single rebecs"
    if problem.between:
        return "--time-between needs all states"
    if any(server.depth for server in program.servers):
        return "of messages that came at one time @KeepLast loses one by the order of rebecs"
    return None


def over_orbits(found: Exploration, symmetry: Symmetry) -> Exploration:
    """A search of canonical states as one of all.

    The largest bag of a rebec is that of any rebec of its orbit: where constructors make them
    differ, it need not have been its own.
    """
    largest = list(found.covered.largest)
    for orbit in symmetry.orbits:
        for rebec in orbit:
            largest[rebec] = max(found.covered.largest[r] for r in orbit)
    return replace(found, covered=replace(found.covered, largest=tuple(largest)))


def counted_once(symmetry: Symmetry, program: Program) -> str:
    """What a search up to an exchange of rebecs says of its figures."""
    exchanged = "; ".join(", ".join(program.rebecs[r].name for r in o) for o in symmetry.orbits)
    return f"states that differ by an exchange are counted once ({symmetry.order}: {exchanged})"


def _largest_group(program: Program, largest: int) -> tuple[Permutation, ...]:
    """Automorphisms, all that leave some rebecs where they are: not more than `largest`."""
    fixed: frozenset[int] = frozenset()
    while True:
        group = []
        for automorphism in _automorphisms(program, fixed):
            group.append(automorphism)
            if len(group) > largest:
                break
        else:
            return tuple(group)
        moved = next(r for r in range(len(program.rebecs)) if any(p[r] != r for p in group))
        fixed = frozenset(range(moved + 1))  # the group is found from its last rebecs on


def _automorphisms(program: Program, fixed: frozenset[int]) -> Iterator[Permutation]:
    """All automorphisms that leave some rebecs where they are, in lexicographic order."""
    rebecs = program.rebecs

    def alike(one: int, other: int) -> bool:
        if one in fixed or other in fixed:
            return one == other
        a, b = rebecs[one], rebecs[other]
        return (a.class_index, a.priority) == (b.class_index, b.priority)

    def fits(images: list[int], rebec: int) -> bool:
        """Whether the bindings of a rebec are those of its image, as far as images are known."""
        bound = zip(rebecs[rebec].known, rebecs[images[rebec]].known, strict=True)
        return all(
            (a == b if NULL in (a, b) else images[a] == b if a < len(images) else b not in images)
            for a, b in bound
        )

    def extended(images: list[int]) -> Iterator[Permutation]:
        count = len(images)
        if count == len(rebecs):
            yield tuple(images)
            return
        for image in range(len(rebecs)):
            if image not in images and alike(count, image):
                longer = [*images, image]
                if all(fits(longer, rebec) for rebec in range(len(longer))):
                    yield from extended(longer)

    yield from extended([])
