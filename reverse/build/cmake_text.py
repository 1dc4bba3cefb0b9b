"""The text of CMake files as commands in blocks, before any variable has a value."""

from __future__ import annotations

import re
from enum import Enum
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source, Span

_DEEPEST = 50
_SPACE = re.compile(r"(?:\s+|#\[(=*)\[.*?\]\1\]|#[^\n]*)*", re.DOTALL)
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_OPEN = re.compile(r"[ \t]*\(")
_BRACKET = re.compile(r"\[(=*)\[\n?(.*?)\]\1\]", re.DOTALL)
_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_UNQUOTED = re.compile(r'(?:[^\s()#"\\]|\\.|"(?:[^"\\]|\\.)*")+', re.DOTALL)
_BLOCKS = {"if": "endif", "foreach": "endforeach", "while": "endwhile"}
_BLOCKS |= {"function": "endfunction", "macro": "endmacro"}


class Quote(Enum):
    """How an argument is written, which says what is replaced in it and whether it is split."""

    NONE = "a list of words"
    DOUBLE = "one text"
    BRACKET = "one text, as it stands"


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument of a command, without its quotes."""

    text: str
    quote: Quote
    span: Span


@dataclass(frozen=True, slots=True)
class Command:
    """A command; its name is in lower case. Parentheses inside are arguments of their own."""

    name: str
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class CommandBlock:
    """A command that opens a block, and what is in it.

    For `if` also the other branches: each begins with its `elseif` or `else`.
    """

    head: Command
    body: tuple[Item, ...]
    others: tuple[tuple[Command, tuple[Item, ...]], ...] = ()


Item: TypeAlias = "Command | CommandBlock"


@dataclass(frozen=True, slots=True)
class CMakeText:
    """The commands of a file, as far as it can be read."""

    items: tuple[Item, ...]
    unknowns: tuple[Unknown, ...]


class _Malformed(Exception):
    def __init__(self, why: str, span: Span) -> None:
        super().__init__(why)
        self.span = span


def read_cmake(source: Source) -> CMakeText:
    """The commands of a CMake file; what follows a mistake is not read."""
    commands: list[Command] = []
    unknowns: tuple[Unknown, ...] = ()
    try:
        at = _skip(source.text, 0)
        while at < len(source.text):
            command = _command(source.text, at)
            commands.append(command)
            at = _skip(source.text, command.span.end)
    except _Malformed as mistake:
        unknowns = (Unknown("the rest of the file", str(mistake), source, mistake.span),)
    try:
        nesting = _Nesting(commands)
        items = nesting.items(until=frozenset(), depth=0)
    except _Malformed as mistake:
        why = Unknown("the blocks of the file", str(mistake), source, mistake.span)
        return CMakeText((), (*unknowns, why))
    return CMakeText(items, unknowns)


def _skip(text: str, at: int) -> int:
    if at < len(text) and text[at] != "#" and not text[at].isspace():
        return at
    match = _SPACE.match(text, at)
    return match.end() if match else at


def _command(text: str, start: int) -> Command:
    name = _NAME.match(text, start)
    opening = _OPEN.match(text, name.end()) if name else None
    if name is None or opening is None:
        raise _Malformed("here a command is wanted: a name, then `(`", Span(start, start + 1))
    arguments: list[Argument] = []
    depth, at = 1, _skip(text, opening.end())
    while at < len(text):
        if text[at] in "()":
            depth += 1 if text[at] == "(" else -1
            if depth == 0:
                return Command(name[0].lower(), tuple(arguments), Span(start, at + 1))
            arguments.append(Argument(text[at], Quote.NONE, Span(at, at + 1)))
            at += 1
        else:
            arguments.append(_argument(text, at))
            at = arguments[-1].span.end
        at = _skip(text, at)
    raise _Malformed(f"`{name[0]}(` is not closed", Span(start, opening.end()))


def _argument(text: str, at: int) -> Argument:
    first = text[at]
    if first == "[" and (match := _BRACKET.match(text, at)):
        return Argument(match[2], Quote.BRACKET, Span(at, match.end()))
    if first == '"' and (match := _QUOTED.match(text, at)):
        return Argument(match[1], Quote.DOUBLE, Span(at, match.end()))
    if match := _UNQUOTED.match(text, at):
        return Argument(match[0], Quote.NONE, Span(at, match.end()))
    raise _Malformed("this text is not closed", Span(at, at + 1))


class _Nesting:
    """Puts commands into blocks."""

    def __init__(self, commands: list[Command]) -> None:
        self._commands = commands
        self._at = 0

    def items(self, until: frozenset[str], depth: int) -> tuple[Item, ...]:
        """The items up to one of these commands, which is not taken."""
        items: list[Item] = []
        while self._at < len(self._commands):
            command = self._commands[self._at]
            if command.name in until:
                return tuple(items)
            if command.name in _BLOCKS.values() or command.name in ("else", "elseif"):
                raise _Malformed(f"`{command.name}` without its beginning", command.span)
            self._at += 1
            items.append(self._block(command, depth) if command.name in _BLOCKS else command)
        if until:
            raise _Malformed(f"no `{min(until)}` follows", self._commands[-1].span)
        return tuple(items)

    def _block(self, head: Command, depth: int) -> CommandBlock:
        if depth >= _DEEPEST:
            raise _Malformed("blocks nested this deeply are not read", head.span)
        end = _BLOCKS[head.name]
        middle = {"elseif", "else"} if head.name == "if" else set()
        until = frozenset({end, *middle})
        body = self.items(until, depth + 1)
        others: list[tuple[Command, tuple[Item, ...]]] = []
        while (command := self._commands[self._at]).name != end:
            self._at += 1
            others.append((command, self.items(until, depth + 1)))
        self._at += 1
        return CommandBlock(head, body, tuple(others))
