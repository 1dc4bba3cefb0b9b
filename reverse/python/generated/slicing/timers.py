"""Timers and hooks that the set-up of generated Python makes, and whose callbacks only log.

A callback runs beside the bodies of the model: what it looks at may be on its way to another value,
and what it logs changes nothing.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.generated_calls import (
    DURATIONS,
    SHUTDOWN_HOOKS,
    TIMER_OF_NODE,
    TIMER_OF_ROS_1,
    is_period,
)
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    expression_in,
    without_parentheses,
)
from rebsync.reverse.python.generated.slicing.exceptions import ToldExceptions
from rebsync.reverse.python.generated.slicing.logs import Looks, only_logs, own_method
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of

# What makes timers, and how many arguments these give their callbacks.
_MAKES = {TIMER_OF_ROS_1: 1, TIMER_OF_NODE: 0}
_BASES = frozenset({"ABC", "Node", "RebecNode", "object"})
_NUMBER = re.compile(r"\d+(?:\.\d*)?")
_FLAGS = frozenset({"oneshot=True", "oneshot=False"})


def called_back(function: Scope) -> Iterator[str]:
    """The methods that the statements of a function hand to timers, and to the node's end."""
    for statement in body_of(function):
        inner = expression_in(statement) or statement
        value = inner.child_by_field_name("right") if inner.type == "assignment" else inner
        called, arguments = call_parts(value) or ("", [])
        handed = arguments[1:2] if called in _MAKES else arguments[: called in SHUTDOWN_HOOKS]
        for given in handed:
            holder, _, name = text_of(given).partition(".")
            if holder == "self" and name.isidentifier():
                yield name


def only_logs_by_words(function: Scope) -> bool:
    """Whether a method does nothing but to log, and to keep in locals what it logs."""
    nodes = [n for s in body_of(function) for n in nodes_in(s)]
    is_logging = any(n.type == "call" and _is_log(n) for n in nodes)
    is_plain = not function.decorators and all(map(_logs_by_words, body_of(function)))
    return is_plain and is_logging and not any(map(_own_method_but_logs, nodes))


def chosen_methods(function: Scope) -> frozenset[str]:
    """The methods of the object that a function chooses from, to call one later: in tables,
    as `TABLE.get(key, self._other)`, and as `self._one if c else self._other`.
    """
    own = (n for n in nodes_in(function.node) if n.type == "attribute" and _is_chosen(n))
    return frozenset(text_of(field(n, "attribute")) for n in own)


def _is_chosen(attribute: Node) -> bool:
    above = attribute.parent
    if above is None or above.type in ("pair", "conditional_expression"):
        return above is not None
    called, _ = call_parts(above.parent) or ("", [])
    return above.type == "argument_list" and called.endswith(".get")


def _own_method_but_logs(node: Node) -> str:
    """The method that a call of one of the object's own calls, if it is not that which logs."""
    name = own_method(node)
    return "" if name == "get_logger" else name


def _is_log(call: Node) -> bool:
    return libraries.log_words().match(text_of(field(call, "function"))) is not None


def _logs_by_words(node: Node) -> bool:
    if node.type in ("comment", "pass_statement"):
        return True
    if node.type == "if_statement":
        parts = [node, *node.children_by_field_name("alternative")]
        bodies = [field(p, "body" if p.type == "else_clause" else "consequence") for p in parts]
        return all(_logs_by_words(each) for body in bodies for each in named(body))
    inner = expression_in(node) or node
    if inner.type == "assignment":
        return field(inner, "left").type == "identifier"
    return is_constant_text(inner) or (inner.type == "call" and _is_log(inner))


@dataclass(frozen=True, eq=False, slots=True)
class Timers:
    """What tells the timers of a class that only log: `logging` are the functions that do no more,
    each with how many arguments it takes.
    """

    looks: Looks = Looks()
    logging: Mapping[str, int] = with_default(default_factory=dict)
    exceptions: ToldExceptions = ToldExceptions()

    @staticmethod
    def of(
        code: PyCode, functions: Mapping[str, Scope], looks: Looks, exceptions: ToldExceptions
    ) -> Timers:
        """Those of a class by its functions; what an heir has in place of one may be anything."""
        found = Timers(looks, exceptions=exceptions)
        return found.telling(code, functions, lambda node: only_logs(node, looks))

    def telling(
        self, code: PyCode, functions: Mapping[str, Scope], tells: Callable[[Node], bool]
    ) -> Timers:
        """The same with those functions of which each statement only tells people something."""
        logging = dict(self.logging)
        for name, function in functions.items():
            others = (f for f in code.methods.get(name, ()) if f is not function)
            told = self._with_locals(function, tells)
            is_telling = _only_tells(function, told) and not any(map(is_heir, others))
            body = field(function.node, "body")
            if is_telling and not (self.exceptions.raises(body) or self.exceptions.races(body)):
                logging[name] = len(function.parameters) - 1
        return replace(self, logging=logging)

    def _with_locals(
        self, function: Scope, tells: Callable[[Node], bool]
    ) -> Callable[[Node], bool]:
        """What says whether a statement tells people something, or keeps it in a local."""
        taken = {p.name for p in function.parameters} | self.looks.trusted | function.outer
        names = frozenset(function.names).difference(taken)
        return lambda node: tells_with(node, names, self.looks, tells)

    def is_idle(self, node: Node) -> bool:
        """Whether something makes a timer or a hook that only logs."""
        called, arguments = call_parts(node) or ("", [])
        if called in SHUTDOWN_HOOKS and called.partition(".")[0] in self.looks.trusted:
            return len(arguments) == 1 and self._logs(arguments[0], 0)
        is_known = called in _MAKES and called.partition(".")[0] in self.looks.trusted
        if not is_known or called.rpartition(".")[2] in self.looks.functions:
            return False
        if len(arguments) < 2 or not all(text_of(a) in _FLAGS for a in arguments[2:]):
            return False
        period, callback, *flags = arguments
        if called == TIMER_OF_ROS_1:
            made, given = call_parts(period) or ("", [])
            if made not in DURATIONS or len(given) != 1:
                return False
            period = given[0]
        elif flags:
            return False
        return _is_period(period) and self._logs(callback, _MAKES[called])

    def _logs(self, callback: Node, count: int) -> bool:
        """Whether a callback that gets so many arguments takes them, and only logs."""
        if callback.type == "lambda":
            given = callback.child_by_field_name("parameters")
            names = named(given) if given is not None else []
            body = without_parentheses(field(callback, "body"))
            is_plain = all(n.type == "identifier" for n in names)
            hides = any(text_of(n) in self.looks.trusted for n in names)
            is_taking = is_plain and not hides and len(names) == count
            is_logging = is_taking and body.type == "call" and self.looks.logs(body)
            is_sure = not (self.exceptions.raises(body) or self.exceptions.races(body))
            return is_logging and is_sure
        holder, _, name = text_of(callback).partition(".")
        return holder == "self" and self.logging.get(name) == count


def is_heir(function: Scope) -> bool:
    """Whether a method is of a class that may be below another one of the package."""
    owner = function.owner
    bases = owner.node.child_by_field_name("superclasses") if owner is not None else None
    return bases is not None and not {text_of(b) for b in named(bases)} <= _BASES


def _only_tells(function: Scope, tells: Callable[[Node], bool]) -> bool:
    """Whether a method does nothing but to tell people, with all its arguments by position."""
    body = body_of(function)
    is_plain = not function.decorators and function.node.children[0].type == "def"
    parameters = function.parameters
    by_position = all(p.star == 0 and p.default is None for p in parameters)
    is_own = bool(parameters) and parameters[0].name == "self"
    return (
        is_plain
        and is_own
        and by_position
        and len(parameters) == len(named(field(function.node, "parameters")))
        and bool(body)
        and all(map(tells, body))
    )


def tells_with(
    node: Node, names: Collection[str], looks: Looks, tells: Callable[[Node], bool]
) -> bool:
    """Whether a statement tells people something, or stores what is there under one of some names.

    Something in a stored object counts as the object.
    """
    if node.type in ("comment", "pass_statement") or tells(node):
        return True
    if node.type == "if_statement":
        parts = [node, *node.children_by_field_name("alternative")]
        return all(_branch_tells(part, names, looks, tells) for part in parts)
    inner = expression_in(node)
    value = inner.child_by_field_name("right") if inner is not None else None
    if inner is None or inner.type != "assignment" or value is None or not looks.is_pure(value):
        return False
    left = field(inner, "left")
    while left.type == "attribute":
        left = field(left, "object")
    return left.type == "identifier" and text_of(left) in names


def _branch_tells(
    part: Node, names: Collection[str], looks: Looks, tells: Callable[[Node], bool]
) -> bool:
    condition = part.child_by_field_name("condition")
    body = field(part, "body" if part.type == "else_clause" else "consequence")
    is_pure = condition is None or looks.is_pure(condition)
    return is_pure and all(tells_with(each, names, looks, tells) for each in named(body))


def _is_period(node: Node) -> bool:
    """Whether it is a number of seconds, as it stands, that leaves time and that ROS can count."""
    number = _NUMBER.fullmatch(text_of(node))
    return number is not None and is_period(float(number[0]))
