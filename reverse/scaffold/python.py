"""The facts that join nodes in Python, in the words of those of C++, and what sets nodes up.

Extraction reads the bodies of the model, and the functions that serve or send. All else that a
class does to that end is a fact here: each statement of the constructor.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TypeGuard

from rebsync.names import uncarry
from rebsync.records import dataclass
from rebsync.reserved import NO_PYTHON_CLASSES
from rebsync.reverse.scaffold.fact import PLAYED, PROGRAM, TOLD, Fact, numbered
from rebsync.reverse.scaffold.python_names import resolved
from rebsync.reverse.scaffold.python_parameters import as_declared
from rebsync.reverse.scaffold.python_trees import (
    MODULE,
    bindings,
    is_log,
    plain,
    said,
    span_of,
    tree_of,
)
from rebsync.reverse.scaffold.setup_file import SetupFile
from rebsync.source import Source

_READS = frozenset({"rospy.get_param", "declared", "read_array", "declare_array"})
_CONNECTING = {"subscribe": "subscribe", "subscribe_on_bridge": "subscribeOnBridge"}
_UNSET = re.compile(r"(?:int|Byte|Short|Float|float|bool|Rebec)\(\)\Z|array\(|(?:0|0\.0|False)\Z")
_OF_ROS = frozenset({"rospy", "rclpy"})


def facts_in_python(
    name: str, source: Source, package: str, beside: Collection[str] = ()
) -> Iterator[Fact]:
    """The facts in a file of Python, of a package of that name; `beside` is what its folder has."""
    tree = None if MODULE.match(name) else tree_of(source)
    if tree is None:
        return  # it is of the run-time part, or extraction lists it
    if name.rpartition("/")[2] == "setup.py":
        yield from SetupFile(source, tree, package, beside).facts()
        return
    classes = [c for c in tree.body if isinstance(c, ast.ClassDef) and _is_node(c)]
    found = list[Fact]()
    if classes:
        resolved(tree)
        found = [f for c in classes for f in _Class.of(source, tree, c).facts()]
        found += _imports(source, tree, classes[0], package)
    else:
        stem = Path(name).stem
        found += _program(stem, source, tree)
    yield from numbered(found)


def _is_node(node: ast.ClassDef) -> bool:
    """Whether it uses a mailbox that it does not make for others, as the run-time part does."""
    functions = {f.name for f in node.body if isinstance(f, ast.FunctionDef)}
    uses = (n for n in ast.walk(node) if isinstance(n, ast.Attribute) and n.attr == "_mailbox")
    return bool(functions & {"__init__", "_wire"}) and any(uses) and "construct" in ast.dump(node)


# --- classes ------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class _Class:
    """A class of nodes; `servers` are the descriptors of its module."""

    source: Source
    owner: str
    node: ast.ClassDef
    servers: Mapping[str, ast.Call]

    @classmethod
    def of(cls, source: Source, tree: ast.Module, node: ast.ClassDef) -> _Class:
        assigned = filter(None, map(_assigned, tree.body))
        servers = {name: value for name, value in assigned if _is_server(value)}
        return cls(source, uncarry(node.name, NO_PYTHON_CLASSES), node, servers)

    def server(self, node: ast.expr) -> str:
        """The server that a descriptor stands for."""
        call = self.servers.get(ast.unparse(node))
        return str(ast.literal_eval(call.args[0])) if call is not None else ast.unparse(node)

    def fact(self, kind: str, name: str, value: str, at: ast.AST) -> Fact:
        return Fact(kind, self.owner, name, value, self.source, span_of(self.source, at))

    def facts(self) -> Iterator[Fact]:
        """All that the class does beside what is in the model."""
        used = {n.id for n in ast.walk(self.node) if isinstance(n, ast.Name)}
        for name, call in self.servers.items():
            if name in used:
                rest = ", ".join(plain(a) for a in (*call.args[1:], *call.keywords))
                yield self.fact("priority", self.server(ast.Name(name)), rest, call)
        for function in self.node.body:
            if not isinstance(function, ast.FunctionDef):
                continue
            if function.name in ("__init__", "_wire"):
                for statement in said(function.body, is_log):
                    yield from self._set_up(function, statement)
            elif function.name == "_publish_state":
                yield from self._told(function)

    def _told(self, function: ast.FunctionDef) -> Iterator[Fact]:
        """What it puts into its state message, and by whom it has that published."""
        names = {a.arg: "served" for a in function.args.args[1:]}
        named = replace(self, owner=_message_of(function).removesuffix("State"))
        late, is_made, message = "", False, _message_in(function)
        for statement in said(function.body, is_log):
            if message and not any(_is_named(n, message) for n in ast.walk(statement)):
                continue  # extraction lists what does more than to tell people something
            match statement:
                case ast.Assign([ast.Attribute(ast.Name(), name)], value):
                    yield named.fact(TOLD, name, f"{plain(value, names)}{late}", statement)
                case ast.Assign([ast.Name()], ast.Call(_, _, keywords)) if not is_made:
                    is_made = True
                    for given in keywords:
                        yield named.fact(TOLD, given.arg or "", plain(given.value, names), given)
                case ast.Expr(ast.Call(ast.Attribute(by, "publish"))):
                    yield named.fact(TOLD, "", f"published by {plain(by)}", statement)
                    late = " once it is published"
                case ast.Assign() | ast.AugAssign() | ast.AnnAssign():
                    yield named.fact(TOLD, "", f"{plain(statement, names)}{late}", statement)
                case _:
                    pass  # extraction lists it

    # --- set up ---------------------------------------------------------------------------------

    def _set_up(self, function: ast.FunctionDef, statement: ast.stmt) -> Iterator[Fact]:
        match statement:
            case ast.Assign([ast.Attribute(ast.Name("self"), member)], value):
                yield from self._member(member, as_declared(value, function), statement)
            case ast.AnnAssign(ast.Attribute(ast.Name("self"), member), _, value) if value:
                yield from self._member(member, as_declared(value, function), statement)
            case ast.AnnAssign(ast.Name(argument), _, value) if value:
                yield from self._member(argument, as_declared(value, function), statement)
            case ast.Expr(ast.Call() as call):
                names = {name: f"_{i}" for i, name in enumerate(_arguments(function), 1)}
                yield self.fact("set-up", ast.unparse(call.func), plain(call, names), statement)
            case _:
                return  # extraction lists what it does not know

    def _member(self, member: str, value: ast.expr, at: ast.stmt) -> Iterator[Fact]:
        called = ast.unparse(value.func) if isinstance(value, ast.Call) else ""
        arguments = value.args if isinstance(value, ast.Call) else []
        method = called.removeprefix("self._mailbox.")
        if called == "Mailbox":
            first, *rest = [*map(plain, arguments), ""]
            of_node = first in ("node", "self")
            yield self.fact("set-up", "mailbox", "Mailbox(self)" if of_node else "Mailbox()", at)
            rest = [given for given in rest[of_node:] if given]
            yield self.fact("best priority", "", ", ".join(rest) or "none", at)
        elif method != called:
            yield from self._connected(member, method, arguments, at)
        elif called == "Sensor":
            topic = _text(arguments[-2]) if len(arguments) > 1 else ""
            shown = plain(value).replace(repr(topic), "...")
            yield self.fact("sensor", member.strip("_"), f'"{_private(topic)}"', at)
            yield self.fact("set-up", member.strip("_"), shown, at)
        elif (read := _parameter(value)) is not None:
            key, default = read
            yield self.fact("default", key, default, at)
            shown = plain(_undescribed(value)).replace(f", {default}", ", ...", 1)
            yield self.fact("set-up", key, shown, at)
        elif not _UNSET.match(ast.unparse(value)):
            yield self.fact("set-up", member.strip("_"), plain(value), at)

    def _connected(
        self, member: str, method: str, arguments: list[ast.expr], at: ast.stmt
    ) -> Iterator[Fact]:
        topic = _text(arguments[0]) if arguments else ""
        message = plain(arguments[-1]) if arguments else ""
        if method == "advertise" and len(arguments) == 2:
            known = _private(topic).rpartition("/")[0]
            word = "advertise" if _is_private(topic) else "advertise_elsewhere"
            value = f'{word}<{message}>("{_private(topic)}")'
            yield self.fact("publisher", f"{known} {message}", value, at)
        elif method == "advertise_all" and len(arguments) == 3:
            value = f'advertiseAll<{message}>("{topic}", "{_text(arguments[1])}")'
            yield self.fact("publisher", message, value, at)
        elif method in _CONNECTING and len(arguments) == 3:
            shim = _handler(arguments[2])
            on_bridge = method == "subscribe_on_bridge"
            is_own = _is_private(topic) or on_bridge
            word = _CONNECTING[method] if is_own else "subscribe_elsewhere"
            value = f'{word} {plain(arguments[1])} "{_private(topic)}"'
            yield self.fact("subscription", self._taken_by(shim), value, at)
        else:
            yield self.fact("set-up", member, f"{method}({', '.join(map(plain, arguments))})", at)

    def _taken_by(self, shim: str) -> str:
        """The server to whose messages a function listens."""
        for function in self.node.body:
            if isinstance(function, ast.FunctionDef) and function.name == shim:
                for call in _calls(function, "self._mailbox.receive"):
                    return self.server(call.args[0]) if call.args else shim
        return shim


# --- programs -----------------------------------------------------------------------------------


def _program(stem: str, source: Source, tree: ast.Module) -> Iterator[Fact]:
    """What a program makes a rebec of, or what sensors it plays."""
    for node in ast.walk(tree):
        match node:
            case ast.Assign([ast.Name("rebec")], ast.Call(ast.Name(made), arguments)):
                owner, span = uncarry(made, NO_PYTHON_CLASSES), span_of(source, node)
                yield Fact(PROGRAM, stem, "", owner, source, span)
                for read in filter(None, map(_parameter, arguments)):
                    yield Fact("default", owner, *read, source, span)
            case ast.Call(ast.Attribute(_, "create_publisher"), [_, topic, *_]) | ast.Call(
                ast.Attribute(ast.Name("rospy"), "Publisher"), [topic, *_]
            ):
                name = _private(_text(topic))
                yield Fact(PLAYED, stem, name, name, source, span_of(source, node))
            case _:
                pass


def _imports(source: Source, tree: ast.Module, node: ast.ClassDef, package: str) -> Iterator[Fact]:
    """What the names of the run-time part, of messages and of ROS stand for."""
    owner = uncarry(node.name, NO_PYTHON_CLASSES)
    for name, (of, statement) in bindings(tree).items():
        head = of.partition(".")[0]
        if head in _OF_ROS or head == package or head == f"{package}_interfaces":
            inside = of.removeprefix(package)
            yield Fact("import", owner, name, inside, source, span_of(source, statement))


def _arguments(function: ast.FunctionDef) -> list[str]:
    """What a constructor calls the model's arguments, passed to it or read by it."""
    read = (s.target for s in function.body if isinstance(s, ast.AnnAssign))
    own = [t.id for t in read if isinstance(t, ast.Name)]
    return [a.arg for a in function.args.args[1:]] + own


# --- parts --------------------------------------------------------------------------------------


def _message_of(function: ast.FunctionDef) -> str:
    """The type of the message that a function makes first."""
    for statement in function.body:
        match statement:
            case ast.Assign([ast.Name()], ast.Call(ast.Name(made) | ast.Attribute(_, made))):
                return made
            case _:
                pass
    return ""


def _calls(node: ast.AST, name: str) -> Iterator[ast.Call]:
    for each in ast.walk(node):
        if isinstance(each, ast.Call) and ast.unparse(each.func) == name:
            yield each


def _assigned(statement: ast.stmt) -> tuple[str, ast.expr] | None:
    """The name that a statement gives a value, with a type or without, and the value."""
    match statement:
        case ast.Assign([ast.Name(name), *_], value) | ast.AnnAssign(ast.Name(name), _, value):
            return None if value is None else (name, value)
        case _:
            return None


def _is_server(value: ast.expr) -> TypeGuard[ast.Call]:
    match value:
        case ast.Call(ast.Name("Server"), [ast.Constant(str()), *_]):
            return True
        case _:
            return False


def _handler(served: ast.expr) -> str:
    match served:
        case ast.Lambda(body=ast.Call(function)) | ast.Call(_, [function, *_]):
            served = function
        case ast.Lambda(body=body):
            served = body
        case _:
            pass
    return ast.unparse(served).removeprefix("self.")


def _parameter(value: ast.expr) -> tuple[str, str] | None:
    """The parameter that a value reads, wherever in it, and what stands in for it."""
    if not isinstance(value, ast.Call):
        return None
    if ast.unparse(value.func) in _READS:
        for number, argument in enumerate(value.args):
            if isinstance(argument, ast.Constant) and isinstance(argument.value, str):
                default = value.args[number + 1 : number + 2]
                key = argument.value.replace(".", "/").lstrip("~")
                return key, ast.unparse(default[0]) if default else ""
    return next((r for a in value.args if (r := _parameter(a)) is not None), None)


def _undescribed(value: ast.expr) -> ast.expr:
    """A call without the description of the parameter that it declares."""
    match value:
        case ast.Call(ast.Name("declared" | "declared_array"), [*rest, ast.Constant(str())]):
            return ast.Call(value.func, [*rest, ast.Constant("...")], value.keywords)
        case ast.Call(of, [inner]):
            return ast.Call(of, [_undescribed(inner)], value.keywords)
        case _:
            return value


def _text(node: ast.expr) -> str:
    """A text; code that is none as it is, which no topic is called."""
    match node:
        case ast.Constant(str(text)):
            return text
        case _:
            return ast.unparse(node)


def _is_private(topic: str) -> bool:
    return topic.startswith(("~", "/"))


def _private(topic: str) -> str:
    """A topic below the node's own name without the sign of that."""
    return topic.removeprefix("~").removeprefix("/") if topic.startswith("~") else topic


def _message_in(function: ast.FunctionDef) -> str:
    """The local that a function has published as the state; empty where it does so otherwise."""
    calls = (n for n in ast.walk(function) if isinstance(n, ast.Call))
    published = [c.args for c in calls if ast.unparse(c.func) == "self._state_pub.publish"]
    match published:
        case [[ast.Name(message)]]:
            return message
        case _:
            return ""


def _is_named(node: ast.AST, message: str) -> bool:
    """Whether something is a message, or what publishes it."""
    match node:
        case ast.Name(name):
            return name == message
        case ast.Attribute(_, name):
            return name == "_state_pub"
        case _:
            return False
