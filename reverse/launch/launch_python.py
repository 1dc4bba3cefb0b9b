"""Launch files of ROS 2 in Python: the nodes that `generate_launch_description` lists.

Only what is declared is read: literals, names bound once to them, and the actions of launch_ros.
Whatever is computed is open, with its place; no file is run.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from rebsync.reverse.launch.launched import Launch, LaunchedNode, LaunchedRemap
from rebsync.reverse.launch.parameters import (
    Parameter,
    ParameterValue,
    read_parameters,
)
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span

SUFFIX = ".launch.py"
_MARKER = re.compile(r"\s*#\s*rebsync:\s*(.*?)\s*\Z")
_YAML = (".yaml", ".yml")
_WILDCARD = "/**/ros__parameters/"
_JOINS = frozenset({"PathJoinSubstitution", "join"})
NOT_GIVEN = "it is not given here"
_NODES = frozenset({"ComposableNode", "LifecycleNode", "Node"})

Load = Callable[[str], Source | None]


def read_python_launch(source: Source, load: Load) -> Launch:
    """What the file declares; `load` gives the text of a path below the package's folder."""
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError) as error:
        why = f"this is no Python that can be read: {error}"
        return Launch((), (), (Unknown("the launch file", why, source, Span(0, 0)),), (source,))
    reader = _Reader(source, load, _bound(tree))
    for call in _calls(tree):
        reader.file_of(call)
    nodes = tuple(reader.node(call) for call in _calls(tree) if _called(call) in _NODES)
    return Launch(
        nodes,
        tuple(reader.common.values()),
        tuple(reader.unknowns),
        (source, *reader.files.values()),
    )


def _bound(tree: ast.Module) -> Mapping[str, ast.expr]:
    """The values of names that are bound once."""
    found: dict[str, ast.expr | None] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target = node.targets[0]
            if isinstance(target, ast.Name):
                found[target.id] = None if target.id in found else node.value
    return {name: value for name, value in found.items() if value is not None}


def _calls(tree: ast.Module) -> Iterator[ast.Call]:
    """All calls, in the order of the text."""
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call)]
    yield from sorted(calls, key=lambda c: (c.lineno, c.col_offset))


def _called(call: ast.Call) -> str:
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case _:
            return ""


class _Reader:
    """Reads the actions of one file; `common` are the parameters that its files give all nodes."""

    def __init__(self, source: Source, load: Load, names: Mapping[str, ast.expr]) -> None:
        self.common: dict[str, Parameter] = {}
        self.files: dict[str, Source] = {}
        self.unknowns: list[Unknown] = []
        self._source = source
        self._load = load
        self._names = names
        self._lines = source.text.split("\n")

    def node(self, call: ast.Call) -> LaunchedNode:
        """The node that an action starts."""
        given = {k.arg: k.value for k in call.keywords if k.arg is not None}
        return LaunchedNode(
            name=self._text(given.get("name"), "the name of a node"),
            namespace=self._namespace(given.get("namespace")),
            package=self._text(given.get("package"), "the package of a node"),
            type=self._text(given.get("executable", given.get("plugin")), "the program of a node"),
            parameters=tuple(self._parameters(given.get("parameters"))),
            remaps=tuple(self._remaps(given.get("remappings"))),
            arguments=(),
            nodelet=None,
            machine=None,
            required=False,
            test=False,
            anonymous=False,
            only_if=("condition",) if "condition" in given else (),
            markers=tuple(self._markers(call.lineno)),
            source=self._source,
            span=self._span(call),
        )

    # --- values ---------------------------------------------------------------------------------

    def _resolved(self, value: ast.expr) -> ast.expr:
        """What a name that is bound once stands for."""
        for _ in self._names:
            if not isinstance(value, ast.Name) or value.id not in self._names:
                break
            value = self._names[value.id]
        return value

    def _open(self, value: ast.expr, what: str) -> Open:
        found = Open("it is computed when the file runs")
        self.unknowns.append(Unknown(what, found.why, self._source, self._span(value)))
        return found

    def _text(self, value: ast.expr | None, what: str) -> Text:
        if value is None:
            return Open(NOT_GIVEN)
        found = _literal(self._resolved(value))
        return found if isinstance(found, str) else self._open(value, what)

    def _namespace(self, value: ast.expr | None) -> Text:
        if value is None:
            return "/"
        found = self._text(value, "the namespace of a node")
        return found if isinstance(found, Open) else f"/{found.strip('/')}/".replace("//", "/")

    # --- parameters and remappings --------------------------------------------------------------

    def _parameters(self, value: ast.expr | None) -> Iterator[Parameter]:
        """The node's own; those of files for all nodes go to `common`."""
        if value is None:
            return
        listed = self._resolved(value)
        for item in listed.elts if isinstance(listed, ast.List | ast.Tuple) else [listed]:
            source = self._resolved(item)
            if isinstance(source, ast.Dict):
                yield from self._table(source, "")
            elif not self.file_of(source):
                self._open(item, "parameters of a node")

    def _table(self, table: ast.Dict, prefix: str) -> Iterator[Parameter]:
        for key, item in zip(table.keys, table.values, strict=True):
            name = _literal(self._resolved(key)) if key is not None else None
            if not isinstance(name, str):
                self._open(key or item, "the name of a parameter")
                continue
            path, value = prefix + name.replace(".", "/"), self._resolved(item)
            if isinstance(value, ast.Dict):
                yield from self._table(value, f"{path}/")
                continue
            found = _literal(value)
            if found is None:
                yield self._parameter(path, self._open(item, f"the parameter `{path}`"), item)
            else:
                yield self._parameter(path, found, item)

    def _parameter(self, name: str, value: ParameterValue | Open, place: ast.expr) -> Parameter:
        return Parameter(name, value, self._source, self._span(place))

    def file_of(self, value: ast.expr) -> bool:
        """Whether a value is the path of a parameter file that is at hand, which then is read."""
        path = _below_share(value)
        file = self._load(path) if path is not None and path.endswith(_YAML) else None
        if path is None or file is None:
            return False
        if path not in self.files:
            self._file(path, file)
        return True

    def _file(self, path: str, file: Source) -> None:
        self.files[path] = file
        read = read_parameters(file)
        self.unknowns += read.unknowns
        for entry in read.entries:
            if entry.name.startswith(_WILDCARD):
                name = f"/{entry.name.removeprefix(_WILDCARD).replace('.', '/')}"
                self.common[name] = replace(entry, name=name)

    def _remaps(self, value: ast.expr | None) -> Iterator[LaunchedRemap]:
        if value is None:
            return
        listed = self._resolved(value)
        if not isinstance(listed, ast.List | ast.Tuple):
            self._open(value, "the remappings of a node")
            return
        for item in map(self._resolved, listed.elts):
            if isinstance(item, ast.Tuple) and len(item.elts) == 2:
                private = self._text(item.elts[0], "a remapping")
                target = self._text(item.elts[1], "a remapping")
                if isinstance(private, str):
                    yield LaunchedRemap(private, target, self._source, self._span(item))
            else:
                self._open(item, "a remapping")

    # --- places ---------------------------------------------------------------------------------

    def _markers(self, line: int) -> list[str]:
        """The comments `rebsync: ...` right above a line, which is counted from 1."""
        found: list[str] = []
        for text in reversed(self._lines[: line - 1]):
            match = _MARKER.match(text)
            if match is None:
                break
            found.insert(0, match[1])
        return found

    def _span(self, node: ast.expr) -> Span:
        end_line, end_column = node.end_lineno or node.lineno, node.end_col_offset or 0
        return Span(self._at(node.lineno, node.col_offset), self._at(end_line, end_column))

    def _at(self, line: int, column: int) -> int:
        """The offset of a place whose column counts bytes."""
        before = self._lines[line - 1].encode()[:column].decode(errors="ignore")
        return self._source.start_of(line) + len(before)


def _literal(node: ast.expr) -> ParameterValue | None:
    """A constant; None where there is none, or one that no parameter holds."""
    match node:
        case ast.Constant(value=bool() | int() | float() | str() as value):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() | float() as value)):
            return -value
        case ast.List(elts=items) | ast.Tuple(elts=items):
            inner = [_literal(item) for item in items]
            return None if None in inner else tuple(v for v in inner if v is not None)
        case ast.Call(args=[value, *_]) if _called(node) == "ParameterValue":
            return _literal(value)
        case _:
            return None


def _below_share(node: ast.expr) -> str | None:
    """The path below a package's folder that `PathJoinSubstitution([...])` stands for."""
    if not isinstance(node, ast.Call) or _called(node) not in _JOINS:
        return None
    listed = node.args[0] if len(node.args) == 1 else ast.List(elts=list(node.args))
    parts = listed.elts if isinstance(listed, ast.List) else []
    if not parts or not isinstance(parts[0], ast.Call):
        return None
    words = [_literal(part) for part in parts[1:]]
    return "/".join(w for w in words if isinstance(w, str)) if None not in words else None
