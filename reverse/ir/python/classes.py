"""The class table of Python: what the text of classes declares."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.program import Class, Field, Property
from rebsync.reverse.ir.python.names import NameLookup
from rebsync.reverse.ir.python.symbols import Binder, ScopeKind, Symbols
from rebsync.reverse.syntax.py_tree import decorators_of, field, named, text_of
from rebsync.source import NOWHERE

_ARITHMETIC = {
    Operator.ADD: "add",
    Operator.SUBTRACT: "sub",
    Operator.MULTIPLY: "mul",
    Operator.MATRIX_MULTIPLY: "matmul",
    Operator.TRUE_DIVIDE: "truediv",
    Operator.CLASSIC_DIVIDE: "div",
    Operator.FLOOR_DIVIDE: "floordiv",
    Operator.FLOOR_MODULO: "mod",
    Operator.POWER: "pow",
    Operator.SHIFT_LEFT: "lshift",
    Operator.SHIFT_RIGHT: "rshift",
    Operator.BIT_AND: "and",
    Operator.BIT_OR: "or",
    Operator.BIT_XOR: "xor",
}
# Each operator or implicit call, and the methods that Python may answer it by.
_ANSWERS: dict[Operator | ImplicitCall, tuple[str, ...]] = {
    **{o: (f"__{n}__", f"__r{n}__", f"__i{n}__") for o, n in _ARITHMETIC.items()},
    Operator.EQUAL: ("__eq__",),
    Operator.UNEQUAL: ("__ne__", "__eq__"),
    Operator.LESS: ("__lt__", "__gt__"),
    Operator.GREATER: ("__gt__", "__lt__"),
    Operator.LESS_EQUAL: ("__le__", "__ge__"),
    Operator.GREATER_EQUAL: ("__ge__", "__le__"),
    Operator.IN: ("__contains__", "__iter__", "__next__", "__getitem__", "__eq__"),
    Operator.NOT_IN: ("__contains__", "__iter__", "__next__", "__getitem__", "__eq__"),
    Operator.NEGATE: ("__neg__",),
    Operator.PLUS: ("__pos__",),
    Operator.INVERT: ("__invert__",),
    Operator.NOT: ("__bool__", "__nonzero__", "__len__"),
    ImplicitCall.GET_ATTRIBUTE: ("__getattribute__", "__getattr__"),
    ImplicitCall.SET_ATTRIBUTE: ("__setattr__",),
    ImplicitCall.DELETE_ATTRIBUTE: ("__delattr__",),
    ImplicitCall.GET_ITEM: ("__getitem__", "__missing__", "__class_getitem__"),
    ImplicitCall.SET_ITEM: ("__setitem__",),
    ImplicitCall.DELETE_ITEM: ("__delitem__",),
    ImplicitCall.CALL: ("__call__",),
    ImplicitCall.ITERATE: ("__iter__", "__getitem__", "__aiter__"),
    ImplicitCall.NEXT: ("__next__", "next", "__anext__"),
    ImplicitCall.LENGTH: ("__len__",),
    ImplicitCall.TRUTH: ("__bool__", "__nonzero__", "__len__"),
    ImplicitCall.NUMBER: (
        *("__int__", "__float__", "__index__", "__abs__", "__round__", "__trunc__"),
        *("__floor__", "__ceil__", "__divmod__", "__complex__"),
    ),
    ImplicitCall.TEXT: ("__str__", "__repr__", "__format__", "__bytes__", "__unicode__"),
    ImplicitCall.HASH: ("__hash__", "__eq__"),
    ImplicitCall.ENTER: ("__enter__", "__aenter__"),
    ImplicitCall.EXIT: ("__exit__", "__aexit__"),
    ImplicitCall.CONSTRUCT: ("__new__", "__init__", "__post_init__"),
    ImplicitCall.DESTROY: ("__del__",),
    ImplicitCall.COPY: ("__copy__", "__deepcopy__", "__reduce__", "__getstate__"),
    ImplicitCall.DESCRIBE: ("__get__", "__set__", "__delete__", "__set_name__"),
    ImplicitCall.DERIVE: (
        *("__init_subclass__", "__mro_entries__", "__prepare__", "_generate_next_value_"),
    ),
    ImplicitCall.AWAIT: ("__await__",),
}
# Decorators that leave a method the one that stands there.
_PLAIN = frozenset(
    {
        *("staticmethod", "classmethod", "abstractmethod", "abc.abstractmethod", "property"),
        *("override", "typing.override", "typing_extensions.override"),
    }
)


# Decorators of classes that give the class that they get.
_KEEPING = frozenset(
    {
        *("dataclass", "dataclasses.dataclass", "unique", "enum.unique"),
        *("total_ordering", "functools.total_ordering", "final", "typing.final"),
    }
)


def class_of(names: NameLookup, binder: Binder, scope: Symbols) -> Class:
    """A class of the text; it is complete where nothing but plain methods and values is in it."""
    methods: dict[str, str] = {}
    properties: dict[str, Property] = {}
    is_plain = not _keywords(scope.node)
    for child in scope.children:
        if child.kind is ScopeKind.FUNCTION:
            is_plain &= _add(child, scope, methods, properties)
    bases = tuple(base_name(names, node, scope) for node in _bases(scope.node))
    declared = {m for m, _ in methods.items()} | set(properties)
    index = names.code.scopes.get((binder.py.source.path, scope.node.id))
    own = sorted(index.attributes) if index is not None else []
    fields = [Field(n, is_shared=True) for n in scope.bound if n not in declared]
    fields += [Field(n) for n in own if n not in scope.bound]
    answers = tuple((o, n) for o, found in _ANSWERS.items() for n in found if n in scope.bound)
    return Class(
        scope.name,
        bases,
        tuple(methods.items()),
        tuple(properties.values()),
        tuple(fields),
        answers,
        constructor=methods.get("__init__"),
        destructor=methods.get("__del__"),
        body=scope.name,
        complete=is_plain and None not in bases and not decorators_of(scope.node),
        is_plain=is_plain and None not in bases,
        place=binder.py.span(scope.node),
    )


def _add(
    child: Symbols, scope: Symbols, methods: dict[str, str], properties: dict[str, Property]
) -> bool:
    """Adds a method or a part of a property; whether nothing else is made of it."""
    name = scope.mangled(text_of(field(child.node, "name")))
    decorators = decorators_of(child.node)
    if "property" in decorators:
        properties[name] = Property(name, getter=child.name)
        return len(decorators) == 1
    parts = [d for d in decorators if d.endswith((".setter", ".getter", ".deleter"))]
    if parts:
        old = properties.get(name) or Property(name)
        part = parts[0].rpartition(".")[2]
        properties[name] = Property(
            name,
            child.name if part == "getter" else old.getter,
            child.name if part == "setter" else old.setter,
            child.name if part == "deleter" else old.deleter,
        )
        return len(decorators) == 1
    is_first = name not in methods
    methods[name] = child.name
    return is_first and scope.bound.get(name) == 1 and set(decorators) <= _PLAIN


def base_name(names: NameLookup, node: Node, scope: Symbols) -> str | None:
    """The full name of a base: of a class of the program, or of a library."""
    value = _value(names, node, scope)
    match value:
        case e.LibraryReference(name):
            return name
        case e.Global(module, name):
            module_names = names.binder(module)
            bound = module_names.module.bound.get(name)
            classes = [
                s
                for s in module_names.module.children
                if s.kind is ScopeKind.CLASS and text_of(field(s.node, "name")) == name
            ]
            is_one = bound == 1 and len(classes) == 1
            is_one &= name not in module_names.assigned_globals
            is_kept = is_one and _KEEPING.issuperset(decorators_of(classes[0].node))
            return classes[0].name if is_kept else None
        case _:
            return None


def _value(names: NameLookup, node: Node, scope: Symbols) -> e.Expression | None:
    """What the name of a base stands for."""
    around = scope.parent
    if around is None:
        return None
    if node.type == "identifier":
        return names.resolve(around.mangled(text_of(node)), around, NOWHERE)
    if node.type != "attribute":
        return None
    holder, name = _value(names, field(node, "object"), scope), text_of(field(node, "attribute"))
    if isinstance(holder, e.LibraryReference):
        return e.LibraryReference(f"{holder.name}.{name}")
    if isinstance(holder, e.ModuleReference):
        return names.module_member(holder, name)
    return None


def _bases(node: Node) -> Iterator[Node]:
    arguments = node.child_by_field_name("superclasses")
    for argument in named(arguments) if arguments is not None else ():
        if argument.type != "keyword_argument":
            yield argument


def _keywords(node: Node) -> list[Node]:
    arguments = node.child_by_field_name("superclasses")
    found = named(arguments) if arguments is not None else []
    return [a for a in found if a.type == "keyword_argument"]
