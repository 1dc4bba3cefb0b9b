"""What single expressions of the model become in C++, whatever class they stand in."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync import model as m
from rebsync import precedence
from rebsync.static.constants import constant

_NTH = ("first", "second", "third", "fourth", "fifth", "sixth")


def is_int(expression: m.Expression) -> bool:
    """Whether C++ makes an int of an expression whose type may be smaller in the model."""
    match expression:
        case m.Paren(inner):
            return is_int(inner)
        case m.IntLiteral() | m.Binary() | m.Choice() | m.Unary(operator="-" | "+" | "~"):
            return True
        case m.Conditional(then=then, otherwise=otherwise):
            return is_int(then) or is_int(otherwise)
        case _:
            return False


def is_bitwise(expression: m.Expression) -> bool:
    """Whether an expression is one of `&`, `|`, `^`, of which C++ makes an int of truth values."""
    match expression:
        case m.Paren(inner):
            return is_bitwise(inner)
        case m.Binary(operator):
            return operator in ("&", "|", "^")
        case m.Conditional(then=then, otherwise=otherwise):
            return is_bitwise(then) or is_bitwise(otherwise)
        case _:
            return False


def is_distance(expression: m.Expression) -> bool:
    """Whether a distance to shift by is a constant for which C++ means what the model does."""
    value = constant(expression)
    return isinstance(value, int) and 0 <= value < 32


def float_literal(literal: str) -> str:
    """A literal of the model, float unless it says double, in C++, where it is the other way."""
    digits = literal.replace("_", "")
    if digits[-1] in "dD":
        return digits[:-1] if any(c in digits for c in ".eE") else f"{digits[:-1]}.0"
    if digits[-1] in "fF":
        digits = digits[:-1]
        return f"{digits}F" if any(c in digits for c in ".eE") else f"{digits}.0F"
    return f"{digits}f"


def when(call: m.Call, times: Sequence[str]) -> list[str]:
    """The last argument of a send that has times."""
    words = [w for w, t in (("after", call.after), ("deadline", call.deadline)) if t is not None]
    parts = [f"{word}({time})" for word, time in zip(words, times, strict=True)]
    return [".".join(parts)] if parts else []


def nth(count: int) -> list[str]:
    """Names of locals that hold so many operands."""
    return [*_NTH[:count], *(f"operand{i}" for i in range(len(_NTH) + 1, count + 1))]


def in_order(names: Sequence[str], values: Sequence[str], result: str) -> str:
    """`result` over the names of the values, which are evaluated in the order of the model.

    C++14 leaves the order of operands and arguments open; the statements of a lambda have one.
    """
    stores = "".join(f"const auto {n} = {v}; " for n, v in zip(names, values, strict=True))
    return f"[&] {{ {stores}return {result}; }}()"


def looks_like_template(operands: Sequence[m.Expression], texts: Sequence[str]) -> bool:
    """Whether arguments may be taken for those of a template: `a < b, as<C>(c)`.

    A compiler knows better, as it knows names; what reads text alone does not.
    """
    after = [">" in " ".join(texts[i:]).replace("->", "") for i in range(1, len(texts) + 1)]
    return any(_compares(o) and later for o, later in zip(operands, after, strict=True))


def _compares(expression: m.Expression) -> bool:
    """Whether `<` is among the operators of an expression that stand in no parentheses."""
    match expression:
        case m.Binary("<"):
            return True
        case m.Binary(_, left, right):
            return _compares(left) or _compares(right)
        case m.Conditional(condition, then, otherwise):
            return any(map(_compares, (condition, then, otherwise)))
        case _:
            return False


def enclosed(operand: m.Expression, level: int) -> m.Expression:
    """An operand of that level which is the argument of a call: parentheses enclose it there.

    It is without its own if the model cannot be without them, so that readers add them again.
    Assignments keep theirs, as C++ has them where values are asked for.
    """
    match operand:
        case m.Paren(inner) if precedence.binding(inner) < level:
            return operand if isinstance(inner, m.Assign) else inner
        case _:
            return operand


def bare(target: m.Expression | None) -> m.Expression:
    """An expression without parentheses around it, such as the target of a send has."""
    if isinstance(target, m.Paren):
        return bare(target.inner)
    assert target is not None
    return target
