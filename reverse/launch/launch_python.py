"""Launch files of ROS 2 in Python: what `generate_launch_description` declares.

Only what is declared is read: literals, names bound once to them, and the actions and
substitutions of launch and launch_ros. Whatever is computed is open, with its place; no file is
run.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Callable, Iterator, Mapping

from rebsync.reverse.launch.described import misleading
from rebsync.reverse.launch.launch_python_values import PythonValues
from rebsync.reverse.launch.python_arguments import called
from rebsync.reverse.launch.ros2_actions import (
    Action,
    CommandAction,
    Condition,
    DeclareArgument,
    ForAll,
    FromFile,
    Group,
    Include,
    Let,
    NodeAction,
    Only,
    Push,
    Unlisted,
)
from rebsync.reverse.launch.ros2_words import Path, Words
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source, Span

_NODES = frozenset({"ComposableNode", "LifecycleNode", "Node"})
_CONTAINERS = frozenset({"ComposableNodeContainer", "LoadComposableNodes"})
# Actions that start no node and set nothing that a node can tell.
_SILENT = frozenset(
    {
        *("LogInfo", "ReadyToTest", "UnregisterEventHandler", "ResetEnvironment"),
        *("SetEnvironmentVariable", "UnsetEnvironmentVariable", "AppendEnvironmentVariable"),
    }
)
_ENDING = frozenset({"EmitEvent", "Shutdown"})
# What these handle comes after the end of a process, of which no model tells.
_AFTERWARDS = frozenset({"OnProcessExit", "OnShutdown"})


def actions_of(source: Source) -> tuple[Action, ...] | Unknown:
    """The actions of a launch file in Python, or why there are none."""
    try:
        tree = ast.parse(source.text)
    except (SyntaxError, ValueError, RecursionError) as error:
        why = f"this is no Python that can be read: {error}"
        return Unknown("the launch file", why, source, Span(0, 0))
    values = PythonValues(source, names := bound_once(tree))
    why = "what `generate_launch_description` gives back need not have all that stands here"
    found = (values.span(place).start for place in misleading(tree, names))
    open_ = (Unlisted("the description", Span(at, at + len("return")), why) for at in found)
    return (*open_, *_File(tree, values).actions())


def bound_once(tree: ast.Module) -> Mapping[str, ast.expr]:
    """The values of names that are bound once, and that nothing changes later."""
    found: dict[str, list[ast.expr]] = {}
    stored: Counter[str] = Counter()
    waiting: list[str] = []
    for node in ast.walk(tree):
        waiting += _changed(node)
        match node:
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                found.setdefault(name, []).append(value)
            case ast.Name(id=name, ctx=ast.Store()):
                stored[name] += 1  # by a loop, a `with` or an unpacking as well
            case ast.arg(arg=name) | ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                stored[name] += 1
            case ast.alias(name=name, asname=other):
                stored[other or name.partition(".")[0]] += 1
            case ast.ExceptHandler(name=str() as name) | ast.MatchAs(name=str() as name):
                stored[name] += 1
            case ast.MatchStar(name=str() as name) | ast.MatchMapping(rest=str() as name):
                stored[name] += 1
    changed: set[str] = set()
    while waiting:
        if (name := waiting.pop()) not in changed:
            changed.add(name)
            waiting += [n for value in found.get(name, ()) for n in _names_in(value)]
    return {n: values[0] for n, values in found.items() if stored[n] == 1 and n not in changed}


_CHANGES = frozenset(
    {
        *("append", "clear", "extend", "insert", "pop", "popitem", "remove", "reverse"),
        *("setdefault", "sort", "update"),
    }
)


def _changed(node: ast.AST) -> list[str]:
    """The names of which a statement or a call may change what they stand for, or a part of it."""
    match node:
        case ast.Subscript(ctx=ast.Store() | ast.Del()) | ast.Attribute(ctx=ast.Store()):
            return _names_in(node.value)
        case ast.AugAssign(target=changed):
            return _names_in(changed)
        case ast.Expr(value=ast.Call(func=ast.Attribute(attr="add_action"))):
            return []
        case ast.Expr(value=ast.Call() as call):
            return _names_in(call)
        case ast.Call(func=ast.Attribute(value=changed, attr=name)) if name in _CHANGES:
            return _names_in(changed)
        case _:
            return []


def _names_in(node: ast.AST) -> list[str]:
    return [n.id for n in ast.walk(node) if isinstance(n, ast.Name)]


def _is_settings(words: Words) -> bool:
    """Whether a text names a file of parameters."""
    match words.parts:
        case (*_, Path(pieces)) if pieces:
            return _is_settings(pieces[-1])
        case (*_, str() as last):
            return last.endswith((".yaml", ".yml"))
        case _:
            return False


class _File:
    """Makes actions of calls; each call for a node is taken once."""

    def __init__(self, tree: ast.Module, values: PythonValues) -> None:
        self._tree = tree
        self._values = values
        self._seen: set[ast.expr] = set()

    def actions(self) -> Iterator[Action]:
        for listed in self._described():
            yield from self._listed(listed)
        for statement, conditions in _added(self._tree):
            for argument in statement.args:
                for action in self._action(argument):
                    yield self._perhaps(action, conditions)
        for call in _calls(self._tree):
            if called(call) in _NODES and call not in self._seen:
                yield from self._elsewhere(call)
        if not any(called(call) in _NODES for call in _calls(self._tree)):
            files = (w for v in self._values.bound() if _is_settings(w := self._values.words(v)))
            yield from (ForAll(parameters=(FromFile(words),)) for words in files)

    def _described(self) -> Iterator[ast.expr]:
        """The lists of actions that descriptions are made of."""
        for call in _calls(self._tree):
            if called(call) == "LaunchDescription":
                given = self._values.keywords(call)
                listed = call.args[0] if call.args else given.get("initial_entities")
                if listed is not None or not self._values.is_whole(call):
                    yield listed if listed is not None else call

    def _elsewhere(self, call: ast.Call) -> Iterator[Action]:
        """A node that no description has: it is made where the file runs it."""
        if called(call) in _NODES:
            text = "the file's code decides"
            condition = Condition(self._values.computed(call), True, text)
            yield from (Only(condition, action) for action in self._action(call))

    def _perhaps(self, action: Action, conditions: tuple[ast.expr, ...]) -> Action:
        for condition in conditions:
            words = self._values.computed(condition)
            action = Only(Condition(words, True, self._values.shown(condition)), action)
        return action

    # --- actions --------------------------------------------------------------------------------

    def _listed(self, value: ast.expr) -> Iterator[Action]:
        """The actions of a list, which may be a name or two lists added."""
        found = self._values.resolved(value)
        match found:
            case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items):
                for item in items:
                    inner = item.value if isinstance(item, ast.Starred) else None
                    yield from self._listed(inner) if inner is not None else self._action(item)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                yield from self._listed(left)
                yield from self._listed(right)
            case ast.Constant(value=None):
                return
            case _:
                yield Unlisted("what the launch file starts", self._values.span(value))

    def _action(self, value: ast.expr) -> Iterator[Action]:
        found = self._values.resolved(value)
        if not isinstance(found, ast.Call):
            yield Unlisted("an action", self._values.span(value))
            return
        if found in self._seen:
            return
        self._see(found)
        given = self._values.keywords(found)
        if not self._values.is_whole(found):
            why = "it is computed when the file runs"
            yield Unlisted(f"an argument of `{called(found)}`", self._span(found), why)
        made = self._made(found, given)
        if "condition" in given and not isinstance(given["condition"], ast.Constant):
            condition = self._condition(given["condition"])
            made = [Only(condition, action) for action in made]
        yield from made

    def _see(self, call: ast.Call) -> None:
        """Notes that a call is in a description, and what a comprehension copies it from."""
        self._seen.add(call)
        if call in self._values.originals:
            self._see(self._values.originals[call])

    def _made(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        name, args = called(call), call.args
        make = _MAKERS.get(name)
        if name in _NODES:
            return [self._start(call, given)]
        if name in _CONTAINERS:
            components = given.get("composable_node_descriptions")
            return list(self._listed(components)) if components is not None else []
        if name == "GroupAction":
            listed = args[0] if args else given.get("actions")
            inner = tuple(self._listed(listed)) if listed is not None else ()
            scoped = given.get("scoped")
            is_scoped = not (isinstance(scoped, ast.Constant) and scoped.value is False)
            return [Group((*self._configured(given), *inner), is_scoped)]
        if name == "TimerAction":
            listed = given.get("actions", args[1] if len(args) > 1 else None)
            return list(self._listed(listed)) if listed is not None else []
        if make is not None:
            return make(self, call, given)
        if name in _SILENT:
            return []
        if name == "RegisterEventHandler" and not self._acts(call):
            return []
        why = "it may end what runs" if name in _ENDING else "it is computed when the file runs"
        return [Unlisted(f"the action `{name}`" if name else "an action", self._span(call), why)]

    def _acts(self, call: ast.Call) -> bool:
        """Whether what a handler of events holds starts a node, or acts on those that run."""
        inner = {called(n) for n in self._values.walk(call) if isinstance(n, ast.Call)} - {""}
        is_afterwards = not _AFTERWARDS.isdisjoint(inner)
        return not _NODES.isdisjoint(inner) or not (is_afterwards or _ACTING.isdisjoint(inner))

    def _configured(self, given: dict[str, ast.expr]) -> Iterator[Action]:
        """The arguments that the actions of a group have; they may have none but these."""
        why = "the arguments of the file need not hold in it"
        configured, forwarding = given.get("launch_configurations"), given.get("forwarding")
        listed = self._values.arguments(configured)
        yield from (Let(*pair) for pair in listed or ())
        for odd in (configured if listed is None else None, forwarding):
            if odd is not None and not (isinstance(odd, ast.Constant) and odd.value is True):
                yield Unlisted("a group", self._values.span(odd), why)

    def _start(self, call: ast.Call, given: dict[str, ast.expr]) -> NodeAction:
        values = self._values
        return NodeAction(
            name=values.words_of(given.get("name")),
            namespace=values.words_of(given.get("namespace")),
            package=values.words_of(given.get("package")),
            type=values.words_of(given.get("executable", given.get("plugin"))),
            parameters=tuple(values.parameters(given.get("parameters"))),
            remaps=tuple(values.remaps(given.get("remappings"))),
            markers=() if call in values.originals else tuple(values.markers(call.lineno)),
            span=self._span(call),
            texts=values.given_texts(given, "arguments", "ros_arguments"),
            arguments=values.listed(given.get("arguments")),
            ros_arguments=values.listed(given.get("ros_arguments")),
        )

    def _condition(self, value: ast.expr) -> Condition:
        found = self._values.resolved(value)
        text = self._values.shown(found)
        if isinstance(found, ast.Call):
            kind = called(found)
            if kind in ("IfCondition", "UnlessCondition") and found.args:
                return Condition(self._values.words(found.args[0]), kind == "IfCondition", text)
            if (same := self._values.compared(found)) is not None:
                return Condition(same, not kind.endswith("NotEquals"), text)
        return Condition(self._values.computed(value), True, text)

    def _span(self, call: ast.expr) -> Span:
        return self._values.span(call)

    # --- actions that set something -------------------------------------------------------------

    def declare(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        name = call.args[0] if call.args else given.get("name")
        default = given.get("default_value", call.args[1] if len(call.args) > 1 else None)
        is_none = isinstance(default, ast.Constant) and default.value is None
        words = None if is_none else self._values.words_of(default)
        return [DeclareArgument(self._values.words(name), words)] if name is not None else []

    def let(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        pair = _two(call, given, "name", "value")
        return [Let(*map(self._values.words, pair))] if pair is not None else []

    def command(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        described = self._values.resolved(given.get("process_description", call))
        inner = self._values.keywords(described) if isinstance(described, ast.Call) else given
        return [CommandAction(self._values.given_texts(inner, "cmd"), self._span(call))]

    def push(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        value = call.args[0] if call.args else given.get("namespace")
        return [Push(self._values.words(value))] if value is not None else []

    def set_remap(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        pair = _two(call, given, "src", "dst")
        if pair is None:
            return []
        return [ForAll(remaps=(self._values.remap(*pair, call),))]

    def set_parameter(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        pair = _two(call, given, "name", "value")
        if pair is None:
            return []
        name = self._values.words(pair[0])
        return [ForAll(parameters=(self._values.given(name, pair[1]),))]

    def parameters_from(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        value = call.args[0] if call.args else given.get("filename")
        return [ForAll(parameters=(FromFile(self._values.words(value)),))] if value else []

    def include(self, call: ast.Call, given: dict[str, ast.expr]) -> list[Action]:
        source = call.args[0] if call.args else given.get("launch_description_source")
        found = self._values.resolved(source) if source is not None else None
        if isinstance(found, ast.Call) and called(found).endswith("LaunchDescriptionSource"):
            found = found.args[0] if found.args else None
        if found is None:
            return [Unlisted("an included launch file", self._span(call))]
        listed = self._values.arguments(given.get("launch_arguments"))
        if listed is None:
            odd = Unlisted("arguments of a launch file", self._span(given["launch_arguments"]))
            return [odd, Include(self._values.words(found), (), self._span(call))]
        return [Include(self._values.words(found), listed, self._span(call))]


_Maker = Callable[[_File, ast.Call, "dict[str, ast.expr]"], "list[Action]"]
_MAKERS: dict[str, _Maker] = {
    "DeclareLaunchArgument": _File.declare,
    "SetLaunchConfiguration": _File.let,
    "ExecuteProcess": _File.command,
    "ExecuteLocal": _File.command,
    "PushRosNamespace": _File.push,
    "PushROSNamespace": _File.push,
    "SetRemap": _File.set_remap,
    "SetParameter": _File.set_parameter,
    "SetParametersFromFile": _File.parameters_from,
    "IncludeLaunchDescription": _File.include,
}
_ACTING = _ENDING | {*_MAKERS, "OpaqueFunction", "UnsetLaunchConfiguration"} - {
    *("ExecuteProcess", "ExecuteLocal", "DeclareLaunchArgument")
}


def _two(
    call: ast.Call, given: dict[str, ast.expr], first: str, second: str
) -> tuple[ast.expr, ast.expr] | None:
    """The two arguments of a call, however they are given."""
    by_name = dict(zip((first, second), call.args, strict=False)) | given
    if first in by_name and second in by_name:
        return by_name[first], by_name[second]
    return None


def _calls(tree: ast.Module) -> Iterator[ast.Call]:
    """All calls, in the order of the text."""
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call)]
    yield from sorted(calls, key=lambda c: (c.lineno, c.col_offset))


def _added(tree: ast.AST) -> Iterator[tuple[ast.Call, tuple[ast.expr, ...]]]:
    """The calls `add_action(...)` of statements, with the conditions they stand under."""
    yield from _added_in(tree, ())


def _added_in(
    node: ast.AST, conditions: tuple[ast.expr, ...]
) -> Iterator[tuple[ast.Call, tuple[ast.expr, ...]]]:
    for child in ast.iter_child_nodes(node):
        match child:
            case ast.Expr(value=ast.Call(func=ast.Attribute(attr="add_action")) as call):
                yield call, conditions
            case ast.If(test=test) | ast.While(test=test):
                yield from _added_in(child, (*conditions, test))
            case ast.For(iter=test):
                yield from _added_in(child, (*conditions, test))
            case _:
                yield from _added_in(child, conditions)
