"""Whether what generated Python does around the model's bodies is what the model says.

Set-up, shims, and functions that send are not in the model: what somebody changed there is listed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync.intervals import Interval
from rebsync.names import graph_name
from rebsync.records import dataclass
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.messages import OwnMessages
from rebsync.reverse.libraries.generated_calls import PUBLISHERS
from rebsync.reverse.python.generated.decorators import is_transparent
from rebsync.reverse.python.generated.named_constants import CodeConstants
from rebsync.reverse.python.generated.parameters import only_declares, parameter_read
from rebsync.reverse.python.generated.posts import Post
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    expression_in,
    handed_over,
    is_text,
    is_unset,
    literal_type,
    passed_on,
    stored_into,
    type_made,
    type_of,
    without_parentheses,
)
from rebsync.reverse.python.generated.roles import OFFERING, PyRoles, PySends
from rebsync.reverse.python.generated.send_functions import odd_in_send
from rebsync.reverse.python.generated.shims import odd_in_shim
from rebsync.reverse.python.generated.slicing.log_words import TEXTS
from rebsync.reverse.python.generated.slicing.logs import is_logger
from rebsync.reverse.python.generated.slicing.silent import Silent
from rebsync.reverse.python.generated.validation import is_passed
from rebsync.reverse.python.generated.value_types import name_in_form
from rebsync.reverse.python.values.class_creation import DECORATORS
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import Py, field, named, text_of

_MADE = frozenset({"Mailbox", "Drive", "Sensor"})
_CONNECTING = frozenset(
    {
        *("advertise", "advertise_all", "subscribe", "subscribe_on_bridge"),
        *OFFERING,
    }
)
_CALLED = frozenset(
    {
        *("self._wire", "super()._wire", "super().__init__", "Node.__init__"),
        "RebecNode.__init__",
        "self._mailbox.on_served",
    }
)
_WITHOUT_ARGUMENTS = frozenset({"object", "ABC", "abc.ABC", "Generic", "Protocol"})
_IN_CLASS = frozenset({"function_definition", "decorated_definition", "pass_statement"})
_PLAIN = frozenset({"__init__", "_wire", "_publish_state", "mailbox"})
_STORING = frozenset({"assignment", "named_expression", "lambda", "await", "yield"})
_LOOKING = frozenset({"flatten"})
_WHY = "what this does is not in the model"
_LOST = "no subscription takes this in: the class only sends it to itself"
_BEGUN = "messages may be served by now: set this up before self._mailbox.construct(...)"
_LATE = "this gives a coroutine, and nobody runs it"
_HINT = "say it in the model, or move it into a user block"


@dataclass(frozen=True, slots=True)
class Plumbing:
    """One class with what its functions are for.

    Of `messages` that another package has, as in ROS 2, only the order of what is passed on can be
    looked at. `above` are the classes above, `posts` what is posted, by the ids of the calls; what
    is lost nobody takes in. `numbers` are those of the constants.
    """

    roles: PyRoles
    messages: OwnMessages
    findings: Findings
    constants: CodeConstants
    silent: Silent
    above: Sequence[Scope]
    posts: Mapping[int, Post]
    is_lost: Callable[[PySends], bool]
    numbers: Mapping[str, Interval]

    def check(self) -> None:
        """Lists what a class does besides."""
        owner = self.roles.owner
        for function in self.roles.functions.values():
            for node, reason in (*self._odd(function), *self._failing(function)):
                self._list(owner.py, node, reason, function.name)
        for function in self.roles.functions.values():
            if any(c.type == "async" for c in function.node.children):
                self._list(owner.py, function.node, _LATE, function.name)
            odd = [d for d in function.decorators if not self._is_plain(function, d)]
            named_by, told = self.constants, self.silent
            if odd := [d for d in odd if not is_transparent(named_by, function, d, told)]:
                why = f'nobody knows what "@{odd[0]}" makes of it'
                self._list(owner.py, function.node, why, function.name)
        for node, why in self._overridden():
            self._list(owner.py, node, why, "")
        for statement in named(field(owner.node, "body")):
            if statement.type in _IN_CLASS or is_text(statement):
                continue
            if not self.constants.is_quiet(owner, statement):
                self._list(owner.py, statement, _WHY, "")

    def _is_plain(self, function: Scope, decorator: str) -> bool:
        """Whether the model knows what a function is with it: what is called is no property."""
        if function.name in self.roles.beside:
            return True  # what it does is asked where it is used
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

    def _odd(self, function: Scope) -> Iterator[tuple[Node, str]]:
        body = [
            s for s in self.silent.without_handlers(body_of(function)) if not self.silent.tells(s)
        ]
        sends = self.roles.sends.get(function.name)
        if function.name in ("__init__", "_wire"):
            yield from self._odd_in_set_up(function, body)
        elif function.name not in self.roles.shims and sends is not None and self.is_lost(sends):
            yield from ((s, _LOST) for s in body[-1:])
        else:
            yield from ((n, _WHY) for n in self._odd_around(function, body))

    def _odd_around(self, function: Scope, body: list[Node]) -> Iterator[Node]:
        """What other functions do besides that are none of the model's."""
        name = function.name
        if name in self.roles.shims:
            yield from odd_in_shim(self.constants.code, self.roles, function, body, self.messages)
        elif name in self.roles.sends:
            sends = self.roles.sends[name]
            yield from odd_in_send(function, body, sends, self.messages, self.posts)
        elif name == "_publish_state":
            yield from (s for s in body if not _is_of_state(s))
        elif name in TEXTS:
            effects, owner = self.silent.effects, name_in_form(self.roles.owner)
            yield from () if effects is not None and effects.describes(owner) else body
        elif name == "mailbox":
            yield from (s for s in body if text_of(s) != "return self._mailbox")

    def _failing(self, function: Scope) -> Iterator[tuple[Node, str]]:
        """What only tells people where no body of the model is, and may raise an exception."""
        others = (self.roles.shims, self.roles.sends, self.roles.functions.keys() & _PLAIN)
        if any(function.name in names for names in others):
            for statement in filter(self.silent.tells, body_of(function)):
                reason = next(self.silent.exceptions.reasons(statement), None)
                if reason is not None:
                    yield statement, reason

    # --- set up ---------------------------------------------------------------------------------

    def _odd_in_set_up(self, function: Scope, body: list[Node]) -> Iterator[tuple[Node, str]]:
        """What does not set up, or comes when the model's constructor has been handed over."""
        is_constructed = False
        early = [s for s in body_of(function) if _is_before_node(function, s)]
        yield from ((s, _WHY) for s in early)
        for statement in body:
            if statement in early:
                continue
            if is_passed(statement, self.roles.env, self.numbers):
                continue
            inner = expression_in(statement)
            is_idle = stored_into(inner).removeprefix("self.") in self.silent.ticking
            is_late = is_constructed and not (is_idle or is_logger(inner))
            if is_late or not self._sets_up(function, statement):
                yield statement, _BEGUN if is_constructed else _WHY
            called, _ = call_parts(expression_in(statement)) or ("", [])
            is_constructed = is_constructed or called == "self._mailbox.construct"

    def _sets_up(self, function: Scope, statement: Node) -> bool:
        inner = expression_in(statement)
        if inner is None:
            return statement.type == "pass_statement"
        if inner.type == "call":
            return self._is_called(function, inner)
        if inner.type != "assignment":
            return is_text(statement)
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
            _, values = passed_on(arguments[0]) or ("", [])
            names = [*(p.name for p in function.parameters[1:]), *self.roles.arguments]
            return [text_of(v) for v in values] == names[-len(values) :] if values else True
        if self.silent.timers.is_idle(call) or self.silent.asked.is_idle(call):
            return True
        if called == "super().__init__" and arguments and not self._takes_arguments():
            return False
        return called in _CALLED or only_declares(call, function.node)

    def _takes_arguments(self) -> bool:
        """Whether a class above has a constructor that takes any: that of `object` does not."""
        line = (self.roles.owner, *self.above)
        bases = (c.node.child_by_field_name("superclasses") for c in line)
        names = {text_of(b).partition("[")[0] for found in bases if found for b in named(found)}
        others = names - _WITHOUT_ARGUMENTS - {c.name for c in self.above}
        return bool(others) or any("__init__" in c.names for c in self.above)

    def _is_connected(self, member: str, arguments: list[Node]) -> bool:
        """Whether topics are called after the servers they lead to."""
        # The feedback of an action stands behind the shim.
        shims = [handed_over(a).removeprefix("self.") for a in (*arguments[5:6], *arguments[-1:])]
        shim = next((s for s in shims if s in self.roles.topics), None)
        if shim is not None:
            key = self.roles.topics[shim].removeprefix("port/")
            server = self.roles.served_by(shim)
            return server is not None and key.startswith(graph_name(server))
        return member in self.roles.publishers


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


def _is_of_state(statement: Node) -> bool:
    inner = expression_in(statement)
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
