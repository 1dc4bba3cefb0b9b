"""The parameters of a node that generated code reads: what a variable or an argument is given.

A value is that of a parameter only where the code does nothing else with it: what is computed from
it, or read by another node handle, is none that the model knows.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.generated.env_values import constant
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

DECLARES = "declare_parameter"
# Its arguments but for `ignore_override`, by which nobody else gives the parameter a value.
MOST_DECLARED = 3
READS = frozenset({"param", DECLARES, "declareArray"})
_HINT = "compute with it in the model's constructor"
_TELLS = frozenset({"described"})  # what stands in the arguments, but for values
_SMALL = frozenset({"char", "float", "int8_t", "int16_t", "short", "uint8_t", "uint16_t"})
_KINDS = {
    **dict.fromkeys(("int", "int32_t", "int64_t", "long", *_SMALL - {"float"}), int),
    **{"bool": bool, "double": float, "float": float},
}
_CONVERTS = frozenset({"static_cast", "narrow"})


def read_by(value: Node | None, type_: str, converts: bool = False) -> CppCall | None:
    """The call that gives a value which is no more than a parameter, converted to its own type."""
    if value is None:
        return None
    call = call_of(value)
    if call is not None and call.name in READS:
        asked = all(c.name in _TELLS for a in call.arguments for c in calls_in(a))
        is_given = call.name != DECLARES or len(call.arguments) <= MOST_DECLARED
        fits = _fits(call, _plain(type_)) and (converts or _plain(type_) not in _SMALL)
        return call if asked and is_given and fits else None
    if value.type in ("parenthesized_expression", "initializer_list") and len(named(value)) == 1:
        return read_by(named(value)[0], type_, converts)
    if call is not None and call.name in _CONVERTS and len(call.arguments) == 1:
        return read_by(call.arguments[0], type_, True) if _is_to(call, type_) else None
    return None


def _fits(call: CppCall, type_: str) -> bool:
    """Whether a parameter is asked for as what a type holds: others are not given, or rounded.

    Without a type a client library asks for that of what stands in for the value.
    """
    if call.types or type_ not in _KINDS:
        asked = _plain(text_of(call.types[0])) if call.types else type_
        return type_ not in _KINDS or _KINDS.get(asked) is _KINDS[type_]
    return any(_kind_of(each) is _KINDS[type_] for each in call.arguments[1:2])


def _kind_of(value: Node) -> type | None:
    """The kind of a constant, or of one that the file names so."""
    for node in inside([value, *ancestors(value)][-1], "declaration"):
        made = node.child_by_field_name("declarator")
        if made is not None and text_of(made).partition("=")[0].strip() == text_of(value):
            return _KINDS.get(_plain(text_of(part(node, "type"))))
    return type(constant(value))


def _is_to(call: CppCall, type_: str) -> bool:
    return [_plain(text_of(t)) for t in call.types] == [_plain(type_)]


def _plain(type_: str) -> str:
    return type_.removeprefix("const ").replace("std::", "").strip()


def objects_in(main: CppFunction) -> Iterator[tuple[str, list[Node]]]:
    """The objects that a program's `main` makes, each by its type with what it is made of."""
    for statement in named(main.body) if main.body is not None else []:
        declarator = statement.child_by_field_name("declarator")
        if statement.type != "declaration" or declarator is None:
            continue
        value = declarator.child_by_field_name("value")
        if value is not None or declarator.type == "function_declarator":  # as `C c(node)` parses
            yield text_of(part(statement, "type")), named(value) if value is not None else []


def odd_arguments(code: Code, main: CppFunction, made: Collection[str]) -> Iterator[Finding]:
    """What a program gives the constructors of classes beside the node's handle and parameters."""
    for type_, values in objects_in(main):
        name = type_.rpartition("::")[2]
        if name not in made:
            continue
        own = [f for f in code.functions_of(code.classes[name]) if f.name == name]
        taken = [f.parameters for f in own if len(f.parameters) == len(values)]
        for index, value in enumerate(values[1:], 1):
            types = [text_of(parameters[index].type) for parameters in taken]
            reads = [read_by(value, type_) for type_ in types or [""]]
            if not any(read is not None and read.on == "node" for read in reads):
                span, why = main.cpp.span(value), "this is more than a parameter of the node"
                yield Finding(Grade.UNREADABLE, main.cpp.source, span, why, _HINT, f"{name}.main")
