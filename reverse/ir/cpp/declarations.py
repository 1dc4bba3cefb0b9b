"""Declarations in bodies ([stmt.dcl]): variables, references, bindings, static locals, arrays."""

from __future__ import annotations

import re
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import is_base
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_statement,
    unsupported,
)
from rebsync.reverse.ir.cpp.declarators import variable_name
from rebsync.reverse.ir.cpp.elision import by_value
from rebsync.reverse.ir.cpp.initialisation import by_arguments, initialised
from rebsync.reverse.ir.cpp.names import field_of
from rebsync.reverse.ir.cpp.objects import (
    address,
    as_value,
    default_constructed,
    dereferenced,
    ends_with_scope,
    implicitly,
)
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.ir.operators import Conversion, Operator
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span

_NO_EFFECT = (
    *("using_declaration", "alias_declaration", "type_definition", "static_assert_declaration"),
    *("namespace_alias_definition", "struct_specifier", "class_specifier", "union_specifier"),
    *("enum_specifier", "preproc_def", "preproc_function_def"),
)
# What these say of warnings changes nothing; others, as `omp`, start threads.
_PRAGMA = re.compile(r"#\s*pragma\s+(?:GCC|clang)\s+diagnostic\b|#\s*pragma\s+(?:end)?region\b")


@lowers_statement(*_NO_EFFECT, "comment", ";", "empty_statement")
def nothing(context: Context, node: Node) -> None:
    """What only tells the compiler something."""


@lowers_statement("preproc_call")
def pragma(context: Context, node: Node) -> None:
    """`#pragma GCC diagnostic push`."""
    if _PRAGMA.match(text_of(node)) is None:
        raise Unlowered("a pragma")


@lowers_statement("declaration")
def declaration(context: Context, node: Node) -> None:
    """All declarators of a declaration; callers that end scopes take them one by one."""
    for declarator in declarators(node):
        declare(context, node, declarator)


def declarators(node: Node) -> list[Node]:
    """The declarators of a declaration in their order."""
    return node.children_by_field_name("declarator")


def declare(context: Context, node: Node, declarator: Node) -> None:
    """One variable with its first value."""
    type_node = node.child_by_field_name("type")
    if type_node is None:
        raise Unlowered("a declaration without a type")
    value: Node | None = None
    if declarator.type == "init_declarator":
        value = part(declarator, "value")
        declarator = part(declarator, "declarator")
    if _is_static(node):
        _static_local(context, node, type_node, declarator, value)
        return
    if "structured_binding" in declarator.type or _binding_in(declarator) is not None:
        _bindings(context, declarator, value)
        return
    name = variable_name(declarator)
    is_class = type_node.type in ("class_specifier", "struct_specifier")
    if name is None or (is_class and type_node.child_by_field_name("body") is not None):
        _no_variable(context, node, declarator)
        return
    declared = context.world.types.declared(context.cpp, context.scope, type_node, declarator)
    is_auto = "auto" in text_of(type_node).split() or type_node.type == "decltype"
    with context.full_expression():
        variable(context, text_of(name), declared, value, is_auto, context.place(node))


def _no_variable(context: Context, node: Node, declarator: Node) -> None:
    """A function that is declared in a body; or `T x(a);`, which the grammar takes for one."""
    if declarator.type != "function_declarator":
        raise Unlowered("a declaration of a class in a body")
    name, list_ = text_of(part(declarator, "declarator")), named(part(declarator, "parameters"))
    place = context.place(node)
    type_ = context.world.types.declared(context.cpp, context.scope, part(node, "type"), None).type
    local = e.Local(context.unique(name), type_, place)
    mark = len(context.out)
    if all(_is_type(context, each.child_by_field_name("type")) for each in list_):
        # It declares a function, of which a call is one of what is not known.
        found = Value(e.Local(context.unique(name), t.FunctionType(), place), t.FunctionType())
        context.bind(name, found)
        return
    try:
        nodes = [_argument(context, each) for each in list_]
        with context.full_expression():
            by_arguments(context, local, type_, nodes, place)
    except Unlowered as error:
        del context.out[mark:]
        context.emit(s.Declare(local, type_, None, place))
        unread = unsupported(context, node, str(error), local)
        context.emit(replace(unread, raises=not all(map(_looks_called, list_))))
    context.bind(name, Value(local, type_, is_lvalue=True))
    _begin(context, mark, local, type_, place)


def _argument(context: Context, node: Node) -> Node:
    """What looks like a parameter without a name, and is an argument: no type has its name."""
    type_ = node.child_by_field_name("type")
    is_called = node.child_by_field_name("declarator") is not None
    if type_ is None or is_called or _is_type(context, type_):
        raise Unlowered("a declaration of a function in a body")
    return type_


def _is_type(context: Context, node: Node | None) -> bool:
    """Whether what looks like the type of a parameter surely is one."""
    if node is None or node.type not in ("type_identifier", "qualified_identifier"):
        return node is not None
    path = context.cpp.source.path
    return context.world.symbols.type_named(text_of(node), context.scope, path) is not None


def _looks_called(node: Node) -> bool:
    """Whether what looks like a parameter, a function without a name, is a call: `T x(f());`."""
    declarator = node.child_by_field_name("declarator")
    return declarator is not None and declarator.type == "abstract_function_declarator"


def _is_static(node: Node) -> bool:
    return any(
        c.type == "storage_class_specifier" and text_of(c) in ("static", "thread_local")
        for c in node.children
    )


def variable(
    context: Context,
    name: str,
    declared: Declared,
    value: Node | None,
    is_auto: bool,
    place: Span,
) -> None:
    """Declares a variable of a name; `auto` takes its type from the value."""
    local = e.Local(context.unique(name), declared.form, place)
    mark = len(context.out)
    try:
        if is_auto:
            _deduced(context, name, local, declared, value, place)
        elif declared.reference is not ReferenceKind.NONE:
            _reference(context, name, local, declared, value, place)
        else:
            _object(context, name, local, declared.type, value, place)
    except Unlowered as error:
        del context.out[mark:]
        type_ = declared.form
        context.bind(name, Value(local, declared.type, is_lvalue=True))
        if declared.reference is not ReferenceKind.NONE:
            context.bind(name, dereferenced(local, declared.type, place))
        context.emit(s.Declare(local, type_, None, place))
        node = value if value is not None else context.cpp.root
        reads = unsupported(context, node, str(error), local) if value is not None else None
        context.emit(reads or s.Unsupported(str(error), (), (), local, place))
        ends_with_scope(context, local, type_, place)


def _object(
    context: Context, name: str, local: e.Local, type_: t.Type, value: Node | None, place: Span
) -> None:
    """`T x = value;`: the name is seen in its own initialiser, but has no value there."""
    mark = len(context.out)
    context.bind(name, Value(local, type_, is_lvalue=True))
    if value is None:
        default_constructed(context, local, type_, place)
    elif isinstance(type_, t.Array) and value.type == "string_literal":
        raise Unlowered("an array of characters with a text")
    else:
        initialised(context, local, type_, value)
    _begin(context, mark, local, type_, place)


def _begin(context: Context, mark: int, local: e.Local, type_: t.Type, place: Span) -> None:
    """The declaration before what gives the first value; both in one where that is one value."""
    last = context.out[-1] if context.out else None
    is_first = getattr(last, "target", None) == local
    if isinstance(last, s.Assign) and is_first:
        context.out[-1] = s.Declare(local, type_, last.value, place)
    else:
        at = len(context.out) - 1 if is_first else mark
        context.out.insert(at, s.Declare(local, type_, None, place))
    ends_with_scope(context, local, type_, place)


def _reference(
    context: Context,
    name: str,
    local: e.Local,
    declared: Declared,
    value: Node | None,
    place: Span,
) -> None:
    """`T& x = value;`; a temporary lives as long as the reference ([class.temporary])."""
    if value is None:
        raise Unlowered("a reference to nothing")
    found = _initial(context, value)
    same = found.type == declared.type or is_base(context.world, declared.type, found.type)
    if not same:
        found = implicitly(context, found, declared.type, place)
    _refer(context, name, local, Declared(declared.type, declared.reference), found, place)


def _initial(context: Context, value: Node) -> Value:
    if value.type in ("initializer_list", "argument_list"):
        inner = named(value)
        if len(inner) != 1 or inner[0].type == "initializer_list":
            raise Unlowered("a reference to what a list makes")
        return lower_value(context, inner[0])
    return lower_value(context, value)


def _refer(
    context: Context,
    name: str,
    local: e.Local,
    declared: Declared,
    found: Value,
    place: Span,
) -> None:
    form = declared.form
    local = replace(local, type=form)
    if found.is_lvalue:
        to = address(context, found, place)
    else:
        if declared.reference is ReferenceKind.LVALUE:
            if found.type not in (declared.type, t.UNKNOWN):
                raise Unlowered("a reference to what is not known as an object")
            to = e.Convert(Conversion.CAST, found.expression, form, True, place)
            context.emit(s.Declare(local, form, to, place))
            context.bind(name, dereferenced(local, declared.type, place))
            return
        extended = e.Local(context.unique(f"{name}~value"), found.type, place)
        mark = len(context.out)
        by_value(context, extended, found.type, found, place)
        _begin(context, mark, extended, found.type, place)
        to = e.AddressOf(extended, form, place)
    context.emit(s.Declare(local, form, to, place))
    context.bind(name, dereferenced(local, declared.type, place))


def _deduced(
    context: Context,
    name: str,
    local: e.Local,
    declared: Declared,
    value: Node | None,
    place: Span,
) -> None:
    """`auto x = value;` and `auto& x = value;`."""
    if value is None:
        raise Unlowered("auto without a value")
    found = _initial(context, value)
    if declared.reference is not ReferenceKind.NONE:
        reference = declared.reference
        if reference is ReferenceKind.RVALUE and found.is_lvalue:
            reference = ReferenceKind.LVALUE  # a forwarding reference
        _refer(context, name, local, Declared(found.type, reference), found, place)
        return
    type_ = found.type
    if isinstance(type_, t.Reference) and not type_.may_be_null:
        type_ = replace(type_, may_be_null=True)
    local = replace(local, type=type_)
    mark = len(context.out)
    by_value(context, local, type_, Value(found.expression, type_, found.is_lvalue), place)
    context.bind(name, Value(local, type_, is_lvalue=True))
    _begin(context, mark, local, type_, place)


# --- structured bindings ([dcl.struct.bind]) ------------------------------------------------------


def _binding_in(declarator: Node) -> Node | None:
    current: Node | None = declarator
    while current is not None and current.type == "reference_declarator":
        current = named(current)[-1] if named(current) else None
    is_binding = current is not None and "structured_binding" in current.type
    return current if is_binding else None


def _bindings(context: Context, declarator: Node, value: Node | None) -> None:
    """`auto [a, b] = value;`: names for the parts of one object."""
    binding = _binding_in(declarator)
    if binding is None or value is None:
        raise Unlowered("a structured binding")
    place = context.place(declarator)
    reference = declarator.type == "reference_declarator"
    hidden = f"[{', '.join(text_of(n) for n in named(binding))}]"
    with context.full_expression():
        kind = ReferenceKind.CONSTANT if reference else ReferenceKind.NONE
        variable(context, hidden, Declared(t.UNKNOWN, kind), value, True, place)
    whole = context.local(hidden)
    if whole is not None:
        bind_parts(context, binding, whole, place)


def bind_parts(context: Context, binding: Node, whole: Value, place: Span) -> None:
    """The names of a structured binding for the parts of an object."""
    names = [text_of(n) for n in named(binding)]
    fields = _part_names(context, whole.type, len(names))
    for number, name in enumerate(names):
        if isinstance(whole.type, t.Array):
            at = e.Literal(number, t.Integer(64), place=place)
            element = whole.type.element
            found = e.Index(whole.expression, at, element, False, False, False, place)
            context.bind(name, Value(found, whole.type.element, is_lvalue=True))
        elif fields is None or number >= len(fields):
            found_unknown = e.Attribute(whole.expression, str(number), t.UNKNOWN, True, place)
            context.bind(name, Value(found_unknown, t.UNKNOWN, is_lvalue=True))
        else:
            context.bind(name, field_of(context, whole, fields[number], place))


def _part_names(context: Context, type_: t.Type, count: int) -> list[str] | None:
    if not isinstance(type_, t.Record):
        return None
    if type_.name in context.world.types.tuples:
        return [name for name, _ in context.world.types.tuples[type_.name]]
    owner = context.world.symbols.classes.get(type_.name)
    if owner is None:
        return None
    names = [f.name for f in owner.fields if not f.is_static]
    return names if len(names) == count else None


# --- static locals ([stmt.dcl]) -------------------------------------------------------------------


def _static_local(
    context: Context, node: Node, type_node: Node, declarator: Node, value: Node | None
) -> None:
    """A variable that is initialised when the declaration is first passed."""
    name, place = variable_name(declarator), context.place(node)
    declared = context.world.types.declared(context.cpp, context.scope, type_node, declarator)
    is_auto = "auto" in text_of(type_node).split()
    if name is None or declared.reference is not ReferenceKind.NONE:
        raise Unlowered("a static local of this kind")
    own = context.unique(f"static {text_of(name)}")
    static = e.Global(context.name, own.removeprefix("static "), declared.type, place)
    type_ = declared.type
    ready = e.Global(context.name, f"{static.name} is initialised", t.TRUTH, place)
    if not is_auto:
        context.bind(text_of(name), Value(static, type_, is_lvalue=True))
    with context.body() as body, context.full_expression():
        if value is None:
            default_constructed(context, static, declared.type, place)
        elif is_auto:
            first = lower_value(context, value)
            type_, static = first.type, replace(static, type=first.type)
            context.emit(s.Assign(static, as_value(context, first, place), place))
        else:
            initialised(context, static, declared.type, value)
        context.emit(s.Assign(ready, e.Literal(True, t.TRUTH, place=place), place))
    test = e.Unary(Operator.NOT, ready, t.TRUTH, False, place)
    context.emit(s.If(test, tuple(body), (), False, place))
    context.bind(text_of(name), Value(static, type_, is_lvalue=True))
