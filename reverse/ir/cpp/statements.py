"""Statements of C++ ([stmt.stmt]): scopes with what ends in them, conditions, loops, jumps."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    full_value,
    lower_statement,
    lower_value,
    lowers_statement,
    unsupported,
)
from rebsync.reverse.ir.cpp.conversions import promoted
from rebsync.reverse.ir.cpp.declarations import declarators, declare, variable
from rebsync.reverse.ir.cpp.expressions import discarded
from rebsync.reverse.ir.cpp.objects import implicitly
from rebsync.reverse.ir.operators import Conversion
from rebsync.reverse.syntax.cpp_declarations import declared_name
from rebsync.reverse.syntax.cpp_tree import named, part, text_of


@lowers_statement("compound_statement")
def block(context: Context, node: Node) -> None:
    """`{ ... }`: a scope; a function's body is lowered by its function."""
    body = scope(context, named(node))
    context.emit(s.Block(body, context.place(node)))


def scope(context: Context, nodes: Sequence[Node]) -> s.Body:
    """Statements in a scope of their own, at whose end its objects end ([class.dtor])."""
    objects, context.objects = context.objects, []
    try:
        with context.scoped(), context.body() as body:
            _statements(context, _single(nodes))
    finally:
        context.objects = objects
    return tuple(body)


def _single(nodes: Sequence[Node]) -> list[tuple[Node, Node | None]]:
    """Each statement, with each declarator of a declaration by itself."""
    found: list[tuple[Node, Node | None]] = []
    for node in nodes:
        if node.type == "declaration" and declarators(node):
            found += [(node, each) for each in declarators(node)]
        else:
            found.append((node, None))
    return found


def _statements(context: Context, items: list[tuple[Node, Node | None]]) -> None:
    """Statements in their order; behind the declaration of an object with a destructor the rest
    of the scope is a `try`, of which `finally` ends the object.
    """
    for number, (node, declarator) in enumerate(items):
        if declarator is None:
            lower_statement(context, node)
        else:
            _declaration(context, node, declarator)
        if context.objects:
            endings, context.objects = context.objects, []
            with context.body() as rest:
                _statements(context, items[number + 1 :])
            _ending(context, tuple(rest), endings)
            return


def _declaration(context: Context, node: Node, declarator: Node) -> None:
    mark = len(context.out)
    try:
        declare(context, node, declarator)
    except Unlowered as error:
        del context.out[mark:]
        context.emit(unsupported(context, node, str(error)))


def _ending(context: Context, rest: s.Body, endings: list[s.Statement]) -> None:
    """Objects end in the reverse order of their construction, however the scope is left."""
    for each in reversed(endings):
        rest = (s.Try(rest, final=(each,), place=each.place),)
    context.emit(*rest)


def one(context: Context, node: Node) -> s.Body:
    """A statement that is the body of another: a scope even without braces."""
    return scope(context, named(node) if node.type == "compound_statement" else [node])


@lowers_statement("expression_statement")
def expression(context: Context, node: Node) -> None:
    """An expression for what it does."""
    for inner in named(node):
        with context.full_expression():
            discarded(context, inner)


@lowers_statement("else_clause", "attributed_statement")
def what_follows(context: Context, node: Node) -> None:
    """What stands behind `else`, or `[[fallthrough]]` and other attributes, which say nothing."""
    for inner in named(node):
        if inner.type != "attribute_declaration":
            lower_statement(context, inner)


# --- conditions -----------------------------------------------------------------------------------


def condition(context: Context, node: Node) -> e.Expression:
    """A condition as a truth; temporaries end before what it decides."""
    place = context.place(node)
    if node.type in ("declaration", "init_declarator"):
        return _declared_condition(context, node)
    with context.full_expression():
        value = full_value(context, node)
        try:
            test = implicitly(context, value, t.TRUTH, place).expression
        except Unlowered as error:
            test = context.temporary(t.TRUTH, place)
            context.emit(unsupported(context, node, str(error), test))
        if context.pending:
            test = context.stored(test, t.TRUTH, place)
    return test


def _declared_condition(context: Context, node: Node) -> e.Expression:
    """`if (T x = value)`: the variable's value decides."""
    value = _declared_value(context, node)
    return implicitly(context, value, t.TRUTH, context.place(node)).expression


def _declared_value(context: Context, node: Node) -> Value:
    """The variable that a condition declares."""
    found = declarators(node)
    declarator, value = (found[0], None) if found else (node, None)
    if len(found) != 1:
        raise Unlowered("a condition that declares other than one variable")
    value_node = node.child_by_field_name("value")
    if declarator.type != "init_declarator" and value_node is not None:
        _declare_with(context, node, declarator, value_node)
    else:
        declare(context, node, declarator)
        value_node = declarator.child_by_field_name("value")
        declarator = part(declarator, "declarator")
    names = [n for n in [declarator] if n.type == "identifier"]
    while not names and named(declarator):
        declarator = named(declarator)[-1]
        names = [declarator] if declarator.type == "identifier" else []
    value = context.local(text_of(names[0])) if names else None
    if value is None:
        raise Unlowered("a condition that declares no variable")
    return value


def _declare_with(context: Context, node: Node, declarator: Node, value: Node) -> None:
    name, type_node = declared_name(declarator), part(node, "type")
    if name is None:
        raise Unlowered("a condition that declares no variable")
    declared = context.world.types.declared(context.cpp, context.scope, type_node, declarator)
    is_auto = "auto" in text_of(type_node).split()
    with context.full_expression():
        variable(context, text_of(name), declared, value, is_auto, context.place(node))


def repeated(context: Context, node: Node) -> e.Expression:
    """The condition of a loop, which is evaluated before each round."""
    objects, context.objects = context.objects, []
    test = condition(context, node)
    if context.objects:
        raise Unlowered("a condition of a loop that declares an object with a destructor")
    context.objects = objects
    return test


@lowers_statement("preproc_if", "preproc_ifdef")
def preprocessor(context: Context, node: Node) -> None:
    """Alternatives of which the build takes one: that is not known here, but always the same."""
    place, alternative = context.place(node), node.child_by_field_name("alternative")
    head = node.child_by_field_name("condition") or part(node, "name")
    objects, context.objects = context.objects, []
    with context.body() as then:
        for each in named(node):
            if each not in (head, alternative):
                lower_statement(context, each)
    with context.body() as otherwise:
        if alternative is not None:
            _alternative(context, alternative)
    if context.objects:
        raise Unlowered("an object with a destructor that is there in some builds only")
    context.objects = objects
    macro = e.LibraryReference(f"#{text_of(head)}", t.UNKNOWN, place)
    test = e.Convert(Conversion.TRUTH, macro, t.TRUTH, True, place)
    context.emit(s.If(test, tuple(then), tuple(otherwise), False, place))


def _alternative(context: Context, node: Node) -> None:
    """`#else`, or `#elif` with its own condition."""
    if node.type in ("preproc_elif", "preproc_elifdef"):
        preprocessor(context, node)
        return
    for each in named(node):
        lower_statement(context, each)


@lowers_statement("if_statement")
def if_statement(context: Context, node: Node) -> None:
    """`if (init; test) ... else ...`."""
    clause, place = part(node, "condition"), context.place(node)
    start = clause.child_by_field_name("initializer")
    value = clause.child_by_field_name("value") if clause.type == "condition_clause" else clause
    if value is None:
        raise Unlowered("a condition")
    is_scope = start is not None or value.type == "declaration"

    def whole() -> None:
        objects, context.objects = context.objects, []
        test = condition(context, value)
        endings, context.objects = context.objects, objects
        with context.body() as body:
            then = one(context, part(node, "consequence"))
            alternative = node.child_by_field_name("alternative")
            otherwise = () if alternative is None else _else(context, alternative)
            context.emit(s.If(test, then, otherwise, False, place))
        _ending(context, tuple(body), endings)

    if not is_scope:
        whole()
        return
    with context.scoped(), context.body() as body:
        with_start(context, start, whole)
    context.emit(s.Block(tuple(body), place))


def with_start(context: Context, start: Node | None, rest: Callable[[], None]) -> None:
    """What is declared before a condition ends behind the whole statement."""
    objects, context.objects = context.objects, []
    for inner in named(start) if start is not None and start.type == "init_statement" else []:
        lower_statement(context, inner)
    if start is not None and start.type in ("declaration", "expression_statement"):
        lower_statement(context, start)
    endings, context.objects = context.objects, objects
    with context.body() as body:
        rest()
    _ending(context, tuple(body), endings)


def _else(context: Context, node: Node) -> s.Body:
    inner = named(node)
    return one(context, inner[-1]) if inner else ()


# --- switch ---------------------------------------------------------------------------------------


@lowers_statement("switch_statement")
def switch(context: Context, node: Node) -> None:
    """`switch`: cases go on into the next ones."""
    clause, place = part(node, "condition"), context.place(node)
    start, value_node = (
        clause.child_by_field_name("initializer"),
        clause.child_by_field_name("value"),
    )
    if value_node is None:
        raise Unlowered("a switch over nothing")

    def whole() -> None:
        with context.full_expression():
            is_declared = value_node.type == "declaration"
            lowered = _declared_value if is_declared else lower_value
            value = lowered(context, value_node)
            type_ = value.type if isinstance(value.type, t.Enumeration) else promoted(value.type)
            found = implicitly(context, value, type_, place).expression
            if context.pending:
                found = context.stored(found, type_, place)
        cases = _cases(context, part(node, "body"), type_)
        context.emit(s.Switch(found, cases, place))

    with context.scoped(), context.body() as body:
        with_start(context, start, whole)
    if start is not None or len(body) > 1:
        context.emit(s.Block(tuple(body), place))
    else:
        context.emit(*body)


def _cases(context: Context, body: Node, type_: t.Type) -> tuple[s.Case, ...]:
    found: list[s.Case] = []
    for child in named(body):
        if child.type != "case_statement":
            raise Unlowered("a switch with statements before its cases")
        value = child.child_by_field_name("value")
        inner = [c for c in named(child) if c != value]
        if any(c.type == "case_statement" for c in inner):
            raise Unlowered("a case within a case")
        values = () if value is None else (_constant(context, value, type_),)
        objects, context.objects = context.objects, []
        with context.body() as statements:
            for each in inner:
                lower_statement(context, each)
        if context.objects:
            raise Unlowered("a case that declares an object with a destructor")
        context.objects = objects
        place = context.place(child)
        found.append(s.Case(values, tuple(statements), value is None, place))
    return tuple(found)


def _constant(context: Context, node: Node, type_: t.Type) -> e.Expression:
    with context.body() as before:
        value = lower_value(context, node)
        found = implicitly(context, value, type_, context.place(node)).expression
    if before:
        raise Unlowered("a case whose constant is computed")
    return found
