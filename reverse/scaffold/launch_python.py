"""The facts of a launch file in Python: what each node is started with."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch
from rebsync.reverse.launch.launch_python import bound_once
from rebsync.reverse.launch.launch_python_values import PythonValues
from rebsync.reverse.launch.python_arguments import called
from rebsync.reverse.scaffold.fact import (
    CLOCK,
    NOT_GIVEN,
    OWN,
    PARAMETERS,
    SHOWN,
    TYPE,
    UNKNOWN,
    Fact,
    has_bearing,
    is_of_runtime,
    speaks,
)
from rebsync.reverse.scaffold.prefixes import is_harmless
from rebsync.reverse.scaffold.texts import is_of_package
from rebsync.source import Source, Span

Load = Callable[[str], "Source | None"]

# What decides how a node runs, or what it is told beside the model's; `output` only shows.
_KEYWORDS = (
    *("respawn", "arguments", "ros_arguments", "prefix"),
    *("additional_env", "env", "condition"),
)
_READ_ALONE = (".launch.py", PARAMETERS)  # files that have facts of their own
_ACTIONS = frozenset({"ComposableNode", "LifecycleNode", "Node"})
_PROCESSES = frozenset({"ExecuteProcess", "ExecuteLocal"})
_STARTING = (["ros2", "run"], ["ros2", "launch"])
_ENVIRONMENT = frozenset(
    {"SetEnvironmentVariable", "AppendEnvironmentVariable", "UnsetEnvironmentVariable"}
    | {"ResetEnvironment"}
)
_CONFIGURING = frozenset({"DeclareLaunchArgument", "SetLaunchConfiguration"})


def facts_of_python_launch(source: Source, package: str, load: Load) -> Iterator[Fact]:
    """What it starts, and what else it says of that, with what included files set before.

    Nodes that other files start are facts of these, and so are the values of the parameters.
    """
    launch = read_ros2_launch(source, load, package)
    own = [node for node in launch.nodes if node.source is source]
    others = [node.span for node in own if node.package != package]
    for unknown in launch.unknowns:
        if unknown.source is not source and unknown.source.path.endswith(_READ_ALONE):
            continue
        said, at = source.text[unknown.span.start : unknown.span.end], unknown.span.start
        is_handed = any(span.start <= at < span.end for span in others)
        if is_handed and unknown.what.startswith("the parameter "):
            continue  # what they are handed are facts of their own
        if not is_of_package(said, package):
            yield Fact(UNKNOWN, "", unknown.what, unknown.why, unknown.source, unknown.span)
    for node in own:
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
        for given in (p for p in node.parameters if not p.source.path.endswith(PARAMETERS)):
            section = given.name.partition("/")[0]
            is_constant = section == "env"  # whose value is read where parameters are
            kind = "setting" if is_constant or has_bearing(given.name) else "parameter"
            if is_constant or is_of_runtime(section):
                yield Fact(kind, name, given.name, repr(given.value), source, given.span)
    yield from _actions(source, package)


def _actions(source: Source, package: str) -> Iterator[Fact]:
    """What else a node is given, and its files of parameters."""
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError):
        return  # what cannot be read, extraction lists
    values = PythonValues(source, bound_once(tree))
    defaults = dict(_defaults(tree, values))
    for each in _prefixes(tree):
        yield Fact("setting", "", "launch-prefix", "given", source, _span(source, each))
    for call in (n for n in values.walk(tree) if isinstance(n, ast.Call)):
        given = values.keywords(call)
        if called(call) == "GroupAction" and "condition" in given:
            value = ast.unparse(given["condition"])
            yield Fact("group of nodes", "", value, "there", source, _span(source, call))
        yield from _around(source, call, values, package)
        if called(call) not in _ACTIONS:
            continue
        parts = values.words(given["name"]).parts if "name" in given else ()
        node = "".join(p if isinstance(p, str) else "" for p in parts)
        span = _span(source, call)
        for key in _KEYWORDS:
            value = _said(given[key], values) if key in given else "not given"
            if key in given and _is_idle(key, _default(given[key], values, defaults), values):
                value = "not given"
            yield Fact("node", node, key, value, source, span)
        files = _files(given["parameters"], values) if "parameters" in given else ()
        told = " and ".join(files) or "none"
        yield Fact("node", node, "parameter file", told, source, span)


def _around(source: Source, call: ast.Call, values: PythonValues, package: str) -> Iterator[Fact]:
    """Commands that act on what the nodes hear, and what is set in their environment."""
    texts = [n.value for n in ast.walk(call) if isinstance(n, ast.Constant)]
    words = [word for text in texts if isinstance(text, str) for word in text.split()]
    # nodes of `ros2 run` are read where its words stand apart, other launch files are not
    is_read = words[:2] != ["ros2", "launch"] and words == texts
    is_own = words[:2] in _STARTING and package in words and not is_read
    if called(call) in _PROCESSES and (speaks(words) or is_own):
        yield Fact("command", "", " ".join(words), "started", source, _span(source, call))
    if called(call) in _ENVIRONMENT:
        named = call.args[0] if call.args else values.keywords(call).get("name")
        parts = values.words(named).parts if named is not None else ()
        name = parts[0] if parts and isinstance(parts[0], str) else ""
        if not name.startswith(SHOWN):
            yield Fact("environment", "", name, ast.unparse(call), source, _span(source, call))


def _prefixes(tree: ast.Module) -> Iterator[ast.expr]:
    """Where all nodes may be given a prefix: by its name, or an argument by a name that is made."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and _is_text(node, "launch-prefix"):
            yield node
        if isinstance(node, ast.Call) and called(node) in _CONFIGURING:
            given = (*node.args[:1], *(k.value for k in node.keywords if k.arg in ("name", None)))
            yield from (each for each in given if not isinstance(each, ast.Constant))


def _defaults(tree: ast.Module, values: PythonValues) -> Iterator[tuple[str, ast.expr]]:
    """The arguments that a launch file takes, each with its default."""
    for call in (n for n in values.walk(tree) if isinstance(n, ast.Call)):
        given = values.keywords(call)
        name = call.args[0] if call.args else given.get("name")
        is_declared = called(call) == "DeclareLaunchArgument" and "default_value" in given
        if is_declared and isinstance(name, ast.Constant):
            yield str(name.value), given["default_value"]


def _default(value: ast.expr, values: PythonValues, defaults: Mapping[str, ast.expr]) -> ast.expr:
    """What a node is given if nobody says an argument: the default of that, or the value itself."""
    found = values.resolved(value)
    if isinstance(found, ast.Call) and called(found) == "LaunchConfiguration" and found.args:
        name = found.args[0]
        if isinstance(name, ast.Constant) and len(found.args) == 1 and not found.keywords:
            return defaults.get(str(name.value), value)
    return value


def _is_idle(key: str, value: ast.expr, values: PythonValues) -> bool:
    """Whether what a node is given changes nothing of what it does."""
    match key:
        case "arguments":
            return _only_logs(value)
        case "additional_env":
            found = values.resolved(value)
            keys = found.keys if isinstance(found, ast.Dict) else [None]
            told = [key.value for key in keys if isinstance(key, ast.Constant)]
            return len(told) == len(keys) and all(str(t).startswith(SHOWN) for t in told)
        case "prefix":
            found = values.resolved(value)
            parts = found.elts if isinstance(found, ast.List | ast.Tuple) else [found]
            texts = [p.value for p in parts if isinstance(p, ast.Constant)]
            said = [text for text in texts if isinstance(text, str)]
            return len(said) == len(parts) and is_harmless("".join(said))
        case "respawn":
            found = values.resolved(value)
            return isinstance(found, ast.Constant) and found.value in (False, "false")
        case _:
            return False


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


def _said(value: ast.expr, values: PythonValues) -> str:
    """What a node is given, but for the least severity that it logs."""
    found = values.resolved(value)
    if not isinstance(found, ast.List | ast.Tuple):
        return ast.unparse(value)
    said = [ast.unparse(each) for each in found.elts]
    level = said.index("'--log-level'") if "'--log-level'" in said else len(said)
    return ", ".join(said[:level] + said[level + 2 :])


def _files(value: ast.expr, values: PythonValues) -> Iterable[str]:
    """The names of the files that parameters come from."""
    for item in values.elements(value) or ():
        source = values.resolved(item)
        if not isinstance(source, ast.Dict):
            texts = [n for n in ast.walk(source) if isinstance(n, ast.Constant)]
            last = max(texts, key=lambda n: (n.lineno, n.col_offset), default=None)
            yield Path(str(last.value)).name if last is not None else ast.unparse(source)


def _span(source: Source, node: ast.expr) -> Span:
    start = source.start_of(node.lineno) + node.col_offset
    told = called(node) if isinstance(node, ast.Call) else ast.unparse(node)
    return Span(start, start + len(told))
