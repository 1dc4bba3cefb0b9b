"""Functions of generated Python that have no object: of a module, static, or of a class.

The model has them as methods of each class that calls them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.arguments import in_order
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.named_constants import CodeConstants
from rebsync.reverse.python.generated.names import Helper
from rebsync.reverse.python.generated.pair_methods import is_beside
from rebsync.reverse.python.values.py_worth import Function, Value
from rebsync.reverse.syntax.py_index import FUNCTION, PyParameter, Scope
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import calls_in, field, named, text_of

# What stores in an object by a name that is a value, or replaces a module.
_BY_NAME = re.compile(r"\b(?:setattr|__dict__|vars|globals|reload|sys\.modules)\b")

STATIC, OF_CLASS = "staticmethod", "classmethod"


def arguments_for(
    helper: Helper, reader: ModelExpressionReader, node: Node, arguments: list[Node]
) -> tuple[m.Expression, ...]:
    """The arguments of a call but for the object. Unread: the object is another one."""
    if helper.own:
        if not arguments or text_of(arguments[0]) != reader.own:
            raise reader.unread(node, f'"{helper.name}" is given another object elsewhere')
        arguments = arguments[1:]
    parameters = parameters_of(helper.function, helper.own)
    given = in_order(reader, node, arguments, parameters)
    if len(given) != len(parameters) or any(a.type == "list_splat" for a in given):
        raise reader.unread(node, f'"{helper.name}" is called with other arguments')
    return tuple(map(reader.expression, given))


def first_of(function: Scope) -> int:
    """How many parameters of a method stand for its object or class."""
    return 0 if not function.is_method or STATIC in function.decorators else 1


def parameters_of(function: Scope, own: str = "") -> list[PyParameter]:
    """The parameters of a function of the model, without the object."""
    return function.parameters[1 if own else first_of(function) :]


def own_name(function: Scope) -> str:
    """What the body of a method calls its object; what is no name for one without."""
    if first_of(function) == 0:
        return "\0"
    return function.parameters[0].name if function.parameters else "self"


def without_object(owner: Scope, functions: Mapping[str, Scope]) -> dict[str, Helper]:
    """The static functions of a class, and those of the class, by how they are called."""
    found = {}
    for name, function in functions.items():
        if {STATIC, OF_CLASS} & set(function.decorators):
            for holder in ("self", "cls", owner.name):
                found[f"{holder}.{name}"] = Helper(name, function)
    return found


def called_in(
    constants: CodeConstants, functions: list[Scope], taken: set[str]
) -> dict[str, Helper]:
    """The functions of modules that some functions call, and those that these call.

    What has the name of something in `taken` is left out, and so is what is decorated, and what
    is another function elsewhere.
    """
    found: dict[str, Helper] = {}
    others: set[str] = set()
    waiting = list(functions)
    while waiting:
        function = waiting.pop()
        for call in calls_in(function.node):
            called = field(call, "function")
            name = text_of(called)
            helper = _called(constants, function, called)
            if name in found and helper is not found[name].function:
                others.add(name)
            if helper is None or name in found or not _is_free(helper, found, taken):
                continue
            found[name] = Helper(helper.name, helper, _object(call, helper))
            waiting.append(helper)
    return {name: helper for name, helper in found.items() if name not in others}


def _called(constants: CodeConstants, function: Scope, called: Node) -> Scope | None:
    """The function of a module that a call names, alone or after its module."""
    if called.type not in ("identifier", "attribute"):
        return None
    ways = constants.ways(called, function)
    found = plain_function(ways[0]) if len(ways) == 1 else None
    own = [m for m in constants.code.modules.values() if not is_runtime_file(m.py.source)]
    if called.type == "attribute" and found is not None:
        is_by_name = any(_BY_NAME.search(m.py.source.text) for m in own)
        return None if is_by_name else found
    return found


def plain_function(value: Value | None) -> Scope | None:
    """A function of a module of the package, neither a coroutine nor of the run-time part."""
    match value:
        case Function(scope) if scope.kind == FUNCTION and scope.parent is scope.module:
            is_coroutine = any(c.type == "async" for c in scope.node.children)
            is_plain = not (scope.decorators or is_coroutine or value.bound)
            return scope if is_plain and not is_runtime_file(scope.py.source) else None
        case _:
            return None


def _is_free(helper: Scope, found: Mapping[str, Helper], taken: set[str]) -> bool:
    """Whether a class has nothing else by the name of a function."""
    others = (h.function for h in found.values() if h.name == helper.name)
    is_new = helper.name not in taken and not is_beside(helper)
    return is_new and all(other is helper for other in others)


def _object(call: Node, function: Scope) -> str:
    """What a function calls the object, if that is what it is given first."""
    arguments = named(field(call, "arguments"))
    is_given = bool(arguments) and text_of(arguments[0]) in ("self", "node")
    return function.parameters[0].name if is_given and function.parameters else ""
