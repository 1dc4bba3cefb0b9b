"""What may end a program of generated C++, and the model says nothing of."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from tree_sitter import Node

from rebsync.model import Type
from rebsync.reverse.analysis.problems import NOTHING_THERE
from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.generated.cpp_names import declared_type
from rebsync.reverse.generated.cpp_roles import parameters_of
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, operator_of, part, text_of
from rebsync.source import Span

_LOOKS = (
    *("subscript_expression", "pointer_expression", "field_expression", "call_expression"),
    "pointer_declarator",
)
_TAKING = frozenset({"front", "back", "top", "pop", "pop_back", "pop_front", "erase"})
_POINTER = re.compile(r"\*|optional")
_ELEMENT = re.compile(r"(\w+)\[(\d+)\]")
_STATE = "state_pub_"  # whether a class has one is a fact of its state's message
_ROOT = re.compile(r"[*&(]*(?:this\s*->\s*)?(\w+)")


def failures(
    code: Code, form: CppForm, owner: CppClass, function: CppFunction
) -> Iterator[tuple[Span, str]]:
    """What may end the program, and the model has nothing of: what is logged, what is looked up.

    Whether an array of the model has an element is a matter of the model, but for logs and what
    has none of its types.
    """
    span = function.cpp.span
    logs = [n for n in inside(function.body, "expression_statement") if is_logging(n)]
    for log in logs:
        if (why := form.raises(function.cpp, log)) is not None:
            yield span(log), why
    texts = inside(function.body, "declaration")
    told = [*logs, *(n for n in inside(function.body, "if_statement") if is_logging(n))]
    told += [n for n in texts if declared_type(code, part(n, "type")) is None and _has_lookup(n)]
    variables = _of_model(code, owner, function)
    if function.body is None or not (told or _looks_up(function, function.body, variables)):
        return
    found = list(form.looked_up(function.cpp, function.body))
    generic = _of_generic(function, variables)
    for lookup in found:
        element = _ELEMENT.fullmatch(function.cpp.source.text, lookup.start, lookup.end)
        if element is not None and int(element[2]) < generic.get(element[1], 0):
            continue
        if any(lookup.holds(o) and o != lookup for o in found):
            continue  # what is in it says it
        root = _ROOT.match(function.cpp.source.text, lookup.start)
        if root is not None and root[1] == _STATE:
            continue
        is_told = any(s.start <= lookup.start < s.end for s in map(span, told))
        if is_told or root is None or root[1] not in variables:
            yield lookup, NOTHING_THERE


def _of_model(code: Code, owner: CppClass, function: CppFunction) -> dict[str, Type]:
    """The variables, parameters and locals of types that the model has."""
    fields = ((f.name, f.type) for c in code.lineage(owner.name) for f in c.fields)
    declared = [p.node for p in function.parameters]
    declared += inside(function.body, "declaration", "parameter_declaration", "for_range_loop")
    own = (
        (text_of(n), part(each, "type"))
        for each in declared
        for d in each.children_by_field_name("declarator")
        for n in inside(d, "identifier", "pointer_declarator")[:1]
        if n.type == "identifier"
    )
    typed = {name: declared_type(code, type_) for name, type_ in (*fields, *own)}
    return {name: type_ for name, type_ in typed.items() if type_ is not None}


def _of_generic(function: CppFunction, variables: Mapping[str, Type]) -> dict[str, int]:
    """How many elements there are in what parameters of generic lambdas get, wherever called."""
    found: dict[str, int] = {}
    names = inside(function.body, "identifier")
    for lambda_ in inside(function.body, "lambda_expression"):
        declared = lambda_.parent if lambda_.parent is not None else lambda_
        name = text_of(part(declared, "declarator")) if declared.type == "init_declarator" else ""
        calls = [c for c in calls_in(function.body) if c.name == name and c.target is None]
        if sum(text_of(n) == name for n in names) != len(calls) + 1:
            continue  # something else may call it
        for index, parameter in enumerate(parameters_of(lambda_)):
            given = [c.arguments[index] for c in calls if index < len(c.arguments)]
            types = [variables.get(text_of(n).removeprefix("this->")) for n in given]
            sizes = [t.dimensions[0] if t is not None and t.dimensions else 0 for t in types]
            own = [n for n in names if text_of(n) == parameter.name]
            is_own = all(lambda_.start_byte < n.start_byte < lambda_.end_byte for n in own)
            if parameter.type.type == "placeholder_type_specifier" and is_own and sizes:
                found[parameter.name] = min(sizes)
    return found


def _looks_up(function: CppFunction, body: Node, variables: Collection[str]) -> bool:
    """Whether code looks up more than what the model has, and what comes, by how it is written.

    Only then the form is asked, which takes long.
    """
    comes = (p.node for p in function.parameters if not _POINTER.search(text_of(p.node)))
    there = {"this", *variables, *(text_of(n) for p in comes for n in inside(p, "identifier"))}
    for node in filter(_is_lookup, inside(body, *_LOOKS)):
        root, field = _ROOT.match(text_of(node)), node.child_by_field_name("field")
        is_arrow = field is not None and text_of(field) not in _TAKING
        if root is None or root[1] not in (there if is_arrow else variables):
            return True
    return False


def _has_lookup(node: Node) -> bool:
    return any(map(_is_lookup, inside(node, *_LOOKS)))


def _is_lookup(node: Node) -> bool:
    match node.type:
        case "pointer_expression":
            return operator_of(node) == "*"
        case "field_expression":
            return operator_of(node) == "->" or text_of(part(node, "field")) in _TAKING
        case "call_expression":
            return text_of(part(node, "function")).rpartition("::")[2] == "getenv"
        case _:
            return True
