"""Bags of ROS 1 and ROS 2 as events; the message types are those of the recording, or the model's.

Types and the storages of ROS 2 are read by rosbags, without an installation of ROS.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from operator import attrgetter
from pathlib import Path, PurePath
from typing import Any

from rebsync.diagnostics import RebsyncError
from rebsync.files import os_mistake
from rebsync.forward.message_files import message_files
from rebsync.package import Package
from rebsync.records import dataclass
from rebsync.roundtrip.conform.mcap import whole_records
from rebsync.roundtrip.conform.recording import Event, Place, Truncated
from rebsync.roundtrip.conform.rosbag1 import Connection, DamagedBag, intact_records
from rebsync.roundtrip.conform.topic_filter import TopicChoice
from rebsync.roundtrip.conform.topics import Topic

_NANO = 1e-9
INSTALL = "pip install 'rebsync[bags]'"

Decode = Callable[[Any], object]
Make = Callable[[Any, float, Place, str], Event]


@dataclass(frozen=True, slots=True)
class OwnTypes:
    """The texts of the message types of a package by their names, for bags that lack them."""

    package: str
    texts: Mapping[str, str]

    @classmethod
    def of(cls, package: Package) -> OwnTypes:
        """Those of a package that a model makes."""
        files = message_files(package)
        texts = {Path(f).stem: text for f, text in files.items() if f.endswith(".msg")}
        return cls(package.name, texts)


class _Fields(Mapping[str, Any]):
    """A message of rosbags by the names of its fields."""

    __slots__ = ("_message",)

    def __init__(self, message: object) -> None:
        self._message = message

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401
        try:
            return getattr(self._message, name)
        except AttributeError:
            raise KeyError(name) from None

    def __iter__(self) -> Iterator[str]:
        return iter(getattr(self._message, "__dataclass_fields__", ()))

    def __len__(self) -> int:
        return len(getattr(self._message, "__dataclass_fields__", ()))


class _Source:
    """What makes events of the raw messages of one file."""

    def __init__(
        self, path: str, file: int, wanted: TopicChoice, own: OwnTypes, is_2: bool
    ) -> None:
        self.path, self.file, self.wanted = path, file, wanted
        self.own, self.is_2 = own, is_2
        self.number = 0
        self.latest = 0  # ns, of the messages that were read

    def decoder(self, type_: str, definition: str, topic: Topic) -> Decode:
        """What makes a message of bytes. RebsyncError: the type cannot be known."""
        from rosbags.interfaces.typing import Typesdict
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        store = get_typestore(Stores.ROS2_HUMBLE if self.is_2 else Stores.ROS1_NOETIC)
        name = type_ if "/msg/" in type_ else type_.replace("/", "/msg/", 1)
        try:
            types: Typesdict = {}
            if definition:
                types.update(get_types_from_msg(definition, name))
            elif name not in store.fielddefs:
                owner = name.split("/")[0]
                for stem, text in self.own.texts.items():
                    renamed = text.replace(f"{self.own.package}/", f"{owner}/")
                    types.update(get_types_from_msg(renamed, f"{owner}/msg/{stem}"))
            store.register({k: v for k, v in types.items() if k not in store.fielddefs})
            found = store.get_msgdef(name)
        except Exception as error:
            raise self.wrong(f"the type {type_} of {topic.name} is not known: {error}") from None
        cls: Any = found.cls
        if not self.is_2:
            read1 = found.deserialize_ros1
            return lambda raw: read1(raw, 0, cls, store)[0]
        return lambda raw: store.deserialize_cdr(raw, name)

    def maker(self, type_: str, definition: str, topic: Topic) -> Make:
        """What makes an event of bytes. RebsyncError: the type cannot be known."""
        decode, convert, build = self.decoder(type_, definition, topic), topic.convert, topic.build
        if build is None or not topic.fields:
            return lambda raw, *said: convert(_Fields(decode(raw)), *said)
        read = attrgetter(*topic.fields)
        if len(topic.fields) == 1:
            return lambda raw, *said: build((read(decode(raw)),), *said)
        return lambda raw, *said: build(read(decode(raw)), *said)

    def event(self, topic: str, make: Make, raw: object, time: int, node: str) -> Event:
        """The event of a message. RebsyncError: it is not as its type says."""
        self.latest = max(self.latest, time)
        try:
            return make(raw, time * _NANO, Place(self.file, self.number), node)
        except KeyError as error:
            what = f"has no field {error}"
        except AttributeError as error:
            what = f"has no field {error.name!r}"
        except Exception as error:
            what = f"is not as its type says: {error}"
        text = f"message {self.number} of {topic} {what}"
        raise RebsyncError.of(self.path, "RS983", text, "is it a recording of this model?")

    def end(self, why: str) -> Event:
        """That the file cannot be read on. RebsyncError: nothing of it can be read."""
        if not self.number:
            raise self.wrong(why)
        place = Place(self.file, self.number)
        return Truncated(
            f"{self.path} cannot be read after message {self.number}: {why}",
            self.latest * _NANO,
            place,
        )

    def wrong(self, what: str, hint: str | None = None) -> RebsyncError:
        """The mistake that the file cannot be read."""
        return RebsyncError.of(self.path, "RS982", what, hint)


def events_1(path: str, file: int, wanted: TopicChoice, own: OwnTypes) -> Iterator[Event]:
    """The events of a bag of ROS 1, in the order of the file."""
    source = _Source(path, file, wanted, own, False)
    readers: dict[int, tuple[str, Make, str] | None] = {}
    try:
        with Path(path).open("rb") as opened:
            for record in intact_records(opened):
                if isinstance(record[1], Connection):
                    number, connection = record[0], record[1]
                    if number not in readers:
                        readers[number] = _reader(source, connection)
                    continue
                number, time, raw = record
                source.number += 1
                reader = readers.get(number)
                if reader is not None:
                    topic, make, node = reader
                    yield source.event(topic, make, raw, time, node)
    except DamagedBag as error:
        yield source.end(str(error))
    except OSError as error:
        raise os_mistake(path, error) from None


def _reader(source: _Source, connection: Connection) -> tuple[str, Make, str] | None:
    topic = source.wanted.topic(connection.topic, source.path)
    if topic is None:
        return None
    make = source.maker(connection.type, connection.definition, topic)
    return topic.name, make, connection.publisher


def events_2(path: str, file: int, wanted: TopicChoice, own: OwnTypes) -> Iterator[Event]:
    """The events of a bag of ROS 2: a folder, or a file of one of its storages."""
    source = _Source(path, file, wanted, own, True)
    try:
        for part in _parts(Path(path)):
            with whole_records(part) as (readable, is_cut):
                yield from _of_part(source, readable)
            if is_cut:
                yield source.end("it ends within a record")
                return
    except (RebsyncError, GeneratorExit):
        raise
    except FileNotFoundError as error:
        raise source.wrong(f"it is no bag of ROS 2: {error}") from None
    except OSError as error:
        raise os_mistake(path, error) from None
    except Exception as error:  # of rosbags, of sqlite, of zstd: each has its own
        yield source.end(f"it cannot be read as a bag of ROS 2: {error}")


def _parts(path: Path) -> list[Path]:
    """What is read one after the other: the files of a folder, unless they are compressed.

    A folder as a whole lacks, for rosbags, what was recorded with another quality of service than
    its metadata say.
    """
    if not path.is_dir():
        return [path]
    metadata = path / "metadata.yaml"
    import yaml

    about = yaml.safe_load(metadata.read_text(encoding="utf-8"))["rosbag2_bagfile_information"]
    names = [PurePath(name).name for name in about["relative_file_paths"]]
    if about.get("compression_mode") or any(PurePath(name).suffix == ".zstd" for name in names):
        return [path]
    return [path / name for name in names]


def _of_part(source: _Source, part: Path) -> Iterator[Event]:
    from rosbags.interfaces import MessageDefinitionFormat
    from rosbags.rosbag2 import Reader

    with Reader(part) as reader:
        readers: dict[int, tuple[str, Make]] = {}
        connections = []
        expected = 0
        for connection in reader.connections:
            topic = source.wanted.topic(connection.topic, source.path)
            if topic is None:
                continue
            is_msg = connection.msgdef.format is MessageDefinitionFormat.MSG
            definition = connection.msgdef.data if is_msg else ""
            make = source.maker(connection.msgtype, definition, topic)
            readers[connection.id] = topic.name, make
            connections.append(connection)
            expected += connection.msgcount
        before = source.number
        if connections:
            for connection, time, raw in reader.messages(connections):
                source.number += 1
                yield source.event(*readers[connection.id], raw, time, "")
    if source.number - before < expected:
        read = source.number - before
        raise source.wrong(f"it has {expected} messages of the model, and only {read} can be read")
