"""What calls give: of functions of the files, of the client libraries, and of Python's own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Access, Kind
from rebsync.reverse.python.values.py_evaluator import PyEvaluator, each_of, lineage
from rebsync.reverse.python.values.py_records import next_number
from rebsync.reverse.python.values.py_texts import filled
from rebsync.reverse.python.values.py_worth import (
    Bound,
    Class,
    Declared,
    Duration,
    External,
    Function,
    Instance,
    Items,
    Made,
    NoneValue,
    Table,
    Value,
    Ways,
    distinct,
    resolved,
)
from rebsync.reverse.syntax.py_index import CLASS, LAMBDA, Scope, arguments_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

_SAME = frozenset({"str", "int", "float", "bool", "list", "tuple", "unicode", "sorted", "set"})
_PARTIAL = frozenset({"functools.partial", "partial"})


def result(values: PyEvaluator, call: Node, scope: Scope) -> Iterable[Value]:
    """What a call gives."""
    called = values.ways(field(call, "function"), scope)
    if not called:
        return [values.unknown(f"nothing is known of `{_shown(call)}`", call, scope)]
    return [w for value in called for w in _of(values, value, call, scope)]


def _shown(call: Node) -> str:
    return text_of(field(call, "function"))


def _of(values: PyEvaluator, called: Value, call: Node, scope: Scope) -> Iterable[Value]:
    match called:
        case Class(owner):
            return [Instance(owner, (call, scope))]
        case Function(inner):
            return returned(values, inner)
        case External(name):
            return _external(values, name, call, scope)
        case Bound(holder, name):
            return _method(values, holder, name, call, scope)
        case Unresolved():
            return [Unresolved(called.why, called.place)]
        case _:
            return [values.unknown(f"what `{_shown(call)}` gives", call, scope)]


def returned(values: PyEvaluator, function: Scope) -> Ways:
    """What a function of the files gives."""
    if function.kind == LAMBDA:
        return values.ways(field(function.node, "body"), function)
    found: list[Value] = []
    for node in function.returns:
        inner = named(node)
        found += values.ways(inner[0], function) if inner else [NoneValue()]
    return distinct(found) or (NoneValue(),)


# --- what is not in the files -------------------------------------------------------------------


def _external(values: PyEvaluator, name: str, call: Node, scope: Scope) -> Iterable[Value]:
    plain, keywords = arguments_of(call)
    last = name.rpartition(".")[2]
    if name.startswith("builtins."):
        return _builtin(values, last, plain, call, scope)
    if name in libraries.own_names():
        return [libraries.own_names()[name]]
    if name == "enum.auto" and scope.kind == CLASS:
        return [next_number(values, call, scope)]
    if name in _PARTIAL:
        return _partial(values, plain, scope)
    kind = libraries.kind_of(name)
    if kind is Kind.SPAN:
        return [_length(values, plain, keywords, call, scope)]
    if _gives_parameter(name):
        return [_parameter(values, plain, keywords, call, scope)]
    if kind is Kind.RESOLVE and plain:
        return values.ways(plain[0], scope)
    if name == "os.path.join" or name.endswith("os.path.join"):
        parts = [values.ways(p, scope) for p in plain]
        slashed = [w for p in parts for w in (p, ("/",))][:-1]
        return values.join(slashed, call, scope)
    if libraries.is_of_client(name):
        return [Made(name, call, scope)]
    return [Made(name, call, scope)] if last[:1].isupper() else [_what(values, name, call, scope)]


def _gives_parameter(name: str) -> bool:
    """Whether a function gives the value of a parameter."""
    found = libraries.function(name)
    is_read = found is not None and found.access is Access.GET
    return found is not None and found.kind is Kind.PARAMETER and is_read


def _what(values: PyEvaluator, name: str, call: Node, scope: Scope) -> Unresolved:
    return values.unknown(f"what `{name}` gives", call, scope)


def _builtin(
    values: PyEvaluator, name: str, plain: list[Node], call: Node, scope: Scope
) -> Iterable[Value]:
    if name in _SAME and len(plain) == 1:
        return [_cast(name, v) for v in values.ways(plain[0], scope)]
    if name == "type" and len(plain) == 1:
        return [_class_of(values, v, call, scope) for v in values.ways(plain[0], scope)]
    if name == "super":
        owner = scope.owner
        return [values.unknown("super", call, scope)] if owner is None else _above(values, owner)
    if name == "range" and plain:
        return _range(values, plain, call, scope)
    if name == "enumerate" and plain:
        rounds = each_of(values, plain[0], scope)
        return [Items(tuple((Items(((i,), w)),) for i, w in enumerate(rounds)))]
    if name == "zip" and plain:
        columns = [each_of(values, p, scope) for p in plain]
        return [Items(tuple((Items(row),) for row in zip(*columns, strict=False)))]
    if name == "getattr" and len(plain) > 1:
        return [values.unknown("an attribute whose name is computed", call, scope)]
    if name == "dict" and not plain:
        _, keywords = arguments_of(call)
        return [Table(tuple(((k,), values.ways(v, scope)) for k, v in keywords.items()))]
    return [_what(values, name, call, scope)]


def _class_of(values: PyEvaluator, value: Value, call: Node, scope: Scope) -> Value:
    """What `type(...)` gives of an object."""
    match value:
        case Instance(owner):
            return Class(owner)
        case Made(name) if name.rpartition(".")[2][:1].isupper():
            return External(name)
        case Unresolved():
            return value
        case _:
            return _what(values, "type", call, scope)


def _above(values: PyEvaluator, owner: Scope) -> list[Value]:
    """The object as one of the class above its own."""
    above = lineage(values, owner)[1:2]
    if above and isinstance(above[0], Scope):
        return [Instance(above[0])]
    return [Bound(Instance(owner), "super")]


def _cast(name: str, value: Value) -> Value:
    match value:
        case bool() | int() | float() if name == "str":
            return str(value)
        case bool() | int() | float() if name == "bool":
            return bool(value)
        case bool() | int() | float() | str() if name in ("int", "float"):
            try:
                return int(value) if name == "int" else float(value)
            except (ValueError, OverflowError):
                return value  # nobody gets it: this raises
        case _:
            return value


def _range(values: PyEvaluator, plain: list[Node], call: Node, scope: Scope) -> list[Value]:
    bounds = [values.ways(p, scope) for p in plain]
    numbers = [b[0] for b in bounds if len(b) == 1 and isinstance(b[0], int)]
    whole = [n for n in numbers if isinstance(n, int)]
    if len(whole) != len(plain) or (len(whole) == 3 and not whole[2]):
        return [values.unknown("a range whose ends are not known", call, scope)]
    found = range(*whole)
    if len(found) > 64:
        return [values.unknown("a long range", call, scope)]
    return [Items(tuple((i,) for i in found))]


def _partial(values: PyEvaluator, plain: list[Node], scope: Scope) -> Iterator[Value]:
    for value in values.ways(plain[0], scope) if plain else ():
        if isinstance(value, Function):
            yield Function(value.scope, value.owner, (*plain[1:], *value.bound))
        else:
            yield value


def _length(
    values: PyEvaluator,
    plain: list[Node],
    keywords: dict[str, Node],
    call: Node,
    scope: Scope,
) -> Value:
    """A span of time, from seconds and nanoseconds."""
    parts = dict(zip(("secs", "nsecs"), plain, strict=False)) | keywords
    seconds = parts.get("secs", parts.get("seconds"))
    nanoseconds = parts.get("nsecs", parts.get("nanoseconds"))
    total = values.value(seconds, scope) if seconds is not None else 0
    if nanoseconds is None:
        return Duration(total)
    more = values.value(nanoseconds, scope)
    if isinstance(total, (int, float)) and isinstance(more, (int, float)):
        return Duration(total + more / 1e9)
    return values.unknown("a time that is computed", call, scope)


def _parameter(
    values: PyEvaluator, plain: list[Node], keywords: dict[str, Node], call: Node, scope: Scope
) -> Value:
    """The value of a parameter of ROS 1, with the default that stands in for it."""
    given = dict(zip(("param_name", "default"), plain, strict=False)) | keywords
    if "param_name" not in given:
        return values.unknown("the name of a parameter", call, scope)
    default = values.ways(given["default"], scope) if "default" in given else ()
    known = [v for v in default if not isinstance(v, NoneValue)]
    unknown = values.unknown("a default that is computed", call, scope)
    stands_in = resolved(tuple(known), unknown) if known else None
    return FromParameter(values.value(given["param_name"], scope), stands_in)


# --- methods ------------------------------------------------------------------------------------


def _method(
    values: PyEvaluator, holder: Value, name: str, call: Node, scope: Scope
) -> Iterable[Value]:
    match holder:
        case str():
            return _text_method(values, holder, name, call, scope)
        case Table(pairs):
            return _table_method(values, pairs, name, call, scope)
        case FromParameter():
            if name in ("keys", "items", "values", "split"):
                why = f"the parts of the parameter {holder.name}"
                return [values.unknown(why, call, scope)]
            same = name in ("strip", "lstrip", "rstrip", "lower", "upper")
            return [holder] if same else [_what(values, name, call, scope)]
        case Declared() if name in libraries.methods_of(Kind.VALUE, Kind.CLOCK):
            return [holder]
        case Instance() | Made():
            return _object_method(values, holder, name, call, scope)
        case _:
            return [_what(values, name, call, scope)]


def _text_method(
    values: PyEvaluator, text: str, name: str, call: Node, scope: Scope
) -> Iterable[Value]:
    if name == "format":
        return filled(values, text, call, scope)
    plain, _ = arguments_of(call)
    simple = {"strip": text.strip, "lower": text.lower, "upper": text.upper}
    if name in simple and not plain:
        return [simple[name]()]
    given = [values.text(p, scope) for p in plain]
    known = [g for g in given if g is not None]
    if len(known) == len(given):
        if name in ("strip", "lstrip", "rstrip") and len(known) == 1:
            return [str(getattr(text, name)(known[0]))]
        if name == "replace" and len(known) == 2:
            return [text.replace(known[0], known[1])]
    if name == "join" and len(plain) == 1:
        rounds = each_of(values, plain[0], scope)
        parts = [w for r in rounds for w in ((text,), r)][1:]
        return values.join(parts, call, scope)
    return [_what(values, name, call, scope)]


def _table_method(
    values: PyEvaluator, pairs: tuple[tuple[Ways, Ways], ...], name: str, call: Node, scope: Scope
) -> Iterable[Value]:
    match name:
        case "items" | "iteritems":
            return [Items(tuple((Items((k, v)),) for k, v in pairs))]
        case "keys" | "iterkeys":
            return [Items(tuple(k for k, _ in pairs))]
        case "values" | "itervalues":
            return [Items(tuple(v for _, v in pairs))]
        case "get":
            plain, _ = arguments_of(call)
            key = values.ways(plain[0], scope) if plain else ()
            found = [w for k, ways in pairs if k == key for w in ways]
            rest = values.ways(plain[1], scope) if len(plain) > 1 else ()
            return found or [*(w for _, ways in pairs for w in ways), *rest]
        case _:
            return [_what(values, name, call, scope)]


def _object_method(
    values: PyEvaluator, holder: Instance | Made, name: str, call: Node, scope: Scope
) -> Iterable[Value]:
    """Methods of nodes, whose own names and parameters matter."""
    plain, keywords = arguments_of(call)
    if name in libraries.own_name_methods():
        return [libraries.own_name_methods()[name]]
    if name in libraries.parameter_methods() and (plain or keywords):
        named_ = plain[0] if plain else keywords.get("name")
        if named_ is None:
            return [values.unknown("the name of a parameter", call, scope)]
        given = plain[1] if len(plain) > 1 else keywords.get("value")
        return [Declared(_declared(values, name, named_, given, scope))]
    if name in libraries.methods_of(Kind.VALUE, Kind.CLOCK):
        return [holder]
    return [Made(f"{_made_by(holder)}.{name}", call, scope)]


def _made_by(holder: Instance | Made) -> str:
    return holder.by if isinstance(holder, Made) else libraries.node_class()


def _declared(
    values: PyEvaluator, method: str, named_: Node, given: Node | None, scope: Scope
) -> FromParameter:
    """A parameter of ROS 2, whose default is where it is declared."""
    name = values.value(named_, scope)
    default = given if method in libraries.declaring() else declared_default(values, name)
    if default is None:
        return FromParameter(name)
    found = default if isinstance(default, Node) else default[0]
    where = scope if isinstance(default, Node) else default[1]
    known = [v for v in values.ways(found, where) if not isinstance(v, (NoneValue, External))]
    unknown = values.unknown("a default that is computed", found, where)
    return FromParameter(name, resolved(tuple(known), unknown) if known else None)


def declared_default(values: PyEvaluator, name: object) -> tuple[Node, Scope] | None:
    """The default with which the files declare a parameter, if they do so once."""
    found = []
    calls = values.code.by_callee
    for call, scope in (c for n in sorted(libraries.declaring()) for c in calls.get(n, [])):
        plain, keywords = arguments_of(call)
        first = plain[0] if plain else keywords.get("name")
        second = plain[1] if len(plain) > 1 else keywords.get("value")
        if first is not None and second is not None and values.text(first, scope) == name:
            found.append((second, scope))
    for call, scope in (c for n in libraries.methods_of(Kind.DECLARED) for c in calls.get(n, [])):
        found += [(v, scope) for n, v in declared_together(values, call, scope) if n == name]
    return found[0] if len(found) == 1 else None


def declared_together(
    values: PyEvaluator, call: Node, scope: Scope
) -> Iterator[tuple[str | None, Node]]:
    """The names and defaults of parameters that are declared in one list."""
    plain, keywords = arguments_of(call)
    given = dict(zip(("namespace", "parameters"), plain, strict=False)) | keywords
    space = values.text(given["namespace"], scope) if "namespace" in given else ""
    items = given.get("parameters")
    for item in named(items) if items is not None and items.type in ("list", "tuple") else []:
        parts = named(item) if item.type in ("tuple", "list") else []
        if len(parts) > 1:
            name = values.text(parts[0], scope)
            yield (f"{space}.{name}" if space and name else name), parts[1]
