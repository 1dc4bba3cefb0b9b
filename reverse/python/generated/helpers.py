"""Functions of generated Python that have no object: of a module, static, or of a class.

The model has them as methods of each class that calls them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.idioms import in_order
from rebsync.reverse.python.generated.names import Helper
from rebsync.reverse.python.generated.plain_functions import function_named, is_runtime
from rebsync.reverse.syntax.py_index import (
    PyCode,
    PyParameter,
    Scope,
    module_named,
    module_of,
)
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
    names = tuple(p.name for p in parameters_of(helper.function, helper.own))
    given = in_order(reader, node, arguments, names)
    if len(given) != len(names) or any(a.type == "list_splat" for a in given):
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


def called_in(code: PyCode, functions: list[Scope], taken: set[str]) -> dict[str, Helper]:
    """The functions of modules that some functions call, and those that these call.

    What has the name of something in `taken` is left out, and so is what is decorated.
    """
    found: dict[str, Helper] = {}
    waiting = list(functions)
    while waiting:
        function = waiting.pop()
        for call in calls_in(function.node):
            called = field(call, "function")
            name = text_of(called)
            if name in found or name in taken:
                continue
            helper = _called(code, function, called)
            if helper is None or not _is_free(helper, found, taken):
                continue
            found[name] = Helper(helper.name, helper, _object(call, helper))
            waiting.append(helper)
    return found


def _called(code: PyCode, function: Scope, called: Node) -> Scope | None:
    """The function that a call names, alone or after its module."""
    if called.type == "identifier":
        name = text_of(called)
        return function_named(code, function.module, name) if name not in function.names else None
    holder = field(called, "object") if called.type == "attribute" else called
    if holder.type != "identifier" or text_of(holder) in function.names:
        return None
    name, module = text_of(field(called, "attribute")), _module(code, function, text_of(holder))
    if module is None or is_runtime(module):
        return None
    if _may_be_replaced(code, name):
        return None
    return function_named(code, module, name)


def _may_be_replaced(code: PyCode, name: str) -> bool:
    """Whether somebody may store another function under a name of a module."""
    own = [m for m in code.modules.values() if not is_runtime_file(m.py.source)]
    stores = (key for scope in (*own, *code.scopes.values()) for key in scope.stores)
    by_name = any(_BY_NAME.search(module.py.source.text) for module in own)
    return by_name or any(stored == name for _, stored in stores)


def _module(code: PyCode, function: Scope, name: str) -> Scope | None:
    """The module of the package that a name is bound to by the only import of it."""
    bindings = function.module.names.get(name, [])
    item = bindings[0].value if len(bindings) == 1 and bindings[0].how == "import" else None
    if item is None:
        return None
    statement = bindings[0].node
    is_alias = item.type == "aliased_import"
    wanted = text_of(field(item, "name") if is_alias else item)
    if statement.type == "import_statement":
        return module_named(code, wanted, function.module) if is_alias else None
    source = module_of(statement)
    package = module_named(code, source, function.module)
    if package is not None and wanted in package.names:
        return None
    return module_named(code, f"{source.rstrip('.')}.{wanted}", function.module)


def _is_free(helper: Scope, found: Mapping[str, Helper], taken: set[str]) -> bool:
    """Whether a class has nothing else by the name of a function."""
    others = (h.function for h in found.values() if h.name == helper.name)
    return helper.name not in taken and all(other is helper for other in others)


def _object(call: Node, function: Scope) -> str:
    """What a function calls the object, if that is what it is given first."""
    arguments = named(field(call, "arguments"))
    is_given = bool(arguments) and text_of(arguments[0]) in ("self", "node")
    return function.parameters[0].name if is_given and function.parameters else ""
