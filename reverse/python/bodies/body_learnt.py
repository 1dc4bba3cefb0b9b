"""What reading the bodies of a package's Python learns, and who asked for which of it."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import field as with_default
from typing import TypeAlias, TypeVar

from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.needs import Mark
from rebsync.reverse.python.bodies.body_scope import Key
from rebsync.reverse.python.expressions.values import OTHER, REAL, WHOLE, Kind

_T = TypeVar("_T")
# A question about what is known, with what it is about.
Asked: TypeAlias = tuple[Callable[..., object], Hashable]
_CHANGED = object()  # of a question that got several answers: no later answer is equal to it


@dataclass(eq=False, slots=True)
class Learnt:
    """What is known of all bodies of a package so far: each round of reading adds to it.

    `kinds` are those of variables; `mixed` those of floats that also get whole numbers, and of
    texts that also get None; `used` are
    the fields that servers read, `wanted` those of messages in variables that something reads;
    `open` those whose values nobody knows; `refused` are expressions that may leave the model's
    `int`; on `pending` variables something stood in the last reading.
    Reading a unit asks for these by the methods alone, so that `answers` is all that it depends on:
    while they are the same, it would be read the same again.
    """

    kinds: dict[Key, Kind] = with_default(default_factory=dict)
    mixed: set[Key] = with_default(default_factory=set)
    used: dict[tuple[str, str], set[str]] = with_default(default_factory=dict)
    open: set[tuple[str, str, str]] = with_default(default_factory=set)
    wanted: set[Key] = with_default(default_factory=set)
    refused: set[Mark] = with_default(default_factory=set)
    pending: set[Key] = with_default(default_factory=set)
    answers: dict[Asked, object] = with_default(default_factory=dict)
    changes: int = 0
    # How many answers there were when the shape of a variable was asked for the first time.
    _first: dict[Key, int] = with_default(default_factory=dict)

    # --- what is asked --------------------------------------------------------------------------

    def start(self) -> None:
        """From here on it is noted anew what is asked, and what stands on nothing."""
        self.answers, self.pending, self._first = {}, set(), {}

    def is_same(self, answers: dict[Asked, object]) -> bool:
        """Whether some answers are what the same questions would get now."""
        return all(question(about) == found for (question, about), found in answers.items())

    def _noted(self, question: Callable[..., object], about: Hashable, found: _T) -> _T:
        if self.answers.setdefault((question, about), found) != found:
            self.answers[question, about] = _CHANGED
        return found

    def kind(self, key: Key) -> Kind | None:
        """What a variable holds; None: nothing is known yet."""
        return self._noted(self._kind, key, self.kinds.get(key))

    def _kind(self, key: Key) -> Kind | None:
        return self.kinds.get(key)

    def shape(self, key: Key) -> Kind:
        """The type of message that a variable holds, or OTHER; empty for a value of the model."""
        self._first.setdefault(key, len(self.answers))
        return self._noted(self._shape, key, self._shape(key))

    def settle(self, key: Key, since: int) -> None:
        """Takes what a variable holds now for what was answered, which makes no difference.

        That is for who asked; not if its shape was asked for earlier than `since` answers.
        """
        if self._first.get(key, -1) >= since:
            self.answers[self._shape, key] = self._shape(key)

    def _shape(self, key: Key) -> Kind:
        kind = self.kinds.get(key)
        return kind if kind is not None and (kind == OTHER or "/" in kind) else ""

    def messages(self) -> frozenset[Kind]:
        """The types of messages that some variables hold."""
        return self._noted(self._messages, (), self._messages(()))

    def _messages(self, _: Hashable) -> frozenset[Kind]:
        return frozenset(kind for kind in self.kinds.values() if "/" in kind)

    def is_mixed(self, key: Key) -> bool:
        """Whether a variable of floats also gets whole numbers, one of texts also None."""
        return self._noted(self._is_mixed, key, key in self.mixed)

    def _is_mixed(self, key: Key) -> bool:
        return key in self.mixed

    def used_of(self, unit: str, server: str) -> frozenset[str]:
        """The fields of its message that a server reads."""
        return self._noted(self._used_of, (unit, server), self._used_of((unit, server)))

    def _used_of(self, server: tuple[str, str]) -> frozenset[str]:
        return frozenset(self.used.get(server, ()))

    def is_wanted(self, key: Key) -> bool:
        """Whether something reads a field of a message in a variable."""
        return self._noted(self._is_wanted, key, key in self.wanted)

    def _is_wanted(self, key: Key) -> bool:
        return key in self.wanted

    def is_open(self, unit: str, server: str, path: str) -> bool:
        """Whether nobody knows the value of a field that a server gets."""
        about = unit, server, path
        return self._noted(self._is_open, about, about in self.open)

    def _is_open(self, about: tuple[str, str, str]) -> bool:
        return about in self.open

    def is_refused(self, mark: Mark) -> bool:
        """Whether an expression may leave the numbers of the model."""
        return self._noted(self._is_refused, mark, mark in self.refused)

    def _is_refused(self, mark: Mark) -> bool:
        return mark in self.refused

    def is_carried(self, name: str, as_parameter: Callable[[str], str]) -> bool:
        """Whether a field that some server reads is a parameter of this name."""
        about = name, as_parameter
        return self._noted(self._is_carried, about, self._is_carried(about))

    def _is_carried(self, about: tuple[str, Callable[[str], str]]) -> bool:
        name, as_parameter = about
        return any(as_parameter(path) == name for used in self.used.values() for path in used)

    # --- what is learnt -------------------------------------------------------------------------

    def join(self, key: Key, kind: Kind) -> None:
        """A variable gets a value of a kind."""
        known = self.kinds.get(key)
        both = {known, kind}
        if known is None or known == kind:
            found = kind
        elif both == {WHOLE, REAL}:
            found = REAL
            self.mix(key)
        else:
            found = OTHER
        if found != known:
            self.kinds[key] = found
            self.changes += 1

    def mix(self, key: Key) -> None:
        """A variable of floats gets a whole number, or one of texts None."""
        if key not in self.mixed:
            self.mixed.add(key)
            self.changes += 1

    def use(self, unit: str, server: str, path: str) -> None:
        """A server reads a field of its message."""
        fields = self.used.setdefault((unit, server), set())
        if path not in fields:
            fields.add(path)
            self.changes += 1

    def want(self, key: Key) -> None:
        """A field of a message in a variable is read."""
        if key not in self.wanted:
            self.wanted.add(key)
            self.changes += 1

    def leave_open(self, unit: str, server: str, path: str) -> None:
        """A server gets a field of which nobody knows the value."""
        if (unit, server, path) not in self.open:
            self.open.add((unit, server, path))
            self.changes += 1

    def refuse(self, mark: Mark) -> None:
        """An expression may leave the numbers of the model."""
        if mark not in self.refused:
            self.refused.add(mark)
            self.changes += 1
