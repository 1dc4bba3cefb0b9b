"""Plain switches: a `switch` of the model that is an `if` chain of Python."""

from __future__ import annotations

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.static import Analysis
from rebsync.static.symbols import EnvSymbol, LocalSymbol, ParameterSymbol, StateSymbol

_JUMPS = (m.Break, m.Continue, m.Return)
_PLACES = (EnvSymbol, LocalSymbol, ParameterSymbol, StateSymbol)


@dataclass(frozen=True, slots=True)
class Branch:
    """What is done for some values of the subject; for all others where there are no `values`.

    Comments of the model from `start` to `end`, in characters, belong to it.
    """

    values: tuple[m.Expression, ...]
    statements: tuple[m.Statement, ...]
    start: int
    end: int


def branches(switch: m.Switch) -> tuple[Branch, ...] | None:
    """The branches of a plain switch; None for other switches.

    In a plain one no case falls through but empty ones, a `break` stands only at the end of a case,
    and the subject is a name. Whether that may be compared again and again, `is_place` says.
    """
    if not isinstance(switch.subject, m.Name) or any(c.annotations for c in switch.cases):
        return None
    found: list[Branch] = []
    labels: list[m.Case] = []
    for case in switch.cases:
        is_last = case is switch.cases[-1]
        labels.append(case)
        if not case.statements and not is_last:
            continue
        branch = _branch(labels, is_last)
        if branch is None:
            return None
        found.append(branch)
        labels = []
    return tuple(found) if found and found[0].values else None


def is_place(subject: m.Expression, analysis: Analysis) -> bool:
    """Whether an expression is a variable or constant."""
    return isinstance(analysis.symbols.get(id(subject)), _PLACES)


def _branch(labels: list[m.Case], is_last: bool) -> Branch | None:
    """The branch of some labels of which the last one has the statements."""
    values = tuple(c.value for c in labels if c.value is not None)
    has_default = len(values) != len(labels)
    statements = labels[-1].statements
    ends = statements[-1:]
    if (has_default and (values or not is_last)) or not all(map(_is_number, values)):
        return None
    if not is_last and not (ends and isinstance(ends[0], _JUMPS)):
        return None
    start = end = labels[0].span.start
    if ends and isinstance(ends[0], m.Break):
        statements, end = statements[:-1], ends[0].span.start
        if statements and isinstance(statements[-1], _JUMPS):
            return None  # a `break` that nothing reaches
    if any(_leaves(s) for s in statements):
        return None
    return Branch(values, statements, start, end)


def _is_number(value: m.Expression) -> bool:
    match value:
        case m.IntLiteral() | m.Unary("-", m.IntLiteral()):
            return True
        case _:
            return False


def _leaves(statement: m.Node) -> bool:
    """Whether a `break` within a statement leaves what the statement is in."""
    if isinstance(statement, m.Break):
        return True
    if isinstance(statement, m.For | m.While | m.Switch):
        return False
    return any(map(_leaves, m.children(statement)))
