"""What of a file the parser could not see as the compiler will: listed, with the place.

These are places that are no C++ to the parser, and alternatives of `#if` of which it is not known
which one is compiled.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.files.packages import HEADERS
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.libraries.cpp import scopes, telling_words
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_conditions import IfSection, alternatives
from rebsync.reverse.syntax.cpp_declarations import only_braces
from rebsync.reverse.syntax.cpp_text import has_alternatives, is_split, read_branch
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.reverse.syntax.misread import misread
from rebsync.source import Span

NO_CPP = "this is no C++ that can be read"
NO_PYTHON = "this is no Python that can be read"
_LONGEST = 120
_WORD = re.compile(r"\w+")
_DIRECTIVES = re.compile(r"^[ \t]*#(?:[^\n\\]|\\(?:\r?\n)?)*", re.MULTILINE)
_INCLUDES = re.compile(rb"#[ \t]*(?:include|import)")  # also `#include_next`
# In these an include is no list of declarations for the file.
_SCOPES = frozenset(
    {"compound_statement", "field_declaration_list", "enumerator_list", "initializer_list"}
    | {"parameter_list", "argument_list", "function_definition", "init_declarator"}
)
_HINT = "where only one is ever compiled, take the others out"


def unparsed(cpp: Cpp) -> Iterator[Finding]:
    """The places of a file that are not read as they will be compiled, in no order."""
    for start, end in cpp.deep:
        why = "this nests deeper than rebsync reads"
        span = _first_line(cpp, cpp.characters(start, end))
        yield Finding(
            Grade.UNREADABLE, cpp.source, span, why, "give parts of it names of their own"
        )
    if cpp.root.has_error:
        yield from (_error(cpp, node) for node in errors_in(cpp))
    if has_alternatives(cpp.source.text):
        yield from _alternatives(cpp)
    yield from _included_code(cpp)
    yield from misread(cpp)


# --- files that are included --------------------------------------------------------------------


def _included_code(cpp: Cpp) -> Iterator[Finding]:
    """Where a file is included that is not read as a header at that place."""
    for directive in _INCLUDES.finditer(cpp.data):
        word = cpp.root.descendant_for_byte_range(*directive.span())
        node = word.parent if word is not None else None
        if node is None or node.type not in ("preproc_include", "preproc_call"):
            continue
        named_ = node.child_by_field_name("path")
        path = text_of(named_) if named_ is not None else ""
        is_inner = any(above.type in _SCOPES for above in ancestors(node))
        is_bare = path.startswith("<") and "." not in path.rpartition("/")[2]  # as <vector> is
        is_header = is_bare or path.strip('"<>').endswith(tuple(HEADERS))
        if is_inner or not is_header:
            why = "what this includes is not read at this place"
            hint = "include headers at the top of a file" if is_inner else "name it a header: .hpp"
            yield Finding(Grade.UNREADABLE, cpp.source, _first_line(cpp, cpp.span(node)), why, hint)


# --- what is no C++ -----------------------------------------------------------------------------


def errors_in(cpp: Cpp) -> Iterator[Node]:
    """The outermost nodes that say that the text is no C++, one for each line."""
    waiting = [cpp.root]
    lines = set[int]()
    while waiting:
        node = waiting.pop()
        if node.is_error or node.is_missing:
            if not _harmless(node) and node.start_point.row not in lines:
                lines.add(node.start_point.row)
                yield node
        elif node.has_error:
            waiting += reversed(node.children)


def _harmless(node: Node) -> bool:
    """Whether what is missing says nothing.

    The `;` after a macro or after `void f() { {} }`, the name of an instantiation, and the type
    that the grammar wants before the braces of a default argument.
    """
    parent = node.parent
    if not node.is_missing or parent is None:
        return False
    if parent.type == "template_instantiation" or only_braces(parent):
        return True
    if parent.type == "compound_literal_expression" and parent.parent is not None:
        return parent.parent.type == "optional_parameter_declaration"
    at_top = parent.parent is None or parent.parent.type in ("translation_unit", "declaration_list")
    first = parent.named_children[0] if parent.named_children else None
    return at_top and node.type == ";" and first is not None and first.type == "call_expression"


def _error(cpp: Cpp, node: Node) -> Finding:
    why = f"{NO_CPP}: a macro may hide it, or a `;` before it is missing"
    if node.is_missing:
        why = f"{NO_CPP}: `{node.type}` is missing"
    return Finding(Grade.UNREADABLE, cpp.source, _first_line(cpp, cpp.span(node)), why)


def _first_line(cpp: Cpp, span: Span) -> Span:
    """The start of a place, at least one character."""
    text = cpp.source.text
    line_end = text.find("\n", span.start)
    end = min(span.end, span.start + _LONGEST, line_end if line_end >= 0 else len(text))
    return Span(span.start, max(end, min(span.start + 1, len(text))))


# --- alternatives -------------------------------------------------------------------------------


def _alternatives(cpp: Cpp) -> Iterator[Finding]:
    """Those of which it is not known what is compiled, and that hold code; not those within."""
    plain, every = alternatives(cpp.source.text)
    done: list[tuple[int, int]] = []
    for each in reversed(every):
        start, end = each.directives[0][0], each.directives[-1][1]
        while done and done[-1][0] > start:
            done.pop()
        if done and end <= done[-1][1]:
            continue
        if each.decided:
            done += [(b.start, b.end) for b in each.branches if not b.taken]
        else:
            done.append((start, end))
            yield from _undecided(cpp, plain, each)


def _undecided(cpp: Cpp, plain: str, each: IfSection) -> Iterator[Finding]:
    code = [_DIRECTIVES.sub("", plain[b.start : b.end]) for b in each.branches]
    if not any(text.strip() for text in code):
        return
    start, end = each.directives[0]
    span = Span(start, start + len(plain[start:end].rstrip()))
    if is_split(plain, each):
        which = "none" if read_branch(each) is None else "one"
        why = f"of the alternatives of `{each.condition}` {which} is read: they overlap other code"
        yield Finding(Grade.UNREADABLE, cpp.source, span, why, _HINT)
        return
    if _in_body(cpp, each) and not any(map(_asks, code)):
        return  # the reader of the body lists it
    why = f"whether `{each.condition}` holds is not known: all alternatives are read"
    yield Finding(Grade.ASSUMED, cpp.source, span, why, _HINT)


def _asks(text: str) -> bool:
    """Whether code may ask for something, or act on the node."""
    found = frozenset(_WORD.findall(text))
    return any(s in text for s in scopes()) or not found.isdisjoint(telling_words())


def _in_body(cpp: Cpp, each: IfSection) -> bool:
    """Whether alternatives stand in the body of a function."""
    at = len(cpp.source.text[: each.directives[0][1]].encode("utf-8", "surrogatepass"))
    node = cpp.root.descendant_for_byte_range(at - 1, at)
    around = (node, *ancestors(node)) if node is not None else ()
    return any(n.type == "compound_statement" for n in around)
