"""What statements and expressions of the model write, and forms of them that tell more."""

from __future__ import annotations

from rebsync import model as m
from rebsync.reverse.models.building import bare

_STEP = 1 << 16  # what a counter may count by: it takes long to get out of an `int`
_UNROLLED = 32  # rounds of a loop that are followed one by one
_NESTED = 4  # the same of one with loops in it


def variable_of(expression: m.Expression) -> str | None:
    """The name of the variable that an expression is, if it is one."""
    match bare(expression):
        case m.Name(name) | m.Member(m.Self(), name):
            return name
        case _:
            return None


def array_of(place: m.Expression) -> str | None:
    """The name of the variable that a place is, or is an element of."""
    return variable_of(_whole(place))


def is_own(place: m.Expression) -> bool:
    """Whether a place is, or is in, a state variable by `self`, whatever hides its name."""
    return isinstance(_whole(place), m.Member)


def own(name: str) -> str:
    """What stands for a state variable where something else has its name."""
    return f"self.{name}"


def _whole(place: m.Expression) -> m.Expression:
    whole = bare(place)
    while isinstance(whole, m.Index):
        whole = bare(whole.target)
    return whole


def written(node: m.Node) -> set[str]:
    """The names of what is written in a statement or expression; "" for what has no name."""
    found = set()
    for inner in m.walk(node):
        match inner:
            case m.Assign(_, target) | m.Postfix(_, target) | m.Unary("++" | "--", target):
                found.add(array_of(target) or "")
            case m.Declarator(name):
                found.add(name)
            case _:
                pass
    return found


def calls_own(node: m.Node) -> bool:
    """Whether a function of the class is called, or of one that it extends."""
    return any(isinstance(n, m.Call) and _is_own(n.target) for n in m.walk(node))


def _is_own(target: m.Expression | None) -> bool:
    return target is None or isinstance(bare(target), m.Super)


def counts_up(operator: str, name: str, value: m.Expression) -> bool:
    """Whether an assignment to a variable gives it little more than it has."""
    match operator, bare(value):
        case "+=", m.IntLiteral(step):
            return 0 < step <= _STEP
        case "=", m.Binary("+", left, m.IntLiteral(step)):
            return variable_of(left) == name and 0 < step <= _STEP
        case _:
            return False


def moved(left: m.Expression, right: m.Expression) -> tuple[m.Expression, m.Expression]:
    """`x + 1 < 5` says of `x` what `x < 4` does, where sums do not wrap."""
    match bare(left), bare(right):
        case m.Binary("+" | "-" as operator, place, m.IntLiteral(by)), m.IntLiteral(number):
            return place, m.IntLiteral(number - by if operator == "+" else number + by)
        case _:
            return left, right


def rounds_of(loop: m.For) -> tuple[str, range] | None:
    """The variable of a loop and its numbers, if these are few and all of them come."""
    match loop:
        case m.For(
            m.Declaration(_, (m.Declarator(name, m.IntLiteral(low)),)),
            m.Binary("<", m.Name(other), m.IntLiteral(high)),
            (m.Postfix("++", m.Name(third)),),
            body,
        ) if name == other == third and high - low <= _UNROLLED:
            inside = list(m.walk(body))
            if any(isinstance(n, m.Break | m.Continue | m.Return) for n in inside):
                return None
            loops = any(isinstance(n, m.While | m.For) for n in inside)
            if name not in written(body) and (not loops or high - low <= _NESTED):
                return name, range(low, high)
    return None
