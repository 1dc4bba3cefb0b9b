"""Automata that accept the runs on which a formula of LTL holds.

A state is a set of formulas that must hold from now on. A move reads the predicates of one state
of the run; it leaves formulas for the next one, and *promises* the right side of each until that it
puts off. A run is accepted when no promise is made for ever.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from dataclasses import field
from typing import NamedTuple

from rebsync.checker.formulas import Formula
from rebsync.checker.look import Look, unwatched
from rebsync.checker.temporal.components import components
from rebsync.checker.temporal.terms import FALSE, TRUE, Terms
from rebsync.records import dataclass
from rebsync.unions import assert_never


class Move(NamedTuple):
    """A move: predicates (bits) that must be true and false, the next state, promises (bits)."""

    needs: int
    forbids: int
    target: int
    promises: int


@dataclass(frozen=True, slots=True)
class Automaton:
    """Starts in state 0; bit b of a move is predicate `predicates[b]`.

    `promises` has one bit for each until. `home` numbers the components in which a run can stay
    and be accepted; it is -1 elsewhere. `anything` is the state that accepts every run, or -1.
    States that accept no run are left out, all but the first.
    """

    predicates: tuple[int, ...]
    moves: tuple[tuple[Move, ...], ...]
    promises: int
    home: tuple[int, ...]
    anything: int


def translate(formula: Formula, wanted: bool = True, look: Look = unwatched) -> Automaton:
    """The automaton of a formula, or of its negation; `look` is called now and then.

    ValueError: it has operators of TCTL.
    """
    translation = _Translation(look)
    moves = _without_dead_ends(_merged(translation.run(formula, wanted), look), look)
    promises = (1 << len(translation.promised)) - 1
    anything = next((s for s, own in enumerate(moves) if own == [Move(0, 0, s, 0)]), -1)
    return Automaton(
        tuple(translation.predicates),
        tuple(tuple(own) for own in moves),
        promises,
        tuple(_homes(moves)),
        anything,
    )


class _Part(NamedTuple):
    """A move under construction; `todo` and `later` have a bit for each term."""

    needs: int
    forbids: int
    later: int
    promises: int
    todo: int
    done: int


@dataclass(slots=True)
class _Translation:
    """Sets of formulas become states; terms, predicates and promises become bits."""

    look: Look = unwatched
    terms: Terms = field(default_factory=Terms)
    predicates: dict[int, int] = field(default_factory=dict)
    promised: dict[int, int] = field(default_factory=dict)

    def run(self, formula: Formula, wanted: bool) -> list[list[Move]]:
        """The moves of each state; state 0 is the formula."""
        start = self._bits(self.terms.build(formula, wanted))
        states, moves = {start: 0}, list[list[Move]]()
        waiting = [start]
        for obligations in waiting:  # grows
            own = []
            for part in _strongest(self._expand(obligations), self.look):
                if part.later not in states:
                    states[part.later] = len(waiting)
                    waiting.append(part.later)
                own.append(Move(part.needs, part.forbids, states[part.later], part.promises))
            moves.append(own)
        return moves

    def _bits(self, term: int) -> int:
        """A conjunction as the set of its parts."""
        node = self.terms[term]
        if node.operator == "and":
            return self._bits(node.left) | self._bits(node.right)
        return 0 if term == TRUE else 1 << term

    def _expand(self, obligations: int) -> Iterator[_Part]:
        waiting = [_Part(0, 0, 0, 0, obligations, 0)]
        while waiting:
            self.look()
            part = waiting.pop()
            if not part.todo:
                yield part
                continue
            term = part.todo.bit_length() - 1
            rest = part._replace(todo=part.todo & ~(1 << term), done=part.done | 1 << term)
            waiting.extend(p for p in reversed(self._ways(term, rest)) if not p.needs & p.forbids)

    def _ways(self, term: int, part: _Part) -> list[_Part]:
        """The ways to fulfil a term, what is due now first."""
        operator, left, right = self.terms[term]
        match operator:
            case "true":
                return [part]
            case "false":
                return []
            case "is":
                return [part._replace(needs=part.needs | self._bit(self.predicates, left))]
            case "not":
                return [part._replace(forbids=part.forbids | self._bit(self.predicates, left))]
            case "next":
                return [part._replace(later=part.later | self._bits(left))]
            case "and":
                return self._now(part, left, right)
            case "or":
                return [*self._now(part, left), *self._now(part, right)]
            case "until":
                later = part.later | 1 << term
                promises = part.promises | self._bit(self.promised, term)
                put_off = part._replace(later=later, promises=promises)
                return [*self._now(part, right), *self._now(put_off, left)]
            case "release":
                kept = part._replace(later=part.later | 1 << term)
                return [*self._now(part, left, right), *self._now(kept, right)]
            case _:
                assert_never(operator)

    def _now(self, part: _Part, *terms: int) -> list[_Part]:
        """The part with more to do at once; none if that is impossible."""
        if FALSE in terms:
            return []
        bits = 0
        for term in terms:
            bits |= self._bits(term)
        return [part._replace(todo=part.todo | bits & ~part.done)]

    def _bit(self, numbers: dict[int, int], key: int) -> int:
        return 1 << numbers.setdefault(key, len(numbers))


def _strongest(parts: Iterator[_Part], look: Look) -> list[_Part]:
    """Without the moves that ask for all that another one asks for, and for more.

    A run that is accepted can always fulfil what holds now and put off only what does not; a
    move that asks for less is as good at that, so no word is lost.
    """
    kept: list[_Part] = []
    for part in parts:
        look()
        if not any(_asks_less(other, part) for other in kept):
            kept = [other for other in kept if not _asks_less(part, other)]
            kept.append(part)
    return kept


def _asks_less(one: _Part, other: _Part) -> bool:
    return not (
        one.needs & ~other.needs
        or one.forbids & ~other.forbids
        or one.later & ~other.later
        or one.promises & ~other.promises
    )


def _merged(moves: list[list[Move]], look: Look) -> list[list[Move]]:
    """States that move alike become one: the coarsest bisimulation."""
    classes, count = [0] * len(moves), 1
    while True:
        look()
        numbers: dict[frozenset[Move], int] = {}
        alike = [frozenset(m._replace(target=classes[m.target]) for m in own) for own in moves]
        classes = [numbers.setdefault(own, len(numbers)) for own in alike]
        if len(numbers) == count:
            break
        count = len(numbers)
    merged: list[list[Move]] = [[] for _ in range(count)]
    for state, own in enumerate(moves):
        look()
        if not merged[classes[state]]:
            merged[classes[state]] = _fewest([m._replace(target=classes[m.target]) for m in own])
    return merged


def _fewest(moves: list[Move]) -> list[Move]:
    """Without moves to the same state that another one makes needless."""
    kept: list[Move] = []
    for move in moves:
        if not any(_covers(other, move) for other in kept):
            kept = [other for other in kept if not _covers(move, other)]
            kept.append(move)
    return kept


def _covers(one: Move, other: Move) -> bool:
    return one.target == other.target and not (
        one.needs & ~other.needs or one.forbids & ~other.forbids or one.promises & ~other.promises
    )


def _homes(moves: list[list[Move]]) -> list[int]:
    """The component of each state, -1 when a run cannot stay in it and be accepted."""
    first, target = array("q", [0]), array("q")
    for own in moves:
        target.extend(move.target for move in own)
        first.append(len(target))
    component = components(first, target)
    unkept: dict[int, int] = {}  # promises that every move within the component makes
    for state, own in enumerate(moves):
        for move in own:
            if component[move.target] == component[state]:
                home = component[state]
                unkept[home] = unkept.get(home, -1) & move.promises
    return [c if unkept.get(c, -1) == 0 else -1 for c in component]


def _without_dead_ends(moves: list[list[Move]], look: Look) -> list[list[Move]]:
    """Only states that accept some run, and the first."""
    alive = {state for state, home in enumerate(_homes(moves)) if home >= 0}
    size = -1
    while size != len(alive):
        look()
        size = len(alive)
        alive |= {s for s, own in enumerate(moves) if any(m.target in alive for m in own)}
    kept = [s for s in range(len(moves)) if s in alive or s == 0]
    number = {state: n for n, state in enumerate(kept)}
    return [
        [m._replace(target=number[m.target]) for m in moves[state] if m.target in alive]
        for state in kept
    ]
