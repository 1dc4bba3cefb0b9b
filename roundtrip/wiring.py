"""How generated nodes are joined: topics, priorities of servers, remaps, fields of messages.

An extracted model does not show these: it knows who sends what to whom, not by which topic. So they
must be as they were generated, but for classes whose servers, known rebecs or instances changed:
there they follow the change.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import TypeAlias

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.files import read_source
from rebsync.records import dataclass
from rebsync.reverse.launch.launch_python import read_python_launch
from rebsync.roundtrip.difference import (
    Added,
    Aspect,
    Changed,
    Comparison,
    Difference,
    Moved,
    Removed,
    Renamed,
)
from rebsync.roundtrip.digests import Standing
from rebsync.roundtrip.manifest import BASE
from rebsync.roundtrip.packages import Kept
from rebsync.roundtrip.recorded import Record
from rebsync.source import NOWHERE, Source, Span

Facts: TypeAlias = "dict[tuple[str, str, str], list[_Fact]]"

_WIRED = (
    *(".cpp", ".h", ".hpp", ".launch", ".launch.py", ".msg"),
    *("CMakeLists.txt", "config/params.yaml"),
)
_JOINING = frozenset(
    {
        *(Aspect.TYPE, Aspect.PARAMETERS, Aspect.BINDING, Aspect.EXTENDS, Aspect.IMPLEMENTS),
        *(Aspect.ABSTRACT, Aspect.ANNOTATION),
    }
)
# Without these extraction lists what they were for; and somebody may call them otherwise.
_MISSED = frozenset(
    {"subscription", "publisher", "priority", "usual time", "sending", "sender", "parameter for"}
)
# What was not there when the code was generated makes a difference too.
_UNWANTED = frozenset({"setting", "compiler option"})
_HINT = "take the edit back, or tell of it in the model"
_LAYOUT = re.compile(r" ?([^\w \"]) ?")
_READ = re.compile(
    r"\b(\w+)\s*=\s*(?:global\s*\.\s*param|declare_parameter)(?:<[^<>]*>)?\s*\(\s*(\"[^\"]*\")"
)
_BEST = re.compile(r"\bmailbox_\s*\(\s*\w+\s*,[^,()]*(?:,\s*([^()]*?)\s*)?\)")
_STARTED = re.compile(r"\bmailbox_\s*\.\s*start\s*\(\s*\)")
_SENT_BY = re.compile(r"\bmailbox_\s*\.\s*receive\s*\(\s*(\w+)\s*,[^,]*,\s*([^,]*?)\s*,")
_HASH = re.compile(r"#[^\n]*")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|<!--.*?-->", re.DOTALL)
_OWNER = re.compile(r"\b(\w+)::\1\s*\(")
_SUBSCRIBED = re.compile(r'\b(subscribe\w*)\s*(?:<[^;()]*>\s*)?\(\s*("[^"]*")\s*,')
_HANDLER = re.compile(r"&\s*(?:\w+::)+(\w+)|\b(k[A-Z]\w*)")
_ADVERTISED = re.compile(r"\b(\w+)\s*=\s*mailbox_\s*\.\s*(advertise\w*\s*<[^;]*?\([^;]*\))\s*;")
_SERVER = re.compile(r'\bServer\s+(\w+)\s*\{\s*("[^"]*")\s*,\s*([^}]*?)\s*\}')
_ENTRY = re.compile(r"^([ \t]*)(\w+):[ \t]*([^\n#]*?)[ \t]*(?:#.*)?$", re.MULTILINE)
_BEARING = {
    "mailbox": ("time_unit", "settle"),
    "drive": ("cell_size", "kind", "heading", "move_time"),
}
_PROGRAM = re.compile(r"\b(add_executable|set_target_properties)\s*\(\s*(\S+)\s+([^)]*)\)")
_COMPILED = re.compile(
    r"\b(?:add|target)_(?:compile_\w+|definitions)\s*\(([^)]*)\)|_FLAGS\s+([^)]*)\)"
)
_OPTION = re.compile(r"(?:^|[\s\"])((?:-D|-U|-f|-include)\s*[^\s\"]+)")
_USUAL = re.compile(r"\b(\w+)\s*\([^;{}]*\bWhen\s*&\s*\w+\s*=\s*([^;]*?)\s*\)\s*;")
_CLASS = re.compile(r"\bclass\s+(\w+)[^;{]*\{")
_SENDER = re.compile(
    r"\b(\w+)::(\w+)\s*\([^;{}]*\bWhen\s*&[^;{}]*\)\s*\{(.*?)^\}", re.M | re.DOTALL
)
_CALLED = re.compile(r"\bmailbox_\s*\.\s*(?:post|publish)\s*\(")
_BRANCH = re.compile(r"\b(?:if|for|while|switch|return|throw)\b|&&|\|\|")
_FAR = 400  # characters within which a subscription names its handler
_POSTED = re.compile(r"\bk[A-Z]\w*")
_TAG = re.compile(r"<(/?)([\w-]+)((?:\s+[\w-]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*)\s*(/?)>")
_ATTRIBUTE = re.compile(r"([\w-]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")
_STATE = re.compile(r"^string server\nstring arguments$", re.MULTILINE)
_FIELD = re.compile(r"^[ \t]*([\w/\[\]]+)[ \t]+(\w+)[ \t]*(?:#.*)?$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class _Fact:
    """Something that joins nodes: its kind, whose it is, its name, what it is, and the place."""

    kind: str
    owner: str
    name: str
    value: str
    source: Source
    span: Span

    @property
    def key(self) -> tuple[str, str, str]:
        return self.kind, self.owner, self.name


def odd_wiring(
    kept: Kept, record: Record, now: Standing, of_code: Comparison
) -> tuple[Findings, ...]:
    """The places where nodes are not joined as they were when the code was generated."""
    touched = {*now.changed, *now.missing} & record.files.keys()
    if not any(_is_wiring(name) for name in touched):
        return ()
    base = _facts({n: f"{kept.root}/{BASE}{n}" for n in record.files if _is_wiring(n)})
    today = _facts({n: p for n, p in now.listing.files.items() if _is_wiring(n)})
    joined = {d.element.group or "" for d in of_code.differences if _joins(d)}
    joined |= {d.element.kind for d in of_code.differences if d.element.kind == "env"}
    base |= {
        key: [] for key, facts in today.items() if facts[0].kind in _UNWANTED and key not in base
    }
    found = list[Findings]()
    files = {name.rpartition("/")[2] for name in now.listing.files}
    for key, facts in base.items():
        first = (facts or today[key])[0]
        if not (_has_moved(first, files) or _is_excused(first, joined)):
            found += _changes(kept, facts, today.get(key, []))
    return tuple(found)


def _is_wiring(name: str) -> bool:
    return name.endswith(_WIRED)


def _joins(difference: Difference) -> bool:
    """Whether the wiring has to follow a difference."""
    match difference:
        case Added() | Removed() | Renamed() | Moved():
            return difference.element.kind not in ("env", "statevar", "method", "parameter")
        case Changed(aspect=aspect):
            return aspect in _JOINING
        case _:
            return False


def _has_moved(fact: _Fact, files: set[str]) -> bool:
    """Whether a fact is about a file that is somewhere else, or called otherwise."""
    about = {"source of a program": fact.name, "field": f"{fact.owner}.msg"}.get(fact.kind)
    return about is not None and about not in files


def _is_excused(fact: _Fact, joined: set[str]) -> bool:
    if fact.kind in _UNWANTED:
        return False
    if fact.kind in ("remap", "node", "parameter") or fact.kind.endswith(" program"):
        return bool(joined - {"env"})
    if fact.kind == "field":
        return any(fact.owner.startswith(group) for group in joined)
    return fact.owner in joined or (fact.kind == "parameter for" and "env" in joined)


def _changes(kept: Kept, before: list[_Fact], now: list[_Fact]) -> Iterator[Findings]:
    """What of the facts of one key is not as it was."""
    old, new = {f.value for f in before}, {f.value for f in now}
    first = (before or now)[0]
    if old == new or (not new and first.kind in _MISSED):
        return
    what = " ".join(filter(None, ("the", first.kind, first.name)))
    what += f" of {first.owner}" if first.owner else ""
    is_now = " and ".join(sorted(new)) or "gone"
    message = f"{what} is {is_now}; generated was {' and '.join(sorted(old)) or 'none'}"
    place = next((f for f in now if f.value not in old), None)
    if place is None:
        place = now[0] if now else None
    source = place.source if place else Source(f"{kept.root}/{_inside(kept, first)}", "")
    span = place.span if place else NOWHERE
    yield Findings(source, (Diagnostic("RS956", span, message, _HINT),))


def _inside(kept: Kept, fact: _Fact) -> str:
    return fact.source.path.removeprefix(f"{kept.root}/{BASE}")


# --- facts --------------------------------------------------------------------------------------


def _facts(paths: Mapping[str, str]) -> Facts:
    found: Facts = {}
    for name, path in sorted(paths.items()):
        with suppress(RebsyncError):  # what cannot be read, extraction lists
            source = read_source(path)
            for fact in _of_file(name, source):
                found.setdefault(fact.key, []).append(fact)
    return found


def _of_file(name: str, source: Source) -> Iterable[_Fact]:
    if name.endswith(".msg"):
        return _fields(source)
    if name.endswith(".yaml"):
        return _settings(source)
    if name.endswith(".txt"):
        return _programs(source)
    if name.endswith(".py"):
        return _declared(source)
    blank = Source(source.path, _COMMENT.sub(lambda m: " " * len(m[0]), source.text))
    if name.endswith(".launch"):
        return _launched(source, blank.text)
    return chain(_joints(source, blank.text), _sendings(source, blank.text))


def _joints(source: Source, text: str) -> Iterator[_Fact]:
    """Subscriptions by the server that they are for, publishers, priorities."""
    owner = _OWNER.search(text)
    if owner is None:
        return
    servers = {m[1]: m[2].strip('"') for m in _SERVER.finditer(text)}
    for m in _SERVER.finditer(text):
        priority = _squeezed(m[3])
        yield _Fact("priority", owner[1], m[2].strip('"'), priority, source, Span(*m.span()))
    for m in _READ.finditer(text):
        yield _Fact("parameter for", owner[1], m[1], m[2], source, Span(*m.span()))
    for m in _STARTED.finditer(text):
        yield _Fact("start of serving", owner[1], "", "there", source, Span(*m.span()))
    for m in _BEST.finditer(text):
        yield _Fact("best priority", owner[1], "", m[1] or "none", source, Span(*m.span()))
    for m in _SENT_BY.finditer(text):
        name = servers.get(m[1], m[1])
        yield _Fact("sender", owner[1], name, _squeezed(m[2]), source, Span(*m.span()))
    for m in _SUBSCRIBED.finditer(text):
        server = _server_of(text, m.end(), servers)
        yield _Fact("subscription", owner[1], server, f"{m[1]} {m[2]}", source, Span(*m.span()))
    for m in _ADVERTISED.finditer(text):
        value = _squeezed(m[2])
        yield _Fact("publisher", owner[1], m[1], value, source, Span(*m.span()))


def _sendings(source: Source, text: str) -> Iterator[_Fact]:
    """How functions that send do that: when, if not told, and how often."""
    for m in _USUAL.finditer(text):
        owners = [c[1] for c in _CLASS.finditer(text, 0, m.start())]
        owner = owners[-1] if owners else ""
        yield _Fact("usual time", owner, m[1], _squeezed(m[2]), source, Span(*m.span()))
    for m in _SENDER.finditer(text):
        value = f"{len(_CALLED.findall(m[3]))} sent, {len(_BRANCH.findall(m[3]))} branches"
        yield _Fact("sending", m[1], m[2], value, source, Span(*m.span(2)))


def _server_of(text: str, start: int, servers: Mapping[str, str]) -> str:
    """The server that a subscription is for: what it, or else its handler, posts to."""
    for method, constant in _HANDLER.findall(text[start : start + _FAR]):
        if constant in servers:
            return servers[constant]
        if method:
            return _posted_in(text, method, servers)
    return ""


def _posted_in(text: str, handler: str, servers: Mapping[str, str]) -> str:
    """The server that a handler posts to; its own name if it posts to none."""
    body = re.search(rf"::{handler}\s*\([^{{;]*\)\s*\{{(.*?)\n\}}", text, re.DOTALL)
    for constant in _POSTED.findall(body[1]) if body is not None else ():
        if constant in servers:
            return servers[constant]
    return handler


def _launched(source: Source, text: str) -> Iterator[_Fact]:
    """Of each node its package, whether it is started again, and its remaps; lists of rebecs."""
    node = ""
    spaces = list[str]()
    for m in _TAG.finditer(text):
        end, tag, rest, closed = m.groups()
        given = {a[1]: a[2] if a[2] is not None else a[3] for a in _ATTRIBUTE.finditer(rest)}
        span = Span(*m.span())
        match tag:
            case "group" if end:
                spaces = spaces[:-1]
            case "group" if not closed:
                spaces.append(given.get("ns", ""))
            case "node" if not end:
                name = given.get("name", "")
                node = "" if closed else name
                given["ns"] = "/".join(filter(None, (*spaces, given.get("ns"))))
                for key in ("pkg", "respawn", "ns"):
                    yield _Fact("node", name, key, given.get(key) or "not given", source, span)
            case "node":
                node = ""
            case "remap" if node:
                yield _Fact("remap", node, given.get("from", ""), given.get("to", ""), source, span)
            case "rosparam" if not end and not closed and "param" in given:
                value = _squeezed(text[m.end() : text.find("</rosparam>", m.end())])
                yield _Fact("parameter", "", given["param"], value, source, span)
            case "rosparam" if given.get("command") == "load":
                value = given.get("file", "").rpartition("/")[2]
                yield _Fact("parameter file", "", value, "loaded", source, span)
            case "param" if not node and _has_bearing(given.get("name", "")):
                name, value = given["name"].strip("/"), given.get("value", "")
                yield _Fact("setting", "", name, value, source, span)
            case _:
                pass


def _declared(source: Source) -> Iterator[_Fact]:
    """The same of a launch file in Python."""
    for node in read_python_launch(source, lambda _: None).nodes:
        name = str(node.name)
        facts = {"pkg": str(node.package), "ns": str(node.namespace), "if": " ".join(node.only_if)}
        for key, value in facts.items():
            yield _Fact("node", name, key, value or "not given", source, node.span)
        for remap in node.remaps:
            yield _Fact("remap", name, remap.private, str(remap.target), source, remap.span)
        for given in node.parameters:
            if given.name.partition("/")[0] in _BEARING:
                yield _Fact("parameter", name, given.name, repr(given.value), source, given.span)


def _fields(source: Source) -> Iterator[_Fact]:
    message = Path(source.path).stem
    if _STATE.search(source.text):
        return  # what a node tells of itself, and no other takes
    for m in _FIELD.finditer(source.text):
        yield _Fact("field", message, m[2], m[1], source, Span(*m.span()))


def _settings(source: Source) -> Iterator[_Fact]:
    """What in the parameters of the run-time part has a bearing on what nodes do."""
    section = ""
    for m in _ENTRY.finditer(source.text):
        if not m[1] or not m[3]:
            section = m[2]
        elif m[2] in _BEARING.get(section, ()):
            yield _Fact("parameter", "", f"{section}/{m[2]}", m[3], source, Span(*m.span(2)))


def _has_bearing(name: str) -> bool:
    section, _, rest = name.strip("/").partition("/")
    return rest in _BEARING.get(section, ())


def _programs(source: Source) -> Iterator[_Fact]:
    """The files that programs are made of, what these are called, how they are compiled."""
    for m in _COMPILED.finditer(_HASH.sub(lambda m: " " * len(m[0]), source.text)):
        for option in _OPTION.findall(m[1] or m[2] or ""):
            yield _Fact("compiler option", "", _squeezed(option), "given", source, Span(*m.span()))
    for m in _PROGRAM.finditer(source.text):
        command, target, rest = m.groups()
        span = Span(*m.span(2))
        if command == "set_target_properties":
            yield _Fact("name of a program", target, "", _squeezed(rest), source, span)
            continue
        for path in rest.split():
            name = path.rpartition("/")[2]
            yield _Fact("source of a program", target, name, "there", source, span)


def _squeezed(text: str) -> str:
    """A text without layout."""
    return _LAYOUT.sub(r"\1", " ".join(text.split()))
