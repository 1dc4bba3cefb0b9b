"""The types that values of the model have in generated Python, for analyses of the form.

The form knows by what is stored which type a value is of. What the run-time part gives is not in
it: arrays, numbers that are cut, parameters. The model has a type for each of these.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from rebsync import model as m
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Class, Function, Parameter, Program
from rebsync.reverse.python.generated.py_types import type_of
from rebsync.reverse.python.generated.roles import PyRoles
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

_NUMBERS: Mapping[str, t.Type] = {
    **{"byte": t.Integer(8), "short": t.Integer(16), "int": t.Integer(32)},
    **{"float": t.Float(32), "double": t.Float(64), "boolean": t.Truth()},
}


def typed(program: Program, roles: Iterable[PyRoles]) -> Program:
    """A program with the types of attributes and parameters of the classes of a model."""
    of_class = {name_in_form(each.owner): dict(_attributes(each)) for each in roles}
    of_function = {
        f"{name_in_form(each.owner)}.{name}": dict(_parameters(function))
        for each in roles
        for name, function in each.functions.items()
        if not each.is_plumbing(name)  # what people added may be called with anything
    }

    def lowered(name: str) -> Function:
        function = program.function(name)
        types = of_function.get(name)
        if types is None:
            return function
        parameters = tuple(_with_type(p, types) for p in function.parameters)
        return replace(function, parameters=parameters)

    classes = [_with_types(c, of_class.get(c.name, {})) for c in program.classes.values()]
    return Program(program.functions, classes, lowered, program.modules.items(), program.globals)


def name_in_form(owner: Scope) -> str:
    """The name of a class in the form."""
    return f"{owner.py.source.path}:{owner.name}"


def _attributes(roles: PyRoles) -> Iterator[tuple[str, t.Type]]:
    variables = {
        name: type_ for of in (roles.state, roles.known) for name, (_, type_, _) in of.items()
    }
    constants = {name: use.type for name, use in roles.env.items()}
    for name, type_ in (*variables.items(), *constants.items()):
        yield name, _of_model(type_)


def _parameters(function: Scope) -> Iterator[tuple[str, t.Type]]:
    """The parameters of a function with types that the model has."""
    for node in named(field(function.node, "parameters")):
        type_ = type_of(node.child_by_field_name("type"))
        if type_ is not None and named(node):
            name = node.child_by_field_name("name") or named(node)[0]
            yield text_of(name), _of_model(type_)


def _of_model(type_: m.Type) -> t.Type:
    """A type of the model: rebecs are told by their names, which are texts."""
    found = _NUMBERS.get(type_.name, t.Text() if type_.name != "void" else t.UNKNOWN)
    for length in reversed(type_.dimensions):
        found = t.Array(found, length)
    return found


def _with_type(parameter: Parameter, types: Mapping[str, t.Type]) -> Parameter:
    return replace(parameter, type=types.get(parameter.name, parameter.type))


def _with_types(class_: Class, types: Mapping[str, t.Type]) -> Class:
    fields = (replace(f, type=types.get(f.name, f.type)) for f in class_.fields)
    return replace(class_, fields=tuple(fields)) if types else class_
