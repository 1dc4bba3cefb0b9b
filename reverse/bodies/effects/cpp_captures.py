"""What a lambda captures: references and the object as they are, and copies that stay the same."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_roots import identifiers_in, specifiers_of
from rebsync.reverse.bodies.effects.known_functions import may_change, takes_values
from rebsync.reverse.bodies.scope import (
    Called,
    Inline,
    Lambda,
    Meaning,
    Scope,
    Sends,
    Variable,
    meant_by,
)
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.bodies.types.cpp_widths import wide_of
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import BYTE, INT, SHORT

_INITIALISED = "lambda_capture_initializer"
# What makes a value of its own of what stands in it, or decides by it.
_READS = frozenset(
    {
        *("binary_expression", "unary_expression", "condition_clause", "return_statement"),
        *("case_statement", "expression_statement", "subscript_argument_list"),
        *("lambda_capture_specifier", "parameter_declaration", "for_statement"),
    }
)


def declared(reader: CppStatementReader, node: Node) -> tuple[Lambda, list[m.Statement]]:
    """The function that a local holds, and the locals of the model for `[n = e]` in it."""
    names: dict[str, Meaning] = {}
    statements: list[m.Statement] = []
    for capture in named(part(node, "captures")):
        if capture.type != _INITIALISED or text_of(capture).startswith("&"):
            continue
        name, value = named(capture)[0], named(capture)[-1]
        read = reader.expressions.read(value)
        if constant(read) is not None:
            names[text_of(name)] = read
            continue
        of = type_in(reader.scope, read)
        if of is None or of.dimensions or wide_of(reader.expressions, value):
            raise reader.unread(capture, "what this holds the model cannot know")
        whole = INT if of in (BYTE, SHORT) else of
        local = Variable(reader.fresh(text_of(name)), whole)
        names[text_of(name)] = local
        reader.meaning(f"{text_of(name)} of {node.start_byte}", local)
        statements.append(reader.local(capture, local, read))
    for copied in dict.fromkeys(_copied(Lambda(node, reader.scope, frozenset(names)))):
        if not _is_copy(reader, reader.scope, node, copied):
            statements += _kept(reader, node, copied, names)
    return Lambda(node, reader.scope.with_locals(names), frozenset(names)), statements


def _kept(
    reader: CppStatementReader, node: Node, name: str, names: dict[str, Meaning]
) -> Iterator[m.Statement]:
    """A local of the model for a copied local that changes later, if it is a plain variable."""
    match reader.scope.locals.get(name):
        case Variable(of_model, type_) as original if type_ is not None and not type_.dimensions:
            local = replace(original, name=reader.fresh(name))
            names[name] = local
            reader.meaning(f"{name} of {node.start_byte}", local)
            yield reader.local(node, local, m.Name(of_model))
        case m.IntLiteral() | m.FloatLiteral() | m.BoolLiteral() as value:
            names[name] = value


def check(reader: CppStatementReader, held: Lambda) -> None:
    """Raises `Unread` where a lambda may hold another value than the one that a name has now."""
    node = held.node
    captures = part(node, "captures")
    copied = set(_copied(held))
    if held.scope is None:
        copied -= reader.scope.members.keys() | reader.scope.functions.keys()
    whole = text_of(captures)
    why = f"what {whole} keeps may change before the call"
    declarator = node.child_by_field_name("declarator")
    changes = declarator is not None and any(text_of(c) == "mutable" for c in named(declarator))
    if (copied or held.own) and changes:
        raise reader.unread(node, why)
    given = {text_of(named(c)[0]) for c in named(captures) if c.type == _INITIALISED}
    if given - held.own or any(c.type == "*" for c in captures.children):
        raise reader.unread(node, why)
    above = node.parent
    if above is not None and above.type == "call_expression":
        return  # copied at the moment of the call
    for name in copied:
        if held.scope is None or not _is_copy(reader, held.scope, node, name):
            raise reader.unread(node, why, "capture it by reference: [&]")


def _copied(held: Lambda) -> Iterator[str]:
    """The names of what is copied."""
    captures = part(held.node, "captures")
    texts, copies = [text_of(c) for c in captures.children], False
    for before, child in zip(["", *texts], captures.children, strict=False):
        if child.type == "identifier" and before != "&" and text_of(child) not in held.own:
            yield text_of(child)
        copies = copies or (child.type == "lambda_default_capture" and text_of(child) == "=")
    if copies:
        known = held.scope.locals.keys() if held.scope is not None else set[str]()
        used = {text_of(n) for n in identifiers_in(part(held.node, "body"))}
        yield from (used & known) - held.own if held.scope is not None else used


def _is_copy(reader: CppStatementReader, scope: Scope, node: Node, name: str) -> bool:
    """Whether the copy of a local has the value of the local whenever the lambda is called."""
    meaning = scope.locals.get(name)
    if isinstance(meaning, Lambda):
        return True
    of_model = meaning.name if isinstance(meaning, Variable | m.Name) else None
    members = (x.name for x in scope.members.values() if isinstance(x, Variable))
    if of_model is None or of_model in members:
        return False
    same = {
        n
        for n, x in scope.locals.items()
        if isinstance(x, Variable | m.Name) and x.name == of_model
    }
    function = climb(node, lambda n: n.type == "function_definition")
    if function is None:
        return False
    uses = (n for n in identifiers_in(function) if text_of(n) in same)
    return all(_is_read(reader.scope, use) for use in uses)


def _is_read(scope: Scope, node: Node) -> bool:
    """Whether a name stands where nothing can change what it names, or where it is declared."""
    above = node.parent
    match above.type if above is not None else "":
        case _ if above is None:
            return False
        case "parenthesized_expression" | "conditional_expression":
            return _is_read(scope, above)
        case "binary_expression":
            return text_of(part(above, "operator")) != ">>" or part(above, "left") == node
        case kind if kind in _READS:
            return True
        case "init_declarator" if part(above, "value") == node:
            constant_ = above.parent is not None and "const" in specifiers_of(above.parent)
            return part(above, "declarator").type == "identifier" or constant_
        case "init_declarator" | "declaration":
            return True
        case "assignment_expression":
            return part(above, "left") != node
        case "lambda_capture_initializer":
            return named(above)[0] == node or not text_of(above).startswith("&")
        case "argument_list":
            return _is_value(scope, above, node)
        case _:
            return False


def _is_value(scope: Scope, arguments: Node, node: Node) -> bool:
    """Whether a function gets no more of an argument than its value."""
    call = call_of(arguments.parent) if arguments.parent is not None else None
    if call is None:
        return arguments.parent is not None and arguments.parent.type == "init_declarator"
    if any("&" in text_of(t) for t in call.types):
        return False
    position = [a.id for a in call.arguments].index(node.id)
    if call.target is not None:
        return call.name in libraries.looking()
    match scope.functions.get(call.name):
        case Sends():
            return True
        case Called() | Inline() as known:
            meant = meant_by(known, call.name, len(call.arguments))
            whole = [f for f in meant if position < len(f.parameters)]
            return bool(meant) and not any(may_change(f.parameters[position]) for f in whole)
    if isinstance(held := scope.meaning(call.name), Lambda):
        declarator = held.node.child_by_field_name("declarator")
        return declarator is None or "&" not in text_of(declarator)
    return takes_values(call)
