"""Whether what generated Python does around the model's bodies is what the model says.

Set-up, shims, and functions that send are not in the model: what somebody changed there is listed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import graph_name
from rebsync.records import dataclass
from rebsync.reserved import NO_PYTHON_CLASSES
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.libraries.generated_calls import LOGGER, PUBLISHERS
from rebsync.reverse.python.model_filled import made_of
from rebsync.reverse.python.model_helpers import is_transparent
from rebsync.reverse.python.model_logs import is_logger
from rebsync.reverse.python.model_parameters import only_declares, parameter_read
from rebsync.reverse.python.model_posts import POST, Post, tells_arguments
from rebsync.reverse.python.model_roles import OFFERING, PyRoles, PySends, field_read
from rebsync.reverse.python.model_silent import Silent
from rebsync.reverse.python.model_types import (
    call_parts,
    called_late,
    handed_over,
    is_alias,
    is_unset,
    literal_type,
    passed_on,
    type_made,
    type_of,
    without_parentheses,
)
from rebsync.reverse.python.named_constants import CodeConstants
from rebsync.reverse.python.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import Py, field, named, text_of
from rebsync.static.types import PRIMITIVES

_MADE = frozenset({"Mailbox", "Drive", "Sensor"})
_CONNECTING = frozenset(
    {
        *("advertise", "advertise_all", "subscribe", "subscribe_on_bridge"),
        *OFFERING,
    }
)
_NAMED = frozenset({"Server", "logging.getLogger", "getLogger", LOGGER})
_CALLED = frozenset(
    {
        *("self._wire", "super()._wire", "super().__init__", "Node.__init__"),
        "RebecNode.__init__",
        "self._mailbox.on_served",
    }
)
_AT_TOP = frozenset(
    {"comment", "import_statement", "import_from_statement", "future_import_statement"}
)
_IN_CLASS = frozenset({"function_definition", "decorated_definition", "pass_statement"})
DECORATORS = frozenset({"abstractmethod", "final", "override", "staticmethod", "classmethod"})
_STORING = frozenset({"assignment", "named_expression", "lambda", "await", "yield"})
_LOOKING = frozenset({"flatten"})
_WHY = "what this does is not in the model"
_LOST = "no subscription takes this in: the class only sends it to itself"
_LATE = "this gives a coroutine, and nobody runs it"
_HINT = "say it in the model, or move it into a user block"
_SENDER = "self._mailbox.self()"


@dataclass(frozen=True, slots=True)
class Plumbing:
    """One class with what its functions are for.

    `fields` are those of messages, by their types; of those that another package has, as in ROS 2,
    only the order of what is passed on can be looked at. `above` are the classes above, `posts`
    what is posted, by the ids of the calls, `types` those of fields; what is lost nobody takes in.
    """

    roles: PyRoles
    fields: Mapping[str, Sequence[str]]
    findings: Findings
    constants: CodeConstants
    silent: Silent
    above: Sequence[Scope]
    posts: Mapping[int, Post]
    types: Mapping[str, Mapping[str, m.Type]]
    is_lost: Callable[[PySends], bool]

    def check(self) -> None:
        """Lists what a class does besides."""
        owner = self.roles.owner
        for function in self.roles.functions.values():
            sends = self.roles.sends.get(function.name)
            why = _LOST if sends is not None and self.is_lost(sends) else _WHY
            for node in self._odd(function):
                self._list(owner.py, node, why, function.name)
        for function in self.roles.functions.values():
            if any(c.type == "async" for c in function.node.children):
                self._list(owner.py, function.node, _LATE, function.name)
            odd = [d for d in function.decorators if not self._is_plain(function, d)]
            if odd := [d for d in odd if not is_transparent(self.constants.code, owner.module, d)]:
                why = f'nobody knows what "@{odd[0]}" makes of it'
                self._list(owner.py, function.node, why, function.name)
        for node, why in self._overridden():
            self._list(owner.py, node, why, "")
        for statement in named(field(owner.node, "body")):
            if statement.type in _IN_CLASS or _is_text(statement):
                continue
            if not self.constants.is_quiet(owner, statement):
                self._list(owner.py, statement, _WHY, "")

    def _is_plain(self, function: Scope, decorator: str) -> bool:
        """Whether the model knows what a function is with it: what is called is no property."""
        if decorator != "property":
            return decorator in DECORATORS
        roles, name = self.roles, function.name
        called = re.search(rf"\bself\.{name}\s*\(", text_of(roles.owner.node))
        return called is None and not any(name in r for r in (roles.handlers, roles.sends))

    def _overridden(self) -> Iterator[tuple[Node, str]]:
        """The constants that functions above use by the value of a class above."""
        owner = self.roles.owner
        values = {n: bound[0] for n, bound in owner.names.items() if bound[0].how == "value"}
        for above in self.above:
            for name in sorted(values.keys() & above.names.keys()):
                if None not in (self.constants.of(c, name) for c in (owner, above)):
                    why = f'this counts in functions of "{above.name}" as well, in place of its own'
                    yield values[name].node, why

    def _list(self, py: Py, node: Node, why: str, function: str) -> None:
        within = ".".join(filter(None, (self.roles.owner.name, function)))
        self.findings.unreadable(py.source, Unread(py.span(node), why, _HINT), within)

    def _odd(self, function: Scope) -> Iterator[Node]:
        name = function.name
        body = [s for s in body_of(function) if not self.silent.holds(s)]
        if name in ("__init__", "_wire"):
            yield from self._odd_in_set_up(function, body)
        elif name in self.roles.shims:
            yield from (s for s in body if not self._receives(function, s))
        elif name in self.roles.sends:
            yield from self._sends(function, body)
        elif name == "_publish_state":
            yield from (s for s in body if not _is_of_state(s))
        elif name == "mailbox":
            yield from (s for s in body if text_of(s) != "return self._mailbox")

    # --- set up ---------------------------------------------------------------------------------

    def _odd_in_set_up(self, function: Scope, body: list[Node]) -> Iterator[Node]:
        """What does not set up, or comes when the model's constructor has been handed over."""
        is_constructed = False
        early = [s for s in body_of(function) if _is_before_node(function, s)]
        yield from early
        for statement in body:
            if statement in early:
                continue
            is_late = is_constructed and not is_logger(_inner(statement))
            if is_late or not self._sets_up(function, statement):
                yield statement
            called, _ = call_parts(_inner(statement)) or ("", [])
            is_constructed = is_constructed or called == "self._mailbox.construct"

    def _sets_up(self, function: Scope, statement: Node) -> bool:
        inner = _inner(statement)
        if inner is None:
            return statement.type == "pass_statement"
        if inner.type == "call":
            return self._is_called(function, inner)
        if inner.type != "assignment":
            return _is_text(statement)
        member = text_of(field(inner, "left")).removeprefix("self.")
        if self.silent.is_member(member):
            return True
        roles = self.roles
        if member in roles.known:
            return roles.known[member][2] == inner
        if member in roles.env:
            return roles.env[member].statement == inner
        if member in roles.own and roles.own[member][1] == inner:
            return True
        if member in roles.state:
            return _is_of_type(inner)
        if member in roles.arguments:
            read = parameter_read(field(inner, "right"))
            return read is not None and read.key == roles.arguments[member]
        called, arguments = call_parts(inner.child_by_field_name("right")) or ("", [])
        if called.endswith("get_logger"):
            return True
        method = called.removeprefix("self._mailbox.")
        if method != called:
            return method in _CONNECTING and self._is_connected(member, arguments)
        return called in _MADE or (called in PUBLISHERS and member == "_state_pub")

    def _is_called(self, function: Scope, call: Node) -> bool:
        called, arguments = call_parts(call) or ("", [])
        if called == "self._mailbox.construct" and len(arguments) == 1:
            passed = arguments[0]
            given = called_late(passed)
            _, values = call_parts(given) or ("", [])
            names = [*(p.name for p in function.parameters[1:]), *self.roles.arguments]
            return [text_of(v) for v in values] == names[-len(values) :] if values else True
        if self.silent.timers.is_idle(call):
            return True
        return called in _CALLED or only_declares(call, function.node)

    def _is_connected(self, member: str, arguments: list[Node]) -> bool:
        """Whether topics are called after the servers they lead to."""
        # The feedback of an action stands behind the shim.
        shims = [handed_over(a).removeprefix("self.") for a in (*arguments[5:6], arguments[-1])]
        shim = next((s for s in shims if s in self.roles.topics), None)
        if shim is not None:
            key = self.roles.topics[shim].removeprefix("port/")
            server = self.roles.served_by(shim)
            return server is not None and key.startswith(graph_name(server))
        return member in self.roles.publishers

    # --- messages -------------------------------------------------------------------------------

    def _receives(self, function: Scope, statement: Node) -> bool:
        """Whether a shim hands over all fields of a message in their order."""
        called, arguments = call_parts(_inner(statement)) or ("", [])
        if called != "self._mailbox.receive" or len(arguments) != 5:
            return False
        parameter = field(function.node, "parameters").named_children[-1]
        type_ = parameter.child_by_field_name("type")
        message = function.parameters[-1].name
        _, values = passed_on(arguments[4]) or ("", [])
        if type_ is None or text_of(arguments[1]) != f"{message}.timing":
            return False
        if not tells_arguments(arguments[3], values):
            return False
        given = [field_read(v, message) for v in values]
        wanted, handler = self.fields.get(text_of(type_)), self.roles.handler_of(function.name)
        if wanted is not None and given != list(wanted):
            return False
        if handler is not None and not self._fits(text_of(type_), given, handler, len(given)):
            return False
        if wanted is not None:
            return True
        count = len(handler.parameters) - 1 if handler is not None else len(given)
        return len(set(given)) == count == len(given) and all(map(str.isidentifier, given))

    def _sends(self, function: Scope, body: list[Node]) -> Iterator[Node]:
        """The statements of a function that do more than fill a message and send it."""
        sends, parameters = self.roles.sends[function.name], _parameters(function)
        passed = [p for p in parameters if p != "when"][sends.known is None :]
        wanted = sends.server.partition(" ")[0] if sends.known != "self" else ""
        filled: dict[str, str] = {}
        type_, message, is_sent = "", "msg", False
        for statement in body:
            inner = _inner(statement)
            called, arguments = call_parts(inner) or ("", [])
            left = _left(inner)
            if is_sent:
                yield statement
            elif inner is not None and left.isidentifier() and not type_:
                message, (type_, first) = left, made_of(field(inner, "right"))
                filled |= {name: _flat(value) for name, value in first.items()}
                is_own = filled.pop("sender", _SENDER) == _SENDER
                if type_ != wanted or left in parameters or not is_own:
                    yield statement
            elif inner is not None and left == f"{message}.sender":
                if text_of(field(inner, "right")) != _SENDER:
                    yield statement
            elif inner is not None and left.startswith(f"{message}."):
                filled[left.removeprefix(f"{message}.")] = _flat(field(inner, "right"))
            elif called == "self._mailbox.publish":
                if not type_ and len(arguments) > 1:
                    type_, first = made_of(arguments[1])
                    filled |= {name: _flat(value) for name, value in first.items()}
                is_sent, fields = True, self.fields.get(type_, tuple(filled))
                in_order = [filled.get(f) for f in fields] == passed and len(filled) == len(passed)
                fits = in_order and self._fits(type_, fields, function, len(passed))
                fits = fits and type_ == wanted
                if not fits or text_of(arguments[-1]) != "when" or self.is_lost(sends):
                    yield statement
            elif called == POST:
                is_sent, post = True, self.posts.get(inner.id) if inner is not None else None
                held = post is not None and post.is_held and text_of(post.when) == "when"
                if post is None or not held or [text_of(v) for v in post.given] != passed:
                    yield statement
            else:
                yield statement

    def _fits(self, message: str, fields: Sequence[str], function: Scope, count: int) -> bool:
        """Whether fields are of the types of the last parameters but for the time."""
        if message not in self.types:
            return True
        nodes = named(field(function.node, "parameters"))
        given = [n for n in nodes if _name_of(n) != "when"][-count:] if count else []
        said = [type_of(n.child_by_field_name("type")) for n in given]
        return all(
            type_ is None or type_.name not in PRIMITIVES or type_ == self.types[message].get(name)
            for name, type_ in zip(fields, said, strict=True)
            if type_ is None or not type_.dimensions
        )


def odd_at_top(module: Scope, constants: CodeConstants) -> Iterator[Node]:
    """The statements of a module of a class that are none of the model's."""
    for statement in named(module.node):
        inner = _inner(statement)
        called, _ = call_parts(inner.child_by_field_name("right") if inner else None) or ("", [])
        definition = statement.child_by_field_name("definition") or statement
        if any(c.type == "wildcard_import" for c in statement.children):
            yield statement
            continue
        if statement.type in _AT_TOP or called in _NAMED or _is_text(statement):
            continue
        if constants.is_quiet(module, statement) or is_alias(module, statement):
            continue
        is_class = definition.type == "class_definition"
        if is_class and text_of(field(definition, "name")) not in NO_PYTHON_CLASSES:
            continue  # of those names generated code means its own
        if statement.type == "if_statement" and "TYPE_CHECKING" in text_of(statement):
            continue
        yield statement


def _is_of_type(statement: Node) -> bool:
    """Whether a state variable is made as its type says, with a value that the model has."""
    value = without_parentheses(field(statement, "right"))
    if not is_unset(value) and literal_type(value) is None:
        return False
    said, made = type_of(statement.child_by_field_name("type")), type_made(value)
    return said is None or made is None or said.dimensions == made.dimensions


def _is_before_node(function: Scope, statement: Node) -> bool:
    """Whether a statement of a constructor asks of the object what only a node can do."""
    made = (s for s in body_of(function) if text_of(s).startswith("super().__init__("))
    start = next(made, None)
    is_early = start is not None and statement.start_byte < start.start_byte
    return is_early and re.search(r"\bself\b(?!\._\w+\s*=)", text_of(statement)) is not None


def _parameters(function: Scope) -> list[str]:
    return [p.name for p in function.parameters[1:]]


def _name_of(parameter: Node) -> str:
    name = parameter.child_by_field_name("name")
    return text_of(name if name is not None else (named(parameter) or [parameter])[0])


def _left(inner: Node | None) -> str:
    """What an assignment stores into; nothing for what is none."""
    return text_of(field(inner, "left")) if inner is not None and inner.type == "assignment" else ""


def _flat(value: Node) -> str:
    """What a field of a message is filled with: an array by its elements."""
    called, arguments = call_parts(value) or ("", [])
    return text_of(arguments[0] if called == "flatten" and len(arguments) == 1 else value)


def _is_of_state(statement: Node) -> bool:
    inner = _inner(statement)
    if inner is None:
        return False
    if inner.type == "assignment":
        target, value = text_of(field(inner, "left")), field(inner, "right")
        if target == "msg":
            return value.type == "call" and _only_looks(field(value, "arguments"))
        return target.startswith("msg.") and _only_looks(value)
    return text_of(inner) == "self._state_pub.publish(msg)"


def _only_looks(value: Node) -> bool:
    """Whether to evaluate something changes nothing: it stores nowhere, and calls nothing else."""
    return all(
        node.type not in _STORING
        and (node.type != "call" or text_of(field(node, "function")) in _LOOKING)
        for node in nodes_in(value)
    )


def _inner(statement: Node) -> Node | None:
    """The expression or assignment that a statement is."""
    if statement.type != "expression_statement" or not named(statement):
        return None
    return named(statement)[0]


def _is_text(statement: Node) -> bool:
    inner = _inner(statement)
    return inner is not None and inner.type in ("string", "concatenated_string")


def set_in(statement: Node) -> Iterator[str]:
    """The variable that a statement at the top of a module makes."""
    inner = named(statement)[0] if named(statement) else statement
    if inner.type == "assignment":
        yield text_of(field(inner, "left"))
