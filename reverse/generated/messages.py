"""The message types of a package of generated code: what the fields are in the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field as with_default

from rebsync.model import Type
from rebsync.records import dataclass
from rebsync.reserved import RUNTIME_FIELDS, SENDER_FIELD
from rebsync.reverse.build.manifests import name_in
from rebsync.reverse.build.messages import MessageField, plain_type, read_message
from rebsync.reverse.files.packages import owner_of
from rebsync.source import Source

_TYPES = {
    "bool": "boolean",
    "int8": "byte",
    "int16": "short",
    "int32": "int",
    "float32": "float",
    "float64": "double",
}


@dataclass(frozen=True, slots=True)
class OwnMessages:
    """The message types that a package declares.

    `fields` are those of each, by its name with its package, but for those of the run-time part;
    None for what the model has no type for. `signed` are those that say who sends them, by their
    names alone. `constants` are the whole numbers that each names, by its name with its package.
    """

    fields: Mapping[str, Mapping[str, Type | None]]
    signed: frozenset[str]
    constants: Mapping[str, Mapping[str, int]] = with_default(default_factory=dict)


NO_MESSAGES = OwnMessages({}, frozenset())


def own_messages(files: Mapping[str, Source]) -> OwnMessages:
    """The message types of a package."""
    declared = {path: s for path, s in sorted(files.items()) if path.endswith(".msg")}
    manifest = files.get("package.xml") if declared else None
    package = name_in(manifest) if manifest is not None else None
    found, constants, signed = {}, {}, set[str]()
    for path, source in declared.items():
        name = path.rpartition("/")[2].removesuffix(".msg")
        read = read_message(source, "", name)
        found[f"{owner_of(path, package or '')}/{name}"] = {
            f.name: _type(f) for f in read.fields if f.name not in RUNTIME_FIELDS
        }
        numbers = {c.name: c.value for c in read.constants if type(c.value) is int}
        constants[f"{owner_of(path, package or '')}/{name}"] = numbers
        if any(f.name == SENDER_FIELD for f in read.fields):
            signed.add(name)
    return OwnMessages(found, frozenset(signed), constants)


def _type(field: MessageField) -> Type | None:
    plain = _TYPES.get(plain_type(field.type))
    if plain is None or field.length == 0:
        return None
    return Type(plain, () if field.length is None else (field.length,))
