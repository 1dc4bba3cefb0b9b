"""What names, attributes and elements stand for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Unresolved
from rebsync.reverse.python.values.py_evaluator import PyEvaluator, each_of, lineage
from rebsync.reverse.python.values.py_guards import together
from rebsync.reverse.python.values.py_imports import imported, star_imported
from rebsync.reverse.python.values.py_records import of_field
from rebsync.reverse.python.values.py_worth import (
    Bound,
    Class,
    Declared,
    EnumMember,
    External,
    Function,
    Instance,
    Items,
    Made,
    Module,
    NoneValue,
    Table,
    Value,
    Ways,
    distinct,
)
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_bindings import Binding, reaching
from rebsync.reverse.syntax.py_index import CLASS, MODULE, Scope
from rebsync.reverse.syntax.py_tree import SCOPES, field, text_of

_ENUMERATIONS = frozenset({"enum.Enum", "enum.Flag"})
_MIXED = frozenset({"builtins.str", "builtins.int", "builtins.float"})
_FIELDS = frozenset({"value", "string_value", "integer_value", "double_value", "bool_value"}) | {
    *("string_array_value", "integer_array_value", "double_array_value", "bool_array_value"),
    "byte_array_value",
}


def followed(values: PyEvaluator, node: Node, scope: Scope) -> Iterable[Value]:
    """What an expression stands for that names something."""
    from rebsync.reverse.python.values.py_results import result

    match node.type:
        case "identifier":
            return name_ways(values, text_of(node), node, scope)
        case "attribute":
            name = text_of(field(node, "attribute"))
            holders = values.ways(field(node, "object"), scope)
            if not holders:
                return [values.unknown(f"nothing is known of `{text_of(node)}`", node, scope)]
            return [w for h in holders for w in attribute(values, h, name, node, scope)]
        case "subscript":
            return _element(values, node, scope)
        case "call":
            return result(values, node, scope)
        case _:
            why = "the value of a condition" if "operator" in node.type else "it is computed"
            return [values.unknown(why, node, scope)]


# --- names --------------------------------------------------------------------------------------


def name_ways(values: PyEvaluator, name: str, node: Node, scope: Scope) -> Ways:
    """What a name stands for at a place: bound here, or in a scope around."""
    at: Scope | None = scope
    while at is not None:
        is_hidden = at.kind == CLASS and at is not scope
        bindings = at.names.get(name, []) if not is_hidden and name not in at.outer else []
        if bindings:
            here = at is scope or _shares_flow(at, scope)
            seen = reaching(bindings, node) if here else bindings
            given = [(b, values.bound(b, name, at)) for b in seen or bindings]
            found = together(values, given, scope)
            if at.kind != MODULE or "*" not in at.names:
                return found
            star = star_imported(values.code, at, name)
            if not isinstance(star, Module):
                return found
            return distinct((*found, *attribute(values, star, name, node, scope)))
        at = at.parent
    star = star_imported(values.code, scope.module, name)
    if star is not None:
        return values_of_import(values, star, name, node, scope)
    if name == "__name__":
        return ("__main__",)
    return (External(f"builtins.{name}"),)


def values_of_import(
    values: PyEvaluator, found: Module | External, name: str, node: Node, scope: Scope
) -> Ways:
    """A name that a star brings from a module."""
    if isinstance(found, External):
        return (found,)
    return tuple(attribute(values, found, name, node, scope))


def _shares_flow(outer: Scope, inner: Scope) -> bool:
    """Whether what is in a scope runs in the order of the text of the one around it."""
    return inner.kind == CLASS and inner.parent is outer


def bound(values: PyEvaluator, binding: Binding, name: str, scope: Scope) -> Ways:
    """What a binding gives."""
    from rebsync.reverse.python.values.py_callers import argument

    match binding.how:
        case "value":
            return _unpacked(
                values, values.ways(binding.value, scope_at(values, binding, scope)), binding, scope
            )
        case "augmented":
            return _augmented(values, binding, scope)
        case "loop":
            inner = scope_at(values, binding, scope)
            rounds = each_of(values, binding.value, inner)
            return distinct(w for ways in rounds for w in _unpacked(values, ways, binding, scope))
        case "scope":
            return _declared(values, binding, scope)
        case "parameter":
            return argument(values, scope, binding.path[0])
        case "import":
            return imported(values, binding, scope)
        case _:
            return (values.unknown("a name that a statement sets", binding.node, scope),)


def scope_at(values: PyEvaluator, binding: Binding, scope: Scope) -> Scope:
    """The scope in which the value of a binding stands: a method may set a global or attribute."""
    above = climb(binding.node, lambda n: n.type in SCOPES)
    if above is None:
        return scope.module
    return values.code.scopes.get((scope.py.source.path, above.id), scope)


def _unpacked(values: PyEvaluator, ways: Ways, binding: Binding, scope: Scope) -> Ways:
    for index in binding.path:
        inner: list[Value] = []
        for value in ways:
            match value:
                case Items(each) if index < len(each):
                    inner += each[index]
                case tuple() if index < len(value):
                    inner.append(value[index])
                case Unresolved(why, place):
                    inner.append(Unresolved(why, place))
                case _:
                    inner.append(
                        values.unknown("a part of what is not known", binding.value, scope)
                    )
        ways = tuple(inner)
    return ways


def _augmented(values: PyEvaluator, binding: Binding, scope: Scope) -> Ways:
    left = values.ways(field(binding.node, "left"), scope_at(values, binding, scope))
    right = values.ways(binding.value, scope_at(values, binding, scope))
    operator = text_of(field(binding.node, "operator")).rstrip("=")
    return distinct(values.operated(operator, left, right, binding.node, scope))


def _declared(values: PyEvaluator, binding: Binding, scope: Scope) -> Ways:
    opened = values.code.scope_of(binding.node, scope.py)
    return (Class(opened),) if opened.kind == CLASS else (Function(opened),)


# --- loops --------------------------------------------------------------------------------------


# --- attributes ---------------------------------------------------------------------------------


def attribute(
    values: PyEvaluator, holder: Value, name: str, node: Node, scope: Scope
) -> Iterator[Value]:
    """What an attribute of something stands for."""
    match holder:
        case External():
            yield External(f"{holder.name}.{name}")
        case Module(inner):
            found = inner.names.get(name)
            if found is None:
                yield values.unknown(f"the module has no `{name}`", node, scope)
            else:
                yield from (w for b in found for w in values.bound(b, name, inner))
        case Instance(owner) if (given := of_field(values, holder, name)) is not None:
            yield from given
        case Class(owner) | Instance(owner):
            yield from _member(values, owner, isinstance(holder, Instance), name, node, scope)
        case Declared(value):
            yield value if name in _FIELDS else Bound(holder, name)
        case EnumMember(_, own, value) if name in ("value", "name"):
            yield from value if name == "value" else (own,)
        case Made() | Function():
            stored = scope.stores.get((text_of(field(node, "object")), name), [])
            seen = reaching(stored, node)
            if seen:
                yield from (w for b in seen for w in values.bound(b, name, scope))
            elif isinstance(holder, Made):
                yield Bound(holder, name)
        case Unresolved():
            yield holder if holder.partial is None else Unresolved(holder.why, holder.place)
        case FromParameter() | str() | Items() | Table() | tuple():
            yield Bound(holder, name)
        case NoneValue():
            return
        case _:
            yield values.unknown(f"`{text_of(node)}` is not followed", node, scope)


def _member(
    values: PyEvaluator, owner: Scope, is_object: bool, name: str, node: Node, scope: Scope
) -> Iterator[Value]:
    """An attribute of a class of the files, or of those above it."""
    externals = False
    for above in lineage(values, owner):
        if not isinstance(above, Scope):
            externals = True
            continue
        set_ = above.attributes.get(name, [])
        declared = above.names.get(name, [])
        if not set_ and not declared:
            continue
        seen = _seen(values, [*declared, *set_], node, above, scope)
        given = [(binding, values.bound(binding, name, above)) for binding in seen]
        if not is_object and len(given) == 1 and is_enumeration(values, owner):
            yield _enum_member(values, above, name, given[0])
            return
        for value in together(values, given, scope):
            yield from _as_member(values, value, owner, is_object)
        return
    if externals and is_object:
        yield Bound(Instance(owner), name)
    else:
        yield values.unknown(f"nothing in these files sets `{text_of(node)}`", node, scope)


def is_enumeration(values: PyEvaluator, owner: Scope) -> bool:
    """Whether members of a class are none of the values that it binds: not as in an `IntEnum`."""
    above = {each.name for each in lineage(values, owner) if isinstance(each, External)}
    return bool(above & _ENUMERATIONS) and not above & _MIXED


def _enum_member(
    values: PyEvaluator, owner: Scope, name: str, given: tuple[Binding, Ways]
) -> Value:
    """A member; what is no value, such as a method, is itself."""
    binding, ways = given
    if binding.how != "value":
        return ways[0] if len(ways) == 1 else values.unknown("it is several", binding.node, owner)
    same = (n for n, b in owner.names.items() if len(b) == 1 and _is_plain_value(b[0]))
    first = next((n for n in same if values.bound(owner.names[n][0], n, owner) == ways), name)
    return EnumMember(owner, first, ways)


def _is_plain_value(binding: Binding) -> bool:
    """Whether a member has a value that is known to be that of another one where it is equal."""
    kinds = ("integer", "float", "string", "true", "false")
    return binding.how == "value" and binding.value.type in kinds


def _seen(
    values: PyEvaluator, bindings: Sequence[Binding], node: Node, owner: Scope, scope: Scope
) -> Sequence[Binding]:
    """The bindings of an attribute that a use may see: those of its own function first."""
    method = scope.method
    if method is None or method is not scope or method.parent is not owner:
        return bindings
    here = [b for b in bindings if scope_at(values, b, owner) is scope]
    before = reaching(here, node)
    elsewhere = [b for b in bindings if b not in here]
    if before and (method.name == "__init__" or len(before) == 1) and _is_sure(before, here, node):
        return before
    if method.name == "__init__" and not elsewhere:
        return before or here
    # What the function sets later it finds when it is called again.
    again = [b for b in here if b not in before] if method.name != "__init__" else []
    return [*before, *again, *elsewhere] or bindings


def _is_sure(before: Sequence[Binding], here: Sequence[Binding], node: Node) -> bool:
    """Whether the first of some bindings always runs before a use."""
    return bool(before) and reaching([before[0]], node) == [before[0]] and before[0] in here


def _as_member(values: PyEvaluator, value: Value, owner: Scope, is_object: bool) -> Iterator[Value]:
    """A function of a class as the method of an object; a property as what it gives."""
    from rebsync.reverse.python.values.py_results import returned

    if isinstance(value, Function) and is_object and value.scope.is_method:
        if "property" in value.scope.decorators:
            yield from returned(values, value.scope)
        else:
            yield Function(value.scope, owner, value.bound)
    else:
        yield value


# --- elements -----------------------------------------------------------------------------------


def _element(values: PyEvaluator, node: Node, scope: Scope) -> Iterator[Value]:
    keys = values.ways(field(node, "subscript"), scope)
    for holder in values.ways(field(node, "value"), scope):
        match holder, keys:
            case Items(each), (int() as index,) if -len(each) <= index < len(each):
                yield from each[index]
            case tuple(), (int() as index,) if -len(holder) <= index < len(holder):
                yield holder[index]
            case Table(pairs), (int() | float() | str(),):
                found = [w for k, ways in pairs if keys[0] in k for w in ways]
                yield from found or [values.unknown("no such key", node, scope)]
            case Table(pairs), _:
                yield from (w for _, ways in pairs for w in ways)
            case FromParameter(name=str() as name), (str() as key,):
                yield FromParameter(f"{name}/{key}")
            case External(name="sys.argv"), _:
                yield values.unknown("an argument of the program", node, scope)
            case Unresolved(), _:
                yield Unresolved(holder.why, holder.place)
            case _:
                yield values.unknown("an element of what is not known", node, scope)
