"""Free functions that bodies of a class call: local methods of the model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from rebsync.reserved import RUNTIME_FUNCTIONS
from rebsync.reverse.bodies.types.cpp_types import type_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction

_NONE: Mapping[str, CppFunction] = MappingProxyType({})
_OPTIONAL = "optional_parameter_declaration"
_LIBRARIES = frozenset({"std", "ros", "rclcpp", "boost", "tf2", "Eigen"})


def free_functions(
    code: Code, bodies: Iterable[CppFunction], helpers: Mapping[str, CppFunction] = _NONE
) -> Iterator[CppFunction]:
    """Those that these functions call, and those that these call, with types of the model.

    `helpers` are further functions that are called by their names alone. Not where there are
    several of a name: which one is meant depends on the types.
    """
    seen: set[str] = set()
    waiting = list(bodies)
    while waiting:
        for call in code.calls_of(waiting.pop(0)):
            space, _, name = call.name.rpartition("::")
            found = [helpers[name]] if name in helpers else code.definitions.get(("", name), [])
            if call.target is not None or name in seen or len(found) != 1:
                continue
            (function,) = found
            is_library = space.partition("::")[0] in _LIBRARIES
            if name not in RUNTIME_FUNCTIONS and not is_library and is_method(function):
                seen.add(name)
                waiting.append(function)
                yield function


def free_beside(
    code: Code, owner: CppClass, helpers: Mapping[str, CppFunction] = _NONE
) -> list[CppFunction]:
    """The free functions that the functions of a class call, not those of its ancestors."""
    above = [f for c in code.lineage(owner.name)[1:] for f in code.functions_of(c)]
    known = {f.name for f in free_functions(code, above, helpers)}
    known |= {f.name for c in code.lineage(owner.name) for f in c.functions}
    own = free_functions(code, code.functions_of(owner), helpers)
    return [f for f in own if f.name not in known]


def is_method(function: CppFunction) -> bool:
    """Whether a function can be a local method of the model: one is given all that it takes."""
    is_whole = all(p.node.type != _OPTIONAL for p in function.parameters)
    is_whole = is_whole and not (is_template(function) or function.gives_place)
    return is_whole and has_plain_types(function) and not list(passed_by_reference(function))


def is_template(function: CppFunction) -> bool:
    """Whether there is a function for each of several types, or numbers."""
    return function.node.parent is not None and function.node.parent.type == "template_declaration"


def has_plain_types(function: CppFunction) -> bool:
    """Whether parameters and result are of types of the model."""
    typed = all(type_of(p.type) is not None for p in function.parameters)
    return function.result is not None and type_of(function.result) is not None and typed


def passed_by_reference(function: CppFunction) -> Iterator[int]:
    """The parameters of which a function gets the caller's own variable, by their positions."""
    for index, parameter in enumerate(function.parameters):
        declarator = parameter.node.child_by_field_name("declarator")
        constant = any(
            c.type == "type_qualifier" and c.text == b"const" for c in parameter.node.named_children
        )
        kind = declarator.type if declarator is not None else ""
        if kind.startswith("abstract_"):
            kind = kind.removeprefix("abstract_")
        if kind == "pointer_declarator" or (kind == "reference_declarator" and not constant):
            yield index
