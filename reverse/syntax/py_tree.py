"""Python text to a syntax tree, with places in the text as the rest of rebsync counts them.

The grammar reads what both generations of Python write: `print` as a statement, backticks, `<>`.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterator
from functools import cache
from itertools import islice
from unicodedata import is_normalized, normalize

import tree_sitter_python
from tree_sitter import Language, Node, Parser

from rebsync.records import dataclass
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.syntax.cpp_tree import Cpp, byte_places
from rebsync.reverse.syntax.cpp_words import Plain
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.unparsed import NO_PYTHON
from rebsync.source import Source

# What has names of its own within a module.
SCOPES = frozenset({"function_definition", "lambda", "class_definition"})
_HINT = "mend the syntax, so that the whole file can be read"
_SHOWN = 3  # places that are listed for one file; a text that is no Python has very many
_ESCAPE = re.compile(r"\\(\r?\n|x[0-9a-fA-F]{2}|u[0-9a-fA-F]{4}|[0-7]{1,3}|.)", re.DOTALL)
_NAMED_CHARACTER = re.compile(r"\\[NU]")
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r", "a": "\a", "b": "\b", "f": "\f", "v": "\v"}


@dataclass(frozen=True)
class Py(Cpp):
    """One file of Python and its tree, with the same places as one of C++."""


@cache
def _parser() -> Parser:
    return Parser(Language(tree_sitter_python.language()))


def parse(source: Source, is_beside: bool = False) -> Py:
    """The tree of a file; where the text is no Python it has error nodes.

    `is_beside`: the file is of another package than what is read.
    """
    data = source.text.encode("utf-8", "surrogatepass")
    root = _parser().parse(data).root_node
    places = byte_places(source.text, data)
    return Py(source, root, Plain(data), places, is_beside=is_beside)


def unparsed(py: Py) -> list[Finding]:
    """The places where a file is no Python, or reads otherwise: that is not in the model."""
    return [*_mistakes(py), *islice(_renamed(py), _SHOWN)]


def _renamed(py: Py) -> Iterator[Finding]:
    """Names that Python takes for others: it reads all in the normal form NFKC."""
    if is_normalized("NFKC", py.source.text):
        return
    for node in nodes_in(py.root):
        name = text_of(node) if node.type == "identifier" else ""
        if (other := normalize("NFKC", name)) != name:
            why = f'Python takes this name for "{other}"'
            yield Finding(Grade.UNREADABLE, py.source, py.span(node), why, f'write "{other}"')


def _mistakes(py: Py) -> list[Finding]:
    found: list[Finding] = []
    waiting = [py.root]
    while waiting and len(found) < _SHOWN:
        node = waiting.pop()
        if node.type == "ERROR" or node.is_missing:
            found.append(Finding(Grade.UNREADABLE, py.source, py.span(node), NO_PYTHON, _HINT))
        elif node.has_error:
            waiting += reversed(node.children)
    return found


def text_of(node: Node) -> str:
    """The text of a node."""
    text = node.text
    return text.decode("utf-8", "replace") if text else ""


_EXTRAS = ("comment", "line_continuation")


def named(node: Node) -> list[Node]:
    """The named children of a node but for comments and the ends of lines that go on."""
    return [c for c in node.named_children if c.type not in _EXTRAS]


def field(node: Node, name: str) -> Node:
    """The child that the grammar promises; the node itself where a broken text lacks it."""
    return node.child_by_field_name(name) or node


def string_parts(node: Node) -> list[str | Node]:
    """The texts of a string, and the expressions within a formatted one, in their order."""
    start = node.children[0]
    prefix = text_of(start).rstrip("\"'`").lower()
    found: list[str | Node] = []
    for child in node.children[1:]:
        if child.type == "interpolation":
            found.append(child)
        elif child.type == "string_content":
            found += _content(child, "r" in prefix, "f" in prefix)
    return found


def is_literal_text(node: Node) -> bool:
    """Whether it is a text, whatever stands in it."""
    return node.type in ("string", "concatenated_string")


def is_constant_text(node: Node) -> bool:
    """Whether it is a text in which nothing is evaluated: a documentation, as a statement."""
    pieces = named(node) if node.type == "concatenated_string" else [node]
    inner = (c.type for piece in pieces for c in piece.children)
    return is_literal_text(node) and "interpolation" not in inner


def text_in(node: Node) -> str | None:
    """The text that a literal is; None of bytes, formatted ones and names of characters."""
    if node.type == "concatenated_string":
        pieces = [text_in(piece) for piece in named(node)]
        return None if None in pieces else "".join(p for p in pieces if p is not None)
    if node.type != "string":
        return None
    prefix = text_of(node.children[0]).rstrip("\"'`").lower()
    parts = string_parts(node)
    texts = [part for part in parts if isinstance(part, str)]
    is_plain = "b" not in prefix and len(texts) == len(parts)
    is_known = "r" in prefix or not _NAMED_CHARACTER.search(text_of(node))
    whole = "".join(texts)
    is_known = is_known and whole[:1] != "\1" and "\0" not in whole
    return whole if is_plain and is_known else None


def _content(node: Node, is_raw: bool, is_formatted: bool) -> list[str | Node]:
    text = text_of(node)
    if is_formatted:
        text = text.replace("{{", "{").replace("}}", "}")
    return [text if is_raw or "\\" not in text else _ESCAPE.sub(_escaped, text)]


def _escaped(match: re.Match[str]) -> str:
    text = match[1]
    if text[0] in "xu" and len(text) > 1:
        return chr(int(text[1:], 16))
    if text.isdigit():
        return chr(int(text, 8))
    if text.endswith("\n"):
        return ""
    return _ESCAPED.get(text, text if text in "\\'\"" else "\\" + text)


TOO_LARGE = 10**300  # larger whole numbers are no floats, larger floats infinite


def number_of(node: Node) -> int | float | None:
    """The number that a literal says, Python 2's `0777` and `10L` included; None: no such."""
    text = text_of(node).replace("_", "").rstrip("lL")
    try:
        if node.type == "float":
            value: int | float = float(text)
        elif re.fullmatch(r"0[0-7]+", text):
            value = int(text, 8)
        else:
            value = int(text, 0)
    except ValueError:
        return None
    return value if abs(value) < TOO_LARGE else None


def whole_number_of(node: Node) -> int | None:
    """The whole number that a literal says; None where it is no such literal, or imaginary."""
    number = number_of(node) if node.type == "integer" else None
    return number if isinstance(number, int) else None


def decorating(definition: Node) -> list[Node]:
    """The decorators of a function or class."""
    above = definition.parent
    if above is None or above.type != "decorated_definition":
        return []
    return [c for c in above.children if c.type == "decorator"]


def decorators_of(definition: Node) -> list[str]:
    """The decorators of a function or class, as they are written."""
    return [text_of(c).lstrip("@ ") for c in decorating(definition)]


def calls_in(node: Node) -> Iterator[Node]:
    """All calls in a part of the code."""
    return (n for n in nodes_in(node) if n.type == "call")


def is_label(node: Node) -> bool:
    """Whether a name is that of an attribute or of an argument."""
    above = node.parent
    part = {"attribute": "attribute", "keyword_argument": "name"}
    name = part.get(above.type) if above is not None else None
    return above is not None and name is not None and above.child_by_field_name(name) == node


def is_asked(node: Node, asking: Container[str] = ()) -> bool:
    """Whether only the truth of an expression matters where it stands: in a condition, or where
    one of these functions is given it.
    """
    above = node.parent
    while above is not None and above.type in ("parenthesized_expression", "boolean_operator"):
        node, above = above, above.parent
    if above is None or above.type in ("not_operator", "assert_statement", "if_clause"):
        return above is not None
    if above.type == "conditional_expression":
        return named(above)[1] == node
    call = above.parent if above.type in ("argument_list", "generator_expression") else None
    if call is not None and call.type == "call":
        return text_of(field(call, "function")).rpartition(".")[2] in asking
    return above.child_by_field_name("condition") == node
