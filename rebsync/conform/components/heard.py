"""Recordings of topics: which there are, and the messages on those that are asked for."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice, zip_longest
from typing import Any

from rebsync.conform.bags import OwnTypes
from rebsync.conform.components.spool import Spool
from rebsync.conform.reading import check_readable, events_of
from rebsync.conform.recording import Event, Heard, Place
from rebsync.conform.topics import Message, Topic
from rebsync.records import dataclass


class _Names:
    """Collects the names of all topics, and reads none."""

    def __init__(self) -> None:
        self.all: dict[str, None] = {}

    def topic(self, name: str, path: str) -> None:
        """Nothing: the name is all that is wanted."""
        self.all[absolute(name)] = None


class _FieldChoice:
    """Reads of topics the fields at some paths."""

    def __init__(self, wanted: Mapping[str, Sequence[str]]) -> None:
        self._topics = {name: _topic(name, at) for name, at in wanted.items()}

    def topic(self, name: str, path: str) -> Topic | None:
        """The topic, if its messages are wanted."""
        return self._topics.get(absolute(name))


def absolute(name: str) -> str:
    """The name of a topic as ROS resolves it."""
    return f"/{name.strip('/')}"


def _topic(name: str, paths: Sequence[str]) -> Topic:
    split = [path.split(".") for path in paths]

    def build(values: Sequence[object], stamp: float, place: Place, publisher: str) -> Event:
        return Heard(name, tuple(values), stamp, place.file, place.number, publisher)

    def convert(message: Message, stamp: float, place: Place, publisher: str) -> Event:
        return build([_at(message, words) for words in split], stamp, place, publisher)

    return Topic(name, "", convert, False, tuple(paths), build)


def _at(message: Any, words: Sequence[str]) -> object:  # noqa: ANN401
    for word in words:
        message = message[word]
    return message


@dataclass(frozen=True, slots=True)
class HeardRecordings:
    """Files of one run, read as messages on topics; `own` are the types of the package."""

    paths: tuple[str, ...]
    own: OwnTypes

    @classmethod
    def of(cls, paths: Sequence[str], own: OwnTypes) -> HeardRecordings:
        """Files by their paths. RebsyncError: one is not there, or needs what is not installed."""
        check_readable(paths)
        return cls(tuple(paths), own)

    def topics(self) -> tuple[str, ...]:
        """The names of the topics that were recorded."""
        names = _Names()
        for number, path in enumerate(self.paths):
            for _ in events_of(path, number, names, self.own):
                pass
        return tuple(sorted(names.all))

    def events(self, wanted: Mapping[str, Sequence[str]]) -> Iterator[Event]:
        """The messages on some topics, with the fields at the paths that are asked for.

        Where several files have a topic at the same time, those of the one that began first.
        """
        if len(self.paths) == 1:
            return self._merged(wanted)
        spans = self._spans(wanted)
        return (e for e in self._merged(wanted) if not (isinstance(e, Heard) and spans.has_two(e)))

    def recorded_twice(self, wanted: Mapping[str, Sequence[str]]) -> dict[str, bool]:
        """Topics that several files have at the same time, and if these say the same of them."""
        if len(self.paths) == 1:
            return {}
        spans = self._spans(wanted)
        shared: dict[str, dict[int, Spool[tuple[object, ...]]]] = {}
        for event in self._merged(wanted):
            if isinstance(event, Heard) and spans.is_shared(event):
                files = shared.setdefault(event.topic, {})
                files.setdefault(event.file, Spool()).append(event.values)
        return {topic: _agree(list(files.values())) for topic, files in shared.items()}

    def _merged(self, wanted: Mapping[str, Sequence[str]]) -> Iterator[Event]:
        choice = _FieldChoice(wanted)
        streams = [events_of(path, n, choice, self.own) for n, path in enumerate(self.paths)]
        return heapq.merge(*streams, key=lambda event: event.stamp)

    def _spans(self, wanted: Mapping[str, Sequence[str]]) -> _Spans:
        spans = _Spans()
        for event in self._merged(wanted):
            if isinstance(event, Heard):
                spans.see(event)
        return spans


def _agree(files: Sequence[Spool[tuple[object, ...]]]) -> bool:
    """Whether all have the same values, but for one more at either end of what they share."""
    first, *others = files
    ends = [(begin, end) for begin in (0, 1) for end in (0, 1)]
    return bool(others) and all(
        any(
            _is_equal(islice(first, a, len(first) - b), islice(other, c, len(other) - d))
            for a, b in ends
            for c, d in ends
        )
        for other in others
    )


def _is_equal(one: Iterable[object], other: Iterable[object]) -> bool:
    return all(str(a) == str(b) for a, b in zip_longest(one, other, fillvalue=""))


class _Spans:
    """When each file has its first and its last message on a topic."""

    def __init__(self) -> None:
        self._of: dict[str, dict[int, tuple[float, float]]] = {}

    def see(self, heard: Heard) -> None:
        """Takes a message into account."""
        files = self._of.setdefault(heard.topic, {})
        first, last = files.get(heard.file, (heard.stamp, heard.stamp))
        files[heard.file] = min(first, heard.stamp), max(last, heard.stamp)

    def is_shared(self, heard: Heard) -> bool:
        """Whether another file has messages on the topic before and after this one."""
        return any(self._others(heard))

    def has_two(self, heard: Heard) -> bool:
        """Whether one that began before does, so that it has the message, too."""
        own = heard.file
        begun = self._of[heard.topic][own][0], own
        return any((first, file) < begun for file, first in self._others(heard))

    def _others(self, heard: Heard) -> Iterator[tuple[int, float]]:
        for file, (first, last) in self._of[heard.topic].items():
            if file != heard.file and first <= heard.stamp <= last:
                yield file, first
