"""Recordings of one run as one stream of events, by time."""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path

from rebsync.conform.bags import OwnTypes
from rebsync.conform.recording import Event, Recording, Served, Truncated
from rebsync.conform.topic_filter import TopicChoice, TopicFilter
from rebsync.conform.topics import Topics
from rebsync.diagnostics import RebsyncError
from rebsync.package import Package
from rebsync.records import dataclass

_REMEMBERED = 10_000  # state messages that two files may be apart
_LOGS = (".jsonl", ".json", ".ndjson", ".log")


@dataclass(frozen=True, slots=True)
class Recordings:
    """Some files of one run; `namespace` is the one of the nodes, None where there is only one."""

    paths: tuple[str, ...]
    topics: Topics
    package: Package
    namespace: str | None = None

    def events(self, with_sent: bool = False) -> Iterator[Event]:
        """What was recorded, by stamps; of one file in its order. RebsyncError: see readers.

        Where one file cannot be read on all end: what the others have is no whole run.
        """
        wanted = TopicFilter(self.topics, self.namespace, with_sent)
        own = OwnTypes.of(self.package) if any(map(_is_bag, self.paths)) else OwnTypes("", {})
        streams = [events_of(path, n, wanted, own) for n, path in enumerate(self.paths)]
        if len(streams) == 1:
            return streams[0]
        return _once(heapq.merge(*streams, key=lambda event: event.stamp))


@dataclass(frozen=True, slots=True)
class InOrderOfStamps:
    """A recording whose files have their messages in another order, as bags put together do."""

    recording: Recording

    @property
    def paths(self) -> tuple[str, ...]:
        """The files."""
        return self.recording.paths

    def events(self, with_sent: bool = False) -> Iterator[Event]:
        """What was recorded, by stamps."""
        return iter(sorted(self.recording.events(with_sent), key=lambda event: event.stamp))


def _once(events: Iterator[Event]) -> Iterator[Event]:
    """The events without those that another file has as well; each file may have one repeated."""
    counts: dict[tuple[object, ...], dict[int, int]] = {}
    for event in events:
        if isinstance(event, Truncated):
            yield event
            return
        if not isinstance(event, Served):
            yield event
            continue
        key = event[:7]
        of_files = counts.pop(key, {})
        most = max(of_files.values(), default=0)
        of_files[event.place.file] = of_files.get(event.place.file, 0) + 1
        counts[key] = of_files
        if of_files[event.place.file] > most:
            yield event
        if len(counts) > _REMEMBERED:
            counts.pop(next(iter(counts)))


def recordings(
    paths: Sequence[str], topics: Topics, package: Package, namespace: str | None
) -> Recordings:
    """Recordings by their paths. RebsyncError: one is not there, or needs what is not installed."""
    check_readable(paths)
    return Recordings(tuple(paths), topics, package, namespace)


def check_readable(paths: Sequence[str]) -> None:
    """RebsyncError: one is not there, or needs what is not installed."""
    for path in paths:
        if not Path(path).exists():
            raise RebsyncError.of(path, "RS801", "no such file or directory")
        if _is_bag(path) and find_spec("rosbags") is None:
            from rebsync.conform.bags import INSTALL

            raise RebsyncError.of(
                path, "RS981", "bags are read by rosbags, which is not installed", INSTALL
            )


def _is_bag(path: str) -> bool:
    return Path(path).is_dir() or Path(path).suffix not in _LOGS


def events_of(path: str, file: int, wanted: TopicChoice, own: OwnTypes) -> Iterator[Event]:
    """The events of one file that are wanted; `own` are types that it may lack."""
    if not _is_bag(path):
        from rebsync.conform.jsonlines import events

        return events(path, file, wanted)
    from rebsync.conform.bags import events_1, events_2

    is_1 = Path(path).is_file() and (".bag" in Path(path).suffixes[-2:])
    return (events_1 if is_1 else events_2)(path, file, wanted, own)
