"""`(x) - 1`, which the grammar takes for a cast of `-1`: only names tell it from `(int) -1`."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import precedence
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.syntax.cpp_tree import Cpp, parse, part, text_of
from rebsync.source import Source

_SIGNS = frozenset({"+", "-", "&", "*"})


@dataclass(frozen=True, slots=True)
class ChainOperand:
    """An operand of a chain of operators, in the file that it was read from."""

    cpp: Cpp
    node: Node


@dataclass(frozen=True, slots=True)
class Operation:
    """`left operator right`."""

    operator: str
    left: Chain
    right: Chain


Chain = ChainOperand | Operation
_Flat = list["ChainOperand | str"]


def is_misread(scope: Scope, node: Node) -> bool:
    """Whether a cast, or a chain of operators with one in it, is something else."""
    match node.type:
        case "cast_expression":
            return _inner(scope, node) is not None or _holds_misread(scope, node)
        case "binary_expression" if b")" in (node.text or b""):
            return is_misread(scope, part(node, "left")) or is_misread(scope, part(node, "right"))
        case _:
            return False


def first_of(cpp: Cpp, scope: Scope, node: Node) -> ChainOperand:
    """The first operand of a misread cast."""
    first = _flat(cpp, scope, node)[0]
    assert isinstance(first, ChainOperand)
    return first


def chain_of(cpp: Cpp, scope: Scope, node: Node) -> Chain:
    """The operators of a misread chain in their order, as tightly as they bind."""
    flat = _flat(cpp, scope, node)
    return _climbed(flat, 1)


def _holds_misread(scope: Scope, node: Node) -> bool:
    """Whether it is `(int8_t)(x) - 1`, of which only `(x)` is cast."""
    value = part(node, "value")
    return value.type == "cast_expression" and is_misread(scope, value)


def _inner(scope: Scope, node: Node) -> Node | None:
    """The first operand of a misread cast, if it is one."""
    value = part(node, "value")
    if value.type not in ("unary_expression", "pointer_expression"):
        return None
    if text_of(part(value, "operator")) not in _SIGNS:
        return None
    inside = parse(Source("operand", f"auto x = {text_of(part(node, 'type'))};")).root
    declared = inside.named_children[0] if inside.named_children else None
    declarator = declared.child_by_field_name("declarator") if declared is not None else None
    first = declarator.child_by_field_name("value") if declarator is not None else None
    if first is None or inside.has_error:
        return None
    known = first.type == "identifier" and text_of(first) in scope.constants
    called = first.type == "call_expression" and part(first, "function").type != "primitive_type"
    return first if known or called or resolve(scope, first) is not None else None


def _flat(cpp: Cpp, scope: Scope, node: Node) -> _Flat:
    if node.type == "binary_expression":
        left, right = part(node, "left"), part(node, "right")
        operator = text_of(part(node, "operator"))
        return [*_flat(cpp, scope, left), operator, *_flat(cpp, scope, right)]
    first = _inner(scope, node) if node.type == "cast_expression" else None
    if first is None and node.type == "cast_expression" and _holds_misread(scope, node):
        operand, *others = _flat(cpp, scope, part(node, "value"))
        assert isinstance(operand, ChainOperand)
        return [_cast(cpp, part(node, "type"), operand.node), *others]
    if first is None:
        return [ChainOperand(cpp, node)]
    value = part(node, "value")
    text = f"auto x = {text_of(part(node, 'type'))};"
    before = ChainOperand(parse(Source(cpp.source.path, text)), first)
    return [before, text_of(part(value, "operator")), *_flat(cpp, scope, part(value, "argument"))]


def _cast(cpp: Cpp, type_: Node, operand: Node) -> ChainOperand:
    """An operand that is cast."""
    text = f"auto x = ({text_of(type_)})({text_of(operand)});"
    made = parse(Source(cpp.source.path, text))
    declarator = part(made.root.named_children[0], "declarator")
    return ChainOperand(made, part(declarator, "value"))


def _climbed(flat: _Flat, least: int) -> Chain:
    """What the next operators join that bind at least so tightly; takes them from the list."""
    left = flat.pop(0)
    assert isinstance(left, ChainOperand)
    joined: Chain = left
    while flat and precedence.BINARY[str(flat[0])] >= least:
        operator = str(flat.pop(0))
        joined = Operation(operator, joined, _climbed(flat, precedence.BINARY[operator] + 1))
    return joined
