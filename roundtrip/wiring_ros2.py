"""The facts that join generated nodes in ROS 2 besides those of ROS 1.

What the constructor declares and makes known to others, what the build makes of it, and what a
launch file in Python gives a node. They are read from the texts alone, whatever the model says.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

from rebsync.reverse.launch.launch_python import bound_once
from rebsync.source import Source, Span

# Kind, owner, name and value of a fact, and where it is.
Told: TypeAlias = "tuple[str, str, str, str, Source, Span]"

_OWNER = re.compile(r"\b(\w+)\s*::\s*\1\s*\(")
_DECLARED = re.compile(r'\bdeclare_parameter\s*<\s*([\w:]+)\s*>\s*\(\s*"([^"]*)"')
_STATE = re.compile(
    r"\b(?:create_publisher|advertise)\s*<\s*[\w:]*State\s*>\s*\(\s*\"[^\"]*\"\s*,([^;]*)\)\s*;"
)
_STOPPED = re.compile(r"~(\w+)\s*\([^;{]*\{[^}]*\bmailbox_\s*\.\s*stop\s*\(\s*\)")
_COMPONENT = re.compile(r"\bRCLCPP_COMPONENTS_REGISTER_NODE\s*\(\s*(?:\w+\s*::\s*)*(\w+)\s*\)")
_BUILT = re.compile(r"\brclcpp_components_register_nodes\s*\(([^)]*)\)")
_MESSAGES = re.compile(r"\b(?:rosidl_generate_interfaces|add_message_files)\s*\(([^)]*)\)")
_LIBRARY = re.compile(r"\badd_library\s*\(\s*(\S+)\s+([^)]*)\)")
_HASH = re.compile(r"#[^\n]*")
_WHOLE = frozenset({"int", "int64_t", "std::int64_t", "long"})
# What decides how a node runs, or what it is told beside the model's; `output` only shows.
_KEYWORDS = (
    *("respawn", "arguments", "ros_arguments", "prefix"),
    *("additional_env", "env", "condition"),
)
_ACTIONS = frozenset({"ComposableNode", "LifecycleNode", "Node"})


def of_code(source: Source, text: str) -> Iterator[Told]:
    """Of a source or header: parameters with their types, the state's quality, components."""
    for m in _STOPPED.finditer(text):
        yield "end of serving", m[1], "", "there", source, Span(*m.span())
    owner = _OWNER.search(text)
    if owner is None:
        return
    for m in _DECLARED.finditer(text):
        type_ = "int" if m[1] in _WHOLE else m[1]
        yield "type of the parameter", owner[1], m[2], type_, source, Span(*m.span())
    for m in _STATE.finditer(text):
        quality = "".join(m[1].split())
        yield "quality of the state", owner[1], "", quality, source, Span(*m.span())
    for m in _COMPONENT.finditer(text):
        yield "component", m[1], "", "registered", source, Span(*m.span())


def of_build(source: Source) -> Iterator[Told]:
    """Of a CMakeLists.txt: libraries with their sources, components, messages."""
    text = _HASH.sub(lambda m: " " * len(m[0]), source.text)
    for m in _LIBRARY.finditer(text):
        for name in (path.rpartition("/")[2] for path in m[2].split()):
            if "." in name:
                yield "source of a program", m[1], name, "there", source, Span(*m.span(1))
    for m in _BUILT.finditer(text):
        for name in re.findall(r'"(?:\w+::)*(\w+)"', m[1]):
            yield "component in the build", name, "", "there", source, Span(*m.span())
    for m in _MESSAGES.finditer(text):
        for name in re.findall(r"(\w+)\.msg\b", m[1]):
            yield "message", "", name, "generated", source, Span(*m.span())


def of_launch(source: Source) -> Iterator[Told]:
    """Of a launch file in Python: what else a node is given, and its files of parameters."""
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError):
        return  # what cannot be read, extraction lists
    names = bound_once(tree)
    for call in (n for n in ast.walk(tree) if isinstance(n, ast.Call)):
        given = {k.arg: k.value for k in call.keywords if k.arg is not None}
        if _called(call) == "GroupAction" and "condition" in given:
            value = ast.unparse(given["condition"])
            yield "group of nodes", "", value, "there", source, _span(source, call)
        if _called(call) not in _ACTIONS:
            continue
        name = given.get("name")
        node = str(name.value) if isinstance(name, ast.Constant) else ""
        span = _span(source, call)
        for key in _KEYWORDS:
            value = _said(given[key], names) if key in given else "not given"
            if key == "arguments" and key in given and _only_logs(given[key]):
                value = "not given"
            yield "node", node, key, value, source, span
        files = _files(given.get("parameters"), names)
        yield "node", node, "parameter file", " and ".join(files) or "none", source, span


def _only_logs(value: ast.expr) -> bool:
    """Whether a node is only told what to log: `["--ros-args", "--log-level", "debug"]`."""
    if not isinstance(value, ast.List | ast.Tuple):
        return False
    items = list(value.elts)
    if items and _is_text(items[0], "--ros-args"):
        items = items[1:]
    pairs = list(zip(items[::2], items[1::2], strict=False))
    return len(items) % 2 == 0 and all(
        _is_text(option, "--log-level") and not isinstance(level, ast.Starred)
        for option, level in pairs
    )


def _is_text(node: ast.expr, text: str) -> bool:
    return isinstance(node, ast.Constant) and node.value == text


def _said(value: ast.expr, names: Mapping[str, ast.expr]) -> str:
    """What a node is given, but for the least severity that it logs."""
    found = _resolved(value, names)
    if not isinstance(found, ast.List | ast.Tuple):
        return ast.unparse(value)
    said = [ast.unparse(each) for each in found.elts]
    level = said.index("'--log-level'") if "'--log-level'" in said else len(said)
    return ", ".join(said[:level] + said[level + 2 :])


def _files(value: ast.expr | None, names: Mapping[str, ast.expr]) -> Iterable[str]:
    """The names of the files that parameters come from."""
    listed = _resolved(value, names)
    for item in listed.elts if isinstance(listed, ast.List | ast.Tuple) else []:
        source = _resolved(item, names)
        if source is not None and not isinstance(source, ast.Dict):
            texts = [n for n in ast.walk(source) if isinstance(n, ast.Constant)]
            last = max(texts, key=lambda n: (n.lineno, n.col_offset), default=None)
            yield Path(str(last.value)).name if last is not None else ast.unparse(source)


def _resolved(value: ast.expr | None, names: Mapping[str, ast.expr]) -> ast.expr | None:
    for _ in names:
        if isinstance(value, ast.Name):
            value = names.get(value.id, value)
    return value


def _called(call: ast.Call) -> str:
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case _:
            return ""


def _span(source: Source, call: ast.Call) -> Span:
    start = source.start_of(call.lineno) + call.col_offset
    return Span(start, start + len(_called(call)))
