"""The message types of a package: what its .msg files say."""

from __future__ import annotations

from math import prod

from rebsync.model import Type
from rebsync.package import Field, Package
from rebsync.reserved import RESPONSE_FIELD

TIMING = ("int64 arrival", "int64 deadline", "bool stamped")
# Times in nanoseconds of the ROS clock, since both generations of ROS have that type; 0: not yet.
ANNOUNCEMENT = ("string rebec", "int64 stamp", "int64 zero", "int64 clock")
STATE_HEAD = (
    "string server",
    "string arguments",
    "int64 arrival",
    "int64 start",
    "int64 now",
)
FIELD_TYPES = {
    "byte": "int8",
    "short": "int16",
    "int": "int32",
    "float": "float32",
    "double": "float64",
    "boolean": "bool",
}


def field_type(type_: Type) -> str:
    """The type of a message field; arrays of several dimensions are flattened."""
    element = FIELD_TYPES.get(type_.name, "string")
    return f"{element}[{prod(type_.dimensions)}]" if type_.dimensions else element


def message_names(package: Package) -> list[str]:
    """The message types of a package."""
    names = {"Announcement", "Timing"} | {m.name for m in package.messages}
    names |= {c.state.name for c in package.classes if c.executable}
    return sorted(names | {s.type for c in package.classes for s in c.sensors if s.stands_in})


def service_names(package: Package) -> list[str]:
    """The service types of a package."""
    return sorted(s.type for s in package.services)


def action_names(package: Package) -> list[str]:
    """The action types of a package."""
    return sorted(a.type for a in package.actions)


def message_files(package: Package) -> dict[str, str]:
    """`msg/*.msg`, `srv/*.srv`, `action/*.action` by their paths; both generations read them."""
    files = {
        "msg/Announcement.msg": text_of(ANNOUNCEMENT),
        "msg/Timing.msg": text_of(TIMING),
    }
    for message in package.messages:
        sender = ["string sender"] if message.carries_sender else []
        lines = [f"{package.name}/Timing timing", *sender, *map(_field, message.fields)]
        files[f"msg/{message.name}.msg"] = text_of(lines)
    for node in package.classes:
        if node.executable:
            lines = [*STATE_HEAD, *map(_field, node.state.fields)]
            files[f"msg/{node.state.name}.msg"] = text_of(lines)
        for sensor in node.sensors:
            if sensor.stands_in:
                lines = [f"{field_type(d.type)} {d.field}" for d in sensor.draws]
                files[f"msg/{sensor.type}.msg"] = text_of(lines)
    for service in package.services:
        lines = [*map(_field, service.request.fields), "---", f"bool {RESPONSE_FIELD}"]
        lines += map(_field, service.reply.fields)
        files[f"srv/{service.type}.srv"] = text_of(lines)
    for action in package.actions:
        feedback = action.feedback.fields if action.feedback is not None else ()
        lines = [*map(_field, action.request.fields), "---", *map(_field, action.reply.fields)]
        files[f"action/{action.type}.action"] = text_of([*lines, "---", *map(_field, feedback)])
    return files


def text_of(lines: list[str] | tuple[str, ...]) -> str:
    """A file of a message type, field by field."""
    return "\n".join(lines) + "\n"


def _field(field: Field) -> str:
    return f"{field_type(field.type)} {field.name}"
