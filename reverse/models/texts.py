"""Texts as whole numbers of the model: an enumeration of the texts that code names.

While bodies are read a text is a string literal, and what holds one is of the type `TEXT`. At the
end each text that occurs becomes a number (`enumerated`), the empty one 0; `OTHER` stands for all
texts that occur nowhere. That is exact for copies, and for comparisons of which one side is a text
that occurs. Two variables that both hold `OTHER` may be equal or not: a choice (`same`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field, replace
from typing import TypeVar

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.models.building import bare, binary
from rebsync.reverse.models.rewriting import rewritten
from rebsync.source import NOWHERE, Span
from rebsync.static.types import INT

_Part = TypeVar("_Part", bound=m.Node)

TEXT = m.Type("text")
OTHER = -1  # all texts that occur nowhere
_NOTHING = -2  # Python's None, in a variable of texts
MEMBER = "\1"  # begins the name of a member of an enumeration, which no text is equal to
# What no code can name, as no text of ROS has this character.
_OTHER, _NONE, _ANY = "\0other", "\0none", "\0any"
_EITHER = m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)))


# --- while bodies are read ----------------------------------------------------------------------


def text_literal(text: str, span: Span = NOWHERE) -> m.StringLiteral:
    """A text that the code names."""
    return m.StringLiteral(f'"{text}"', span)


def is_text(text: str) -> bool:
    """Whether what the model tells apart is a text, and no member of an enumeration."""
    return not text.startswith(MEMBER)


def is_plain(literal: str) -> bool:
    """Whether a literal is a text as it stands, and not one of those that mean something else."""
    return literal[1:2] not in ("\0", MEMBER)


def shown(text: str) -> str:
    """A text, or the member of an enumeration, as people write it."""
    return text if is_text(text) else text.rpartition(":")[2]


def any_text() -> m.StringLiteral:
    """A text of which nothing is known: a choice of all."""
    return text_literal(_ANY)


def no_text() -> m.StringLiteral:
    """Python's None where there may be a text: equal to none."""
    return text_literal(_NONE)


def is_constant(expression: m.Expression) -> bool:
    """Whether an expression gives nothing but texts that the code names."""
    match bare(expression):
        case m.StringLiteral(text):
            return text[1:-1] not in (_OTHER, _ANY)
        case m.Conditional(_, then, otherwise):
            return is_constant(then) and is_constant(otherwise)
        case _:
            return False


def same(left: m.Expression, right: m.Expression, span: Span = NOWHERE) -> m.Expression:
    """Whether two texts are equal; a choice where both may be among those that occur nowhere.

    Operands that are no constants may be evaluated twice.
    """
    equal = binary("==", left, right, span)
    if is_constant(left) or is_constant(right):
        return equal
    known = binary("!=", left, text_literal(_OTHER))
    return binary("&&", equal, m.Paren(binary("||", known, _EITHER)), span)


# --- at the end ---------------------------------------------------------------------------------


@dataclass(slots=True)
class _Enumeration:
    """Numbers texts in the order in which they occur."""

    numbers: dict[str, int] = field(default_factory=dict)

    def number(self, text: str) -> m.Expression:
        if text in (_OTHER, _NONE):
            return m.Unary("-", m.IntLiteral(-OTHER if text == _OTHER else -_NOTHING))
        return m.IntLiteral(self.numbers.setdefault(text, len(self.numbers)))

    def every(self) -> m.Expression:
        """A choice of all texts."""
        numbers = [m.IntLiteral(n) for t, n in self.numbers.items() if is_text(t)]
        return m.Choice((*numbers, self.number(_OTHER)))


def text_variables(owner: m.ReactiveClass) -> Iterator[tuple[str, str, str]]:
    """The state variables, and parameters of servers, that hold texts: class, server, name."""
    for member in owner.members:
        match member:
            case m.StateVars(declarations):
                for declaration in (d for d in declarations if d.type == TEXT):
                    yield from ((owner.name, "", d.name) for d in declaration.declarators)
            case m.MessageServer(name, parameters):
                yield from ((owner.name, name, p.name) for p in parameters if p.type == TEXT)
            case _:
                pass


def enumerated(parts: Sequence[_Part], known: Iterable[str] = ()) -> tuple[list[_Part], list[str]]:
    """Parts of a model with numbers in the place of texts, and the texts by their numbers.

    Those that are `known` keep their numbers; `assertion` keeps its text.
    """
    numbers = _Enumeration()
    for text in ("", *known):
        numbers.number(text)
    kept: set[int] = set()

    def change(node: object) -> object:
        match node:
            case m.StringLiteral(text) if id(node) not in kept and text[1:-1] != _ANY:
                number = numbers.number(text[1:-1])
                return replace(number, span=node.span)
            case m.Declaration() | m.Parameter() | m.Method() if node.type.name == TEXT.name:
                return replace(node, type=replace(node.type, name=INT.name))
            case _:
                return node

    def choose(node: object) -> object:
        match node:
            case m.StringLiteral() if id(node) not in kept:
                return replace(numbers.every(), span=node.span)
            case _:
                return node

    done = []
    for part in parts:
        calls = (n for n in m.walk(part) if isinstance(n, m.Call) and n.name == "assertion")
        kept |= {id(a) for call in calls for a in call.arguments}
        done.append(rewritten(part, change))
    return [rewritten(part, choose) for part in done], list(numbers.numbers)
