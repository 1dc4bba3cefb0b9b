"""Bags of ROS 1 and ROS 2 as events; the message types are those of the recording, or the model's.

All is read by rosbags, without an installation of ROS.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from operator import attrgetter
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

from rebsync.conform.recording import Event, Place, Truncated
from rebsync.conform.topic_filter import TopicChoice
from rebsync.conform.topics import Topic
from rebsync.diagnostics import RebsyncError
from rebsync.files import os_mistake
from rebsync.forward.message_files import message_files
from rebsync.package import Package
from rebsync.records import dataclass

if TYPE_CHECKING:
    from rosbags.rosbag1 import Reader as Reader1
    from rosbags.rosbag2 import Reader as Reader2

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
        try:
            types: Typesdict = {}
            if definition:
                types.update(get_types_from_msg(definition, type_))
            elif type_ not in store.fielddefs:
                owner = type_.split("/")[0]
                for stem, text in self.own.texts.items():
                    renamed = text.replace(f"{self.own.package}/", f"{owner}/")
                    types.update(get_types_from_msg(renamed, f"{owner}/msg/{stem}"))
            store.register({k: v for k, v in types.items() if k not in store.fielddefs})
            found = store.get_msgdef(type_)
        except Exception as error:
            raise self.wrong(f"the type {type_} of {topic.name} is not known: {error}") from None
        cls: Any = found.cls
        if not self.is_2:
            read1 = found.deserialize_ros1
            return lambda raw: read1(raw, 0, cls, store)[0]
        return lambda raw: store.deserialize_cdr(raw, type_)

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

    def end(self, why: str, hint: str) -> Event:
        """That the file cannot be read on. RebsyncError: nothing of it can be read."""
        if not self.number:
            raise self.wrong(why, hint)
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
    """The events of a bag of ROS 1, by their times."""
    from rosbags.rosbag1 import Reader

    source = _Source(path, file, wanted, own, False)
    hint = f"an index that a recorder left out is made by: rosbag reindex {path}"
    yield from _until_damage(source, lambda: _of_part(source, Reader(path)), hint)


def events_2(path: str, file: int, wanted: TopicChoice, own: OwnTypes) -> Iterator[Event]:
    """The events of a bag of ROS 2: a folder, or a file of one of its storages."""
    from rosbags.rosbag2 import Reader

    source = _Source(path, file, wanted, own, True)

    def of_parts() -> Iterator[Event]:
        for part in _parts(Path(path)):
            yield from _of_part(source, Reader(part))

    hint = "what a recorder left that was killed is mended by: mcap recover, ros2 bag reindex"
    yield from _until_damage(source, of_parts, hint)


def _until_damage(
    source: _Source, events: Callable[[], Iterator[Event]], hint: str
) -> Iterator[Event]:
    try:
        yield from events()
    except (RebsyncError, GeneratorExit):
        raise
    except FileNotFoundError as error:
        raise source.wrong(f"it is no bag: {error}") from None
    except OSError as error:
        raise os_mistake(source.path, error) from None
    except Exception as error:  # of rosbags, of sqlite, of zstd: each has its own
        yield source.end(f"it cannot be read as a bag: {error}", hint)


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


def _of_part(source: _Source, opened: Reader1 | Reader2) -> Iterator[Event]:
    from rosbags.interfaces import ConnectionExtRosbag1, MessageDefinitionFormat

    with opened as reader:
        readers: dict[int, tuple[str, Make, str]] = {}
        connections = []
        expected = 0
        for connection in reader.connections:
            topic = source.wanted.topic(connection.topic, source.path)
            if topic is None:
                continue
            is_msg = connection.msgdef.format is MessageDefinitionFormat.MSG
            definition = connection.msgdef.data if is_msg else ""
            make = source.maker(connection.msgtype, definition, topic)
            said = connection.ext
            node = said.callerid if isinstance(said, ConnectionExtRosbag1) else None
            readers[connection.id] = topic.name, make, node or ""
            connections.append(connection)
            expected += connection.msgcount
        before = source.number
        if connections:
            for connection, time, raw in reader.messages(connections):
                source.number += 1
                topic_name, make, node = readers[connection.id]
                yield source.event(topic_name, make, raw, time, node)
    if source.number - before < expected:
        read = source.number - before
        raise source.wrong(f"it has {expected} messages of the model, and only {read} can be read")
