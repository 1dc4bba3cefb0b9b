"""Where objects behind pointers come from: provenance of what code calls methods of.

Who makes a node and hands it an object may have told that object of the node. What a library gives
knows of the node what it was told by calls, which are looked at by themselves.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import field
from enum import IntEnum

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, returns_in, text_of
from rebsync.reverse.values.cpp_flow import Texts
from rebsync.reverse.values.cpp_flow_calls import Calls
from rebsync.reverse.values.cpp_flow_definitions import Definition, definitions
from rebsync.reverse.values.cpp_flow_types import Variable, unscoped_member
from rebsync.reverse.values.cpp_static_types import StaticTypes, declarator_of


class Provenance(IntEnum):
    """Who made an object, from what is best known to what is least."""

    MADE = 0  # the code that was read, which says its class
    LIBRARY = 1  # a function of a library
    GIVEN = 2  # somebody outside of what was read


_MAKES = frozenset({"make_shared", "make_unique", "allocate_shared"})
_PASSING = frozenset({"move", "forward", "ref", "cref", "shared_from_this"})
# Methods of `pluginlib`, whose objects are of classes that a file names when the node runs.
_PLUGINS = frozenset(
    {"createInstance", "createUniqueInstance", "createSharedInstance", "createUnmanagedInstance"}
    | {"createClassInstance"}
)
# Methods of pointers and containers that give what these hold.
_HELD = frozenset({"get", "lock", "at", "front", "back", "value", "begin", "find", "top"})
_PUTTING = frozenset(
    {"push_back", "push_front", "emplace_back", "emplace", "insert", "push", "reset", "assign"}
)
_REFERRING = ("*", "&", "ptr", "Ptr", "reference_wrapper")
_DEEPEST = 8


@dataclass(slots=True)
class ProvenanceAnalysis:
    """Finds out where objects come from, by all that the files store in variables."""

    texts: Texts
    calls: Calls
    statics: StaticTypes
    _known: dict[int, Provenance] = field(default_factory=dict)
    # Variables that are looked for, by their place in the search, and the first that was met again:
    # what depends on it is not known before it is (Tarjan 1972).
    _open: dict[int, int] = field(default_factory=dict)
    _first: int = 0

    def of(self, cpp: Cpp, node: Node, depth: int = 0) -> Provenance:
        """Where the object that an expression names, or points to, comes from."""
        if depth > _DEEPEST:
            return Provenance.GIVEN
        match node.type:
            case "new_expression" | "compound_literal_expression":
                return self._made(cpp, part(node, "type"))
            case "lambda_expression":
                return Provenance.MADE
            case "null" | "number_literal" | "nullptr":
                return Provenance.MADE
            case "identifier" | "field_expression" | "qualified_identifier" | "type_identifier":
                variable = self.statics.variable(cpp, node)
                if variable is not None:
                    return self.variable(variable, depth)
                of_unknown = node.type == "field_expression"
                return self.of(cpp, part(node, "argument"), depth + 1) if of_unknown else _OTHER
            case "cast_expression":
                return self.of(cpp, part(node, "value"), depth + 1)
            case "subscript_expression":
                return self.led_to(cpp, part(node, "argument"), "operator[]", depth + 1)
            case "pointer_expression":
                return self.led_to(cpp, part(node, "argument"), "operator*", depth + 1)
            case "parenthesized_expression" | "initializer_list" | "argument_list":
                return max((self.of(cpp, n, depth + 1) for n in named(node)), default=_NONE)
            case "conditional_expression":
                ways = part(node, "consequence"), part(node, "alternative")
                return max(self.of(cpp, each, depth + 1) for each in ways)
            case "call_expression":
                return self._result(cpp, node, depth)
            case _:
                return Provenance.GIVEN

    def led_to(self, cpp: Cpp, node: Node, by: str, depth: int = 0) -> Provenance:
        """Where what an operator of an object leads to comes from; of others, the object."""
        owner = self.statics.class_of(self.statics.of(cpp, node))
        if owner is None:
            return self.of(cpp, node, depth)
        bodies = [f for c in self.texts.lineage(owner) for f in self.calls.bodies(c, by)]
        return self._given_by(bodies, depth) if bodies else self.of(cpp, node, depth)

    def _given_by(self, functions: Iterable[CppFunction], depth: int) -> Provenance:
        """Where what some functions give comes from."""
        returns = ((f.cpp, each) for f in functions for each in returns_in(f.body))
        given = ((cpp, value) for cpp, each in returns for value in named(each))
        return max((self.of(c, v, depth + 1) for c, v in given), default=Provenance.MADE)

    def variable(self, variable: Variable, depth: int = 0) -> Provenance:
        """Where what a variable holds, or points to, comes from."""
        key = variable.name.id
        if key in self._known:
            return self._known[key]
        if key in self._open:
            self._first = min(self._first, self._open[key])
            return Provenance.MADE
        around, self._first = self._first, len(self._open)
        place = self._open[key] = self._first
        found = self._variable(variable, depth)
        del self._open[key]
        if self._first == place:
            self._known[key] = found
            self._first = around
        else:
            self._first = min(around, self._first)
        return found

    def _variable(self, variable: Variable, depth: int) -> Provenance:
        is_auto = variable.type is not None and variable.type.type == "placeholder_type_specifier"
        if not is_auto and not _refers(variable):
            return Provenance.MADE
        if variable.kind == "lambda":
            return Provenance.LIBRARY  # whoever calls it, of which the call is looked at
        if variable.kind == "parameter":
            return self._parameter(variable, depth)
        found = [self._defined(cpp, d, depth) for cpp, d in self._definitions(variable)]
        if variable.field is not None and variable.field.value is not None:
            found.append(self.of(variable.cpp, variable.field.value, depth + 1))
        return max(found, default=Provenance.GIVEN)

    def _definitions(self, variable: Variable) -> Iterator[tuple[Cpp, Definition]]:
        places: Iterable[tuple[Cpp, Node]] = self.texts.everywhere(variable.text)
        if variable.scope is not None:
            scope, cpp = variable.scope, variable.cpp
            inner = self.texts.within(cpp, variable.text, scope.start_byte, scope.end_byte)
            places = ((cpp, place) for place in inner)
        for cpp, place in places:
            at = place.start_byte
            for definition in definitions(self.texts, cpp, variable, "", at, at + 1):
                yield cpp, definition

    def _defined(self, cpp: Cpp, definition: Definition, depth: int) -> Provenance:
        values: tuple[Node, ...] = definition.arguments
        match definition.how:
            case "value" | "added" | "element":
                values = (definition.node,)
            case "given":
                return Provenance.MADE  # of a call by itself: what it may store is the library's
            case "unknown" if definition.node.type == "call_expression":
                name = unscoped_member(part(part(definition.node, "function"), "field"))
                if name not in _PUTTING:
                    return Provenance.MADE
                values = tuple(named(part(definition.node, "arguments")))
        return max((self.of(cpp, v, depth + 1) for v in values), default=Provenance.MADE)

    # --- parameters and results -----------------------------------------------------------------

    def _parameter(self, variable: Variable, depth: int) -> Provenance:
        """What callers give; of callbacks, what the library gives that calls them."""
        function = self.texts.functions().get(variable.scope.id) if variable.scope else None
        if function is None:
            return Provenance.GIVEN
        uses = self.calls.uses(function)
        found = [
            self.of(use.cpp, use.arguments[variable.index], depth + 1)
            for use in uses
            if variable.index < len(use.arguments)
        ]
        if self._is_handed_on(function):
            found.append(Provenance.LIBRARY)
        return max(found, default=Provenance.GIVEN)

    def _is_handed_on(self, function: CppFunction) -> bool:
        """Whether code takes the address of a function: who gets it calls it."""
        if function.name == function.owner:
            return False  # a constructor has none
        for _, place in self.texts.everywhere(function.name):
            above = place.parent
            while above is not None and above.type == "qualified_identifier":
                above = above.parent
            if above is not None and above.type in ("pointer_expression", "argument_list"):
                return True
        return False

    def _result(self, cpp: Cpp, node: Node, depth: int) -> Provenance:
        function, given = part(node, "function"), named(part(node, "arguments"))
        last = function
        while last.type == "qualified_identifier":
            last = part(last, "name")
        if function.type == "field_expression":
            name = unscoped_member(part(function, "field"))
            if name in _PLUGINS:
                return Provenance.GIVEN
        else:
            name = unscoped_member(last)
        if name in _MAKES:
            types = named(part(last, "arguments")) if last.type == "template_function" else ()
            return self._made(cpp, types[0]) if types else Provenance.LIBRARY
        if (name in _PASSING or name.endswith("_cast")) and given:
            return self.of(cpp, given[-1], depth + 1)
        if reached := self.calls.functions(cpp, node):
            return self._given_by(reached, depth)
        if function.type == "field_expression":
            holder = self.of(cpp, part(function, "argument"), depth + 1)
            return holder if name in _HELD else max(holder, Provenance.LIBRARY)
        is_class = name in self.texts.code.all_classes
        return Provenance.MADE if is_class else Provenance.LIBRARY

    def _made(self, cpp: Cpp, type_: Node) -> Provenance:
        """Where an object of a type comes from: its class may be one that no file has."""
        owner = self.statics.class_of(self.statics.written(cpp, type_))
        return Provenance.MADE if owner is not None else Provenance.LIBRARY


_NONE = Provenance.MADE
_OTHER = Provenance.LIBRARY


def _refers(variable: Variable) -> bool:
    """Whether a variable is a pointer or a reference, or a container that may have some."""
    if variable.type is None:
        return True
    declarator = declarator_of(variable)
    around = text_of(declarator) if declarator is not None else ""
    around = around.partition("=")[0].partition("(")[0].partition("{")[0]
    return any(mark in text_of(variable.type) + around for mark in _REFERRING)
