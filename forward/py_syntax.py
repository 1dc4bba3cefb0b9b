"""Statements and expressions of Python that were just written, as trees: for their layout."""

from __future__ import annotations

import re
from dataclasses import field
from typing import TypeAlias

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Atom:
    """A name or literal."""

    text: str


@dataclass(frozen=True, slots=True)
class Attribute:
    """`value.name`."""

    value: Tree
    name: str


@dataclass(frozen=True, slots=True)
class Call:
    """`function(items)`."""

    function: Tree
    items: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Subscript:
    """`value[items]`."""

    value: Tree
    items: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Display:
    """A list, or a tuple in parentheses."""

    opening: str
    items: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Paren:
    """`(inner)`."""

    inner: Tree


@dataclass(frozen=True, slots=True)
class Prefix:
    """`not x`, `-x`, `name=x`, `name := x` or `lambda: x`: something with words before it."""

    words: str
    operand: Tree


@dataclass(frozen=True, slots=True)
class Operation:
    """`left operator right`; `level` is how tightly it binds."""

    operator: str
    left: Tree
    right: Tree
    level: int


@dataclass(frozen=True, slots=True)
class Conditional:
    """`then if condition else otherwise`."""

    then: Tree
    condition: Tree
    otherwise: Tree


Tree: TypeAlias = (
    "Atom | Attribute | Call | Subscript | Display | Paren | Prefix | Operation | Conditional"
)

_TOKEN = re.compile(
    r"""\ *(?:(?P<string>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
    |(?P<number>\d[\d_.]*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?)
    |(?P<name>\w+)
    |(?P<sign>\.\.\.|:=|->|==|!=|<=|>=|<<|>>|\*\*|//|[-+*/%&|^~<>=()\[\]{},.:;@]))""",
    re.VERBOSE,
)
COMPARISON = 4
LEVELS = {
    "or": 1,
    "and": 2,
    **dict.fromkeys(("==", "!=", "<", "<=", ">", ">=", "in", "is"), COMPARISON),
    "|": 5,
    "^": 6,
    "&": 7,
    **dict.fromkeys(("<<", ">>"), 8),
    **dict.fromkeys(("+", "-"), 9),
    **dict.fromkeys(("*", "/", "//", "%"), 10),
}
_NOT, _UNARY = 3, 11
_KEYWORDS = frozenset({"if", "else", "for", "await", "yield", "from", "lambda", "not"})


class UnknownSyntax(ValueError):
    """Something that no generated statement has."""


def tokens(text: str) -> list[str]:
    """The tokens of a line without a comment."""
    found, at, end = [], 0, len(text.rstrip())
    while at < end:
        match = _TOKEN.match(text, at)
        if match is None:
            raise UnknownSyntax(text)
        found.append(match[0].strip())
        at = match.end()
    return found


def tree(of: list[str]) -> Tree:
    """The tree of an expression; raises `UnknownSyntax` for what is none of a known kind."""
    reader = _Reader([*of, ""])
    found = reader.expression()
    if reader.next:
        raise UnknownSyntax(reader.next)
    return found


@dataclass(slots=True)
class _Reader:
    tokens: list[str]
    at: int = field(default=0)

    @property
    def next(self) -> str:
        return self.tokens[self.at]

    def take(self, wanted: str = "") -> str:
        found = self.next
        if not found or (wanted and found != wanted):
            raise UnknownSyntax(found)
        self.at += 1
        return found

    def expression(self) -> Tree:
        """A conditional expression, or what binds more tightly."""
        if self.next == "lambda":
            self.take()
            self.take(":")
            return Prefix("lambda: ", self.expression())
        found = self.operation(1)
        if self.next != "if":
            return found
        self.take()
        condition = self.operation(1)
        self.take("else")
        return Conditional(found, condition, self.expression())

    def operation(self, least: int) -> Tree:
        """Operators that bind at least so tightly."""
        found = self.prefix(least)
        while (level := LEVELS.get(self.next, 0)) >= least:
            operator = self.take()
            found = Operation(operator, found, self.operation(level + 1), level)
        return found

    def prefix(self, least: int) -> Tree:
        """`not` where it may stand, signs, and what they are before."""
        if self.next == "not" and least <= _NOT:
            self.take()
            return Prefix("not ", self.operation(_NOT))
        if self.next in ("-", "+", "~"):
            return Prefix(self.take(), self.prefix(_UNARY))
        return self.postfix()

    def postfix(self) -> Tree:
        """Attributes, calls and subscripts."""
        found = self.primary()
        while self.next in (".", "(", "["):
            match self.take():
                case ".":
                    found = Attribute(found, self.take())
                case "(":
                    found = Call(found, self.items(")"))
                case _:
                    found = Subscript(found, self.items("]"))
        return found

    def primary(self) -> Tree:
        """A name, a literal, or something in brackets."""
        token = self.take()
        if token == "[":
            return Display("[", self.items("]"))
        if token == "(":
            items = self.items(")")
            is_tuple = len(items) != 1 or self.tokens[self.at - 2] == ","
            return Display("(", items) if is_tuple else Paren(items[0])
        if token in _KEYWORDS or token in LEVELS or not (token[0].isalnum() or token[0] in "_\"'"):
            raise UnknownSyntax(token)
        return Atom(token)

    def items(self, closing: str) -> tuple[Tree, ...]:
        """What stands between brackets, up to and with the closing one."""
        found: list[Tree] = []
        while self.next != closing:
            found.append(self.item())
            if self.next != closing:
                self.take(",")
        self.take()
        return tuple(found)

    def item(self) -> Tree:
        """An expression, which may have a name before it."""
        following = self.tokens[self.at + 1 : self.at + 2]
        if following == ["="]:
            return Prefix(f"{self.take()}{self.take()}", self.expression())
        if following == [":="]:
            return Prefix(f"{self.take()} {self.take()} ", self.expression())
        return self.expression()
