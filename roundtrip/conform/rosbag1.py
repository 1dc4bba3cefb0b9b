"""Bags of ROS 1, format 2.0 (wiki.ros.org/Bags/Format/2.0), record after record.

rosbags reads the index of all messages before the first one, which takes memory for each, and
refuses bags without an index, which a recorder leaves that was killed. Only what lies in chunks is
read here, in the order of the file; types and fields are those of rosbags.
"""

from __future__ import annotations

import bz2
import re
import struct
from collections.abc import Iterator
from typing import BinaryIO, NamedTuple

_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _CHUNK, _CONNECTION = 2, 5, 7
_LENGTH = struct.Struct("<I")
_TIME = struct.Struct("<II")
_LARGEST = 2**30
_NUMBERS = struct.Struct("<IIII")
# A message up to its content, as writers make it: `op` has one of two places.
_OP = rb"(?:\x04\0\0\0op=\x02)?"
_CONN, _STAMP = rb"\x09\0\0\0conn=(.{4})", rb"\x0d\0\0\0time=(.{8})"
_USUAL = re.compile(rb"\x26\0\0\0" + _OP + _CONN + _OP + _STAMP + rb"(.{4})", re.DOTALL)
_USUAL_SIZE = 46


class DamagedBag(Exception):
    """Something that no bag has; the text says what."""


class TruncatedBag(DamagedBag):
    """The bag ends within a record."""


class Connection(NamedTuple):
    """A publisher's topic."""

    topic: str
    type: str
    definition: str
    publisher: str


class RawMessage(NamedTuple):
    """A message; `time` in nanoseconds."""

    connection: int
    time: int
    data: bytes | memoryview


def intact_records(file: BinaryIO) -> Iterator[tuple[int, Connection] | RawMessage]:
    """The records up to the first damage, but for the last one before it. Raises DamagedBag.

    What is damaged may begin within that one. A bag that ends within a record has all before it.
    """
    last: tuple[int, Connection] | RawMessage | None = None
    try:
        for record in records(file):
            if last is not None:
                yield last
            last = record
    except TruncatedBag:
        if last is not None:
            yield last
        raise
    if last is not None:
        yield last


def records(file: BinaryIO) -> Iterator[tuple[int, Connection] | RawMessage]:
    """The connections, each before its messages, and the messages. Raises DamagedBag."""
    if file.readline(20) != _MAGIC:
        raise DamagedBag("it does not begin as a bag of ROS 1")
    while head := file.read(4):
        header = _fields(_exactly(file, _size(head)))
        op, compression = _op(header), header.get(b"compression", b"none")
        size = _size(file.read(4))
        data = file.read(size)
        if len(data) < size:
            if op == _CHUNK and compression == b"none":
                yield from _chunk(data, True)
            raise TruncatedBag("it ends within a record")
        match op:
            case 5:
                yield from _chunk(_decompressed(data, compression))
            case 7:
                yield _connection(header, data)
            case 2:  # version 1.2 had no chunks
                yield _message(header, data)


def _op(header: dict[bytes, bytes]) -> int:
    kind = header.get(b"op", b"")
    if len(kind) != 1:
        raise DamagedBag("a record is of no kind")
    return kind[0]


def _chunk(data: bytes, is_cut: bool = False) -> Iterator[tuple[int, Connection] | RawMessage]:
    """The connections in a chunk, then its messages; all that are whole if the chunk `is_cut`."""
    messages: list[RawMessage] = []
    damage: DamagedBag | None = None
    try:
        for record in _records_in(data):
            if isinstance(record, RawMessage):
                messages.append(record)
                continue
            op, fields, content = record
            if op == _MESSAGE:
                messages.append(_message(fields, content))
            elif op == _CONNECTION:
                yield _connection(fields, bytes(content))
    except DamagedBag as error:
        damage = error
    yield from messages
    if damage is not None and not is_cut:
        raise damage


def _records_in(
    data: bytes,
) -> Iterator[RawMessage | tuple[int, dict[bytes, bytes], memoryview]]:
    """The messages, and the fields and contents of other records with their kinds."""
    view, position, end = memoryview(data), 0, len(data)
    while position < end:
        usual = _USUAL.fullmatch(data, position, position + _USUAL_SIZE)
        if usual is not None:
            numbers = usual[1] + usual[2] + usual[3]
            connection, seconds, nanoseconds, size = _NUMBERS.unpack(numbers)
            content = position + _USUAL_SIZE
            position = content + size
            if position > end:
                raise DamagedBag("a chunk ends within a record")
            yield RawMessage(connection, seconds * 10**9 + nanoseconds, view[content:position])
            continue
        start = position + 4
        position = start + _at(data, position)
        content = position + 4
        header = data[start:position]
        position = content + _at(data, position)
        if position > end:
            raise DamagedBag("a chunk ends within a record")
        fields = _fields(header)
        yield _op(fields), fields, view[content:position]


def _at(data: bytes, position: int) -> int:
    if position + 4 > len(data):
        raise DamagedBag("a chunk ends within a record")
    return int.from_bytes(data[position : position + 4], "little")


def _message(fields: dict[bytes, bytes], data: bytes | memoryview) -> RawMessage:
    try:
        seconds, nanoseconds = _TIME.unpack(fields[b"time"])
        return RawMessage(_LENGTH.unpack(fields[b"conn"])[0], seconds * 10**9 + nanoseconds, data)
    except (KeyError, struct.error):
        raise DamagedBag("a message has no time or no connection") from None


def _connection(fields: dict[bytes, bytes], data: bytes) -> tuple[int, Connection]:
    more = _fields(data)
    try:
        number: int = _LENGTH.unpack(fields[b"conn"])[0]
        texts = (fields[b"topic"], more[b"type"], more[b"message_definition"])
        topic, type_, definition = (text.decode() for text in texts)
        publisher = more.get(b"callerid", b"").decode()
        return number, Connection(topic, type_, definition, publisher)
    except (KeyError, struct.error, UnicodeDecodeError):
        raise DamagedBag("a connection has no topic or no type") from None


def _fields(data: bytes) -> dict[bytes, bytes]:
    found, position = {}, 0
    while position < len(data):
        start = position + 4
        position = start + _at(data, position)
        name, equals, value = data[start:position].partition(b"=")
        if not equals:
            raise DamagedBag("a header has a field without a value")
        found[name] = value
    return found


def _size(data: bytes) -> int:
    if len(data) < 4:
        raise TruncatedBag("it ends within a record")
    size: int = _LENGTH.unpack(data)[0]
    if size > _LARGEST:
        raise DamagedBag("a record is larger than any")
    return size


def _exactly(file: BinaryIO, size: int) -> bytes:
    data = file.read(size)
    if len(data) < size:
        raise TruncatedBag("it ends within a record")
    return data


def _decompressed(data: bytes, how: bytes) -> bytes:
    try:
        match how:
            case b"none":
                return data
            case b"bz2":
                return bz2.decompress(data)
            case b"lz4":
                import lz4.frame

                decompressed: bytes = lz4.frame.decompress(data)
                return decompressed
    except (OSError, ValueError, EOFError, RuntimeError) as error:
        raise DamagedBag(f"a chunk cannot be decompressed: {error}") from None
    raise DamagedBag(f"a chunk is compressed by {how.decode(errors='replace')}")
