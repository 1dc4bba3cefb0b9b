"""Which definitions of a variable may reach a place, in one function."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_tree import named, text_of
from rebsync.reverse.values.cpp_flow_definitions import Definition

_LOOPS = frozenset({"for_statement", "while_statement", "do_statement", "for_range_loop"})
_SIDES = frozenset({"if_statement", "conditional_expression"})
_BRANCHES = _LOOPS | _SIDES | {"case_statement", "catch_clause", "lambda_expression"}
_JUMPS = frozenset({"return_statement", "throw_statement"})
_Bytes = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Branch:
    """A part of a statement that is run on some ways only: `then`, `else`, or another."""

    statement: Node
    side: str
    body: Node
    condition: Node | None
    own: _Bytes
    whole: _Bytes


@dataclass(frozen=True, eq=False)
class Located:
    """A definition with the byte from which on it holds, and what stands around it.

    `branches` and `loops` (their first and last bytes) are those around it, from the inside out;
    a lambda or function ends the loops.
    """

    definition: Definition
    start: int
    at: int
    branches: tuple[Branch, ...]
    loops: tuple[_Bytes, ...]


@dataclass(frozen=True, slots=True)
class Reach:
    """A definition that may reach a place; `sure` if it does on all ways.

    `unset` says that it is made only where the definition before gave none.
    """

    definition: Definition
    sure: bool
    unset: bool = False


def located(found: Iterable[Definition]) -> list[Located]:
    """Definitions with what stands around them, the latest first."""
    every = [_located(definition) for definition in found]
    return sorted(every, key=lambda one: -one.at)


def _located(definition: Definition) -> Located:
    place, node = definition.place, definition.node
    branches, loops = _around(place)
    at = max(node.end_byte, place.end_byte)
    return Located(definition, node.start_byte, at, tuple(branches), tuple(loops))


def _around(place: Node) -> tuple[list[Branch], list[_Bytes]]:
    branches: list[Branch] = []
    loops: list[_Bytes] = []
    inside = True
    below, above = place, place.parent
    while above is not None and (kind := above.type) != "function_definition":
        if kind in _BRANCHES:
            if kind in _LOOPS and inside:
                loops.append((above.start_byte, above.end_byte))
            inside = inside and kind != "lambda_expression"
            if side := _side(above, kind, below):
                branches.append(_branch(above, kind, side, below))
        below, above = above, above.parent
    return branches, loops


def _branch(statement: Node, kind: str, side: str, body: Node) -> Branch:
    condition = statement.child_by_field_name("condition") if kind in _SIDES else None
    own = body.start_byte, body.end_byte
    return Branch(statement, side, body, condition, own, (statement.start_byte, statement.end_byte))


def _side(statement: Node, kind: str, child: Node) -> str:
    """Which part of a statement a child is; empty for one that is always run."""
    if kind in _SIDES:
        if statement.child_by_field_name("consequence") == child:
            return "then"
        return "else" if statement.child_by_field_name("alternative") == child else ""
    if kind == "case_statement":
        return "case"
    if kind == "do_statement" or statement.child_by_field_name("body") != child:
        return ""
    return "body"


# --- reaching -----------------------------------------------------------------------------------


def reaching(
    found: list[Located], use: Node | None, holds: Callable[[Node], bool | None]
) -> Iterator[Reach]:
    """The definitions that may reach a place, or the end (`use` is None), the latest first.

    They end with one that is sure, if there is. `holds` says whether a condition is met.
    """
    at = use.start_byte if use is not None else -1
    covered: dict[int, str] = {}
    for one in found:
        definition = one.definition
        if use is not None and not _before(one, at):
            continue
        if not one.branches:
            sure = use is None or one.at <= at
            yield Reach(definition, sure)
            if sure:
                return
            continue
        branches = [b for b in one.branches if not _within(at, b.own)]
        if use is not None and branches and _jumps(branches[-1]):
            continue
        known = [_taken(b, holds) for b in branches]
        if False in known:
            continue
        open_ = [b for b, taken_ in zip(branches, known, strict=True) if taken_ is None]
        again = use is not None and one.at > at  # in the round before
        sure = not open_ and not again
        if len(open_) == 1 and open_[0].condition is not None and not again:
            side = covered.setdefault(open_[0].statement.id, open_[0].side)
            sure = side != open_[0].side
        yield Reach(definition, sure, any(_if_unset(b, definition) for b in open_))
        if sure:
            return


def _within(at: int, span: _Bytes) -> bool:
    return span[0] <= at < span[1]


def _before(one: Located, at: int) -> bool:
    """Whether a definition may come before a place, perhaps in the round before."""
    if one.start <= at < one.at and one.definition.how not in ("declared", "unknown"):
        return False
    if one.at <= at:
        return not one.branches or not any(_exclusive(b, at) for b in one.branches)
    return one.definition.how != "declared" and any(_within(at, loop) for loop in one.loops)


def _exclusive(branch: Branch, at: int) -> bool:
    """Whether a place is in the other side of an `if` than what stands in a branch."""
    if branch.condition is None or not _within(at, branch.whole) or _within(at, branch.own):
        return False
    return at >= branch.condition.end_byte


def _taken(branch: Branch, holds: Callable[[Node], bool | None]) -> bool | None:
    """Whether a branch is taken, if that is known."""
    if branch.condition is None:
        return None
    known = holds(branch.condition)
    return None if known is None else known is (branch.side == "then")


def _if_unset(branch: Branch, definition: Definition) -> bool:
    """Whether a branch is that of `isnan(x)`, or of a parameter that was not read to `x`."""
    if branch.condition is None:
        return False
    text = text_of(branch.condition)
    negated = (branch.side == "then") == text.lstrip("( ").startswith("!")
    name = re.escape(text_of(definition.place))
    if re.search(rf"\bisnan\s*\(\s*{name}\s*\)", text):
        return not negated
    read = re.search(
        rf"\b(?:getParam\w*|get|getCached|get_parameter)\s*\([^&|]*\b{name}\s*\)", text
    )
    return negated and read is not None


def in_loop(definition: Definition, scope: Node | None) -> bool:
    """Whether a definition may be made more than once while a variable of a scope lives."""

    def ends(node: Node) -> bool:
        return node == scope or node.type == "function_definition"

    return any(n.type in _LOOPS for n in ancestors(definition.place, ends))


def taken(place: Node, holds: Callable[[Node], bool | None]) -> bool | None:
    """Whether a statement of a function is reached, if that is known."""
    known = [_taken(b, holds) for b in _around(place)[0]]
    if False in known:
        return False
    return None if None in known else True


def _jumps(branch: Branch) -> bool:
    """Whether a branch ends in a jump, so that nothing behind it sees what it does."""
    body = branch.body
    if body.type == "else_clause" and body.named_children:
        body = body.named_children[-1]
    statements = named(body) if body.type == "compound_statement" else [body]
    return bool(statements) and statements[-1].type in _JUMPS
