"""Trees that no parser made: what is printed must parse to what was meant."""

from __future__ import annotations

import pytest

from rebsync import model as m
from rebsync.grammars.parser import parse_expression, parse_statement
from rebsync.printing import (
    print_class,
    print_expression,
    print_line,
    print_member,
    print_statement,
)

A, B, C, ONE = m.Name("a"), m.Name("b"), m.Name("c"), m.IntLiteral(1)
INT = m.Type("int")
SUM = m.Binary("+", A, B)
TEST = m.Conditional(A, B, C)
SET = m.Assign("=", A, ONE)
STEP = m.ExpressionStatement(m.Postfix("++", A))
INNER = m.If(B, STEP)


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (m.Binary("*", SUM, C), "(a + b) * c"),
        (m.Binary("-", A, SUM), "a - (a + b)"),
        (m.Binary("-", SUM, A), "a + b - a"),
        (m.Binary("==", m.Binary("<", A, B), C), "a < b == c"),
        (m.Binary("<", m.Binary("==", A, B), C), "(a == b) < c"),
        (m.Binary("-", A, m.Unary("-", B)), "a - -b"),
        (m.Unary("-", m.Unary("-", A)), "- -a"),
        (m.Unary("-", m.Unary("--", A)), "- --a"),
        (m.Unary("+", m.IntLiteral(-1)), "+-1"),
        (m.Unary("-", m.IntLiteral(-1)), "- -1"),
        (m.Binary("-", A, m.IntLiteral(-1)), "a - -1"),
        (m.Unary("!", SUM), "!(a + b)"),
        (m.Unary("-", m.Postfix("++", A)), "-a++"),
        (m.Postfix("++", m.Unary("-", A)), "(-a)++"),
        (m.Cast(INT, SUM), "(int) (a + b)"),
        (m.Cast(INT, m.Unary("-", A)), "(int) (-a)"),
        (m.Cast(INT, m.Cast(m.Type("byte"), A)), "(int) (byte) a"),
        (m.Cast(INT, m.Member(A, "x")), "(int) a.x"),
        (m.Member(m.Cast(m.Type("R"), A), "x"), "((R) a).x"),
        (m.Call(m.Cast(m.Type("R"), m.Name("sender")), "m"), "((R) sender).m()"),
        (m.Index(m.Cast(m.Type("R"), A), ONE), "((R) a)[1]"),
        (m.Unary("-", m.Cast(INT, A)), "-(int) a"),
        (m.Binary("+", TEST, ONE), "(a ? b : c) + 1"),
        (m.Conditional(TEST, TEST, TEST), "(a ? b : c) ? a ? b : c : a ? b : c"),
        (m.Conditional(A, SET, SET), "a ? a = 1 : a = 1"),
        (m.Binary("+", SET, ONE), "(a = 1) + 1"),
        (m.Assign("+=", A, SET), "a += a = 1"),
        (m.InstanceOf(SUM, m.Type("R")), "a + b instanceof R"),
        (m.InstanceOf(m.Binary("==", A, B), m.Type("R")), "(a == b) instanceof R"),
        (m.Choice((SUM, m.Choice((A, B)))), "?(a + b, ?(a, b))"),
        (
            m.Call(None, "m", (TEST, SET), m.Choice((ONE, A)), SUM),
            "m(a ? b : c, a = 1) after(?(1, a)) deadline(a + b)",
        ),
    ],
    ids=lambda case: case if isinstance(case, str) else "",
)
def test_expressions(tree: m.Expression, text: str) -> None:
    assert print_expression(tree) == text
    assert print_expression(parse_expression(text)) == text


@pytest.mark.parametrize(
    "then",
    [
        INNER,
        m.While(A, INNER),
        m.For((), None, (), m.While(A, INNER)),
        m.If(A, STEP, INNER),
        m.If(A, STEP, m.If(A, STEP, m.While(B, INNER))),
    ],
)
def test_an_else_is_not_taken_by_an_inner_if(then: m.Statement) -> None:
    tree = m.If(C, then, m.Return())
    assert parse_statement(print_statement(tree)) == m.If(C, m.Block((then,)), m.Return())


@pytest.mark.parametrize("then", [m.If(A, STEP, STEP), m.While(A, STEP), m.Block((INNER,))])
def test_braces_come_in_only_where_they_must(then: m.Statement) -> None:
    tree = m.If(C, then, m.Return())
    assert parse_statement(print_statement(tree)) == tree


def test_an_annotated_else_if_stands_on_its_own() -> None:
    tree = m.If(A, STEP, m.If(B, STEP, annotations=(m.Annotation("note"),)))
    text = "if (a)\n  a++;\nelse\n  @note if (b)\n    a++;"
    assert print_statement(tree) == text
    assert parse_statement(text) == tree


def test_what_is_longer_than_the_stack_is_deep() -> None:
    terms: m.Expression = A
    branches: m.Statement = STEP
    for _ in range(3000):
        terms = m.Binary("+", terms, ONE)
        branches = m.If(A, STEP, branches)
    assert print_expression(terms).count("+") == 3000
    assert print_statement(branches).count("else if") == 2999


def test_parts_of_a_model() -> None:
    server = m.MessageServer("m", (m.Parameter(INT, "x"),), m.Block((STEP,)), annotations=(PORT,))
    assert print_member(server) == "@Port\nmsgsrv m(int x) {\n  a++;\n}\n"
    assert print_member(m.StateVars((DECLARED,))) == "statevars {\n  int[2] a = {1, 1}, b;\n}\n"
    assert print_line(DECLARED) == "int[2] a = {1, 1}, b;"
    assert print_line(m.Env(DECLARED)) == "env int[2] a = {1, 1}, b;"
    assert print_line(m.Rebec(m.Type("R"), "r", (A,), (ONE,), (PORT,))) == "@Port R r(a):(1);"
    assert print_line(m.Annotation("Move", (SUM, B))) == "@Move(a + b, b)"
    assert print_class(m.Interface("I", (), ("J", "K"))) == "interface I extends J, K {}\n"
    assert print_class(m.ReactiveClass("R", 2, (), True, "S", ("I",), (PORT,))) == (
        "@Port\nabstract reactiveclass R extends S implements I(2) {}\n"
    )


PORT = m.Annotation("Port")
DECLARED = m.Declaration(
    m.Type("int", (2,)), (m.Declarator("a", m.ArrayInitializer((ONE, ONE))), m.Declarator("b"))
)


def test_a_tree_with_mistakes_is_not_printed() -> None:
    with pytest.raises(ValueError, match="Broken"):
        print_expression(m.Binary("+", A, m.Broken()))
