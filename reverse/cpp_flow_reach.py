"""Which definitions of a variable may reach a place, in one function."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.cpp_flow import Texts, declaration_of, is_pointer, made_of
from rebsync.reverse.cpp_flow_types import Variable
from rebsync.reverse.cpp_tree import Cpp, named, part, text_of

_LOOPS = frozenset({"for_statement", "while_statement", "do_statement", "for_range_loop"})
_BRANCHES = frozenset(
    {
        *_LOOPS,
        *("if_statement", "case_statement", "conditional_expression", "catch_clause"),
        "lambda_expression",
    }
)
_JUMPS = frozenset({"return_statement", "throw_statement"})
_CHANGES = frozenset({"append", "push_back", "insert", "erase", "replace", "resize", "clear"})


@dataclass(frozen=True, slots=True)
class Definition:
    """A place that gives a variable a value.

    `how` is `value` (then `node` is it), `made` (of `arguments`), `declared` (with none), `added`
    (`node` is appended), `element` (a loop takes it from
    `node`), `given` (a call, `node`, gets it as the argument `index` and may change
    it), `initialised` (by a constructor's list), `unknown` (why: `text`).
    """

    how: str
    place: Node
    node: Node
    arguments: tuple[Node, ...] = ()
    index: int = 0
    text: str = ""

    @property
    def at(self) -> int:
        """The byte from which on it holds."""
        return max(self.node.end_byte, self.place.end_byte)


def definitions(
    texts: Texts, cpp: Cpp, variable: Variable, path: str, start: int, end: int
) -> Iterator[Definition]:
    """The definitions of a variable, or of a field of it, between two bytes of a file."""
    for place in texts.within(cpp, variable.text, start, end):
        found = _definition(place, variable, path)
        if found is not None:
            yield found


def _definition(place: Node, variable: Variable, path: str) -> Definition | None:
    declaration = declaration_of(place)
    if declaration is not None:
        if variable.kind == "member" or place != variable.name:
            return None
        return _declared(place, declaration)
    left = _left_value(place, variable, path)
    above = left.parent if left is not None else None
    if left is None or above is None:
        return None
    if above.type == "pointer_expression" and above.children[0].type in ("&", "*"):
        left, above = above, above.parent
    return _changed(place, left, above) if above is not None else None


def _declared(place: Node, declaration: Node) -> Definition | None:
    if declaration.type == "for_range_loop":
        return Definition("element", place, part(declaration, "right"))
    if declaration.type != "declaration":
        return None  # a parameter
    given = made_of(place)
    if given is None:
        return Definition("declared", place, place)
    holder = place.parent
    while holder is not None and not _holds_value(holder):
        holder = holder.parent
    plain = holder is not None and holder.type == "init_declarator"
    if holder is not None and plain and part(holder, "value").type not in _LISTS:
        return Definition("value", place, given[0])
    return Definition("made", place, declaration if holder is None else holder, given)


def _holds_value(node: Node) -> bool:
    if node.type == "function_declarator":
        return not is_pointer(node)
    return node.type == "init_declarator"


_LISTS = ("argument_list", "initializer_list")


def _left_value(place: Node, variable: Variable, path: str) -> Node | None:
    """The whole expression of which a name is the start, if it is the variable's (field)."""
    left, above = place, place.parent
    if above is not None and above.type == "field_expression" and part(above, "field") == place:
        if part(above, "argument").type != "this":
            return None
        left, above = above, above.parent
    elif place.type == "field_identifier" and (above is None or above.type != "field_initializer"):
        return None
    for name in path.split(".") if path else []:
        if above is not None and above.type == "parenthesized_expression":
            left, above = above, above.parent
        if above is None or above.type != "field_expression":
            return left if _handed(left) else None
        if text_of(part(above, "field")) != name:
            return None
        left, above = above, above.parent
    return left


def _handed(node: Node) -> bool:
    """Whether a node is an argument of a call, or the address of one that is."""
    above = node.parent
    if above is not None and above.type == "pointer_expression":
        above = above.parent
    return above is not None and above.type == "argument_list"


def _changed(place: Node, left: Node, above: Node) -> Definition | None:
    match above.type:
        case "assignment_expression" if part(above, "left") == left:
            how = "value" if text_of(part(above, "operator")) == "=" else "added"
            if how == "added" and text_of(part(above, "operator")) != "+=":
                return Definition("unknown", place, above, text="arithmetic in place")
            return Definition(how, place, part(above, "right"))
        case "update_expression":
            return Definition("unknown", place, above, text="a count")
        case "argument_list" if above.parent is not None:
            call = above.parent
            if call.type == "call_expression":
                return Definition("given", place, call, index=named(above).index(left))
        case "field_initializer":
            lists = [n for n in above.named_children if n.type in _LISTS]
            given = tuple(named(lists[-1])) if lists else ()
            return Definition("initialised", place, above, given)
        case "field_expression" if part(above, "argument") == left:
            return _by_method(place, above)
        case "binary_expression" if text_of(above.children[1]) == ">>":
            if part(above, "right") == left:
                return Definition("unknown", place, above, text="read at run time")
    return None


def _by_method(place: Node, access: Node) -> Definition | None:
    call, method = access.parent, text_of(part(access, "field"))
    if call is None or call.type != "call_expression" or part(call, "function") != access:
        return None
    given = named(part(call, "arguments"))
    if method in ("reset", "assign") and given:
        return Definition("value", place, given[0])
    if method == "append" and len(given) == 1:
        return Definition("added", place, given[0])
    if method in _CHANGES:
        return Definition("unknown", place, call, text=f"changed by {method}")
    return None


# --- reaching -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Reach:
    """A definition that may reach a place; `sure` if it does on all ways.

    `unset` says that it is made only where the definition before gave none.
    """

    definition: Definition
    sure: bool
    unset: bool = False


def reaching(
    found: list[Definition], use: Node | None, holds: Callable[[Node], bool | None]
) -> Iterator[Reach]:
    """The definitions that may reach a place, or the end (`use` is None), the latest first.

    They end with one that is sure, if there is. `holds` says whether a condition is met.
    """
    covered: dict[int, set[str]] = {}
    for definition in sorted(found, key=lambda d: -d.at):
        if use is not None and not _before(definition, use):
            continue
        branches = list(_branches(definition.place, use))
        if use is not None and _jumps(branches):
            continue
        open_ = [b for b in branches if not _met(b, holds)]
        if any(holds_not(b, holds) for b in open_):
            continue
        again = use is not None and definition.at > use.start_byte  # in the round before
        if not open_ and not again:
            yield Reach(definition, True)
            return
        yield Reach(definition, False, any(_if_unset(b, definition) for b in open_))
        if len(open_) == 1 and open_[0].statement.type == "if_statement":
            sides = covered.setdefault(open_[0].statement.id, set())
            sides.add(open_[0].side)
            if len(sides) == 2:
                return


@dataclass(frozen=True, slots=True)
class Branch:
    """A part of a statement that is run on some ways only."""

    statement: Node
    side: str
    body: Node


def _before(definition: Definition, use: Node) -> bool:
    inside = definition.node.start_byte <= use.start_byte < definition.node.end_byte
    if inside and definition.how not in ("declared", "unknown"):
        return False
    if definition.at <= use.start_byte:
        return not _exclusive(definition.place, use)
    above = definition.place.parent
    while above is not None:
        if above.type in _LOOPS and above.start_byte <= use.start_byte < above.end_byte:
            return definition.how != "declared"
        if above.type in ("function_definition", "lambda_expression"):
            return False
        above = above.parent
    return False


def _exclusive(place: Node, use: Node) -> bool:
    """Whether one stands in the other side of an `if` than the other."""
    for branch in _branches(place, use):
        if branch.statement.type not in ("if_statement", "conditional_expression"):
            continue
        if not branch.statement.start_byte <= use.start_byte < branch.statement.end_byte:
            continue
        condition = branch.statement.child_by_field_name("condition")
        return condition is None or use.start_byte >= condition.end_byte
    return False


def _branches(place: Node, use: Node | None) -> Iterator[Branch]:
    """The branches around a place that are not around the use, from the inside out."""
    below, above = place, place.parent
    while above is not None and above.type != "function_definition":
        if above.type in _BRANCHES:
            side = _side(above, below)
            inside = use is not None and below.start_byte <= use.start_byte < below.end_byte
            if side and not inside:
                yield Branch(above, side, below)
        below, above = above, above.parent


def _side(statement: Node, child: Node) -> str:
    """Which part of a statement a child is; empty for one that is always run."""
    if statement.type in ("if_statement", "conditional_expression"):
        if statement.child_by_field_name("consequence") == child:
            return "then"
        return "else" if statement.child_by_field_name("alternative") == child else ""
    if statement.type == "case_statement":
        return "case"
    body = statement.child_by_field_name("body")
    if body != child or statement.type == "do_statement":
        return ""
    return "body"


def _met(branch: Branch, holds: Callable[[Node], bool | None]) -> bool:
    condition = branch.statement.child_by_field_name("condition")
    if condition is None or branch.side not in ("then", "else"):
        return False
    return holds(condition) is (branch.side == "then")


def holds_not(branch: Branch, holds: Callable[[Node], bool | None]) -> bool:
    """Whether a branch is known not to be taken."""
    condition = branch.statement.child_by_field_name("condition")
    if condition is None or branch.side not in ("then", "else"):
        return False
    known = holds(condition)
    return known is not None and known is not (branch.side == "then")


def _if_unset(branch: Branch, definition: Definition) -> bool:
    """Whether a branch is that of `isnan(x)`, or of a parameter that was not read to `x`."""
    condition = branch.statement.child_by_field_name("condition")
    text = text_of(condition) if condition is not None else ""
    if condition is None or branch.side not in ("then", "else"):
        return False
    negated = (branch.side == "then") == text.lstrip("( ").startswith("!")
    name = re.escape(text_of(definition.place))
    if re.search(rf"\bisnan\s*\(\s*{name}\s*\)", text):
        return not negated
    read = re.search(rf"\b(?:getParam\w*|get|getCached)\s*\([^&|]*\b{name}\s*\)", text)
    return negated and read is not None


def in_loop(definition: Definition, scope: Node | None) -> bool:
    """Whether a definition may be made more than once while a variable of a scope lives."""
    above = definition.place.parent
    while above is not None and above != scope and above.type != "function_definition":
        if above.type in _LOOPS:
            return True
        above = above.parent
    return False


def taken(place: Node, holds: Callable[[Node], bool | None]) -> bool | None:
    """Whether a statement of a function is reached, if that is known."""
    open_ = [b for b in _branches(place, None) if not _met(b, holds)]
    if any(holds_not(b, holds) for b in open_):
        return False
    return None if open_ else True


def _jumps(branches: list[Branch]) -> bool:
    """Whether the outermost branch ends in a jump, so that nothing behind it sees what it does."""
    if not branches:
        return False
    body = branches[-1].body
    if body.type == "else_clause" and body.named_children:
        body = body.named_children[-1]
    statements = named(body) if body.type == "compound_statement" else [body]
    return bool(statements) and statements[-1].type in _JUMPS
