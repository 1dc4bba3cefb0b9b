"""What Python writes for classes: constructors that fill fields, numbers of enumerations."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.python.values.py_evaluator import PyEvaluator, lineage
from rebsync.reverse.python.values.py_worth import External, Instance, Value, Ways
from rebsync.reverse.syntax.py_index import Scope, arguments_of, has_splat
from rebsync.reverse.syntax.py_tree import field, named, text_of

_TUPLE = "typing.NamedTuple"
# Those above a class that take no argument of its constructor.
_PLAIN = frozenset({"builtins.object", "abc.ABC", "typing.Generic", _TUPLE})
_CONSTRUCTORS = frozenset({"__init__", "__new__"})
_COUNTED = frozenset({"enum.Enum", "enum.IntEnum"})


def of_field(values: PyEvaluator, holder: Instance, name: str) -> Ways | None:
    """What a field of an object holds that is filled by a constructor nobody wrote.

    None if there is no such field, so that it holds what its class binds.
    """
    line = lineage(values, holder.scope)
    owners = [each for each in line if isinstance(each, Scope)]
    above = {each.name for each in line if isinstance(each, External)}
    is_made = _TUPLE in above or any(owner.decorators for owner in owners)
    if not is_made or any(_CONSTRUCTORS & owner.names.keys() for owner in owners):
        return None
    fields = {text_of(field(n, "left")): n for o in reversed(owners) for n in _fields(o)}
    if name not in fields:
        return None
    owner = next(o for o in owners if name in map(_name, _fields(o)))
    unknown = (values.unknown("what an object is made of", fields[name], owner),)
    is_filled = any("__post_init__" in o.names for o in owners)
    if holder.made is None or is_filled or not above <= _PLAIN or has_splat(holder.made[0]):
        return unknown
    is_steady = _TUPLE in above or all("frozen=True" in d for o in owners for d in o.decorators)
    if not is_steady and (values.is_stored(name) or name in owner.attributes):
        return unknown
    call, scope = holder.made
    plain, keywords = arguments_of(call)
    given = dict(zip(fields, plain, strict=False)) | keywords
    default = fields[name].child_by_field_name("right")
    if any("init=" in text_of(n) for n in fields.values()):  # which are not given in this order
        return unknown
    if name in given:
        return values.ways(given[name], scope)
    return values.ways(default, owner) if default is not None else unknown


def _fields(owner: Scope) -> Iterator[Node]:
    """The statements of a class that say of which type a field is."""
    for statement in named(field(owner.node, "body")):
        inner = named(statement)[0] if statement.type == "expression_statement" else statement
        said = inner.child_by_field_name("type") if inner.type == "assignment" else None
        if said is not None and "ClassVar" not in text_of(said):
            yield inner


def _name(declaration: Node) -> str:
    return text_of(field(declaration, "left"))


def next_number(values: PyEvaluator, call: Node, owner: Scope) -> Value:
    """What `auto()` gives in an enumeration: one more than the greatest before it, if that is the
    last, as versions of Python differ otherwise."""
    line = lineage(values, owner)
    above = {each.name for each in line if isinstance(each, External)}
    bindings = [(n, b) for n, of in owner.names.items() for b in of if b.how != "scope"]
    before = [(n, b) for n, b in bindings if b.node.end_byte < call.start_byte]
    ways = [values.bound(b, n, owner) for n, b in before]
    numbers = [w[0] for w in ways if len(w) == 1 and isinstance(w[0], int)]
    is_plain = len(line) == 2 and above <= _COUNTED and not any(n[0] == "_" for n in owner.names)
    is_known = len(numbers) == len(before) and all(type(n) is int for n in numbers)
    if not (is_plain and is_known and all(n <= numbers[-1] for n in numbers)):
        return values.unknown("a number of an enumeration", call, owner)
    return numbers[-1] + 1 if numbers else 1
