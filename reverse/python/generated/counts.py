"""How many elements of an array something holds of, which people write in one expression.

The model counts them in a loop, as its author would: `sum(1 for x in xs if x > 0)`.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.arrays import array_elements
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.py_types import call_parts, type_of
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.syntax.py_tree import SCOPES, field, named, text_of

_FEW = 4  # elements that are said one by one, in the expression itself


def declared(
    reader: ModelStatementReader, node: Node, name: str, value: Node
) -> list[m.Statement] | None:
    """A local that gets such a number, by a loop; None for another assignment."""
    said = node.child_by_field_name("type")
    is_whole = said is None or type_of(said) == m.Type("int")
    is_new = field(node, "left").type == "identifier" and name not in reader.expressions.locals
    if not (is_whole and is_new) or name in reader.expressions.names.constants:
        return None
    if _counted(reader.expressions, value) is None:
        return None
    if said is None:
        reader.implied.add(name)
    return _loop(reader, value, name)


def before(
    reader: ModelStatementReader, node: Node, condition: Node
) -> tuple[list[m.Statement], dict[str, m.Expression]]:
    """What counts what a condition of `if` asks for, before that, and the locals for the numbers.

    These are by the texts that they stand for.
    """
    found: list[m.Statement] = []
    stands: dict[str, m.Expression] = {}
    for call in _calls(condition):
        if _counted(reader.expressions, call) is not None and text_of(call) not in stands:
            name = reader.free("number", "count", pattern="number{}")
            found += _loop(reader, call, name)
            stands[text_of(call)] = m.Name(reader.expressions.locals[name])
    return found, stands


def _calls(node: Node) -> Iterator[Node]:
    if node.type in SCOPES:
        return
    if node.type == "call" and text_of(field(node, "function")) == "sum":
        yield node
        return
    for child in named(node):
        yield from _calls(child)


def _counted(
    reader: ModelExpressionReader, call: Node
) -> tuple[list[m.Expression], str, Node | None] | None:
    """The elements that are counted, what each is called, and what must hold of it."""
    called, arguments = call_parts(call) or ("", [])
    is_own = reader.names.constants.binds("sum") or "sum" in reader.locals
    if called != "sum" or len(arguments) != 1 or is_own:
        return None
    given, name, test = arguments[0], "", None
    if given.type in ("generator_expression", "list_comprehension"):
        body, *clauses = named(given)
        loops = [c for c in clauses if c.type == "for_in_clause"]
        tests = [named(c)[0] for c in clauses if c.type == "if_clause"]
        if len(loops) != 1 or len(tests) != 1 or text_of(body) != "1":
            return None
        left, test, given = field(loops[0], "left"), tests[0], field(loops[0], "right")
        name = text_of(left)
        if left.type != "identifier" or not idioms.is_quiet(test) or name in reader.locals:
            return None
    elements = array_elements(reader, given)
    if elements is None or len(elements) <= _FEW:
        return None
    is_truth = reader.kind(elements[0]) == m.Type("boolean")
    return (elements, name, test) if test is not None or is_truth else None


def _loop(reader: ModelStatementReader, call: Node, name: str) -> list[m.Statement]:
    expressions, span = reader.expressions, reader.expressions.py.span(call)
    elements, each, test = _counted(expressions, call) or ([], "", None)
    index = reader.local(each) if each else reader.free("i", "j", "k", pattern="i{}")
    first = elements[0]
    assert isinstance(first, m.Index)
    element = m.Index(first.target, m.Name(index))
    value = expressions.value(element)
    with expressions.standing_for([each] if each else [], [value] if each else []):
        holds = expressions.truth(expressions.read(test) if test is not None else value, call)
    plain = reader.local(reader.without_number(name))
    expressions.locals[name] = plain
    expressions.types[plain] = m.Type("int")
    zero = m.Declaration(m.Type("int"), (m.Declarator(plain, m.IntLiteral(0), span),), span=span)
    more: m.Expression = m.Postfix("++", m.Name(plain))
    more = expressions.cuts.converted("int32", more, update=True)  # no more than the elements
    counted = m.Block((m.ExpressionStatement(more, span=span),))
    begin = m.Declaration(m.Type("int"), (m.Declarator(index, m.IntLiteral(0)),))
    step: m.Expression = m.Postfix("++", m.Name(index))
    step = expressions.cuts.converted("int32", step, update=True)
    end = binary("<", m.Name(index), m.IntLiteral(len(elements)))
    rounds = m.For(
        begin, end, (step,), m.Block((m.If(holds, counted, None, span=span),)), span=span
    )
    return [m.Local(zero, span=span), rounds]
