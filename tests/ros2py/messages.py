"""Messages as rosidl makes them of .msg files: fields with defaults, and checks of their types."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import ModuleType

_FIELD = re.compile(r"([\w/]+)(?:\[(\d*)\])? (\w+)\Z")
_ANY = -1  # the length of an array without one
_CONSTANTS = {
    "diagnostic_msgs/DiagnosticStatus": {
        name: bytes([value]) for value, name in enumerate(("OK", "WARN", "ERROR", "STALE"))
    }
}
_PARTS = {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
_RANGES = {"int8": 8, "int16": 16, "int32": 32, "int64": 64, "uint32": 33}
_STANDARD = {
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "diagnostic_msgs/KeyValue": "string key\nstring value",
    "diagnostic_msgs/DiagnosticStatus": "byte level\nstring name\nstring message\n"
    "string hardware_id\ndiagnostic_msgs/KeyValue[] values",
    "diagnostic_msgs/DiagnosticArray": "std_msgs/Header header\n"
    "diagnostic_msgs/DiagnosticStatus[] status",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Twist": "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    "geometry_msgs/Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation",
    "geometry_msgs/PoseWithCovariance": "geometry_msgs/Pose pose\nfloat64[36] covariance",
    "geometry_msgs/TwistWithCovariance": "geometry_msgs/Twist twist\nfloat64[36] covariance",
    "nav_msgs/Odometry": "std_msgs/Header header\nstring child_frame_id\n"
    "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist",
    "std_msgs/Float64": "float64 data",
}


class Message:
    """A message: its fields are checked as rosidl does where Python runs with assertions."""

    _fields: Mapping[str, tuple[str, int | None]] = {}
    _known: Mapping[str, type[Message]] = {}

    def __init__(self, **values: object) -> None:
        for name, (type_, length) in self._fields.items():
            default = self._default(type_)
            count = max(length or 0, 0)
            every = default if length is None else [copy.copy(default) for _ in range(count)]
            object.__setattr__(self, name, every)
        for name, value in values.items():
            setattr(self, name, value)

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """The names and types of the fields."""
        return {name: type_ for name, (type_, _) in cls._fields.items()}

    def _default(self, type_: str) -> object:
        if type_ in self._known:
            return self._known[type_]()
        other = {"bool": False, "byte": b"\0", "string": "", "float32": 0.0, "float64": 0.0}
        return other.get(type_, 0)

    def __setattr__(self, name: str, value: object) -> None:
        type_, length = self._fields[name]
        values = [value]
        if length is not None:
            assert isinstance(value, list), f"{name}: {value!r}"
            assert length in (_ANY, len(value)), f"{name}: {value!r}"
            values = value
        for each in values:
            assert self._is(type_, each), f"{name} of {type_}: {each!r}"
        object.__setattr__(self, name, value)

    def _is(self, type_: str, value: object) -> bool:
        match type_:
            case "bool":
                return isinstance(value, bool)
            case "byte":
                return isinstance(value, bytes) and len(value) == 1
            case "string":
                return isinstance(value, str)
            case "float32" | "float64":
                return isinstance(value, float)
            case _ if type_ in _RANGES:
                half = 1 << (_RANGES[type_] - 1)
                return isinstance(value, int) and -half <= value < half
            case _:
                return isinstance(value, self._known[type_])


def plain(message: Message) -> dict[str, object]:
    """The fields of a message as plain data."""
    return {name: _plain(getattr(message, name)) for name in message._fields}


def _plain(value: object) -> object:
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return plain(value) if isinstance(value, Message) else value


def modules(folders: Iterable[Path]) -> dict[str, ModuleType]:
    """`<package>.msg` of the standard messages, and `msg`, `srv` and `action` of some packages."""
    known: dict[str, type[Message]] = {}
    texts = dict(_STANDARD)
    for folder in folders:
        for file in sorted(folder.glob("msg/*.msg")):
            texts[f"{folder.name}/{file.stem}"] = file.read_text()
    for name, text in texts.items():
        known[name] = _message(name, text, known)
    found = _as_modules(known)
    for folder in folders:
        for kind, parts in _PARTS.items():
            module = ModuleType(f"{folder.name}.{kind}")
            for file in sorted(folder.glob(f"{kind}/*.{kind}")):
                every = zip(parts, file.read_text().split("---\n"), strict=True)
                members = {p: _message(f"{file.stem}_{p}", text, known) for p, text in every}
                setattr(module, file.stem, type(file.stem, (), members))
            found[module.__name__] = module
    return found


def _message(name: str, text: str, known: Mapping[str, type[Message]]) -> type[Message]:
    fields = {}
    for line in text.strip().splitlines():
        match = _FIELD.match(line)
        assert match is not None, line
        fields[match[3]] = (match[1], int(match[2] or _ANY) if match[2] is not None else None)
    members = {"_fields": fields, "_known": known, **_CONSTANTS.get(name, {})}
    return type(name.rpartition("/")[2], (Message,), members)


def _as_modules(known: Mapping[str, Callable[..., Message]]) -> dict[str, ModuleType]:
    found: dict[str, ModuleType] = {}
    for name, class_ in known.items():
        package, _, last = name.rpartition("/")
        parent = found.setdefault(package, ModuleType(package))
        parent.__path__ = []
        module = found.setdefault(f"{package}.msg", ModuleType(f"{package}.msg"))
        setattr(module, last, class_)
    return found
