"""What C++ code declares: functions, classes, variables, enumerations, and how they are read."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_tree import (
    FIELDS,
    Cpp,
    default_of,
    markers_above,
    markers_beside,
    named,
    part,
    text_of,
)

WRAPPERS = frozenset(
    {
        *("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef"),
        *("template_declaration", "ERROR"),
    }
)
TYPES = frozenset({"class_specifier", "struct_specifier", "enum_specifier"})
CONVERSION = "operator "  # what names of conversion functions begin with
_CONSTANT = frozenset({b"const", b"constexpr"})
_OVERRIDING = frozenset({b"override", b"final"})
REFERRING = frozenset({"pointer_declarator", "reference_declarator"})
_DECLARATORS = REFERRING | {"array_declarator", "parenthesized_declarator"}
_DECLARATOR, _BODY, _TYPE = FIELDS["declarator"], FIELDS["body"], FIELDS["type"]
# Declarators, each with the value that follows it.
Declared: TypeAlias = "list[tuple[Node, Node | None]]"
# One type, with its scope or, after `using`, without.
_STD = re.compile(r"^(?:::)?std::(?=\w+\Z)")


@dataclass(frozen=True, slots=True)
class CppParameter:
    """A parameter; its name is empty where the code gives none.

    `default` is what it is where a call leaves it out, with the file that says so.
    """

    name: str
    type: Node
    node: Node
    default: tuple[Cpp, Node] | None = None

    @property
    def may_change(self) -> bool:
        """Whether a function may change what it gets for it."""
        fixed = any(text_of(c) == "const" for c in self.node.named_children)
        levels = map(self.declarator.partition("(")[0].count, "&*[")
        return self.refers and not (fixed and sum(levels) < 2)

    @property
    def refers(self) -> bool:
        """Whether it is a reference or a pointer, or may be made of some."""
        return self.is_pointer or not {*"&*"}.isdisjoint(self.declarator + text_of(self.type))

    @property
    def is_pointer(self) -> bool:
        """Whether it is a pointer, as which arrays are handed over."""
        return not {*"*["}.isdisjoint(self.declarator)

    @property
    def declarator(self) -> str:
        """What stands behind its type."""
        return "".join(map(text_of, self.node.children_by_field_name("declarator")))


@dataclass(frozen=True, slots=True)
class CppFunction:
    """A function, declared or defined; `owner` is the class it belongs to, or empty."""

    name: str
    owner: str
    parameters: tuple[CppParameter, ...]
    result: Node | None
    body: Node | None
    initialisers: Node | None
    markers: tuple[str, ...]
    cpp: Cpp
    node: Node
    pure: bool = False
    overrides: bool = False

    @property
    def types(self) -> tuple[str, ...]:
        """The parameters' types as text, which tells overloads apart."""
        return tuple(_STD.sub("", "".join(text_of(p.type).split())) for p in self.parameters)

    def may_take(self, count: int) -> bool:
        """Whether it may be called with so many arguments."""
        texts = [text_of(p.node) for p in self.parameters]
        if any("..." in text for text in texts):
            return True
        needed = sum(p.default is None for p in self.parameters)
        return count == 0 if texts == ["void"] else needed <= count <= len(texts)

    @property
    def gives_place(self) -> bool:
        """Whether it returns a reference or a pointer."""
        declarator = self.node.child_by_field_name("declarator")
        return declarator is not None and declarator.type in REFERRING


@dataclass(frozen=True, slots=True)
class CppField:
    """A member variable."""

    name: str
    type: Node
    value: Node | None
    markers: tuple[str, ...]
    cpp: Cpp
    node: Node


@dataclass(frozen=True, slots=True)
class CppEnumerator:
    """A constant of an enumeration; `scope` is the class around it, or empty.

    `value` is known where the enumeration says it with numbers, or leaves it out, and it is one of
    an `int`.
    """

    name: str
    enum: str
    scope: str
    value: int | None
    cpp: Cpp
    node: Node


@dataclass(frozen=True, slots=True)
class CppAlias:
    """Another name for a type: `typedef type name;` or `using name = type;`."""

    name: str
    type: Node
    cpp: Cpp


@dataclass(frozen=True, slots=True)
class CppClass:
    """A class with a body; its functions are as declared in it, in their order.

    `fields` are its plain variables; `others` its pointers, references, arrays, and constants that
    its constructors set. `outer` is the class it stands in, or empty. `roots` are the classes of
    rclcpp that it is derived from; `bases` all others.
    """

    name: str
    bases: tuple[str, ...]
    fields: tuple[CppField, ...]
    functions: tuple[CppFunction, ...]
    markers: tuple[str, ...]
    cpp: Cpp
    node: Node
    others: tuple[CppField, ...] = ()
    outer: str = ""
    roots: tuple[str, ...] = ()


def function_of(cpp: Cpp, node: Node, owner: str) -> CppFunction | None:
    """The function that a node declares or defines, if it is one; `owner` is the class around."""
    kind = node.type
    if kind not in ("function_definition", "field_declaration", "declaration"):
        return None
    declarator = node.child_by_field_id(_DECLARATOR)
    while declarator is not None and declarator.type in REFERRING:
        declarator = declarator.named_children[-1] if declarator.named_children else None
    body = node.child_by_field_id(_BODY) if kind == "function_definition" else None
    if kind == "declaration" and declarator is not None and only_braces(node):
        body, declarator = part(declarator, "value"), part(declarator, "declarator")
    if declarator is None or declarator.type != "function_declarator":
        return conversion_function(cpp, node, owner)
    name = part(declarator, "declarator")
    while name.type == "qualified_identifier":
        scope = name.child_by_field_name("scope")
        owner, name = unscoped(scope) if scope is not None else owner, part(name, "name")
    if name.type == "template_function":  # a specialisation is one more function of the name
        name = part(name, "name")
    value = node.child_by_field_name("default_value") if kind == "field_declaration" else None
    result = node.child_by_field_id(_TYPE)
    constructs = kind == "function_definition" and (result is None or node.has_error)
    lists = (c for c in node.named_children if c.type == "field_initializer_list")
    return CppFunction(
        _operator(text_of(name)) if name.type == "operator_name" else cpp.text(name),
        owner,
        tuple(parameters_in(part(declarator, "parameters"))),
        result,
        body,
        next(lists, None) if constructs else None,
        markers_above(node) if cpp.has_markers else (),
        cpp,
        node,
        pure=value is not None and text_of(value) == "0",
        overrides=not cpp.words.isdisjoint(_OVERRIDING)
        and any(c.type == "virtual_specifier" for c in declarator.named_children),
    )


def _operator(text: str) -> str:
    """The name of an operator function as one writes it, with no blanks but before words."""
    sign = "".join(text.removeprefix("operator").split())
    return f"operator {sign}" if sign[:1].isalpha() else f"operator{sign}"


def conversion_function(cpp: Cpp, node: Node, owner: str) -> CppFunction | None:
    """`operator bool() const`, by the type that it converts to ([class.conv.fct])."""
    declarator = node.child_by_field_id(_DECLARATOR)
    while declarator is not None and declarator.type == "qualified_identifier":
        scope = declarator.child_by_field_name("scope")
        owner = unscoped(scope) if scope is not None else owner
        declarator = declarator.child_by_field_name("name")
    if declarator is None or declarator.type != "operator_cast":
        return None
    type_, inner = declarator.child_by_field_id(_TYPE), declarator.child_by_field_id(_DECLARATOR)
    stars = text_of(inner).partition("(")[0].strip() if inner is not None else ""
    value = node.child_by_field_name("default_value")
    return CppFunction(
        f"{CONVERSION}{text_of(type_) if type_ is not None else ''}{stars}",
        owner,
        (),
        type_,
        node.child_by_field_id(_BODY),
        None,
        (),
        cpp,
        node,
        pure=value is not None and text_of(value) == "0",
        overrides=inner is not None and any(c.type == "virtual_specifier" for c in named(inner)),
    )


def unscoped(name: Node) -> str:
    """The last name of a scope, class or type, without the arguments of a template."""
    while name.type in ("qualified_identifier", "template_type", "template_function"):
        name = part(name, "name")
    return text_of(name)


def declared_name(declarator: Node) -> Node | None:
    """The name that a declarator of a variable declares; None for a function's."""
    while declarator.type in _DECLARATORS:
        if not declarator.named_children:
            return None
        inner = declarator.child_by_field_name("declarator")
        declarator = inner if inner is not None else declarator.named_children[-1]
    return declarator if declarator.type in ("identifier", "field_identifier") else None


def members_of(body: Node) -> Iterator[Node]:
    """The members of a class, those between preprocessor lines and of templates too."""
    for member in named(body):
        if member.type in WRAPPERS:
            yield from members_of(member)
        else:
            yield member


def other_fields(cpp: Cpp, node: Node, declared: Declared) -> Iterator[CppField]:
    """The pointers, references and arrays of a declaration of members."""
    for declarator, value in declared:
        if declarator.type in _DECLARATORS and (name := declared_name(declarator)) is not None:
            yield CppField(text_of(name), part(node, "type"), value, (), cpp, node)


def with_values(node: Node) -> Declared:
    """The declarators of a member declaration, each with the value that follows it."""
    declarators = node.children_by_field_name("declarator")
    values = node.children_by_field_name("default_value")
    if not values or len(declarators) == 1:
        return [(d, values[0] if values else None) for d in declarators]
    found: Declared = []
    for declarator, after in zip(declarators, [*declarators[1:], None], strict=True):
        end = after.start_byte if after is not None else node.end_byte
        own = [v for v in values if declarator.end_byte <= v.start_byte < end]
        found.append((declarator, own[0] if own else None))
    return found


def only_braces(node: Node) -> bool:
    """Whether it is `void f() { {} }`, which the grammar takes for a variable."""
    declarator = node.child_by_field_name("declarator") if node.type == "declaration" else None
    if declarator is None or declarator.type != "init_declarator":
        return False
    function, value = part(declarator, "declarator"), part(declarator, "value")
    return function.type == "function_declarator" and value.type == "initializer_list"


def parameters_in(node: Node) -> Iterator[CppParameter]:
    """The parameters of a list of them."""
    for parameter in named(node) if node.named_child_count else ():
        if parameter.type in ("parameter_declaration", "optional_parameter_declaration"):
            yield parameter_of(parameter)


def parameter_of(node: Node) -> CppParameter:
    """The parameter that a declaration of one declares."""
    unnamed = CppParameter("", part(node, "type"), node)
    return replace(unnamed, name=name_of_parameter(node) or unnamed.declarator)


def lambda_parameters(lambda_: Node) -> list[Node]:
    """The parameters of a lambda, as they are declared; none where it has no list of them."""
    declarator = lambda_.child_by_field_name("declarator")
    listed = declarator.child_by_field_name("parameters") if declarator is not None else None
    return named(listed) if listed is not None else []


def name_of_parameter(parameter: Node) -> str:
    """The name of a parameter; empty for one that has none."""
    at = parameter.child_by_field_id(_DECLARATOR)
    name = declared_name(at) if at is not None else None
    return text_of(name) if name is not None else ""


def is_constant(cpp: Cpp, node: Node) -> bool:
    """Whether a declaration is of constants: `const` or `constexpr`, and of no pointer."""
    if cpp.words.isdisjoint(_CONSTANT):
        return False
    qualifiers = (c for c in node.named_children if c.type == "type_qualifier")
    return any(text_of(c) in ("const", "constexpr") for c in qualifiers)


def constant_name(node: Node, declarator: Node) -> Node:
    """The name of a constant that a declaration declares.

    Of a pointer that may be changed it is all of the declarator, by which nothing is called.
    """
    words = {text_of(c) for c in declarator.named_children}
    words |= {"constexpr"} & {text_of(c) for c in node.named_children}
    is_fixed = declarator.type == "array_declarator" or words & {"const", "constexpr"}
    return (declared_name(declarator) if is_fixed else None) or declarator


def valued(node: Node) -> Iterator[tuple[Node, Node]]:
    """The member constants of a declaration with their values."""
    declarators = node.children_by_field_name("declarator")
    value = node.child_by_field_name("default_value")
    if value is not None and len(declarators) == 1:
        yield declarators[0], value


def plain_fields(cpp: Cpp, node: Node, declared: Declared) -> Iterator[CppField]:
    """The plain variables of a declaration of members."""
    for declarator, value in declared:
        if declarator.type == "field_identifier":
            markers = (*markers_above(node), *markers_beside(node)) if cpp.has_markers else ()
            yield CppField(cpp.text(declarator), part(node, "type"), value, markers, cpp, node)


def bases_of(node: Node) -> Iterator[str]:
    for clause in node.named_children:
        if clause.type == "base_class_clause":
            for base in (b for b in clause.named_children if not _is_root(b)):
                if base.type in ("type_identifier", "qualified_identifier", "template_type"):
                    yield unscoped(base)


def roots_of(node: Node) -> Iterator[str]:
    """The classes of nodes that a class is derived from itself: `Node` for `rclcpp::Node`."""
    for clause in node.named_children:
        if clause.type == "base_class_clause":
            named_ = (base for base in clause.named_children if _is_root(base))
            yield from (unscoped(base) for base in named_)


def _is_root(base: Node) -> bool:
    return "".join(text_of(base).split()) in libraries.roots()


def with_defaults(function: CppFunction, declared: Sequence[CppFunction]) -> CppFunction:
    """A function with what its parameters are by default: those `declared` of its name say so."""
    if not function.parameters:
        return function
    given = (p.node.type for f in (*declared, function) for p in f.parameters)
    if "optional_parameter_declaration" not in given:
        return function
    same = [f for f in declared if f.types == function.types]
    parameters = list(function.parameters)
    for known in (*same, function):
        for number, parameter in enumerate(known.parameters):
            default = default_of(parameter.node)
            if default is not None:
                parameters[number] = replace(parameters[number], default=(known.cpp, default))
    changed = any(a is not b for a, b in zip(parameters, function.parameters, strict=True))
    return replace(function, parameters=tuple(parameters)) if changed else function
