"""Functions that Python itself has, which people call in the bodies of generated code.

What goes through an array of the model is said element by element; the array is of fixed length.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models import building
from rebsync.reverse.models.building import binary, chosen, negated, selected
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.idioms import grouped, is_plain, truth, type_of
from rebsync.reverse.python.generated.py_types import call_parts
from rebsync.reverse.syntax.py_tree import field, named, text_of, whole_number_of

_LARGEST = 24  # parts of what is repeated where values are compared
_MOST = 16  # elements that are said one by one
_TESTS = {"any": "||", "all": "&&"}
_OF_SETS = frozenset({"any", "all", "min", "max"})  # for which order and number are nothing
_CUTS = frozenset({"int8", "int16", "int32"})
_NAMES = frozenset({"identifier", "attribute", "integer", "float", "true", "false"})
NO_LENGTH = 'an array of the model has no "{}" in Python: say its length as a number'


def of_python(
    reader: ModelExpressionReader, node: Node, called: str, arguments: list[Node]
) -> m.Expression | None:
    """What a function of Python gives, as the model says it; None for another function.

    Unread: the model cannot say it.
    """
    if reader.names.constants.binds(called) or called in reader.locals:
        return None
    match called, arguments:
        case ("any" | "all" | "sum", [given]):
            return grouped(node, _folded(reader, node, called, given))
        case "sum", [given, start] if is_plain(start):
            first = reader.read(start)
            _assert_whole(reader, node, first)
            return grouped(node, _folded(reader, node, called, given, first))
        case ("min" | "max", [given, key]) if key.type == "keyword_argument":
            return grouped(node, _best(reader, node, called, given, key))
        case ("min" | "max", [given]):
            values = _certain(reader, given, called)
            return grouped(node, _extreme(reader, node, called, values))
        case ("min" | "max", _) if len(arguments) > 1 and all(map(_is_cut_or_plain, arguments)):
            return grouped(node, _extreme(reader, node, called, list(map(reader.read, arguments))))
        case "abs", [given] if is_plain(given):
            read = reader.read(given)
            _assert_whole(reader, node, read)
            below = binary("<", read, m.IntLiteral(0))
            return grouped(node, chosen(below, m.Unary("-", _tight(read)), read))
        case "bool", [given]:
            return grouped(node, truth(reader, reader.read(given)))
        case "int", [given]:
            return grouped(node, _as_int(reader, node, reader.read(given)))
        case ("len" | "reversed", [given]) if _array(reader, given) is not None:
            raise reader.unread(node, NO_LENGTH.format(called))
        case "len", [given] if given.type in ("list", "tuple"):
            return m.IntLiteral(len(named(given)))
        case _, [key, default] if called.endswith(".get"):
            return _looked_up(reader, node, key, default)
        case _:
            return None


def _is_cut_or_plain(node: Node) -> bool:
    """Whether an expression does nothing, be it cut to the width that the model has, or clamped."""
    called, arguments = call_parts(node) or ("", [])
    if called in ("min", "max") and len(arguments) > 1:
        return all(map(_is_cut_or_plain, arguments))
    if called in ("min", "max") and len(arguments) == 1:  # of an array, a list, or what makes one
        return is_plain(arguments[0]) or is_plain_list(arguments[0]) or is_calm(arguments[0])
    return is_plain(node) or (called in _CUTS and all(map(is_plain, arguments)))


def _looked_up(
    reader: ModelExpressionReader, node: Node, key: Node, default: Node
) -> m.Expression | None:
    """`{1: a, 2: b}.get(key, default)`, of numbers written out and what does nothing."""
    table = field(field(node, "function"), "object")
    table = reader.kept_tables.get(text_of(table), table)
    pairs = [(field(p, "key"), field(p, "value")) for p in named(table) if p.type == "pair"]
    values = [value for _, value in pairs] + [default]
    is_known = table.type == "dictionary" and len(pairs) == len(named(table)) <= _MOST
    if not is_known or not is_plain(key) or not all(v.type in _NAMES for v in values):
        return None
    numbers = [whole_number_of(k) for k, _ in pairs]
    if None in numbers:
        return None
    asked, otherwise = reader.read(key), reader.read(default)
    if reader.kind(asked) != m.Type("int"):
        return None
    read = [reader.read(value) for _, value in pairs]
    # of two values of one number the last counts
    numbered = {n: r for n, r in zip(numbers, read, strict=True) if n is not None}
    return grouped(node, selected(asked, numbered, otherwise))


def drawn(
    reader: ModelExpressionReader, node: Node, called: str, arguments: list[Node]
) -> m.Choice | None:
    """`random.choice([1, 2])` and `random.randint(1, 3)`; None for another call."""
    holder, _, name = called.rpartition(".")
    if holder != "random" or reader.names.imported.get("random") != "random":
        return None
    span = reader.py.span(node)
    ends = [n for n in map(whole_number_of, arguments) if n is not None]
    match name, arguments, ends:
        case "choice", [given], _ if given.type in ("list", "tuple") and is_plain_list(given):
            return m.Choice(tuple(map(reader.read, named(given))), span)
        case (("randint" | "randrange"), [_, _], [low, high]):
            end = high + 1 if name == "randint" else high
        case "randrange", [_], [end]:
            low = 0
        case _:
            return None
    if not 0 < end - low <= _MOST:
        return None
    return m.Choice(tuple(map(m.IntLiteral, range(low, end))), span)


def is_plain_list(node: Node) -> bool:
    """Whether a list has elements, none of which does anything."""
    return bool(named(node)) and all(map(is_plain, named(node)))


def array_elements(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    """The elements of a variable of the model that is an array of one dimension; else None."""
    found = _array(reader, node)
    if found is None:
        return None
    read, length = found
    return [m.Index(read, m.IntLiteral(i)) for i in range(length)]


def listed(reader: ModelExpressionReader, node: Node) -> list[m.Expression]:
    """The elements of a list, an array or a comprehension. Unread: nobody knows these."""
    return _certain(reader, node, "this")


def _array(reader: ModelExpressionReader, node: Node) -> tuple[m.Expression, int] | None:
    if node.type not in ("identifier", "attribute"):
        return None
    name = text_of(node)
    plain = reader.locals.get(name) or reader.names.variables.get(name.removeprefix("self."))
    if not {plain} & (reader.types.keys() | reader.names.types.keys()):
        return None
    read = reader.read(node)
    type_ = type_of(reader, read)
    return None if type_ is None or len(type_.dimensions) != 1 else (read, type_.dimensions[0])


# --- elements -----------------------------------------------------------------------------------


def _elements(
    reader: ModelExpressionReader, node: Node, called: str
) -> list[tuple[m.Expression, m.Expression | None]]:
    """Each value that something goes through, with the condition under which it is there."""
    if node.type == "set" and called not in _OF_SETS:
        raise reader.unread(node, "nobody knows how many values this set has, in which order")
    if node.type in ("list", "tuple", "set") and is_plain_list(node):
        found: list[tuple[m.Expression, m.Expression | None]] = [
            (reader.read(n), None) for n in named(node)
        ]
    elif called in _TESTS and _is_harmless_list(reader, node):
        found = [(reader.read(n), None) for n in named(node)]
    elif node.type in ("generator_expression", "list_comprehension"):
        found = list(_comprehended(reader, node))
    else:
        values = array_elements(reader, node)
        if values is None:
            raise reader.unread(node, f'nobody knows what "{called}" goes through here')
        found = [(value, None) for value in values]
    if len(found) > _MOST:
        raise reader.unread(node, "this goes through too many values to say each")
    return found


def _is_harmless_list(reader: ModelExpressionReader, node: Node) -> bool:
    """Whether all of a list may be left unevaluated: nothing in it changes anything or fails."""
    parts = named(node) if node.type in ("list", "tuple") else []
    if not parts or not all(is_calm(n) and not may_fail(reader, n) for n in parts):
        return False
    read = [reader.read(n) for n in parts]
    divides = any(isinstance(p, m.Binary) and p.operator in "/%" for r in read for p in m.walk(r))
    return all(map(building.is_calm, read)) and not divides


def assert_of_python(reader: ModelExpressionReader, node: Node, called: str) -> None:
    """Unread: the name of a function of Python that makes what is gone through is bound again."""
    is_python = called in ("range", "enumerate", "zip", "reversed")
    if is_python and (reader.names.constants.binds(called) or called in reader.locals):
        raise reader.unread(node, f'"{called}" is not the one of Python here')


def _certain(reader: ModelExpressionReader, node: Node, called: str) -> list[m.Expression]:
    """Each value that something goes through. Unread: one may not be there."""
    found = _elements(reader, node, called)
    if any(condition is not None for _, condition in found):
        raise reader.unread(node, f'nobody knows how many values "{called}" goes through here')
    return [value for value, _ in found]


def _comprehended(
    reader: ModelExpressionReader, node: Node
) -> Iterator[tuple[m.Expression, m.Expression | None]]:
    """`f(x) for x in values if condition`, of one loop and at most one condition."""
    body, *clauses = named(node)
    loops = [c for c in clauses if c.type == "for_in_clause"]
    tests = [named(c)[0] for c in clauses if c.type == "if_clause"]
    if len(loops) != 1 or len(tests) > 1 or not all(map(is_calm, (body, *tests))):
        raise reader.unread(node, "the model has no such expression")
    left, right = field(loops[0], "left"), field(loops[0], "right")
    names = [text_of(n) for n in (named(left) if left.type == "pattern_list" else [left])]
    for values in rows(reader, right, len(names)):
        with reader.standing_for(names, values):
            condition = reader.condition(tests[0]) if tests else None
            yield reader.read(body), condition


def is_calm(node: Node) -> bool:
    """Whether evaluating it changes nothing: it calls nothing but what is of Python or cuts."""
    if node.type == "named_expression":
        return False
    if node.type == "call" and text_of(field(node, "function")) not in _CALM:
        return False
    return all(map(is_calm, named(node)))


_CALM = frozenset({"abs", "min", "max", "bool", "int8", "int16", "int32", "divide", "remainder"})


def known_range(arguments: list[Node]) -> range | None:
    """What `range` gives for arguments that are numbers; None for others, and where it fails."""
    whole = [n for n in map(whole_number_of, arguments) if n is not None]
    is_known = 1 <= len(whole) == len(arguments) <= 3 and whole[2:] != [0]
    return range(*whole) if is_known else None


def rows(reader: ModelExpressionReader, node: Node, width: int) -> list[tuple[m.Expression, ...]]:
    """What a loop gives its variables, round by round."""
    called = text_of(field(node, "function")) if node.type == "call" else ""
    arguments = named(field(node, "arguments")) if called else []
    assert_of_python(reader, node, called)
    numbers = known_range(arguments) if called == "range" and width == 1 else None
    if numbers is not None and len(numbers) <= _MOST:
        return [(m.IntLiteral(n),) for n in numbers]
    if called == "enumerate" and width == 2 and 1 <= len(arguments) <= 2:
        values = _certain(reader, arguments[0], called)
        start = _start(arguments[1]) if len(arguments) > 1 else 0
        if start is not None:
            return [(m.IntLiteral(i), value) for i, value in enumerate(values, start)]
    if called == "zip" and width == len(arguments):
        each = [_certain(reader, a, called) for a in arguments]
        return list(zip(*each, strict=False))
    if width == 1 and node.type not in ("generator_expression", "list_comprehension"):
        return [(e,) for e in _certain(reader, node, called or "this")]
    raise reader.unread(node, "nobody knows what this goes through")


def _start(node: Node) -> int | None:
    """What `enumerate` counts from, given by place or by its name."""
    if node.type == "keyword_argument":
        node = field(node, "value") if text_of(field(node, "name")) == "start" else node
    return whole_number_of(node)


# --- values -------------------------------------------------------------------------------------


def _folded(
    reader: ModelExpressionReader,
    node: Node,
    called: str,
    given: Node,
    found: m.Expression | None = None,
) -> m.Expression:
    """`any`, `all` and `sum` of some elements, `found` before them."""
    if given.type == "list_comprehension" and called != "sum":
        raise reader.unread(node, "leave out the brackets: then it ends with the first that counts")
    for value, condition in _elements(reader, given, called):
        each = _counted(reader, node, called, value, condition)
        found = each if found is None else binary(_TESTS.get(called, "+"), found, each)
    if found is None:
        return m.IntLiteral(0) if called == "sum" else m.BoolLiteral(called == "all")
    return found


def _counted(
    reader: ModelExpressionReader,
    node: Node,
    called: str,
    value: m.Expression,
    condition: m.Expression | None,
) -> m.Expression:
    if called == "sum":
        kind = reader.kind(value)
        if kind == m.Type("boolean"):
            value = chosen(value, m.IntLiteral(1), m.IntLiteral(0))
        else:
            _assert_whole(reader, node, value)
        return value if condition is None else chosen(condition, value, m.IntLiteral(0))
    value = truth(reader, value)
    if condition is None:
        return value
    return (
        binary("&&", condition, value)
        if called == "any"
        else binary("||", negated(condition), value)
    )


def _extreme(
    reader: ModelExpressionReader, node: Node, called: str, values: list[m.Expression]
) -> m.Expression:
    """The least or greatest value, of equal ones the first."""
    kinds = {reader.kind(value) for value in values}
    if len(kinds) != 1 or kinds & {None, m.Type("boolean")} or not values:
        raise reader.unread(node, f'nobody knows of which type "{called}" is here')
    if not all(map(building.is_calm, values)):  # each is said more than once
        raise reader.unread(node, "what this compares is to be in a variable first")
    return _first(reader, node, called, values, lambda value: value)


def _first(
    reader: ModelExpressionReader,
    node: Node,
    called: str,
    values: list[m.Expression],
    measured: Callable[[m.Expression], m.Expression],
) -> m.Expression:
    """The first value of which what is measured is the least or greatest."""
    found, sign = values[0], "<" if called == "min" else ">"
    for value in values[1:]:
        if len(list(m.walk(found))) > _LARGEST:
            raise reader.unread(node, "the model compares two values at a time")
        found = chosen(binary(sign, measured(value), measured(found)), value, found)
    return found


def _best(
    reader: ModelExpressionReader, node: Node, called: str, given: Node, key: Node
) -> m.Expression:
    """The first value of which a function of it is the least or greatest."""
    function = field(key, "value")
    parameters = function.child_by_field_name("parameters")
    names = [text_of(n) for n in named(parameters)] if parameters is not None else []
    is_simple = text_of(field(key, "name")) == "key" and function.type == "lambda"
    body = field(function, "body") if is_simple else function
    if not is_simple or len(names) != 1 or not is_calm(body):
        raise reader.unread(node, "the model has no such expression")

    def measured(value: m.Expression) -> m.Expression:
        with reader.standing_for(names, [value]):
            read = reader.read(body)
        _assert_whole(reader, node, read)
        return read

    return _first(reader, node, called, [value for (value,) in rows(reader, given, 1)], measured)


def _as_int(reader: ModelExpressionReader, node: Node, read: m.Expression) -> m.Expression:
    if reader.kind(read) == m.Type("boolean"):
        return chosen(read, m.IntLiteral(1), m.IntLiteral(0))
    _assert_whole(reader, node, read)
    return read


def _assert_whole(reader: ModelExpressionReader, node: Node, read: m.Expression) -> None:
    if reader.kind(read) != m.Type("int"):
        raise reader.unread(node, "this is to be a whole number")


def _tight(read: m.Expression) -> m.Expression:
    is_small = isinstance(read, m.Name | m.Member | m.Index | m.Paren | m.Call)
    return read if is_small else m.Paren(read)
