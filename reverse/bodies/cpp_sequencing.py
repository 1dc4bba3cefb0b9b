"""Operands that C++ leaves unsequenced, where the body of one stands before the whole statement.

[intro.execution]: `n + f()` may read `n` before or after `f` changes it. A body that is put before
the statement is evaluated first of all, so that nothing beside its call may see that.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field, replace
from itertools import combinations

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_effects import touching
from rebsync.reverse.bodies.effects.cpp_kinds import SHORT_CIRCUIT
from rebsync.reverse.bodies.effects.cpp_roots import (
    declared_in,
    identifiers_in,
    parameters_of,
    root,
)
from rebsync.reverse.bodies.effects.known_functions import may_change
from rebsync.reverse.bodies.scope import (
    Called,
    Inline,
    Lambda,
    Meaning,
    Record,
    Scope,
    Variable,
    meant_by,
)
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of

_WHY = "C++ leaves open in which order this is evaluated"
_HINT = "say it in two statements"
_GUARDED = frozenset({"conditional_expression", "while_statement", "for_statement", "do_statement"})


def check_place(reader: CppStatementReader, node: Node) -> None:
    """Raises `Unread` where the call is not run once, and first of all in its statement."""
    below, above = node, node.parent
    while above is not None and not below.type.endswith(("_statement", "declaration")):
        if above.type == "binary_expression" and text_of(part(above, "operator")) in SHORT_CIRCUIT:
            guarded = part(above, "right").id == below.id
        elif above.type == "conditional_expression":
            guarded = part(above, "condition").id != below.id
        else:
            guarded = above.type in _GUARDED and below.type != "compound_statement"
        if guarded:
            why = "the body of this function cannot stand here"
            raise reader.unread(node, why, "call it in a statement of its own")
        below, above = above, above.parent


def check_call(reader: CppStatementReader, call: Node) -> None:
    """Raises `Unread` where what stands beside a call can see whether its body has run."""
    others = list(_beside(call))
    if others:
        own = _effects(reader, call)
        if any(own.conflicts(_effects(reader, other)) for other in others):
            raise reader.unread(call, _WHY, _HINT)


def check_arguments(reader: CppStatementReader, arguments: Sequence[Node]) -> None:
    """Raises `Unread` where it matters which of the arguments is evaluated first."""
    found = [_effects(reader, a) for a in arguments] if len(arguments) > 1 else []
    if any(one.conflicts(other) for one, other in combinations(found, 2)):
        raise reader.unread(arguments[0], _WHY, _HINT)


def changes(reader: CppStatementReader, nodes: Sequence[Node], hidden: frozenset[str]) -> bool:
    """Whether expressions change anything, but for what the names of parameters hide."""
    found = OperandEffects()
    for node in nodes:
        _Looking(reader.cpp, reader.scope, found, hidden).look(node)
    return bool(found.writes) or found.acts


def _effects(reader: CppStatementReader, node: Node) -> OperandEffects:
    found = OperandEffects()
    if node.type == "init_declarator":  # of the same declaration, before this one
        found.writes |= set(declared_in(part(node, "declarator")))
    _Looking(reader.cpp, reader.scope, found).look(node)
    return found


def _beside(node: Node) -> Iterator[Node]:
    """What is evaluated before a node in its statement, or in no order with it."""
    below, above = node, node.parent
    while above is not None and not below.type.endswith(("_statement", "declaration")):
        others = [c for c in named(above) if c.id != below.id]
        match above.type:
            case "binary_expression" if text_of(part(above, "operator")) in SHORT_CIRCUIT:
                others = []  # the left one is first; what is right of it has no place for a body
            case "assignment_expression" if text_of(part(above, "operator")) == "=":
                left = part(above, "left")
                others = [] if left.id == below.id or left.type == "identifier" else others
            case "argument_list" | "subscript_expression" | "subscript_argument_list":
                pass
            case "binary_expression" | "assignment_expression" | "call_expression":
                pass
            case _:
                others = [c for c in others if c.start_byte < below.start_byte]
        yield from others
        below, above = above, above.parent


@dataclass(slots=True)
class OperandEffects:
    """What an operand may read and change of variables, by name; `acts` on messages and time."""

    reads: set[str] = field(default_factory=set)
    writes: set[str] = field(default_factory=set)
    acts: bool = False

    def conflicts(self, other: OperandEffects) -> bool:
        """Whether one of the two may see what the other does."""
        return bool(
            (self.writes & (other.reads | other.writes))
            or (other.writes & self.reads)
            or (self.acts and other.acts)
        )


@dataclass(frozen=True, slots=True)
class _Looking:
    """Adds what pieces of one body do to `found`; `hidden` names are the body's own."""

    cpp: Cpp
    scope: Scope
    found: OperandEffects
    hidden: frozenset[str] = frozenset()
    seen: set[tuple[str, int]] = field(default_factory=set)

    def look(self, node: Node) -> None:
        match node.type:
            case "identifier":
                self.found.reads |= self._variables(node)
            case "field_expression":
                self.found.reads |= self._variables(node)
                self.look(part(node, "argument"))
            case "assignment_expression" | "update_expression":
                self._change(node)
            case "call_expression":
                self._call(node)
            case _:
                if node.type == "pointer_expression" and text_of(node).startswith("&"):
                    self._written(named(node)[0])
                elif node.type == "init_declarator" and _refers(node):
                    self._written(part(node, "value"))
                for child in node.named_children:
                    self.look(child)

    def _variables(self, node: Node) -> set[str]:
        name, meaning = root(self.scope, self.hidden, node)
        return set(_names(name, meaning)) if name not in self.hidden else set()

    def _written(self, node: Node) -> None:
        found = self._variables(node)
        for inner in identifiers_in(node):
            found |= self._variables(inner)
        self.found.writes |= found

    def _change(self, node: Node) -> None:
        value = node.child_by_field_name("right")  # None of `x++`
        target = part(node, "argument" if value is None else "left")
        self._written(target)
        if value is None or target.type != "identifier" or text_of(part(node, "operator")) != "=":
            self.look(target)
        if value is not None:
            self.look(value)

    def _call(self, node: Node) -> None:
        call = self.scope.call(node)
        for child in named(part(node, "arguments")):
            self.look(child)
        if call is None:
            self.look(part(node, "function"))
            return
        if call.target is not None:
            self.look(call.target)
        name = call.name.rpartition("::")[2]
        meaning = None if name in self.hidden else self.scope.meaning(name)
        if call.target is None and isinstance(meaning, Lambda):
            self._lambda(call, meaning)
            return
        known = self.scope.functions.get(name)
        if isinstance(known, Called | Inline):
            for function in meant_by(known, call.name, len(call.arguments)):
                for parameter, argument in zip(function.parameters, call.arguments, strict=False):
                    if may_change(parameter):
                        self._written(argument)
                own = frozenset(p.name for p in function.parameters)
                self._body(function.cpp, replace(self.scope, locals={}), function.body, own)
        elif touching(self.cpp, self.scope, node) is not None:
            self.found.acts = True
            self._written(node)

    def _lambda(self, call: CppCall, meaning: Lambda) -> None:
        declarator = meaning.node.child_by_field_name("declarator")
        if declarator is not None and any(c in text_of(declarator) for c in "&*"):
            for argument in call.arguments:
                self._written(argument)
        scope = meaning.scope or replace(self.scope, locals={})
        own = frozenset(parameters_of(meaning.node)) | meaning.own
        self._body(self.cpp, scope, part(meaning.node, "body"), own)

    def _body(self, cpp: Cpp, scope: Scope, body: Node | None, own: frozenset[str]) -> None:
        if body is None:
            self.found.acts = True
            return
        key = cpp.source.path, body.start_byte
        if key not in self.seen:
            self.seen.add(key)
            declared = (d for x in inside(body, "declaration") for d in _declarators(x))
            locals_ = own.union(*(declared_in(d) for d in declared))
            _Looking(cpp, scope, self.found, locals_, self.seen).look(body)


def _declarators(declaration: Node) -> Iterator[Node]:
    for each in declaration.children_by_field_name("declarator"):
        yield each.child_by_field_name("declarator") or each


def _refers(declared: Node) -> bool:
    declarator = part(declared, "declarator")
    return declarator.type in ("reference_declarator", "pointer_declarator")


def _names(name: str, meaning: Meaning | None) -> Iterator[str]:
    """The variables of the model that a name stands for; else the name itself."""
    match meaning:
        case Variable(of_model) | m.Name(of_model):
            yield of_model
        case Record(fields) if fields:
            yield from (v.name for v in fields.values())
        case _ if isinstance(meaning, m.Node):
            yield from (n.name for n in m.walk(meaning) if isinstance(n, m.Name))
        case _ if name:
            yield name
        case _:
            pass
