"""Which state variables give the cell of a robot, inferred from the bodies of its class.

A variable gives a coordinate if every body changes it as it moves the robot along that axis:
`@Move(X + 1, Y); delay(2); pos[0] = pos[0] + 1;`. For an axis along which a class never moves it is
the variable beside the other one: `pos[1]` beside `pos[0]`, `y` beside `x`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from rebsync.model import (
    Annotation,
    Assign,
    Binary,
    Block,
    Expression,
    IntLiteral,
    Name,
    Node,
    Paren,
    Postfix,
    Unary,
    walk,
)
from rebsync.records import dataclass
from rebsync.static.cells import CellOf, place, variables_of
from rebsync.static.movement import Movement, movement
from rebsync.static.symbols import ClassInfo

# The letter of an axis in `x`, `pos_x`, `x1` and `posX`.
_LETTERS = (
    re.compile(r"(?:(?<=_)|\A)x(?=\Z|_|\d)|X(?=\Z|_|\d)"),
    re.compile(r"(?:(?<=_)|\A)y(?=\Z|_|\d)|Y(?=\Z|_|\d)"),
)
_OTHER = {"x": "y", "y": "x", "X": "Y", "Y": "X"}

Change: TypeAlias = tuple[str, Expression]
"""`+` or `-`, and an amount."""


def cell_of(info: ClassInfo) -> CellOf:
    """What gives the cell of the robots of a class."""
    bodies = [_Body.of(block) for block in _blocks(info)]
    names = set(variables_of(info, ("byte", "short", "int")))
    x, y = (_variable(bodies, axis, names) for axis in (0, 1))
    if x is not None and x == y:  # it goes with diagonal moves: which axis it is only names say
        x, y = (x if _is_named(x, axis) else None for axis in (0, 1))
    moves = [any(body.along(axis) for body in bodies) for axis in (0, 1)]
    if x is None and not moves[0]:
        x = _beside(y, 1, names)
    if y is None and not moves[1]:
        y = _beside(x, 0, names)
    return CellOf(_named(x), _named(y), (x, y))


def _named(name: str | None) -> Expression | None:
    return None if name is None else Name(name)


@dataclass(frozen=True, slots=True)
class _Body:
    """The moves of a body, and what it does to variables: a Change, or None for other values."""

    moves: tuple[Movement, ...]
    changes: Mapping[str, Sequence[Change | None]]

    @classmethod
    def of(cls, block: Block) -> _Body:
        moves: list[Movement] = []
        changes: dict[str, list[Change | None]] = {}
        for node in walk(block):
            match node:
                case Annotation("Move"):
                    step = movement(node)
                    moves += [step] if step is not None else []
                case Assign(_, target) | Postfix(_, target) | Unary("++" | "--", target):
                    changes.setdefault(place(target) or "", []).append(_change(node))
                case _:
                    pass
        return cls(tuple(moves), changes)

    def along(self, axis: int) -> set[Change]:
        """The moves along an axis."""
        offsets = ((step.x, step.y)[axis] for step in self.moves)
        return {(o.operator, _bare(o.amount)) for o in offsets if o.amount is not None}

    def follows(self, axis: int, name: str) -> bool:
        """Whether a variable changes as the robot moves along an axis, and not otherwise."""
        return self.along(axis) == set(self.changes.get(name, ()))


def _blocks(info: ClassInfo) -> Iterator[Block]:
    bodies = [server.declaration.body for server in info.servers]
    bodies += [method.declaration.body for method in info.methods]
    yield from (body for body in bodies if body is not None)


def _variable(bodies: Sequence[_Body], axis: int, names: set[str]) -> str | None:
    """The one variable that follows the moves along an axis; of several the one named so."""
    if not any(body.along(axis) for body in bodies):
        return None
    found = [name for name in sorted(names) if all(body.follows(axis, name) for body in bodies)]
    named = [name for name in found if _is_named(name, axis)]
    return next((several[0] for several in (found, named) if len(several) == 1), None)


def _is_named(name: str, axis: int) -> bool:
    return name.endswith(f"[{axis}]") or bool(_LETTERS[axis].search(name))


def _change(node: Node) -> Change | None:
    match node:
        case Postfix(operator, _) | Unary(operator, _):
            return operator[0], IntLiteral(1)
        case Assign("+=" | "-=" as operator, _, value):
            return operator[0], _bare(value)
        case Assign("=", target, value):
            return _added(place(target), _bare(value))
        case _:
            return None


def _added(name: str | None, value: Expression) -> Change | None:
    """What `name = value` adds to the variable, or takes from it."""
    match value:
        case Binary("+" | "-" as sign, left, right) if name is not None and place(left) == name:
            return sign, _bare(right)
        case Binary("+", left, right) if name is not None and place(right) == name:
            return "+", _bare(left)
        case _:
            return None


def _bare(expression: Expression) -> Expression:
    while isinstance(expression, Paren):
        expression = expression.inner
    name = place(expression)
    return expression if name is None else Name(name)


def _beside(name: str | None, axis: int, names: set[str]) -> str | None:
    """The variable for the other axis, beside that for `axis`."""
    if name is None:
        return None
    if name.endswith(f"[{axis}]"):
        other = f"{name[: name.rindex('[')]}[{1 - axis}]"
    else:
        other = _LETTERS[axis].sub(lambda letter: _OTHER[letter[0]], name)
    return other if other != name and other in names else None
