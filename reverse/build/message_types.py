"""The message types of a package: which of their fields the model has, and as what."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from functools import cache
from itertools import chain

from rebsync.intervals import Interval, unsigned
from rebsync.model import Type
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import WIDE, Variable, of_width
from rebsync.reverse.build.common_messages import COMMON
from rebsync.reverse.build.messages import plain_type, read_message
from rebsync.reverse.files.packages import owner_of
from rebsync.reverse.libraries import cpp, python
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_tree import Cpp
from rebsync.source import Source

# What the model keeps of a field's values. Wider integers are taken for `int`.
_TYPES = {
    **{"bool": "boolean", "int8": "byte", "int16": "short", "uint8": "short", "int32": "int"},
    **{"uint16": "int", "uint32": "int", "int64": "int", "uint64": "int"},
    **{"float32": "float", "float64": "double", "string": TEXT.name},
}
# In bits without the sign: narrow ones wrap sooner than the model's type, others hold more than its
# `int`. A truth value is a byte in the code.
_WIDTHS = {"bool": 8, "uint8": 8, "uint16": 16, "uint32": 32, "int64": 63, "uint64": 64}
_UNSIGNED = {"uint8": 8, "uint16": 16, "uint32": 31, "uint64": 31}  # as far as an `int` holds them
_DEEPEST = 8
# The namespace of messages in ROS 2: `std_msgs::msg::String`.
_SPACE = re.compile(r"::(?:msg|srv|action)::(?=\w+\Z)")
_SHARED = re.compile(r"(?:boost|std)::shared_ptr<(.*)>")
_POINTERS = re.compile(r"(::)?(Const)?(Shared|Unique|Weak)?Ptr$")
_QUOTED = re.compile(r"(['\"])(.*)\1")
_GENERATES = re.compile(
    r"rosidl_default_\w+|rosidl_interface_packages|message_(?:generation|runtime)"
)
_SERVICE = re.compile(r"/?srv/([^/]+)\.srv\Z")
_BETWEEN = re.compile(r"^---.*$", re.MULTILINE)
_PARTS = ("Request", "Response")
_MESSAGE = re.compile(r"/?msg/([^/]+)\.msg\Z")

# Times in ROS 1 are objects of their own, in ROS 2 messages.
_STAMP_TYPES = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}
_STAMP: list[tuple[str, str, int | None]] = [("sec", "int32", None), ("nanosec", "uint32", None)]

# The number of a header is counted by the publishers of ROS 1, whatever the code says. In ROS 2 a
# quaternion starts as the one that does not turn.
_COUNTED = frozenset({("std_msgs/Header", "seq")})
_STARTED = frozenset({("geometry_msgs/Quaternion", "w")})
_ROS2 = re.compile(r"\b(?:ament|rosidl)_\w+")

Fields = Mapping[str, Type | None]


def _of_service(
    source: Source, path: str, owner: str
) -> dict[str, list[tuple[str, str, int | None]]]:
    """The fields of the request and the response of a service, if a file declares one."""
    service = _SERVICE.search(path)
    if service is None:
        return {}
    parts = zip(_PARTS, _BETWEEN.split(source.text), strict=False)
    read = (read_message(Source(path, text), owner, f"{service[1]}_{p}") for p, text in parts)
    return {each.full_name: [(f.name, f.type, f.length) for f in each.fields] for each in read}


@dataclass(slots=True)
class MessageTypes:
    """The types that the files of a package declare, and those that come with ROS.

    `widths` are those of fields, by type and path, that are not the model's type's, the sign not
    counted: 8 and 16 bits wrap sooner, 32 and more hold more than its `int`.
    """

    own: dict[str, list[tuple[str, str, int | None]]]
    package: str
    widths: dict[str, dict[str, int]] = field(default_factory=dict)
    # Fields of types that come with ROS which start with, or get, other values than 0.
    set_by_library: frozenset[tuple[str, str]] = _COUNTED
    _constants: dict[str, int | str] = field(default_factory=dict)
    _ranges: dict[tuple[str, str], Interval] = field(default_factory=dict)
    _fields: dict[str, Fields] = field(default_factory=dict)
    # The types by texts of C++ that were asked for.
    _named: dict[str, str | None] = field(default_factory=dict)
    # In ROS 2 a `byte` is a number without a sign in C++, and `bytes` in Python.
    has_octets: bool = False

    @staticmethod
    def of(files: Mapping[str, Source], package: str) -> MessageTypes:
        """The types that a package declares, and those that come with ROS."""
        own: dict[str, list[tuple[str, str, int | None]]] = {}
        constants: dict[str, int | str] = {}
        rosidl, unclear = _of_rosidl(files), set[str]()
        for path, source in sorted(files.items()):
            own |= _of_service(source, f"/{path}", owner_of(path, package))
            found = _MESSAGE.search(f"/{path}")
            if found is not None:
                owner = owner_of(path, package)
                read = read_message(source, owner, found[1])
                own[read.full_name] = [(f.name, f.type, f.length) for f in read.fields]
                for constant in read.constants:
                    value = _kept(constant.value, rosidl)
                    for scope in ("", f"{owner}::", f"{owner}::msg::"):
                        if value is None:
                            continue
                        name = f"{scope}{read.name}::{constant.name}"
                        if constants.setdefault(name, value) != value:
                            unclear.add(name)  # messages of two packages have one name
        known = {name: value for name, value in constants.items() if name not in unclear}
        is_ros2 = _is_of_ros2(files)
        others = _COUNTED | _STARTED if is_ros2 else _COUNTED
        return MessageTypes(own, package, {}, others, known, {}, has_octets=is_ros2)

    def constants(self) -> dict[str, int | str]:
        """The whole numbers and texts that messages of the package give names."""
        return self._constants

    def constant(self, type_: str, name: str) -> int | str | None:
        """The whole number or text that a message of the package gives a name."""
        return self._constants.get(f"{type_.replace('/', '::')}::{name}")

    def has_field(self, name: str) -> bool:
        """Whether a type of the package, or one that comes with ROS, has a field of this name."""
        own = (field for fields in self.own.values() for field, _, _ in fields)
        return name in own or name in _common_names()

    def fields(self, type_: str) -> Fields | None:
        """The fields of a type by their paths, inner ones too; None for a type that is not known.

        The model's type of a field is None where the model has none.
        """
        if type_ not in self._fields:
            if self._declared(type_) is None:
                return None
            self._fields[type_] = dict(self._flat(type_, "", type_, 0))
        return self._fields[type_]

    def python_fields(self, type_: str, has_stamps: bool) -> Mapping[str, str] | None:
        """The fields of a type as Python has them, with their types; None if it is not known.

        Where times are messages themselves (`has_stamps`), as in ROS 2, headers have no number.
        """
        is_stamp = has_stamps and type_ in _STAMP_TYPES.values()
        declared = _STAMP if is_stamp else self._declared(type_)
        if declared is None:
            return None
        found = {name: f"{of}{_dimension(length)}" for name, of, length in declared}
        if not has_stamps:
            return found
        if type_ == "std_msgs/Header":
            found.pop("seq", None)
        return {name: _STAMP_TYPES.get(of, of) for name, of in found.items()}

    def variable(self, type_: str, path: str, name: str, of: Type) -> Variable:
        """A variable of the model for a field of a type."""
        return of_width(name, of, self.widths.get(type_, {}).get(path, 0))

    def range_of(self, type_: str, path: str) -> Interval | None:
        """What a whole number of a field can be, where that is less than its type of the model."""
        self.fields(type_)
        return self._ranges.get((type_, path))

    def holds_more(self, type_: str, path: str) -> bool:
        """Whether a field holds more than the model's `int` does."""
        return self.widths.get(type_, {}).get(path, 0) >= WIDE

    def all_fields(self, types: set[str]) -> dict[str, Fields]:
        """The fields of several types, of those that are known."""
        found = {t: self.fields(t) for t in sorted(types)}
        return {t: f for t, f in found.items() if f is not None}

    def mentioned(self, files: Iterable[Cpp]) -> set[str]:
        """The types that some code may use: of each the name stands in it."""
        types = (*self.own, *COMMON)
        names = frozenset(t.partition("/")[2].encode() for t in types)
        used = names.intersection(chain.from_iterable(names & cpp.words for cpp in files))
        return {t for t in types if t.partition("/")[2].encode() in used}

    def named(self, text: str) -> str | None:
        """The message type of a type of C++: `const std_msgs::Int32::ConstPtr&` is one."""
        if text not in self._named:
            self._named[text] = self._type_named(text)
        return self._named[text]

    def _type_named(self, text: str) -> str | None:
        plain = "".join(text.replace("const ", "").split()).rstrip("&*").removeprefix("::")
        inner = _SHARED.fullmatch(plain)
        if inner is not None:
            return self.named(inner[1].removesuffix("const"))
        plain = _POINTERS.sub("", plain).removesuffix("_<std::allocator<void>>")
        plain = _SPACE.sub("::", plain)
        package, _, name = plain.rpartition("::")
        if package:
            full = f"{package}/{name}"
            return full if self._declared(full) is not None else None
        same = [t for t in self.own if t.partition("/")[2] == name]
        same += _common_types().get(name, ())
        return same[0] if len(same) == 1 else None

    def _declared(self, type_: str) -> list[tuple[str, str, int | None]] | None:
        owner, _, name = type_.partition("/")
        # generated packages of ROS 2 have one of interfaces beside them: both are read as one
        beside = f"{self.package}/{name}" if owner == f"{self.package}_interfaces" else type_
        if (own := self.own.get(type_, self.own.get(beside))) is not None:
            return own
        text = COMMON.get(type_)
        return list(map(_field, text.split(", "))) if text else ([] if text == "" else None)

    def _flat(
        self, type_: str, path: str, whole: str, depth: int
    ) -> Iterator[tuple[str, Type | None]]:
        for name, inner, length in self._declared(type_) or ():
            at, plain = f"{path}{name}", plain_type(inner)
            if inner == "byte" and self.has_octets:
                yield at, None
                continue
            if plain in _WIDTHS:
                self.widths.setdefault(whole, {})[at] = _WIDTHS[plain]
            if plain in _UNSIGNED:
                self._ranges[whole, at] = unsigned(_UNSIGNED[plain])
            if (type_, name) in self.set_by_library:
                yield at, None
            elif plain in _TYPES:
                dimensions = () if length is None else (length,)
                is_kept = length is None if plain == "string" else length != 0
                yield at, Type(_TYPES[plain], dimensions) if is_kept else None
            elif length is None and depth < _DEEPEST and self._declared(inner) is not None:
                yield from self._flat(inner, f"{at}.", whole, depth + 1)
            else:
                yield at, None


@cache
def _common_types() -> dict[str, list[str]]:
    """By their own names the types that come with ROS."""
    found: dict[str, list[str]] = {}
    for type_ in COMMON:
        found.setdefault(type_.partition("/")[2], []).append(type_)
    return found


@cache
def _common_names() -> frozenset[str]:
    """The names of all fields of types that come with ROS."""
    fields = (field for text in COMMON.values() for field in text.split(", "))
    return frozenset(field.partition(" ")[0] for field in fields)


def _kept(value: bool | int | float | str, rosidl: bool | None) -> int | str | None:
    """The value of a constant; None where it is none of the model, or not known."""
    if isinstance(value, str):
        return _text(value, rosidl)
    return int(value) if isinstance(value, int) else None


def _text(value: str, rosidl: bool | None) -> str | None:
    """A text as the generators of its ROS read it: genmsg takes all that stands in the line.

    That of ROS 2 ends it at a `#`, and takes quotes around it off.
    """
    if rosidl is None:
        return value if not set("#'\"\\") & set(value) else None
    if not rosidl:
        return value
    text = value.partition("#")[0].strip()
    quoted = _QUOTED.fullmatch(text)
    text = quoted[2] if quoted is not None else text
    return text if "\\" not in text and (quoted is None or quoted[1] not in text) else None


def _of_rosidl(files: Mapping[str, Source]) -> bool | None:
    """Whether the messages of a package are of ROS 2; None where its manifest does not say."""
    manifests = [s.text for path, s in files.items() if path.endswith("package.xml")]
    found = {"rosidl_" in text for text in manifests if _GENERATES.search(text)}
    return found.pop() if len(found) == 1 else None


def _is_of_ros2(files: Mapping[str, Source]) -> bool:
    """Whether a manifest names a client library of ROS 2, or what builds packages there."""
    manifests = (s.text for path, s in files.items() if path.endswith("package.xml"))
    return any(
        _ROS2.search(text) or cpp.is_flat(text.encode()) or python.client_in(text).flat
        for text in manifests
    )


def _dimension(length: int | None) -> str:
    """How the type of a field says that it is an array: of any length, or of a fixed one."""
    return "" if length is None else f"[{length or ''}]"


def _field(text: str) -> tuple[str, str, int | None]:
    name, _, type_ = text.partition(" ")
    plain, bracket, length = type_.partition("[")
    return name, plain, int(length.rstrip("]") or 0) if bracket else None
