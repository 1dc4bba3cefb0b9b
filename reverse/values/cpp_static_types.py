"""Static types of C++ expressions: classes with the pointers, holders and containers around them.

`cpp_flow_types` gives the class that is inside of all these; here each is taken off where the code
does so, by `*`, `->`, `[]` or a method, so that a method of a pointer is none of what it points to.
"""

from __future__ import annotations

from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of, unqualified
from rebsync.reverse.values.cpp_flow import declaration_of, made_of
from rebsync.reverse.values.cpp_flow_types import POINTERS, Types, Variable, unscoped_member

POINTING = frozenset({"shared_ptr", "unique_ptr", "scoped_ptr", "weak_ptr", "intrusive_ptr"})
_DEREFERENCED = POINTING | {"optional", "reference_wrapper"}
_SEQUENCES = frozenset(
    {"vector", "array", "deque", "list", "forward_list", "set", "unordered_set", "multiset"}
    | {"queue", "stack", "initializer_list"}
)
_MAPS = frozenset({"map", "unordered_map", "multimap", "unordered_multimap"})
_ITERATOR, _PAIR = "iterator", "std::pair"
_ITERATORS = frozenset({"begin", "end", "cbegin", "cend", "rbegin", "find", "lower_bound"})
_ELEMENTS = frozenset({"at", "front", "back", "top"})
_PASSING = frozenset({"move", "forward", "ref", "cref", "as_const"})
_CASTS = frozenset(
    {"static_cast", "dynamic_cast", "reinterpret_cast", "const_cast"}
    | {"static_pointer_cast", "dynamic_pointer_cast", "const_pointer_cast"}
)
_MAKERS = frozenset({"make_shared", "make_unique", "allocate_shared"})
_DECLARATORS = frozenset({"pointer_declarator", "array_declarator", "abstract_pointer_declarator"})
_DEEPEST = 12
FUNCTION = "function"  # the name of what holds a function, of any kind


@dataclass(frozen=True, slots=True)
class StaticType:
    """A type by its full name, the arguments of its template, and the raw pointers around it."""

    cpp: Cpp
    name: str
    arguments: tuple[Node, ...] = ()
    pointers: int = 0

    @property
    def last(self) -> str:
        """The name without its scope."""
        return self.name.rpartition("::")[2]


@dataclass(frozen=True, slots=True)
class StaticTypes:
    """Finds the static types of expressions; None where no declaration tells it."""

    types: Types

    def of(self, cpp: Cpp, node: Node, depth: int = 0) -> StaticType | None:
        """The type of an expression."""
        if depth > _DEEPEST:
            return None
        match node.type:
            case name if name in _NAMES:
                variable = self.types.variable(cpp, node)
                return self.declared(variable, depth) if variable else self._bound(cpp, node, depth)
            case "field_expression":
                return self._field(cpp, node, depth)
            case "subscript_expression":
                return self.element(self.of(cpp, part(node, "argument"), depth + 1))
            case "pointer_expression":
                inner = self.of(cpp, part(node, "argument"), depth + 1)
                if node.children[0].type == "&":
                    return replace(inner, pointers=inner.pointers + 1) if inner else None
                return self.dereferenced(inner, "operator*")
            case "parenthesized_expression" if len(named(node)) == 1:
                return self.of(cpp, named(node)[0], depth + 1)
            case "conditional_expression":
                return self.of(cpp, part(node, "consequence"), depth + 1)
            case "assignment_expression":
                return self.of(cpp, part(node, "left"), depth + 1)
            case "new_expression":
                made = self.written(cpp, part(node, "type"))
                return replace(made, pointers=made.pointers + 1) if made is not None else None
            case "cast_expression" | "compound_literal_expression":
                return self.written(cpp, part(node, "type"))
            case "call_expression":
                return self._result(cpp, node, depth)
            case _:
                return None

    def variable(self, cpp: Cpp, node: Node) -> Variable | None:
        """The variable that an expression names: by itself, or as the field of a known object."""
        if node.type != "field_expression":
            return self.types.variable(cpp, node) if node.type in _NAMES else None
        target, name = part(node, "argument"), text_of(part(node, "field"))
        if target.type == "this":
            return self.types.variable(cpp, part(node, "field"))
        return self.types.member(self.class_of(self._holder(cpp, node, 0)), name)

    def class_of(self, type_: StaticType | None) -> CppClass | None:
        """The class of the files that a type is, with nothing around it."""
        if type_ is None or type_.pointers:
            return None
        return self.types.texts.class_near(type_.last, type_.cpp)

    # --- declarations ---------------------------------------------------------------------------

    def declared(self, variable: Variable, depth: int = 0) -> StaticType | None:
        """The type that a variable is declared with, or that `auto` finds."""
        pointers = pointers_around(variable)
        if variable.type is None:
            return None
        if variable.type.type != "placeholder_type_specifier":
            return self.written(variable.cpp, variable.type, pointers)
        declaration = declaration_of(variable.name)
        if declaration is not None and declaration.type == "for_range_loop":
            return self.element(self.of(variable.cpp, part(declaration, "right"), depth + 1), True)
        given = made_of(variable.name)
        return self.of(variable.cpp, given[0], depth + 1) if given else None

    def written(
        self, cpp: Cpp, node: Node | None, pointers: int = 0, depth: int = 0
    ) -> StaticType | None:
        """A type as the code writes it, other names for types replaced."""
        if node is None or depth > _DEEPEST:
            return None
        if node.type == "type_descriptor":
            around = node.child_by_field_name("declarator")
            while around is not None and around.type.startswith("abstract_"):
                if around.type == "abstract_function_declarator":
                    return StaticType(cpp, FUNCTION)  # and pointers to one, which are called alike
                pointers += around.type in _DECLARATORS
                around = around.child_by_field_name("declarator")
            return self.written(cpp, node.child_by_field_name("type"), pointers, depth + 1)
        last = unqualified(node)
        text = "".join(text_of(node).split())
        if last.type == "template_type":
            given = tuple(named(part(last, "arguments")))
            full = text.removesuffix("".join(text_of(part(last, "arguments")).split()))
            return StaticType(cpp, full, given, pointers)
        name, texts = text_of(last), self.types.texts
        if last is node and _is_template_parameter(cpp, node):
            return None
        if name in POINTERS and last is not node:
            return StaticType(cpp, text.rpartition("::")[0].partition("<")[0], (), pointers + 1)
        if (alias := texts.renamed(cpp, node)) is not None:
            return self.written(alias.cpp, alias.type, pointers, depth + 1)
        if (pointed := texts.pointed_to(name)) is not None:
            return StaticType(cpp, pointed, (), pointers + 1)
        return StaticType(cpp, text, (), pointers)

    # --- what is inside -------------------------------------------------------------------------

    def dereferenced(
        self, type_: StaticType | None, by: str = "operator->", depth: int = 0
    ) -> StaticType | None:
        """What `->` and, `by` that operator, `*` lead to."""
        if type_ is None or depth > _DEEPEST:
            return None
        if type_.pointers:
            return replace(type_, pointers=type_.pointers - 1)
        if type_.last in _DEREFERENCED and type_.arguments:
            return self.written(type_.cpp, type_.arguments[0])
        if type_.name == _ITERATOR:
            if len(type_.arguments) > 1:
                return replace(type_, name=_PAIR)
            return self.written(type_.cpp, type_.arguments[0])
        result = self._result_of(self.class_of(type_), by)
        return self.dereferenced(result, by, depth + 1) if by == "operator->" else result

    def element(self, type_: StaticType | None, in_order: bool = False) -> StaticType | None:
        """What `[]` gives; of a map, taken `in_order`, a key with its value."""
        if type_ is None:
            return None
        if type_.pointers:
            return replace(type_, pointers=type_.pointers - 1)
        if type_.last in _SEQUENCES and type_.arguments:
            return self.written(type_.cpp, type_.arguments[0])
        if type_.last in _MAPS and len(type_.arguments) > 1:
            if in_order:
                return replace(type_, name=_PAIR)
            return self.written(type_.cpp, type_.arguments[1])
        return self._result_of(self.class_of(type_), "operator[]")

    def _holder(self, cpp: Cpp, node: Node, depth: int) -> StaticType | None:
        """The object that a field, or a method, is of."""
        target = part(node, "argument")
        found = self.of(cpp, target, depth + 1)
        return self.dereferenced(found) if is_arrow(node) else found

    def _field(self, cpp: Cpp, node: Node, depth: int) -> StaticType | None:
        name = text_of(part(node, "field"))
        if part(node, "argument").type == "this":
            variable = self.types.variable(cpp, part(node, "field"))
            return self.declared(variable, depth) if variable is not None else None
        holder = self._holder(cpp, node, depth)
        if holder is not None and holder.name == _PAIR and len(holder.arguments) > 1:
            halves = dict(zip(("first", "second"), holder.arguments, strict=False))
            return self.written(holder.cpp, halves.get(name))
        member = self.types.member(self.class_of(holder), name)
        return self.declared(member, depth) if member is not None else None

    def _bound(self, cpp: Cpp, node: Node, depth: int) -> StaticType | None:
        """`auto& [key, value]`: a part of what is taken apart."""
        texts = self.types.texts
        function = texts.function_around(cpp, node)
        if function is None:
            return None
        start, end = function.node.start_byte, node.start_byte
        for place in reversed(texts.within(cpp, text_of(node), start, end)):
            around = place.parent
            if around is None or around.type != "structured_binding_declarator":
                continue
            index, above = named(around).index(place), around.parent
            while above is not None and above.type == "reference_declarator":
                above = above.parent
            if above is not None and above.type == "for_range_loop":
                whole = self.element(self.of(cpp, part(above, "right"), depth + 1), True)
            elif above is not None and above.type == "init_declarator":
                whole = self.of(cpp, part(above, "value"), depth + 1)
            else:
                return None
            if whole is None or whole.name not in (_PAIR, "std::tuple"):
                return None
            return self.written(whole.cpp, dict(enumerate(whole.arguments)).get(index))
        return None

    # --- calls ----------------------------------------------------------------------------------

    def _result(self, cpp: Cpp, node: Node, depth: int) -> StaticType | None:
        function = part(node, "function")
        if function.type == "field_expression":
            return self._of_method(cpp, node, function, depth)
        last = unqualified(function)
        name, given = unscoped_member(last), named(part(node, "arguments"))
        if last.type == "template_function" and (types := named(part(last, "arguments"))):
            made = self.written(cpp, types[0])
            if name in _MAKERS or name.endswith("_pointer_cast"):
                return replace(made, pointers=made.pointers + 1) if made is not None else None
            if name in _CASTS:
                return made
        if name in _PASSING and given:
            return self.of(cpp, given[0], depth + 1)
        around = self.types.texts.class_of(self.types.texts.function_around(cpp, node))
        if last is function and (found := self._result_of(around, name)):
            return found
        for definition in self.types.texts.code.definitions.get(("", name), ()):
            return self.given(definition)
        return StaticType(cpp, name) if name in self.types.texts.code.all_classes else None

    def _of_method(self, cpp: Cpp, node: Node, function: Node, depth: int) -> StaticType | None:
        name, holder = (
            unscoped_member(part(function, "field")),
            self._holder(cpp, function, depth),
        )
        if holder is None:
            return None
        if (owner := self.class_of(holder)) is not None:
            return self._result_of(owner, name)
        if holder.last in _SEQUENCES | _MAPS:
            if name in _ITERATORS:
                return replace(holder, name=_ITERATOR)
            return self.element(holder) if name in _ELEMENTS else None
        if holder.last in _DEREFERENCED and name in ("get", "lock", "value"):
            inner = self.dereferenced(holder)
            is_pointer = inner is not None and holder.last in POINTING
            return replace(inner, pointers=inner.pointers + 1) if is_pointer and inner else inner
        return None

    def _result_of(self, owner: CppClass | None, name: str) -> StaticType | None:
        function = self.types.texts.giving(owner, name)
        return self.given(function) if function is not None else None

    def given(self, function: CppFunction) -> StaticType | None:
        """The type of what a function gives, references left out."""
        declarator, pointers = function.node.child_by_field_name("declarator"), 0
        while declarator is not None and declarator.type == "pointer_declarator":
            declarator, pointers = declarator.child_by_field_name("declarator"), pointers + 1
        return self.written(function.cpp, function.result, pointers)


# `C c(x);` is a function to the grammar, and `x` the type of a parameter.
_NAMES = frozenset({"identifier", "qualified_identifier", "field_identifier", "type_identifier"})


def is_arrow(node: Node) -> bool:
    """Whether a field is reached by `->`."""
    return any(child.type == "->" for child in node.children)


def declarator_of(variable: Variable) -> Node | None:
    """The declarator of a variable with what stands around its name."""
    if variable.field is None:
        node: Node | None = variable.name
        while node is not None and node.parent is not None and node.parent.type in _AROUND:
            node = node.parent
        return node
    for declarator in variable.field.node.children_by_field_name("declarator"):
        inner: Node | None = declarator
        while inner is not None and inner.type not in ("identifier", "field_identifier"):
            inner = inner.child_by_field_name("declarator") or (
                inner.named_children[-1] if inner.named_children else None
            )
        if inner is not None and text_of(inner) == variable.text:
            return declarator
    return None


_AROUND = frozenset(
    {"pointer_declarator", "array_declarator", "reference_declarator", "init_declarator"}
)


def pointers_around(variable: Variable) -> int:
    """How many raw pointers and arrays are around what a variable's type names."""
    node, count = declarator_of(variable), 0
    while node is not None and node.type not in ("identifier", "field_identifier"):
        count += node.type in _DECLARATORS
        node = node.child_by_field_name("declarator") or (
            node.named_children[-1] if node.named_children else None
        )
    return count


def _is_template_parameter(cpp: Cpp, node: Node) -> bool:
    """Whether a name is that of a parameter of a template around, which any type may be."""
    if b"template" not in cpp.words:
        return False
    templates = (n for n in ancestors(node) if n.type == "template_declaration")
    lists = (n.child_by_field_name("parameters") for n in templates)
    parameters = (p for list_ in lists if list_ is not None for p in named(list_))
    return any(c.text == node.text for p in parameters for c in named(p))
