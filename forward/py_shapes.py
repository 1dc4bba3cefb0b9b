"""Expressions of Python as documents, with the places where ruff breaks them.

After `needs_parentheses`, `can_omit_optional_parentheses` and `maybe_parenthesize_expression` of
ruff's formatter, in the parts that generated code needs.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum, auto
from itertools import count

from rebsync.forward.py_documents import (
    BestFit,
    Document,
    Either,
    FirstFit,
    Group,
    Indent,
    Line,
    MayExpand,
)
from rebsync.forward.py_syntax import (
    LEVELS,
    Atom,
    Attribute,
    Call,
    Conditional,
    Display,
    Operation,
    Paren,
    Prefix,
    Subscript,
    Tree,
)
from rebsync.unions import assert_never

_numbers = count(1)
_ATTRIBUTE, _LOOSEST = 0, 100  # how loosely things bind: attributes least, conditionals most


class Need(Enum):
    """What a whole expression may be put into parentheses for, in several lines."""

    MULTILINE = auto()  # it is broken outside of its own brackets
    BEST_FIT = auto()  # it fits on a line of its own
    NEVER = auto()


def number() -> int:
    """A number for a group that conditions name."""
    return next(_numbers)


def bare(tree: Tree) -> Tree:
    """An expression that stands alone, without parentheses that it does not need there."""
    match tree:
        case Paren(Prefix(words)) if words.endswith(":= "):
            return tree
        case Paren(inner):
            return bare(inner)
        case _:
            return tree


def whole(tree: Tree) -> Document:
    """An expression that stands alone in a statement, in parentheses where these break it."""
    match _need(tree):
        case Need.NEVER:
            return shape(tree, None)
        case Need.BEST_FIT:
            of = number()
            return BestFit(shape(tree, of), of)
        case Need.MULTILINE:
            return _in_optional(tree)
        case other:
            assert_never(other)


def assignment(name: str, target: Tree, value: Tree) -> Document:
    """`target = value`; `name` stands before a target that is an annotation.

    A target with brackets is broken in these if nothing else helps.
    """
    before = f"{name}{flat(target)}"
    if not isinstance(target, Subscript | Call):
        return before, " = ", whole(value)
    last = name, shape(target, None), " = "
    if _need(value) is not Need.BEST_FIT:
        return *last, whole(value)
    plain = shape(value, None)
    inside = before, " = (", Indent((Line(), shape(value, 0))), Line(), ")"
    same = before, " = ", plain
    return FirstFit(same, (same, inside, (*last, plain)))


def _in_optional(tree: Tree) -> Document:
    """An expression in parentheses that are there only if it is broken outside of its brackets."""
    of = number()
    content = shape(tree, of if _may_go_without(tree) else 0)
    body = Indent((Line(), content), of)
    return Group((Either("(", of=of), body, Line(), Either(")", of=of)), of)


def flat(tree: Tree) -> str:
    """An expression in one line."""
    match tree:
        case Atom(text):
            return text
        case Attribute(value, name):
            return f"{flat(value)}.{name}"
        case Call(function, items):
            return f"{flat(function)}({', '.join(map(flat, items))})"
        case Subscript(value, items):
            return f"{flat(value)}[{', '.join(map(flat, items))}]"
        case Display(opening, items):
            comma = "," if opening == "(" and len(items) == 1 else ""
            return f"{opening}{', '.join(map(flat, items))}{comma}{_closing(opening)}"
        case Paren(inner):
            return f"({flat(_once(inner))})"
        case Prefix(words, operand):
            return f"{words}{flat(operand)}"
        case Operation(operator, left, right):
            return f"{flat(left)} {operator} {flat(right)}"
        case Conditional(then, condition, otherwise):
            return f"{flat(then)} if {flat(condition)} else {flat(otherwise)}"
        case _:
            assert_never(tree)


def _once(inner: Tree) -> Tree:
    """What doubled parentheses hold."""
    return _once(inner.inner) if isinstance(inner, Paren) else inner


def _closing(opening: str) -> str:
    return ")" if opening == "(" else "]"


# --- shapes -------------------------------------------------------------------------------------


def shape(tree: Tree, of: int | None) -> Document:
    """An expression as a document.

    `of` is the group whose parentheses are optional; 0 within brackets; None where an expression
    cannot be broken but in brackets.
    """
    match tree:
        case Atom(text):
            return text
        case Attribute(value, name):
            return shape(value, of), f".{name}"
        case Call(function, items):
            return shape(function, of), arguments("(", items, of)
        case Subscript(value, items):
            return shape(value, of), _bracketed("[", _listed(items, len(items) > 1), of)
        case Display(opening, items):
            if not items:
                return f"{opening}{_closing(opening)}"
            one = Display(opening, items) if opening == "(" and len(items) == 1 else None
            return flat(one) if one else _bracketed(opening, _listed(items, len(items) > 1), of)
        case Paren(inner):
            return _bracketed("(", shape(_once(inner), 0), of)
        case Prefix("lambda: " as words, body):
            plain, inside = (words, shape(body, 0)), Indent((Line(), shape(body, 0)))
            return FirstFit(plain, (plain, (words, "(", inside, Line(), ")")))
        case Prefix(words, operand) if words.endswith(" := "):
            name = words.removesuffix(" := ")
            return _grouped((name, _break(of)), of), ":= ", shape(operand, of)
        case Prefix(words, operand):
            return words, shape(operand, of)
        case Operation():
            return _grouped(_operation(tree, of), of)
        case Conditional():
            return _grouped(_conditional(tree, of), of)
        case _:
            assert_never(tree)


def arguments(opening: str, items: tuple[Tree, ...], of: int | None = None) -> Document:
    """Arguments: all in one line between the brackets, or each in its own."""
    if not items:
        return f"{opening}{_closing(opening)}"
    return _bracketed(opening, Group(_listed(items, len(items) > 1)), of)


def _listed(items: tuple[Tree, ...], ends_with_comma: bool) -> Document:
    found: list[Document] = []
    for item in items:
        found += [*((",", Line(" ")) if found else ()), shape(item, 0)]
    return (*found, *((Either(","),) if ends_with_comma else ()))


def _bracketed(opening: str, content: Document, of: int | None) -> Document:
    group = Group((opening, Indent((Line(), content)), Line(), _closing(opening)))
    return MayExpand(group, of) if of else group


def _grouped(content: Document, of: int | None) -> Document:
    if of is None:
        return content
    return Either(Group(content), content, of) if of else Group(content)


def _break(of: int | None) -> Document:
    """Where a line may end before an operator."""
    if of is None:
        return " "
    return Either(Line(" "), " ", of) if of else Line(" ")


def _operation(tree: Operation, of: int | None) -> Document:
    """Operators that bind alike, each at the start of a line."""
    first, last = (
        _operation(side, of)
        if isinstance(side, Operation) and _class(side) == _class(tree)
        else shape(side, of)
        for side in (tree.left, tree.right)
    )
    return first, _break(of), f"{tree.operator} ", last


def _class(tree: Operation) -> int:
    """Operators of one class are broken together; `and` and `or` are of one."""
    return max(tree.level, LEVELS["and"])


def _conditional(tree: Conditional, of: int | None) -> Document:
    last = tree.otherwise
    otherwise = _conditional(last, of) if isinstance(last, Conditional) else shape(last, of)
    test = shape(tree.condition, of)
    return shape(tree.then, of), _break(of), "if ", test, _break(of), "else ", otherwise


# --- parentheses --------------------------------------------------------------------------------


def _need(tree: Tree) -> Need:
    match tree:
        case Operation() | Conditional() | Prefix("lambda: "):
            return Need.MULTILINE
        case Atom():
            return Need.BEST_FIT
        case Attribute(value) | Call(value) | Subscript(value):
            return Need.NEVER if isinstance(value, Paren) else _need(value)
        case Prefix(_, operand):
            return Need.NEVER if isinstance(operand, Paren) else _need(operand)
        case Display() | Paren():
            return Need.NEVER
        case _:
            assert_never(tree)


def _may_go_without(tree: Tree) -> bool:
    """Whether an expression may be broken in its own brackets, without parentheses around it."""
    if not any(_has_brackets(t) for t in _seen(tree)):
        return False
    levels = [level for t in _seen(tree) for level in _looseness(t)]
    loosest = max(levels, default=_ATTRIBUTE)
    if loosest == _ATTRIBUTE:
        return True
    if levels.count(loosest) > 1:
        return False
    return _is_filled(_last(tree)) or _is_filled(_first(tree))


def _seen(tree: Tree) -> Iterator[Tree]:
    """An expression and those in it that are not in brackets."""
    yield tree
    match tree:
        case Attribute(value) | Call(value) | Subscript(value):
            yield from _seen(value)
        case Prefix(_, operand):
            yield from _seen(operand)
        case Operation(_, left, right):
            yield from _seen(left)
            yield from _seen(right)
        case Conditional(then, condition, otherwise):
            for part in (then, condition, otherwise):
                yield from _seen(part)
        case _:
            pass


def _looseness(tree: Tree) -> tuple[int, ...]:
    """How loosely something binds: comparisons alike, other operators by their level."""
    match tree:
        case Operation():
            return (_LOOSEST - _class(tree),)
        case Conditional():
            return (_LOOSEST, _LOOSEST)  # `if` and `else`
        case _:
            return ()


def _has_brackets(tree: Tree) -> bool:
    return isinstance(tree, Call | Subscript | Display | Paren)


def _is_filled(tree: Tree | None) -> bool:
    """Whether something has brackets with something in them."""
    match tree:
        case Call(items=items) | Display(items=items):
            return bool(items)
        case Paren():
            return True
        case _:  # a subscript is broken within other brackets only
            return False


def _last(tree: Tree) -> Tree:
    """What an expression ends with."""
    match tree:
        case Operation(right=last) | Conditional(otherwise=last) | Prefix(operand=last):
            return _last(last)
        case _:
            return tree


def _first(tree: Tree) -> Tree | None:
    """What an expression begins with; None where that is a word or sign."""
    match tree:
        case Operation(left=first) | Conditional(then=first):
            return _first(first)
        case Attribute(first) | Call(first) | Subscript(first):
            return _first(first)
        case Prefix():
            return None
        case _:
            return tree
