"""What people write in Python where generated code says the same otherwise, as the model has it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.analysis.intervals.writes import array_of, is_own, own, written
from rebsync.reverse.models.building import bare
from rebsync.reverse.python.expressions import values
from rebsync.reverse.python.expressions.conditions import signs_of
from rebsync.reverse.python.generated.cuts import FUNCTIONS, other_division
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.kinds import is_floating
from rebsync.reverse.python.generated.named_constants import is_moment
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.static.types import BOOLEAN, DOUBLE, INT

_PLAIN = frozenset({"identifier", "attribute", "integer", "float", "true", "false", "none"})
_AROUND = frozenset(
    {
        *("boolean_operator", "not_operator", "comparison_operator", "binary_operator"),
        *("unary_operator", "conditional_expression"),
    }
)
_BY_VALUE = frozenset({"<", "<=", ">", ">=", "==", "!=", "in", "not in"})
_CALM = frozenset({"abs", "min", "max", "bool", "int8", "int16", "int32", "divide", "remainder"})
_COPYING = frozenset({"copied", "copy.deepcopy"})
_GROWING = frozenset({"+", "-", "*", "<<", ">>", "&", "|", "^"})
_CHANGES = "how often this is done may change: say it with numbers or locals"


def alike(
    reader: ModelExpressionReader,
    node: Node,
    operator: str,
    sides: tuple[m.Expression, m.Expression],
) -> tuple[m.Expression, m.Expression]:
    """What is compared, with truth values as the numbers that they are beside others.

    Unread: a number and a truth value are compared otherwise than by an operator: a pattern, and
    `is`, do not take one for the other.
    """
    kinds = [reader.kind(side) for side in sides]
    truths = kinds.count(BOOLEAN)
    if (truths < 2 or operator in ("==", "!=")) and (truths != 1 or None in kinds):
        return sides
    is_by_value = node.type == "comparison_operator" and _BY_VALUE.issuperset(signs_of(node))
    if not is_by_value or not {*kinds} <= {BOOLEAN, INT}:
        raise reader.unread(node, "the model compares no truth value with a number")
    return as_number(reader, sides[0]), as_number(reader, sides[1])


def grouped(node: Node, found: m.Expression) -> m.Expression:
    """What Python says in one piece and the model in several, within an operation."""
    is_one = not isinstance(found, m.Binary | m.Conditional)
    return found if is_one or not is_within(node) else m.Paren(found)


def is_within(node: Node) -> bool:
    """Whether something stands in an operation, be it in parentheses."""
    above = climb(node, lambda n: n.type != "parenthesized_expression")
    return above is not None and above.type in _AROUND


def is_plain(node: Node) -> bool:
    """Whether an expression does nothing, however often it is evaluated."""
    if node.type == "subscript":
        return all(map(is_plain, named(node)))
    if node.type in ("parenthesized_expression", "unary_operator", "binary_operator"):
        return all(map(is_plain, named(node)))
    return node.type in _PLAIN


def is_quiet(node: Node) -> bool:
    """Whether evaluating it changes nothing: it calls nothing but what is of Python or cuts."""
    if node.type == "named_expression":
        return False
    if node.type == "call" and text_of(field(node, "function")) not in _CALM:
        return False
    return all(map(is_quiet, named(node)))


def divided(reader: ModelExpressionReader, node: Node, read: m.Binary) -> m.Binary:
    """`a / b` of numbers with a point, and `a // b` and `a % b` of integers that must turn out to
    be ones of which the model has the same. Unread: all else, which the model divides otherwise.
    """
    operator = text_of(field(node, "operator"))
    kinds = reader.kind(read.left), reader.kind(read.right)
    if operator == "/" and any(map(is_floating, kinds)):
        return read
    if operator != "/" and kinds == (m.Type("int"), m.Type("int")):
        whole = m.Binary(operator[0], read.left, read.right, read.span)
        return reader.cuts.divided(whole)
    raise reader.unread(node, other_division(operator))


def as_number(reader: ModelExpressionReader, operand: m.Expression) -> m.Expression:
    """An operand of an addition or product, of which Python takes truth values for 1 and 0."""
    found = values.as_number(reader.value(operand)).expression
    return m.Paren(found) if isinstance(found, m.Conditional) and found != operand else found


@contextmanager
def ahead(reader: ModelExpressionReader) -> Iterator[None]:
    """Lets expressions be read to look at what they are; they are still to be read."""
    divided = dict(reader.cuts.floored)
    try:
        yield
    finally:
        reader.cuts.floored.clear()
        reader.cuts.floored.update(divided)


def kind_at(reader: ModelExpressionReader, node: Node) -> m.Type | None:
    """The kind of what is still to be read, as the types of locals are told."""
    with ahead(reader):
        return reader.kind(reader.expression(node))


def copied_type(reader: ModelExpressionReader, node: Node) -> m.Type | None:
    """The type of an array that is copied; None of all else."""
    called = reader.of_run_time(text_of(field(node, "function"))) if node.type == "call" else ""
    with ahead(reader):
        return _array_type(reader, reader.expression(node)) if called in _COPYING else None


def _array_type(reader: ModelExpressionReader, read: m.Expression) -> m.Type | None:
    """The type of an array, or of both that it may be; None where Python's elements are wider."""
    if isinstance(read, m.Conditional):
        ways = _array_type(reader, bare(read.then)), _array_type(reader, bare(read.otherwise))
        return ways[0] if ways[0] == ways[1] else None
    type_ = type_of(reader, read) if _is_array(reader, read) else None
    if type_ is None or not isinstance(read, m.Name | m.Member):
        return None
    return type_ if m.Type(type_.name) in (INT, BOOLEAN, DOUBLE) else None


def type_of(reader: ModelExpressionReader, place: m.Expression) -> m.Type | None:
    """The type of the variable that a place is, or is an element of."""
    name = array_of(place) or ""
    key = own(name) if is_own(place) else name
    return reader.types.get(key, reader.names.types.get(key))


def check_copied(reader: ModelExpressionReader, node: Node, read: m.Expression) -> None:
    """Raises `Unread` for an array that Python would only give another name."""
    if node.type == "parenthesized_expression" and len(named(node)) == 1:
        check_copied(reader, named(node)[0], read.inner if isinstance(read, m.Paren) else read)
    elif isinstance(read, m.Conditional) and node.type == "conditional_expression":
        then, _, otherwise = named(node)
        check_copied(reader, then, read.then)
        check_copied(reader, otherwise, read.otherwise)
    elif node.type != "call" and _is_array(reader, read):
        why = "this is the same array in Python, and a copy in the model: say copied(...)"
        raise reader.unread(node, why)


def _is_array(reader: ModelExpressionReader, read: m.Expression) -> bool:
    """Whether an expression names an array, or one in an array."""
    type_, depth = type_of(reader, read), 0
    while isinstance(read, m.Index):
        read, depth = read.target, depth + 1
    if not isinstance(read, m.Name | m.Member):
        return False
    return type_ is not None and len(type_.dimensions) > depth


# --- sends --------------------------------------------------------------------------------------


def times(reader: ModelExpressionReader, node: Node) -> dict[str, m.Expression]:
    """When a send arrives and expires. Unread: it is told otherwise than by `When`."""
    if node.type == "identifier" and text_of(node) in reader.moments:
        return {**reader.moments[text_of(node)]}
    constants, hidden = reader.names.constants, reader.hides_name
    code, module = constants.code, constants.module
    if reader.of_run_time(text_of(node)) == "AT_ONCE":
        return {}
    if node.type == "identifier" and not hidden(text_of(node)):
        node = code.moment(module, text_of(node)) or node
    called = text_of(field(node, "function")) if node.type == "call" else ""
    is_made = reader.of_run_time(called) == "When" or is_moment(code.of(module, called))
    is_moment_ = is_made and not hidden(called.partition(".")[0])
    given = named(field(node, "arguments")) if is_moment_ else []
    is_spread = any(g.type in ("list_splat", "dictionary_splat") for g in given)
    if not is_moment_ or is_spread or len(given) > 2:
        raise reader.unread(node, "this is no time of a send")
    said: dict[str, Node] = {}
    for name, each in zip(("after", "deadline"), given, strict=False):
        is_named = each.type == "keyword_argument"
        value = field(each, "value") if is_named else each
        said[text_of(field(each, "name")) if is_named else name] = value
    if "deadline" in said and text_of(said["deadline"]) == "None":
        del said["deadline"]
    return {name: reader.expression(value) for name, value in said.items()}


# --- statements ---------------------------------------------------------------------------------


def augmented(reader: ModelExpressionReader, node: Node) -> m.Expression:
    """`x += e`. Unread: the model has no such operator, or Python means another one."""
    operator = text_of(field(node, "operator")).removesuffix("=")
    target = reader.expression(field(node, "left"))
    value = reader.expression(field(node, "right"))
    value = as_number(reader, value) if operator in ("+", "-", "*") else value
    kinds = reader.kind(target), reader.kind(value)
    if operator in FUNCTIONS and not (operator == "/" and is_floating(kinds[0])):
        right = f"x = {FUNCTIONS[operator]}(x, e)"
        raise reader.unread(node, f'"{operator}=" of Python is not the model\'s, which is {right}')
    if operator not in _GROWING and operator != "/":
        raise reader.unread(node, f'the model has no operator "{operator}="')
    if None in kinds or (is_floating(kinds[1]) and not is_floating(kinds[0])):
        raise reader.unread(node, "what this stores is of another type than the variable")
    return m.Assign(f"{operator}=", target, value, reader.py.span(node))


def base_of(node: Node) -> str:
    """The variable that something is stored in, or in an element of which."""
    while node.type == "subscript":
        node = named(node)[0]
    return text_of(node)


def names_in(node: Node) -> set[str]:
    """The names and attributes that a part of the code has."""
    if node.type in ("identifier", "attribute"):
        return {text_of(node)}
    return {name for each in named(node) for name in names_in(each)}


def lasts(reader: ModelExpressionReader, subject: Node, name: str, block: Node) -> bool:
    """Whether a name has the value of a local throughout a block, and is no other's."""
    stored = stored_in(block)
    is_free = name not in reader.locals and name not in reader.names.constants
    if is_free and name not in names_in(block):  # only the guard asks it
        return True
    return is_free and subject.type == "identifier" and not stored & {name, text_of(subject)}


def rounds(
    reader: ModelExpressionReader, node: Node
) -> tuple[m.Expression, m.Expression, m.Expression]:
    """Start, end and step of `range(...)`."""
    arguments = named(field(field(node, "right"), "arguments"))
    read = [reader.expression(a) for a in arguments]
    if not 1 <= len(read) <= 3 or any(reader.kind(each) != INT for each in read):
        raise reader.unread(node, _CHANGES)
    start = read[0] if len(read) > 1 else m.IntLiteral(0)
    step = read[2] if len(read) > 2 else m.IntLiteral(1)
    return start, read[1] if len(read) > 1 else read[0], step


def check_steady(
    reader: ModelExpressionReader, node: Node, bound: m.Expression, body: m.Block
) -> None:
    """Unread: a bound of a loop may change in it, where Python asks for it only once."""
    own = {*reader.names.functions.values(), *(h.name for h in reader.names.helpers.values())}
    calls = (n for n in m.walk(body) if isinstance(n, m.Call) and n.name in own)
    runs = any(not isinstance(call.target, m.Self | m.Name) for call in calls)  # others send
    stored, local = written(body), reader.locals.values()
    for part in m.walk(bound):
        match part:
            case m.IntLiteral() | m.Paren() | m.Binary() | m.Unary("-" | "+" | "~") | m.Self():
                continue
            case m.Name(name) | m.Member(m.Self(), name) if name not in stored:
                if not runs or (name in local and not is_own(part)):
                    continue
        raise reader.unread(node, _CHANGES)


def is_literal(reader: ModelExpressionReader, node: Node) -> bool:
    """Whether an expression is the same at any time."""
    if node.type == "unary_operator":
        return is_literal(reader, field(node, "argument"))
    return node.type in ("integer", "float", "true", "false") or (
        text_of(node) in reader.names.constants and text_of(node) not in reader.locals
    )


def stored_in(node: Node) -> set[str]:
    """The variables that a block stores something in."""
    found: set[str] = set()
    for each in node.named_children:
        if each.type == "call" and text_of(field(each, "function")) == "put":
            found |= _put(named(field(each, "arguments")))
        if each.type in ("assignment", "augmented_assignment", "for_statement", "named_expression"):
            left = each.child_by_field_name("left") or each.child_by_field_name("name")
            is_many = left is not None and left.type in ("pattern_list", "tuple_pattern")
            lefts = named(left) if left is not None and is_many else [left]
            found |= {base_of(n) for n in lefts if n is not None}
        found |= stored_in(each)
    return found


def _put(arguments: list[Node]) -> set[str]:
    """What `put(self, "_x", ...)` stores in."""
    if len(arguments) < 2:
        return set()
    of, name = map(text_of, arguments[:2])
    return {f"{of}.{name[1:-1]}"}
