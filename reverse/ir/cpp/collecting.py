"""Declarations of C++ trees as symbols: one walk over what stands outside of bodies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir.cpp.declarators import variable_name
from rebsync.reverse.ir.cpp.symbols import (
    AliasSymbol,
    ClassSymbol,
    EnumSymbol,
    FieldSymbol,
    FunctionSymbol,
    VariableSymbol,
    base_names,
    joined,
)
from rebsync.reverse.syntax.cpp_declarations import (
    CppFunction,
    conversion_function,
    function_of,
    with_values,
)
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of

_CLASSES = frozenset({"class_specifier", "struct_specifier", "union_specifier"})
_WRAPPERS = frozenset(
    {
        *("translation_unit", "declaration_list", "ERROR", "linkage_specification"),
        *("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef"),
    }
)
_REFERRING = frozenset({"pointer_declarator", "reference_declarator"})


@dataclass(frozen=True, slots=True)
class Declaration:
    """A declaration or definition of a function, before those of one function are joined."""

    scope: str
    owner: str | None
    code: CppFunction
    words: frozenset[str]
    is_template: bool
    converts_to: Node | None = None


@dataclass(slots=True)
class Collected:
    """All that some files declare, in the order of the text."""

    classes: list[ClassSymbol] = field(default_factory=list)
    enums: list[EnumSymbol] = field(default_factory=list)
    aliases: list[AliasSymbol] = field(default_factory=list)
    variables: list[VariableSymbol] = field(default_factory=list)
    functions: list[Declaration] = field(default_factory=list)
    imports: dict[str, list[str]] = field(default_factory=dict)  # using directives by path
    names: dict[str, dict[str, str]] = field(default_factory=dict)  # using declarations by path
    spaces: dict[str, str] = field(default_factory=dict)  # namespaces by other names, of all files
    own_spaces: set[str] = field(default_factory=set)
    forward: list[str] = field(default_factory=list)  # classes that are declared without members

    def add(self, cpp: Cpp) -> None:
        """The declarations of one more file."""
        self._within(cpp, cpp.root, "", False)
        for node in inside(cpp.root, "namespace_alias_definition"):
            names = ["".join(text_of(each).split()) for each in named(node)]
            if len(names) == 2:
                self.spaces[names[0]] = names[1]

    def _within(self, cpp: Cpp, node: Node, scope: str, is_template: bool) -> None:
        for child in named(node):
            self._one(cpp, child, scope, is_template)

    def _one(self, cpp: Cpp, node: Node, scope: str, is_template: bool) -> None:
        match node.type:
            case kind if kind in _WRAPPERS:
                self._within(cpp, node, scope, is_template)
            case "namespace_definition":
                name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
                inner = scope if name is None else joined(scope, "".join(text_of(name).split()))
                self.own_spaces |= {inner, inner.rpartition("::")[2]}
                if body is not None:
                    self._within(cpp, body, inner, is_template)
            case "template_declaration":
                self._within(cpp, node, scope, True)
            case "using_declaration":
                self._using(cpp, node)
            case _:
                self._declared(cpp, node, scope, is_template, None)

    def _using(self, cpp: Cpp, node: Node) -> None:
        """`using namespace a;` and `using a::b;`."""
        name = "".join(text_of(named(node)[-1]).split()) if named(node) else ""
        if any(child.type == "namespace" for child in node.children):
            self.imports.setdefault(cpp.source.path, []).append(name)
        else:
            self.names.setdefault(cpp.source.path, {})[name.rpartition("::")[2]] = name

    def _declared(
        self, cpp: Cpp, node: Node, scope: str, is_template: bool, owner: str | None
    ) -> None:
        """What a declaration declares, but for fields."""
        type_ = node if node.type in _CLASSES or node.type == "enum_specifier" else None
        if node.type in (
            "declaration",
            "field_declaration",
            "type_definition",
            "alias_declaration",
        ):
            type_ = node.child_by_field_name("type")
        if type_ is not None and type_.type in _CLASSES:
            self._class(cpp, type_, scope, is_template)
        elif type_ is not None and type_.type == "enum_specifier":
            self._enum(cpp, type_, scope)
        if node.type in ("type_definition", "alias_declaration"):
            self._alias(cpp, node, scope)
        elif (function := _function(cpp, node, scope, owner, is_template)) is not None:
            self.functions.append(function)
        elif node.type == "declaration" and owner is None:
            self.variables += _variables(cpp, node, scope)
        elif node.type == "expression_statement" and owner is None:
            self.variables += _pointers(cpp, node, scope)

    def _class(self, cpp: Cpp, node: Node, scope: str, is_template: bool) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if name is not None and body is None:
            self.forward.append(joined(scope, text_of(name)))
        if name is None or body is None:
            return
        full = joined(scope, "".join(text_of(name).split()).partition("<")[0])
        fields: list[FieldSymbol] = []
        self._members(cpp, body, full, is_template, fields)
        bases = tuple(base_names(node))
        is_union = node.type == "union_specifier"
        found = ClassSymbol(full, scope, node, cpp, bases, tuple(fields), is_template, is_union)
        self.classes.append(found)

    def _members(
        self, cpp: Cpp, body: Node, full: str, is_template: bool, fields: list[FieldSymbol]
    ) -> None:
        for member in named(body):
            if member.type in _WRAPPERS:
                self._members(cpp, member, full, is_template, fields)
            elif member.type == "template_declaration":
                self._members(cpp, member, full, True, fields)
            elif member.type == "friend_declaration":  # of the namespace around ([class.friend])
                self._within(cpp, member, full.rpartition("::")[0], is_template)
            else:
                self._declared(cpp, member, full, is_template, full)
                fields += _fields(cpp, member)

    def _enum(self, cpp: Cpp, node: Node, scope: str) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is None:
            return
        own = text_of(name) if name is not None else f"enum at {node.start_point.row + 1}"
        is_scoped = any(child.type in ("class", "struct") for child in node.children)
        self.enums.append(EnumSymbol(joined(scope, own), is_scoped, node, cpp, scope))

    def _alias(self, cpp: Cpp, node: Node, scope: str) -> None:
        type_ = node.child_by_field_name("type")
        if type_ is None:
            return
        if node.type == "alias_declaration":
            name = node.child_by_field_name("name")
            if name is not None:
                self.aliases.append(
                    AliasSymbol(joined(scope, text_of(name)), type_, None, cpp, scope)
                )
            return
        for declarator in node.children_by_field_name("declarator"):
            inner = declarator
            while inner.type in _REFERRING or inner.type == "array_declarator":
                inner = inner.child_by_field_name("declarator") or inner.named_children[-1]
            if inner.type == "type_identifier":
                full = joined(scope, text_of(inner))
                self.aliases.append(AliasSymbol(full, type_, declarator, cpp, scope))


def _fields(cpp: Cpp, member: Node) -> Iterator[FieldSymbol]:
    """The variables that a member declaration declares."""
    type_ = member.child_by_field_name("type")
    if member.type != "field_declaration" or type_ is None:
        return
    is_static = any(
        c.type == "storage_class_specifier" and text_of(c) == "static" for c in member.children
    )
    for declarator, value in with_values(member):
        name = variable_name(declarator)
        if name is not None:
            bits = _bits(member, declarator)
            yield FieldSymbol(text_of(name), type_, declarator, value, cpp, is_static, bits)


def _bits(member: Node, declarator: Node) -> Node | None:
    """The width of a bit-field; the grammar has it in an error where a value follows."""
    clauses = [c for c in member.named_children if c.type in ("bitfield_clause", "ERROR")]
    for clause in clauses:
        if clause.start_byte >= declarator.end_byte:
            inner = (
                clause if clause.type == "bitfield_clause" else next(iter(named(clause)), clause)
            )
            return next(iter(named(inner)), None)
    return None


def _variables(cpp: Cpp, node: Node, scope: str) -> Iterator[VariableSymbol]:
    type_ = node.child_by_field_name("type")
    is_extern = any(
        c.type == "storage_class_specifier" and text_of(c) == "extern" for c in node.children
    )
    if type_ is None or is_extern:
        return
    for declarator in node.children_by_field_name("declarator"):
        value: Node | None = None
        if declarator.type == "init_declarator":
            value = declarator.child_by_field_name("value")
            declarator = declarator.child_by_field_name("declarator") or declarator
        inner: Node | None = declarator
        if declarator.type != "qualified_identifier":
            inner = variable_name(declarator)
        if inner is not None:
            full = joined(scope, "".join(text_of(inner).split()))
            yield VariableSymbol(full, type_, declarator, value, cpp, scope)


def _pointers(cpp: Cpp, node: Node, scope: str) -> Iterator[VariableSymbol]:
    """`void (*f)(int);` outside of functions, which the grammar takes for a call."""
    for call in inside(node, "call_expression"):
        type_, list_ = part(call, "function"), named(part(call, "arguments"))
        if type_.type == "primitive_type" and [n.type for n in list_] == ["pointer_expression"]:
            name = part(list_[0], "argument")
            full = joined(scope, text_of(name))
            yield VariableSymbol(full, type_, list_[0], None, cpp, scope)


def _function(
    cpp: Cpp, node: Node, scope: str, owner: str | None, is_template: bool
) -> Declaration | None:
    found = function_of(cpp, node, owner or "")
    if found is None or found.name.startswith("("):  # that is a pointer to a function
        return None
    qualifier = _qualifier(node)
    is_conversion = conversion_function(cpp, node, "") is not None
    converts_to = found.result if is_conversion else None
    words = {text_of(c) for c in node.children if c.type not in ("compound_statement", "comment")}
    declarator = node.child_by_field_name("declarator")
    while declarator is not None and declarator.type in _REFERRING:
        declarator = declarator.named_children[-1]
    if declarator is not None:
        words |= {text_of(c) for c in declarator.children if c.type != "parameter_list"}
    inner = joined(scope, qualifier)
    is_member = owner is not None or bool(qualifier)
    return Declaration(
        inner, inner if is_member else None, found, frozenset(words), is_template, converts_to
    )


def _qualifier(node: Node) -> str:
    """What stands before the name: `Robot` in `void Robot::move() {}`."""
    declarator = node.child_by_field_name("declarator")
    while declarator is not None and declarator.type != "qualified_identifier":
        inner = declarator.child_by_field_name("declarator")
        if inner is None and declarator.type in _REFERRING and declarator.named_children:
            inner = declarator.named_children[-1]
        declarator = inner
    if declarator is None:
        return ""
    text, _, is_operator = "".join(text_of(declarator).split()).partition("::operator")
    if is_operator:
        return text.partition("<")[0]
    return text.partition("<")[0] if "<" in text else text.rpartition("::")[0]


def symbol_of(
    name: str, declarations: tuple[Declaration, ...], defined: Declaration
) -> FunctionSymbol:
    """The symbol of a function of which these are all declarations."""
    words = frozenset[str]().union(*(d.words for d in declarations))
    has_default = any(w.replace(" ", "").startswith("=default") for w in words)
    return FunctionSymbol(
        name,
        defined.code.name,
        defined.scope,
        defined.owner,
        defined.code,
        tuple(d.code for d in declarations),
        is_static="static" in words,
        is_virtual=bool(words & {"virtual", "override", "final"}) or defined.code.pure,
        is_const="const" in words,
        is_explicit="explicit" in words,
        is_default=has_default,
        is_deleted=any(w.replace(" ", "").startswith("=delete") for w in words),
        is_template=any(d.is_template for d in declarations),
        converts_to=defined.converts_to,
    )
