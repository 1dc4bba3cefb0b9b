"""Recorded runs written as bags, as rosbag and `ros2 bag` write them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Literal

from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from rebsync.checker.values import real
from rebsync.conform.observable import Observable
from rebsync.conform.recording import Event, Served
from rebsync.conform.topics import Topics
from rebsync.forward.message_files import message_files

ZERO = 100.0  # s, of the clock at time 0
Storage = Literal["ros1", "sqlite3", "mcap"]


def typestore(observable: Observable, is_2: bool) -> Typestore:
    """The message types of a model's package."""
    store = get_typestore(Stores.ROS2_HUMBLE if is_2 else Stores.ROS1_NOETIC)
    package = observable.package
    types: Any = {}
    for path, text in message_files(package).items():
        if path.endswith(".msg"):
            types.update(get_types_from_msg(text, f"{package.name}/msg/{Path(path).stem}"))
    store.register(types)
    return store


def write_bag(
    path: Path,
    observable: Observable,
    events: Iterable[Event],
    storage: Storage = "ros1",
    compression: str = "",
) -> Path:
    """Writes the state messages of a run as a bag."""
    store = typestore(observable, storage != "ros1")
    if storage == "ros1":
        writer: Any = Writer1(path)
        if compression:
            writer.set_compression(Writer1.CompressionFormat[compression.upper()])
        serialise: Any = store.serialize_ros1
    else:
        plugin = StoragePlugin.MCAP if storage == "mcap" else StoragePlugin.SQLITE3
        writer = Writer2(path, version=9, storage_plugin=plugin)
        if compression:
            writer.set_compression(CompressionMode[compression.upper()], CompressionFormat.ZSTD)
        serialise = store.serialize_cdr
    with writer:
        connections: dict[tuple[int, str], Any] = {}
        for event in events:
            if not isinstance(event, Served):
                continue
            key = event.rebec, event.publisher
            name = f"{observable.package.name}/msg/{observable.states[event.rebec].name}"
            if key not in connections:
                topic = f"/{observable.nodes[event.rebec]}/state"
                more = {"callerid": event.publisher} if storage == "ros1" else {}
                connections[key] = writer.add_connection(topic, name, typestore=store, **more)
            message = _message(store.types[name], observable, event)
            stamp = round((ZERO + event.stamp) * 1e9)
            writer.write(connections[key], stamp, serialise(message, name))
    return path


def _message(cls: Any, observable: Observable, served: Served) -> object:  # noqa: ANN401
    import numpy

    fields: dict[str, Any] = {
        name: getattr(served, name) for name in ("server", "arguments", "arrival", "start", "now")
    }
    names = {f.source: f.name for f in observable.states[served.rebec].fields}
    dtypes = {"byte": "int8", "short": "int16", "int": "int32", "float": "float32"}
    for slot in observable.program.rebecs[served.rebec].state:
        cells = served.cells[slot.offset : slot.offset + slot.size]
        values: list[Any] = [
            observable.value(c, "rebec")
            if slot.kind == "rebec"
            else bool(c)
            if slot.kind == "boolean"
            else real(c)
            if slot.kind in ("float", "double")
            else c
            for c in cells
        ]
        if not slot.type.dimensions:
            fields[names[slot.name]] = values[0]
        elif slot.kind == "rebec":
            fields[names[slot.name]] = values
        else:
            dtype = "bool" if slot.kind == "boolean" else dtypes.get(slot.kind, "float64")
            fields[names[slot.name]] = numpy.array(values, dtype=dtype)
    return cls(**fields)


def bag_of_log(log: Path, observable: Observable, path: Path) -> Path:
    """The messages of a log that are of the types of a model's package, as a bag of ROS 1."""
    store = typestore(observable, False)
    topics = Topics.of(observable)
    writer = Writer1(path)
    writer.set_compression(Writer1.CompressionFormat.LZ4)
    with writer:
        connections: dict[tuple[str, str], Any] = {}
        for line in log.read_text(encoding="utf-8").splitlines():
            said = json.loads(line)
            found = topics.find(said["topic"], with_sent=True) if said["topic"] else None
            if found is None or not found[1].type:
                continue
            name = f"{observable.package.name}/msg/{found[1].type}"
            key = said["topic"], said.get("node", "")
            if key not in connections:
                connections[key] = writer.add_connection(
                    said["topic"], name, typestore=store, callerid=key[1] or None
                )
            message = _of_data(store, name, said["data"])
            raw = store.serialize_ros1(message, name)
            writer.write(connections[key], round(said["stamp"] * 1e9), raw)
    return path


def _of_data(store: Typestore, name: str, data: Any) -> object:  # noqa: ANN401
    """A message of its fields as JSON has them."""
    values: dict[str, Any] = {}
    for field, type_ in store.fielddefs[name][1]:
        values[field] = _value(store, type_, data[field])
    return store.types[name](**values)


def _value(store: Typestore, type_: Any, data: Any) -> object:  # noqa: ANN401
    import numpy

    kind, about = type_
    if kind.name == "NAME":
        return _of_data(store, about, data)
    if kind.name == "BASE":
        return data
    element = about[0]
    if element[0].name == "BASE" and element[1][0] != "string":
        return numpy.array(data, dtype=element[1][0])
    return [_value(store, element, each) for each in data]
