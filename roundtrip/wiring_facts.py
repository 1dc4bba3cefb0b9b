"""The facts that join generated nodes: topics, remaps, fields of messages, programs.

They are read from the texts alone, whatever the model says.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from itertools import chain
from pathlib import Path
from typing import TypeAlias

from rebsync.diagnostics import RebsyncError
from rebsync.files import BOM, read_bytes, read_source
from rebsync.records import dataclass
from rebsync.reverse.files.python_files import is_python
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch
from rebsync.roundtrip import wiring_ros2
from rebsync.roundtrip.wiring_texts import conditions, joined, space, squeezed
from rebsync.source import Source, Span

PROGRAM, PLAYED, TYPE, SPACE = "program", "played sensor", "type of a node", "space of parameters"
CONSTANT, CLOCK = "type of the constant", "use_sim_time"
NOT_GIVEN, OWN = "not given", "this package"
_PACKAGE = re.compile(r"<name>\s*([^<\s]+)\s*</name>")

Facts: TypeAlias = "dict[tuple[str, str, str], list[Fact]]"

_STARTED = re.compile(r"\bmailbox_\s*\.\s*start\s*\(\s*\)")
_SHOWS = re.compile(r"\bmailbox_\s*\.\s*onServed\s*\(")
_HASH = re.compile(r"#[^\n]*")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
# Names and literals that a formatter broke.
_BROKEN = re.compile(r'\w+(?:\s*::\s*\w+)+|"[^"\n\\]*"(?:\s*"[^"\n\\]*")+')
_REMARK = re.compile(r"<!--.*?-->", re.DOTALL)
_SENSOR = re.compile(r'[:,]\s*(\w+)\s*[({]\s*\w+\s*,\s*("[^"]*")\s*[)}]')
_PLAYED = re.compile(r'\bnode\s*\.\s*advertise\s*<[^;()]*>\s*\(\s*"([^"]*)"')
MAIN = re.compile(r"\bint\s+main\s*\(")
_MADE = re.compile(r"\b(?:\w+\s*::\s*)*(\w+)\s+\w+\s*[({]\s*node\s*[,)}]")
_SHARED = re.compile(
    r"\bmake_shared\s*<\s*(?:\w+\s*::\s*)*(\w+)\s*>\s*\(\s*rclcpp\s*::\s*NodeOptions\b"
)
_OWNER = re.compile(r"\b(\w+)\s*::\s*\1\s*\(")
_SUBSCRIBED = re.compile(r'\b(subscribe\w*)\s*(?:<[^;()]*>\s*)?\(\s*("[^"]*")\s*,')
_HANDLER = re.compile(r"&\s*(?:\w+\s*::\s*)+(\w+)|\b(k[A-Z]\w*)")
_ADVERTISED = re.compile(r"\b(\w+)\s*=\s*mailbox_\s*\.\s*(advertise\w*\s*<[^;]*?\([^;]*\))\s*;")
_OFFERED = re.compile(r"\b(\w+)\s*=\s*mailbox_\s*\.\s*(offer\w*\s*<[^;]*?\([^;]*\))\s*;")
_SERVER = re.compile(r'\bServer\s+(\w+)\s*\{\s*("[^"]*")\s*,\s*([^}]*?)\s*\}')
_ENTRY = re.compile(r"^([ \t]*)(\w+):[ \t]*([^\n#]*?)[ \t]*(?:#.*)?$", re.MULTILINE)
_BEARING = {
    "mailbox": ("time_unit", "settle"),
    "drive": ("cell_size", "kind", "heading", "move_time", "odometry"),
}
_PROGRAM = re.compile(r"\b(add_executable|set_target_properties)\s*\(\s*(\S+)\s+([^)]*)\)")
_NAMED = re.compile(r"\bset_target_properties\s*\(\s*(\S+)\s[^)]*\bOUTPUT_NAME\s+(\w+)")
_TARGETS = re.compile(r"\binstall\s*\(\s*TARGETS\s+([^)]*)\)")
_SCRIPT = re.compile(r"^[ \t]*scripts/(\w+)[ \t]*$", re.MULTILINE)
_MODULES = re.compile(r"\bcatkin_python_setup\s*\(\s*\)")
_GENERATED = re.compile(r"\bgenerate_messages\s*\(")
_FOLDERS = re.compile(r"\bDIRECTORY\s+([\w\s]+?)\s+DESTINATION\b")
# A section of parameters in ROS 2 that is not for all nodes.
_ONE_NODE = re.compile(r"^(?!/\*\*:)([^\s#][^\n]*):[ \t]*\n[ \t]+ros__parameters:", re.MULTILINE)
# The environment that has to do with what is shown only.
_SHOWN = ("ROSCONSOLE_", "RCUTILS_", "ROS_LOG_DIR")
_TYPES = {
    "a whole number": re.compile(r"[+-]?(?:0x[\da-fA-F]+|\d[\d_]*)"),
    "a fraction": re.compile(r"[+-]?(?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?"),
    "a truth": re.compile(r"true|false|yes|no|on|off", re.IGNORECASE),
}
_FOLDER = re.compile(r"^(script_dir|install_scripts)[ \t]*=[ \t]*(\S+)", re.MULTILINE)
_COMPILED = re.compile(
    r"\b(?:add|target)_(?:compile_\w+|definitions)\s*\(([^)]*)\)"
    r"|_(?:FLAGS|OPTIONS)\s+([^)]*)\)|\bset\s*\(\s*\w+\s+([^)]*)\)"
)
_DEFINED = re.compile(r"_(?:compile_definitions\s*\(\s*[^\s)]+|COMPILE_DEFINITIONS)\s+([^)]*)\)")
_SCOPES = frozenset({"PRIVATE", "PUBLIC", "INTERFACE"})
_OPTION = re.compile(r"(?:^|[\s\"])((?:-D|-U|-f|-include)\s*[^\s\"]+)")
_FAR = 400  # characters within which a subscription names its handler
_POSTED = re.compile(r"\bk[A-Z]\w*")
_TAG = re.compile(r"<(/?)([\w-]+)((?:\s+[\w-]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*)\s*(/?)>")
_ATTRIBUTE = re.compile(r"([\w-]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")
_STATE = re.compile(r"^string server\nstring arguments$", re.MULTILINE)
_FIELD = re.compile(r"^[ \t]*([\w/\[\]]+)[ \t]+(\w+)[ \t]*(?:#.*)?$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Fact:
    """Something that joins nodes: its kind, whose it is, its name, what it is, and the place."""

    kind: str
    owner: str
    name: str
    value: str
    source: Source
    span: Span

    @property
    def key(self) -> tuple[str, str, str]:
        """By what it is known in another state of the package."""
        return self.kind, self.owner, self.name


def package_name(path: str) -> str:
    """The name of a package by its `package.xml`; empty where that does not tell."""
    with suppress(RebsyncError):
        found = _PACKAGE.search(read_source(path).text)
        return found[1] if found is not None else ""
    return ""


def facts_of(paths: Mapping[str, str], package: str = "") -> Facts:
    """The facts in files of a package of that name, by their keys; `paths` are by names inside."""
    found: Facts = {}
    for name, path in sorted(paths.items()):
        with suppress(RebsyncError):  # what cannot be read, extraction lists
            source = Source(path, _text(read_bytes(path)))
            for fact in _told(name, source, package):
                found.setdefault(fact.key, []).append(fact)
    return found


@lru_cache(maxsize=256)  # most texts are there as they were and as they are, and asked for again
def _told(name: str, source: Source, package: str) -> tuple[Fact, ...]:
    return tuple(_of_file(name, source, package))


def _text(data: bytes) -> str:
    """The text of a file; an odd byte, which extraction lists, changes only what it is in."""
    return data.removeprefix(BOM).decode("utf-8", "replace").replace("\r\n", "\n")


def _of_file(name: str, source: Source, package: str) -> Iterable[Fact]:
    if name.endswith((".msg", ".srv", ".action")):
        return _fields(source, package)
    if name.endswith(".yaml"):
        return _settings(source)
    if name.endswith("package.xml"):
        return _other_package(source, package)
    if name.endswith(".cfg"):
        return _folders(source)
    if name.endswith(".txt"):
        return chain(_programs(source), (Fact(*told) for told in wiring_ros2.of_build(source)))
    if name.endswith(".launch.py"):
        return _declared(source, package)
    if is_python(name, source):
        from rebsync.roundtrip.wiring_python import facts_in_python

        return facts_in_python(name, source, package)
    is_launch = name.endswith(".launch")
    text = (_REMARK if is_launch else _COMMENT).sub(lambda m: " " * len(m[0]), source.text)
    if not is_launch:
        text = _BROKEN.sub(joined, text)
    if is_launch:
        return _launched(source, text, package)
    program = Path(name).stem
    more = (Fact(*told) for told in wiring_ros2.of_code(source, text))
    return chain(_joints(source, text), _made(program, source, text), more)


def _joints(source: Source, text: str) -> Iterator[Fact]:
    """Subscriptions by the server that they are for, publishers, sensors."""
    owner = _OWNER.search(text)
    if owner is None:
        return
    servers = {m[1]: m[2].strip('"') for m in _SERVER.finditer(text)}
    for number, m in enumerate(_STARTED.finditer(text)):
        told = "there again" if number else "there"
        yield Fact("start of serving", owner[1], "", told, source, Span(*m.span()))
    for m in _SHOWS.finditer(text):
        yield Fact("state after each body", owner[1], "", "shown", source, Span(*m.span()))
    for m in _SENSOR.finditer(text):
        yield Fact("sensor", owner[1], m[1], m[2], source, Span(*m.span(2)))
    for m in _SUBSCRIBED.finditer(text):
        server = _server_of(text, m.end(), servers)
        yield Fact("subscription", owner[1], server, f"{m[1]} {m[2]}", source, Span(*m.span()))
    for m in _ADVERTISED.finditer(text):
        value = squeezed(m[2])
        yield Fact("publisher", owner[1], m[1], value, source, Span(*m.span()))
    for m in _OFFERED.finditer(text):
        yield Fact("service", owner[1], m[1], squeezed(m[2]), source, Span(*m.span()))


def _made(program: str, source: Source, text: str) -> Iterator[Fact]:
    """What a program makes a rebec of, or what sensors it plays."""
    if not MAIN.search(text):
        return
    for m in chain(_MADE.finditer(text), _SHARED.finditer(text)):
        yield Fact(PROGRAM, program, "", m[1], source, Span(*m.span()))
    for m in _PLAYED.finditer(text):
        yield Fact(PLAYED, program, m[1], m[1], source, Span(*m.span()))


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
    body = re.search(rf"::\s*{handler}\s*\([^{{;]*\)\s*\{{(.*?)\n\}}", text, re.DOTALL)
    for constant in _POSTED.findall(body[1]) if body is not None else ():
        if constant in servers:
            return servers[constant]
    return handler


def _launched(source: Source, text: str, package: str) -> Iterator[Fact]:
    """Of each node its package, type, namespace and remaps; lists of rebecs.

    Remaps outside of nodes, which all that follow have, are those of no node.
    """
    node, groups = "", list[dict[str, str]]()
    for m in _TAG.finditer(text):
        end, tag, rest, closed = m.groups()
        given = {a[1]: a[2] if a[2] is not None else a[3] for a in _ATTRIBUTE.finditer(rest)}
        span = Span(*m.span())
        is_absolute = given.get("name", "").startswith("/")  # whatever it is in
        if tag in ("param", "rosparam") and not (end or node or is_absolute):
            yield Fact(SPACE, "", str(m.start()), space(groups), source, span)
        match tag:
            case "group" if end:
                groups = groups[:-1]
            case "group" if not closed:
                groups.append(given)
            case "node" if not end:
                name = given.get("name", "")
                node = "" if closed else name
                if given.get("pkg") == package:
                    given["pkg"] = OWN
                given["if"], given["ns"] = conditions([*groups, given]), space([*groups, given])
                if not _may_rename(given.get("args", "")):
                    given.pop("args", None)
                for key in ("pkg", "respawn", "ns", "args", "if"):
                    yield Fact("node", name, key, given.get(key) or NOT_GIVEN, source, span)
                yield Fact(TYPE, name, "", given.get("type", ""), source, span)
            case "node":
                node = ""
            case "env" if not end and not given.get("name", "").startswith(_SHOWN):
                name, value = given.get("name", ""), given.get("value", "")
                yield Fact("environment", node, name, value, source, span)
            case "include" if not end and not _is_own(given.get("file", ""), package):
                yield Fact("launch file", "", given.get("file", ""), "included", source, span)
            case "remap":
                yield Fact("remap", node, given.get("from", ""), given.get("to", ""), source, span)
            case "rosparam" if not end and not closed and "param" in given:
                value = squeezed(text[m.end() : text.find("</rosparam>", m.end())])
                yield Fact("parameter", "", given["param"], value, source, span)
            case "rosparam" if given.get("command") == "load":
                value = given.get("file", "").rpartition("/")[2]
                yield Fact("parameter file", "", value, "loaded", source, span)
            case "param" if not node and _has_bearing(given.get("name", "")):
                name, value = given["name"].strip("/"), given.get("value", "")
                yield Fact("setting", "", name, value, source, span)
            case _:
                pass


def _may_rename(arguments: str) -> bool:
    """Whether arguments of a program are more than what generated programs do not look at."""
    return any(sign in arguments for sign in (":=", "$(", "__"))


def _declared(source: Source, package: str) -> Iterator[Fact]:
    """The same of a launch file in Python, but for what a node is made of."""
    launch = read_ros2_launch(source, lambda _: None)
    for unknown in launch.unknowns:
        said = source.text[unknown.span.start : unknown.span.end]
        if not _is_own(said, package):
            yield Fact("unknown", "", unknown.what, unknown.why, source, unknown.span)
    for node in launch.nodes:
        name = str(node.name)
        of = OWN if node.package == package else str(node.package)
        facts = {"pkg": of, "ns": str(node.namespace), "if": " ".join(node.only_if)}
        for key, value in facts.items():
            yield Fact("node", name, key, value or NOT_GIVEN, source, node.span)
        yield Fact(TYPE, name, "", str(node.type), source, node.span)
        for remap in node.remaps:
            yield Fact("remap", name, remap.private, str(remap.target), source, remap.span)
        clocks = [repr(p.value) for p in node.parameters if p.name == CLOCK]
        yield Fact("node", name, CLOCK, (clocks or [NOT_GIVEN])[-1], source, node.span)
        for given in node.parameters:
            section = given.name.partition("/")[0]
            is_constant = section == "env"  # whose value is read where parameters are
            kind = "setting" if is_constant or _has_bearing(given.name) else "parameter"
            if is_constant or section in _BEARING:
                yield Fact(kind, name, given.name, repr(given.value), source, given.span)
    yield from (Fact(*told) for told in wiring_ros2.of_launch(source))


def _is_own(said: str, package: str) -> bool:
    """Whether what is said of a file is of the package itself, where extraction reads it."""
    if f"$(find {package})" in said or "$(dirname)" in said:
        return True
    # formatters choose the quotes and the lines
    return re.search(rf"""\(\s*(["']){re.escape(package)}\1\s*,?\s*\)""", said) is not None


def _fields(source: Source, package: str) -> Iterator[Fact]:
    message = Path(source.path).stem
    if _STATE.search(source.text):
        return  # what a node tells of itself, and no other takes
    for m in _FIELD.finditer(source.text):
        type_ = m[1].removeprefix(f"{package}/")
        yield Fact("field", message, m[2], type_, source, Span(*m.span()))


def _settings(source: Source) -> Iterator[Fact]:
    """What in the parameters has a bearing on what nodes do, but for the values of constants."""
    section = ""
    for m in _ONE_NODE.finditer(source.text):
        yield Fact(
            "parameters", "", m[1].strip("\"'"), "given for it alone", source, Span(*m.span(1))
        )
    for m in _ENTRY.finditer(source.text):
        if m[3] and (not m[1] or section == "env"):
            yield Fact(CONSTANT, "", m[2], _type_of(m[3]), source, Span(*m.span(2)))
        if not m[1] or not m[3]:
            section = m[2]
        elif m[2] in _BEARING.get(section, ()):
            yield Fact("parameter", "", f"{section}/{m[2]}", m[3], source, Span(*m.span(2)))


def _type_of(value: str) -> str:
    """The type that a value has in YAML, as ROS tells them apart."""
    return next((name for name, pattern in _TYPES.items() if pattern.fullmatch(value)), "a text")


def _folders(source: Source) -> Iterator[Fact]:
    """Where a `setup.cfg` has programs installed, from where launch files start them."""
    for m in _FOLDER.finditer(source.text):
        yield Fact("folder of programs", "", m[1], m[2], source, Span(*m.span()))


def _other_package(source: Source, package: str) -> Iterator[Fact]:
    """The name of a package of messages beside the one of the nodes, `package`."""
    found = _PACKAGE.search(source.text)
    if found is not None and package and found[1] != package:
        value = found[1].replace(package, OWN)
        yield Fact("name of the package", "", "messages", value, source, Span(*found.span(1)))


def _has_bearing(name: str) -> bool:
    section, _, rest = name.strip("/").partition("/")
    return rest in _BEARING.get(section, ())


def _programs(source: Source) -> Iterator[Fact]:
    """The files that programs are made of, what these are called, how they are compiled."""
    commands = _HASH.sub(lambda m: " " * len(m[0]), source.text)
    for m in _COMPILED.finditer(commands):
        for option in _OPTION.findall(m[1] or m[2] or m[3] or ""):
            yield Fact("compiler option", "", squeezed(option), "given", source, Span(*m.span()))
    for m in _DEFINED.finditer(commands):
        for word in sorted({*m[1].split()} - _SCOPES):
            option = f"-D{word.removeprefix('-D')}"
            yield Fact("compiler option", "", option, "given", source, Span(*m.span()))
    named = {m[1]: m[2] for m in _NAMED.finditer(source.text)}
    for m in _TARGETS.finditer(source.text):
        for target in re.split(r"\b[A-Z]+\b(?! *\})", m[1])[0].split():
            name = named.get(target, target)
            yield Fact("installed program", "", name, "there", source, Span(*m.span(1)))
    for m in _SCRIPT.finditer(source.text):
        yield Fact("installed program", "", m[1], "there", source, Span(*m.span()))
    for m in _FOLDERS.finditer(source.text):
        for folder in m[1].split():
            yield Fact("installed folder", "", folder, "there", source, Span(*m.span(1)))
    for m in _GENERATED.finditer(commands):
        yield Fact("code of the messages", "", "", "generated", source, Span(*m.span()))
    for m in _MODULES.finditer(commands):
        yield Fact("Python package", "", "", "built", source, Span(*m.span()))
    for m in _PROGRAM.finditer(source.text):
        command, target, rest = m.groups()
        target, span = named.get(target, target), Span(*m.span(2))
        if command == "set_target_properties":
            yield Fact("name of a program", target, "", squeezed(rest), source, span)
            continue
        for path in rest.split():
            name = path.rpartition("/")[2]
            yield Fact("source of a program", target, name, "there", source, span)
