"""What the parameters of functions are given by all that calls them."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.python.values.py_evaluator import PyEvaluator, lineage
from rebsync.reverse.python.values.py_worth import Class, Function, Instance, Ways, distinct
from rebsync.reverse.syntax.py_index import LAMBDA, PyParameter, Scope, arguments_of, classes_in
from rebsync.reverse.syntax.py_tree import field, text_of

_MANY = 40
# Of objects with which somebody else makes an object of a class nothing is known.
UNGIVEN = "an argument of a constructor that nothing in these files calls"
_UNCALLED = "an argument of a function that nothing in these files calls"


def argument(values: PyEvaluator, function: Scope, index: int) -> Ways:
    """What a parameter may be worth, by all calls of its function in the files."""
    parameters = function.parameters
    parameter = parameters[index]
    if index == 0 and function.self_name is not None and function.parent is not None:
        return (Instance(function.parent),)
    is_constructor = function.is_method and function.name == "__init__"
    if parameter.star and is_constructor and not callers(values, function):
        return (values.unknown(UNGIVEN, function.node, function),)
    if function.kind == LAMBDA or parameter.star:
        return _default(values, function, parameter, "an argument that a caller gives")
    found: list[Ways] = []
    for call, scope in callers(values, function)[:_MANY]:
        given = _given(call, function, index, parameter)
        if given is not None:
            found.append(values.ways(given, scope))
        elif parameter.default is not None:
            found.append(values.ways(parameter.default, function.parent or function))
        else:
            found.append((values.unknown("an argument that is unpacked", call, scope),))
    if not found:
        return _default(values, function, parameter, UNGIVEN if is_constructor else _UNCALLED)
    return distinct(w for ways in found for w in ways)


def _default(values: PyEvaluator, function: Scope, parameter: PyParameter, why: str) -> Ways:
    if parameter.default is not None:
        return values.ways(parameter.default, function.parent or function)
    return (values.unknown(why, function.node, function),)


def _given(call: Node, function: Scope, index: int, parameter: PyParameter) -> Node | None:
    plain, keywords = arguments_of(call)
    if parameter.name in keywords:
        return keywords[parameter.name]
    if function.self_name is not None and not _names_class(call, function):
        index -= 1
    return plain[index] if 0 <= index < len(plain) else None


def _names_class(call: Node, function: Scope) -> bool:
    """Whether a call names the object itself as its first argument, `Base.__init__(self, x)`."""
    called = field(call, "function")
    if called.type != "attribute" or function.parent is None:
        return False
    plain, _ = arguments_of(call)
    holder = text_of(field(called, "object")).rpartition(".")[2]
    return holder == function.parent.name and bool(plain) and text_of(plain[0]) == "self"


def callers(values: PyEvaluator, function: Scope) -> list[tuple[Node, Scope]]:
    """The calls of a function; of a constructor, those that make objects of the class."""
    if function.is_method and function.name == "__init__" and function.parent is not None:
        return list(_makers(values, function.parent))
    found = []
    for call, scope in values.code.by_callee.get(function.name, []):
        if _calls(values, call, scope, function):
            found.append((call, scope))
    return found


def _calls(values: PyEvaluator, call: Node, scope: Scope, function: Scope) -> bool:
    ways = values.ways(field(call, "function"), scope)
    functions = [w for w in ways if isinstance(w, Function)]
    if functions:
        return any(_runs(values, f.scope, function) for f in functions)
    known = values.code.methods.get(function.name, [])
    is_open = not ways or not any(isinstance(w, (Class, Instance)) for w in ways)
    return is_open and function.is_method and len(known) == 1 and _is_member(call)


def _runs(values: PyEvaluator, called: Scope, function: Scope) -> bool:
    """Whether a call of one function may run another: itself, or one that overrides it."""
    if called is function:
        return True
    if not (called.is_method and function.is_method) or function.parent is None:
        return False
    return called.name == function.name and called.parent in lineage(values, function.parent)


def _is_member(call: Node) -> bool:
    return field(call, "function").type == "attribute"


def _makers(values: PyEvaluator, owner: Scope) -> Iterator[tuple[Node, Scope]]:
    """The calls that run the constructor of a class: its own, and those of classes below it."""
    heirs = [c for c in classes_in(values.code) if owner in lineage(values, c)]
    for name in dict.fromkeys((owner.name, *(h.name for h in heirs))):
        for call, scope in values.code.by_callee.get(name, ()):
            for value in values.ways(field(call, "function"), scope):
                if isinstance(value, Class) and _constructor_of(values, value.scope) is owner:
                    yield call, scope
    for call, scope in values.code.by_callee.get("__init__", ()):
        below = scope.owner
        if below is None or below is owner or below not in heirs or not _is_super(call):
            continue
        above = [c for c in lineage(values, below)[1:] if isinstance(c, Scope)]
        if next((c for c in above if "__init__" in c.names), None) is owner:
            yield call, scope


def _constructor_of(values: PyEvaluator, owner: Scope) -> Scope | None:
    classes = [c for c in lineage(values, owner) if isinstance(c, Scope)]
    return next((c for c in classes if "__init__" in c.names), None)


def _is_super(call: Node) -> bool:
    called = field(call, "function")
    return called.type == "attribute" and text_of(field(called, "object")) != "self"
