"""The layout of generated Python: that of `ruff format` with the settings of the package.

Whoever formats a package that was generated shall find nothing to change. Line breaks are made
here alone: the writers give each statement in one line.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from rebsync.forward.py_documents import Document, printed
from rebsync.forward.py_shapes import arguments, assignment, bare, flat, shape, whole
from rebsync.forward.py_syntax import (
    Paren,
    Prefix,
    Tree,
    UnknownSyntax,
    tokens,
    tree,
)

LINE_LENGTH = 100
INDENT = "    "

_MARKED = re.compile(r"( *)(\S.*?)  (# rebsync: .*)")
_BRACKETS = {"(": 1, "[": 1, ")": -1, "]": -1}
_CHANGED = re.compile(r"\(\(|(?:= |return |if |while )\(")


def indented(lines: Iterable[str]) -> list[str]:
    """The lines, those with text moved to the right."""
    return [INDENT + line if line else line for line in lines]


def laid_out(lines: Iterable[str]) -> Iterator[str]:
    """Lines of one statement each, as ruff has them; markers that make one too long above it."""
    for line in lines:
        marked = _MARKED.fullmatch(line) if len(line) > LINE_LENGTH else None
        if marked is not None:
            yield f"{marked[1]}{marked[3]}"
            yield from _statement(f"{marked[1]}{marked[2]}")
        else:
            yield from _statement(line)


def formatted(text: str) -> str:
    """A text of statements of one line each, or that are broken as ruff does, as ruff has it."""
    return "\n".join(laid_out(text.split("\n")))


def _statement(line: str) -> Sequence[str]:
    """A statement; as it is where it has no layout of its own, or is of no known kind."""
    text = line.lstrip(" ")
    is_plain = len(line) <= LINE_LENGTH and not _CHANGED.search(text)
    if is_plain or text.startswith(("#", '"""', "class ", "import ", "from ")):
        return [line]
    try:
        document = _document(text)
    except UnknownSyntax:
        return [line]
    return printed(document, len(line) - len(text), LINE_LENGTH)


def _document(text: str) -> Document:
    found = tokens(text)
    match found[0]:
        case "def":
            return _definition(found)
        case "@":
            return "@", shape(tree(found[1:]), None)
        case "return" | "if" | "elif" | "while" as word:
            end = ":" if word != "return" else ""
            asked = found[1 : len(found) - len(end)]
            if end and found[-1] != end:
                raise UnknownSyntax(text)
            return f"{word} ", whole(_condition(tree(asked)) if end else bare(tree(asked))), end
        case "for":
            at = found.index("in")
            return f"for {' '.join(found[1:at])} in ", whole(bare(tree(found[at + 1 : -1]))), ":"
        case _:
            return _assignment(found)


def _condition(asked: Tree) -> Tree:
    """What a statement asks, which has no parentheses around it."""
    match bare(asked):
        case Paren(inner):
            return inner
        case other:
            return other


def _assignment(found: list[str]) -> Document:
    """An assignment, or an expression for what it does."""
    equals = _at_top(found, "=")
    if equals is None:
        comma = "," if found[-1] == "," else ""  # of an item on a line of its own
        return shape(tree(found[: len(found) - len(comma)]), None), comma
    value = bare(tree(found[equals + 1 :]))
    colon = _at_top(found[:equals], ":")
    if colon is None:
        return assignment("", tree(found[:equals]), value)
    annotation = tree(found[colon + 1 : equals])
    return assignment(f"{flat(tree(found[:colon]))}: ", annotation, value)


def _at_top(found: Sequence[str], wanted: str) -> int | None:
    """Where a token stands outside of all brackets."""
    depth = 0
    for i, token in enumerate(found):
        depth += _BRACKETS.get(token, 0)
        if token == wanted and not depth:
            return i
    return None


def _definition(found: list[str]) -> Document:
    """The head of a function: its parameters in one line, or each in its own."""
    end = max(i for i, token in enumerate(found) if token == "->")
    body = " ..." if found[-1] == "..." else ""
    parameters = _parted(found[3 : end - 1])
    returned = flat(tree(found[end + 1 : -2 if body else -1]))
    return f"def {found[1]}", arguments("(", parameters), f" -> {returned}:{body}"


def _parted(found: list[str]) -> tuple[Tree, ...]:
    """Parameters: names with types, and perhaps with defaults."""
    parameters: list[Tree] = []
    while found:
        comma = _at_top(found, ",")
        own = found[:comma]
        match own:
            case [name]:
                parameters.append(tree([name]))
            case [name, ":", *type_]:
                equals = _at_top(type_, "=")
                typed = Prefix(f"{name}: ", tree(type_[:equals]))
                if equals is not None:
                    typed = Prefix(f"{flat(typed)} = ", tree(type_[equals + 1 :]))
                parameters.append(typed)
            case _:
                raise UnknownSyntax(" ".join(own))
        found = [] if comma is None else found[comma + 1 :]
    return tuple(parameters)
