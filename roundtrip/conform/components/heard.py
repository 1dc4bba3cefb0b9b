"""Recordings of topics: which there are, and the messages on those that are asked for."""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Mapping, Sequence

from rebsync.records import dataclass
from rebsync.roundtrip.conform.bags import OwnTypes
from rebsync.roundtrip.conform.reading import check_readable, events_of
from rebsync.roundtrip.conform.recording import Event, Heard, Place
from rebsync.roundtrip.conform.topics import Convert, Message, Topic


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
        self._topics = {name: Topic(name, "", _convert(name, at)) for name, at in wanted.items()}

    def topic(self, name: str, path: str) -> Topic | None:
        """The topic, if its messages are wanted."""
        return self._topics.get(absolute(name))


def absolute(name: str) -> str:
    """The name of a topic as ROS resolves it."""
    return f"/{name.strip('/')}"


def _convert(name: str, paths: Sequence[str]) -> Convert:
    split = [path.split(".") for path in paths]

    def convert(message: Message, stamp: float, place: Place, publisher: str) -> Event:
        return Heard(name, tuple(_at(message, words) for words in split), stamp, place, publisher)

    return convert


def _at(message: object, words: Sequence[str]) -> object:
    for word in words:
        message = message[word] if isinstance(message, Mapping) else getattr(message, word)
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
        """The messages on some topics, with the fields at the paths that are asked for."""
        choice = _FieldChoice(wanted)
        streams = [events_of(path, n, choice, self.own) for n, path in enumerate(self.paths)]
        if len(streams) == 1:
            return streams[0]
        return heapq.merge(*streams, key=lambda event: event.stamp)
