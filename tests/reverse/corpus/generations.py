"""What nodes ask of ROS, without what only tells the two generations of ROS apart.

Taken for the same: a private parameter of ROS 1 and a parameter of ROS 2, whose levels are set off
by slashes or dots; a parameter that is a map and those below a name; reading a parameter with a
default and declaring it; a loop's rate and a timer; waiting for one message and a subscription;
names in camelCase and in snake_case.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator

from rebsync.records import dataclass
from tests.reverse.corpus.compare import KINDS
from tests.reverse.corpus.values import Json, same, spelt, tidied

_DETAILS = {
    "publisher": ("depth", "latched"),
    "subscription": ("depth", "callback"),
    "timer": ("one_shot", "callback"),
    "service": ("callback",),
    "parameter": ("default",),
}
_HUMP = re.compile(r"(?<=[a-z0-9])([A-Z])")
_CALLED = re.compile(r"(^_+|_?(callback|cb)$)")


@dataclass(frozen=True, slots=True)
class Entity:
    """Something that nodes ask for; `place` is that of the first call, for people to find it.

    `name` is the period of a timer; `details` need not be the same where two are alike.
    """

    kind: str
    name: Json
    type: Json
    details: dict[str, Json]
    place: str

    @property
    def shown(self) -> str:
        """What it is, for people."""
        return f"{self.label} ({self.place})"

    @property
    def label(self) -> str:
        """What it is, wherever it is."""
        type_ = f" {_text(self.type)}" if self.type is not None else ""
        return f"{self.kind} {_text(self.name)}{type_}"


def _text(value: Json) -> str:
    """A name, period or type on one line."""
    if isinstance(value, float):
        return f"{value:.6g}"
    return value if isinstance(value, str) else json.dumps(value)


def entities(graph: dict[str, list[Json]], below: str) -> list[Entity]:
    """Those in the file or folder `below`; each parameter once, whatever is done with it."""
    at = len(below) - len(below.rstrip("/").rpartition("/")[2])
    kept = [
        _entity({**one, "file": item["file"][at:]}, kind)
        for name, kind in KINDS.items()
        for item in graph[name]
        if item["file"].startswith(below)
        for one in (_each(item) if kind == "parameter" else [item])
    ]
    return [*(e for e in kept if e.kind != "parameter"), *_parameters(kept)]


def _entity(item: Json, kind: str) -> Entity:
    place = f"{item['file']}:{item['line']}"
    if kind == "rate":
        period = _inverse(plain(item["hz"]))
        return Entity("timer", period, None, {"one_shot": False, "callback": None}, place)
    details = {key: plain(item.get(key)) for key in _DETAILS.get(kind, ())}
    if "callback" in details:
        details["callback"] = _called(item["callback"])
    if kind == "timer":
        return Entity(kind, plain(item["period"]), None, details, place)
    name = plain(item.get("topic", item.get("name")))
    if kind == "parameter":
        name = _group(name)
    if item.get("nodelet"):
        name = {"nodelet": item["nodelet"].rpartition("::")[2]}
    return Entity(kind, name, plain(item.get("type")), details, place)


def _each(item: Json) -> list[Json]:
    """The parameters that one call asks for, after which of several calls it is."""
    name = item["name"]
    several = isinstance(name, dict) and "one_of" in name
    return [{**item, "name": n} for n in name["one_of"]] if several else [item]


def _parameters(found: Iterable[Entity]) -> Iterator[Entity]:
    """Each parameter once: with its default where any call gives one."""
    by_name: dict[str, Entity] = {}
    for entity in found:
        if entity.kind == "parameter":
            before = by_name.get(repr(entity.name))
            if before is None or before.details["default"] is None:
                by_name[repr(entity.name)] = entity
    yield from by_name.values()


# --- values -------------------------------------------------------------------------------------


def plain(value: Json) -> Json:
    """A value without places, reasons and the order of alternatives."""
    match value:
        case {"one_of": values}:
            return {"one_of": sorted((plain(v) for v in values), key=repr)}
        case {"parameter": name}:
            default = {"default": plain(value["default"])} if "default" in value else {}
            use = {"expression": spelt(value["expression"])} if "expression" in value else {}
            return {"parameter": _parameter_named(plain(name)), **default, **use}
        case {"unknown": _}:
            return {"unknown": value.get("partial", "*")}
        case {"relative": name}:
            return {"unknown": f"*/{name}"}
        case list():
            return [plain(v) for v in value]
        case str():
            return tidied(value)
        case _:
            return value


def _parameter_named(name: Json) -> Json:
    """The name of a parameter, as far as it is known."""
    match name:
        case {"unknown": str(partial)}:
            return {"unknown": _parameter(partial)}
        case {"one_of": names}:
            return {"one_of": [_parameter_named(n) for n in names]}
        case str():
            return _parameter(name)
        case _:
            return name


def _group(name: Json) -> Json:
    """The name of a parameter; of all below a name, which in ROS 1 are one, that name."""
    partial = name["unknown"] if isinstance(name, dict) and "unknown" in name else name
    if not isinstance(partial, str) or partial == "*":
        return name
    if "*" in partial[:-1]:
        return {"unknown": _parameter(partial)}
    return _parameter(partial.removesuffix("*").rstrip("./"))


def _parameter(name: str) -> str:
    return tidied(name).removeprefix("~").lstrip("/").replace("/", ".")


def _inverse(hz: Json) -> Json:
    """The period of a rate."""
    match hz:
        case int() | float() if hz and hz is not True:
            return 1 / hz
        case {"parameter": name, **rest}:
            default = rest.get("default")
            given = {"default": 1 / default} if isinstance(default, int | float) and default else {}
            return {"parameter": name, **given, "expression": "1.0 / value"}
        case _:
            return hz


def _called(callback: Json) -> Json:
    """The name of what is called, without its class and what shows that it is called."""
    match callback:
        case {"function": str(name)}:
            last = re.split(r"::|\.", name)[-1]
            return _CALLED.sub("", _HUMP.sub(r"_\1", last).lower())
        case {"function": None}:
            return "lambda"
        case None:
            return None
        case _:
            return plain(callback)


def agree(one: Json, other: Json) -> bool:
    """Whether two values are the same; numbers as numbers."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(agree(one[k], other[k]) for k in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(agree, one, other))
    return type(one) is type(other) and one == other if one is None else same(one, other)
