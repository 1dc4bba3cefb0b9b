"""What generated Python asks of its mailbox, and how it sends, as the model has it."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import original
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.libraries.tables.runtime import names_in_model
from rebsync.reverse.models.building import bare, cell
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.arguments import in_order
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.overloads import told
from rebsync.reverse.python.generated.py_types import string_value
from rebsync.reverse.python.generated.roles import PySends
from rebsync.reverse.python.generated.tuples import parts
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_tree import named, text_of

# What functions that send call the time, and what says that it is at once.
TIME = "when"
_AT_ONCE = frozenset({"AT_ONCE", "When()"})
_CLOCK = names_in_model(Language.PYTHON)


def of_mailbox(
    reader: ModelExpressionReader, node: Node, name: str, arguments: list[Node]
) -> m.Expression:
    """What a function of the mailbox gives or does. Unread: the model has no such thing."""
    span = reader.py.span(node)
    match name, len(arguments):
        case "self", 0:
            return m.Self(span)
        case _, 0 if name in _CLOCK:
            return m.Name(_CLOCK[name], span)
        case "choose", 1 | 2 if arguments[0].type in ("list", "tuple"):
            return m.Choice(tuple(map(reader.expression, named(arguments[0]))), span)
        case "choose", 1 | 2 if options := _constants(reader, text_of(arguments[0])):
            return m.Choice(options, span)
        case "is_a", 2:
            type_ = m.Type(original(string_value(arguments[1]) or ""))
            return m.InstanceOf(reader.expression(arguments[0]), type_, span)
        case "delay" | "assertion", _:
            return m.Call(None, name, tuple(map(reader.expression, arguments)), span=span)
        case "post", 4:
            return _posted(reader, node)
        case _:
            raise reader.unread(node, f'the model has no function "{name}"')


def _constants(reader: ModelExpressionReader, name: str) -> tuple[m.Expression, ...]:
    """The elements of a constant tuple or list."""
    return reader.names.constants.elements(name) if name not in reader.locals else ()


def _posted(reader: ModelExpressionReader, node: Node) -> m.Expression:
    """`self._mailbox.post(_P, When(), "", self.p)`, which a function that sends does as well."""
    post = reader.names.posts.get(node.id)
    if post is None:
        why = "this is no server with its priority, the function that serves it, and its arguments"
        raise reader.unread(node, why)
    if not post.is_held:
        raise reader.unread(node, "this is evaluated when it is served: send it by `send_self_...`")
    times, span = idioms.times(reader, post.when), reader.py.span(node)
    given = tuple(map(reader.expression, post.given))
    after, deadline = times.get("after"), times.get("deadline")
    call = m.Call(m.Self(span), post.server, given, after, deadline, span)
    return reader.cuts.passing(call, post.handler)


def sent(
    reader: ModelExpressionReader, node: Node, sends: PySends, arguments: list[Node]
) -> m.Expression:
    """What a function that sends is given, as a send of the model."""
    span, is_to_any = reader.py.span(node), sends.known is None
    expected = sends.arguments + is_to_any
    arguments = in_order(reader, node, arguments, sends.parameters)
    rest = arguments[is_to_any:]
    values: list[m.Expression] = []
    target: m.Expression = m.Self(span)
    if sends.known is None and arguments:
        target = _receiver(reader, arguments[0])
    elif sends.known is not None and sends.known != "self":
        target = m.Name(sends.known, span)
    while rest and len(values) < sends.arguments:
        values += unpacked(reader, rest.pop(0))
    if len(values) != sends.arguments or len(rest) > 1 or len(arguments) < is_to_any:
        raise reader.unread(node, f"this sends with {expected} arguments")
    times = idioms.times(reader, rest[0]) if rest else _by_default(reader, node, sends)
    given = told(reader, node, sends, tuple(values))
    return m.Call(target, sends.server, given, times.get("after"), times.get("deadline"), span)


def _by_default(
    reader: ModelExpressionReader, node: Node, sends: PySends
) -> dict[str, m.Expression]:
    """The time of a send for which nothing is said, which is the same at any time."""
    default = next((p.default for p in sends.parameters if p.name == TIME), None)
    if default is None:
        raise reader.unread(node, "nobody says when this is to arrive")
    if text_of(default) in _AT_ONCE:
        return {}
    module = climb(default, lambda each: each.type == "module")
    found = idioms.times(reader.inside({}), default)
    is_same = all(isinstance(time, m.IntLiteral) for time in found.values())
    if not is_same or module is None or module.id != reader.py.root.id:
        raise reader.unread(node, "this may arrive at another time")
    return found


def unpacked(reader: ModelExpressionReader, node: Node) -> list[m.Expression]:
    """One argument, or the elements of an array behind a star."""
    if node.type != "list_splat":
        return [reader.expression(node)]
    elements = parts(reader, named(node)[0])
    if elements is None:
        raise reader.unread(node, "nobody knows how many values this gives")
    return elements


def _receiver(reader: ModelExpressionReader, node: Node) -> m.Expression:
    """Who gets a message: what is no name or call stands in parentheses."""
    found = reader.expression(node)
    return m.Paren(found) if isinstance(found, (m.Cast, m.Conditional, m.Choice)) else found


def moved(reader: ModelExpressionReader, call: Node, arguments: list[Node]) -> m.Empty:
    """What the drive is told: along x, and along y."""
    by = [(found, node) for node in arguments for found in unpacked(reader, node)]
    if len(by) != 2:
        raise reader.unread(call, "this moves along x and along y")
    cells = tuple(_cell(axis, *each) for axis, each in zip("XY", by, strict=True))
    span = reader.py.span(call)
    return m.Empty((m.Annotation("Move", cells, span),), span)


def _cell(axis: str, by: m.Expression, node: Node) -> m.Expression:
    found = bare(by)
    if isinstance(found, m.Unary) and node.type != "unary_operator":
        return m.Binary("+", m.Name(axis), found)
    return cell(axis, found)
