"""Uses, in bodies of generated C++, of what no file that was read declares.

A statement of which nothing is left in the model must not touch what the model has. An object of an
unknown type, or under an unknown name, may: to make, change or end it may run any code. Reading a
variable does nothing, whatever it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.effects.cpp_roots import declared_in, identifiers_in
from rebsync.reverse.bodies.effects.known_functions import (
    is_harmless_object,
    is_known,
    starts_nothing,
    takes_values,
    type_takes_values,
)
from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.syntax.descendants import nodes_in

_PLACES = frozenset({"field_expression", "subscript_expression", "pointer_expression"})


@dataclass(frozen=True, slots=True)
class UnknownNames:
    """Looks through one statement. `inner` are the names that it declares itself."""

    scope: Scope
    inner: frozenset[str]

    @classmethod
    def of(cls, scope: Scope, statement: Node) -> UnknownNames:
        """For a statement: what it declares hides what is declared elsewhere."""
        names = set[str]()
        for node in nodes_in(statement):
            for declarator in node.children_by_field_name("declarator"):
                if declarator.type != "init_declarator":  # its own declarator is there as well
                    names.update(declared_in(declarator))
        return cls(scope, frozenset(names))

    def uses(self, node: Node) -> Iterator[Node]:
        """The types and objects that are unknown, and that something is done with."""
        match node.type:
            case "declaration":
                yield from self._type(part(node, "type"))
            case "new_expression" | "compound_literal_expression":
                yield from self._type(part(node, "type"))
            case "delete_expression":
                yield from self._object(named(node)[0])
            case "assignment_expression":
                yield from self._object(part(node, "left"))
            case "update_expression":
                yield from self._object(part(node, "argument"))
            case "binary_expression" if part(node, "operator").type in ("<<", ">>"):
                yield from self._object(part(node, "left"))
            case "call_expression":
                yield from self._handed(node)
        for child in named(node):
            yield from self.uses(child)

    def _type(self, node: Node) -> Iterator[Node]:
        """A type whose constructors and destructor nobody knows."""
        text = text_of(node)
        name = text.removeprefix("const ").partition("<")[0].strip()
        is_own = name.rpartition("::")[2] in self.scope.types
        is_plain = node.type in ("primitive_type", "placeholder_type_specifier", "auto")
        if is_plain or is_own or self.scope.carried(node) is not None:
            return
        if not (type_takes_values(name) and starts_nothing(name)):
            yield node

    def _object(self, node: Node) -> Iterator[Node]:
        """A place that is part of an object that nobody knows."""
        while node.type in _PLACES:
            node = part(node, "argument")
        match node.type:
            case "identifier" if self._is_unknown(text_of(node)):
                yield node
            case "qualified_identifier" if not is_harmless_object(text_of(node)):
                owner, _, name = text_of(node).rpartition("::")
                known = owner.rpartition("::")[2] in self.scope.types
                if not known or self.scope.members.get(name) is None:
                    yield node
            case "parenthesized_expression" | "conditional_expression":
                yield from (n for n in identifiers_in(node) if self._is_unknown(text_of(n)))

    def _handed(self, node: Node) -> Iterator[Node]:
        """What a function gets that may call or change it."""
        call = self.scope.call(node)
        if call is None or takes_values(call):
            return
        if call.target is None and self._is_unknown(call.name) and not is_known(call):
            yield part(node, "function")
        for argument in call.arguments:
            yield from self._object(argument)

    def _is_unknown(self, name: str) -> bool:
        scope = self.scope
        known = (scope.functions, scope.constants, scope.enumerators, scope.macros)
        if name in self.inner or scope.meaning(name) is not None:
            return False
        return not any(name in names for names in known) and not is_harmless_object(name)


def is_unknown_function(scope: Scope, inner: AbstractSet[str], call: CppCall) -> bool:
    """Whether a body of generated code calls a free function that may touch more than it gets.

    `inner` are the names that are declared inside what is looked at.
    """
    name = call.name.rpartition("::")[2]
    if not has_mailbox(scope) or call.target is not None:
        return False
    return not (name in inner or scope.meaning(name) is not None or is_known(call))


def is_method_of_unknown(scope: Scope, inner: AbstractSet[str], owner: str, name: str) -> bool:
    """Whether a body of generated code calls a method of an object that nobody knows."""
    if not has_mailbox(scope) or not owner or owner in inner:
        return False
    return name not in libraries.looking() and not is_harmless_object(owner)
