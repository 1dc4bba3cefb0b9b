"""How steps, messages and figures are called, in whatever form they are shown."""

from __future__ import annotations

from rebsync.checker.result import Extreme, Violation
from rebsync.checker.steps import Semantics
from rebsync.checker.trace import Change, ShownMessage, ShownRebec, TraceStep

_UNITS = ("bytes", "KB", "MB", "GB", "TB")
_VIEWS: dict[str, str] = {
    "tts": "exact time (tts)",
    "ftts": "floating time (ftts)",
    "core": "without time (core)",
}

NEVER = "for ever"  # a time between two events of which the second need not come


def view_of(semantics: Semantics | str) -> str:
    """The name of a view of the semantics."""
    return _VIEWS.get(semantics, semantics)


def measured(extreme: Extreme) -> str:
    """A least or greatest value."""
    return NEVER if extreme.value is None else str(extreme.value)


def title(violation: Violation) -> str:
    """`overflow controller`; a kind that is its own name stands alone."""
    kind, name = violation.kind, violation.name
    return kind if kind == name else f"{kind} {name}"


def call(message: ShownMessage) -> str:
    """`start(1, true)`."""
    return f"{message.server}({', '.join(value for _, value in message.arguments)})"


def named_call(message: ShownMessage) -> str:
    """`start(speed = 1, forward = true)`."""
    listed = ", ".join(f"{name} = {value}" for name, value in message.arguments)
    return f"{message.server}({listed})"


def heading(step: TraceStep) -> str:
    """What happens in a step, in one line."""
    match step.kind, step.message:
        case "start", _:
            return "the constructors run"
        case "time", _:
            return f"time passes until {step.until}"
        case "resume", None:
            return f"{step.rebec} goes on"
        case "resume", ShownMessage() as message:
            return f"{step.rebec} goes on with {call(message)}"
        case _, ShownMessage() as message:
            return f"{step.rebec}.{call(message)} from {message.sender}"
        case _:
            return step.rebec


def option(step: TraceStep) -> str:
    """A step among others that could be made: what happens, and which choices tell it apart."""
    chosen = f", chooses {', '.join(step.choices)}" if step.choices else ""
    return heading(step) + chosen


def sending(message: ShownMessage, now: int) -> str:
    """A message that is sent, and the times of it that are not the usual ones."""
    return f"{message.receiver}.{call(message)}{times(message, now)}"


def times(message: ShownMessage, now: int) -> str:
    """` at 7, due by 9`: when a message arrives unless it is now, and until when it is in time."""
    arrival = f" at {message.arrival}" if message.arrival != now else ""
    return arrival + (f", due by {message.deadline}" if message.deadline is not None else "")


def waiting(message: ShownMessage) -> str:
    """A message in a bag with all that is known of it."""
    due = f", due by {message.deadline}" if message.deadline is not None else ""
    return f"{call(message)} from {message.sender} at {message.arrival}{due}"


def doing(rebec: ShownRebec) -> str:
    """`busy until 4, goes on at line 31`, or an empty text for an idle rebec."""
    parts = []
    if rebec.busy_until is not None:
        parts.append(f"busy until {rebec.busy_until}")
    if rebec.suspended_at is not None:
        parts.append(f"goes on at line {rebec.suspended_at}")
    return ", ".join(parts)


def values(rebec: ShownRebec) -> str:
    """`left: at = 1, moving = false`."""
    return f"{rebec.name}: {', '.join(f'{name} = {value}' for name, value in rebec.variables)}"


def difference(change: Change) -> str:
    """`speed: 1 -> 2`."""
    return f"{change.variable}: {change.before} -> {change.after}"


def counted(number: int, singular: str, plural: str = "") -> str:
    """`1 state`, `1,200 states`."""
    return f"{number:,} {singular if number == 1 else plural or singular + 's'}"


def duration(seconds: float) -> str:
    """A time that somebody waited, in seconds with as many digits as tell something."""
    return f"{seconds:.2f} s" if seconds < 10 else f"{seconds:,.0f} s"


def memory(size: int) -> str:
    """A number of bytes in the largest unit that it fills, of a thousand of the next."""
    amount, unit = float(size), 0
    while amount >= 1000 and unit < len(_UNITS) - 1:
        amount, unit = amount / 1000, unit + 1
    return (
        f"{amount:.0f} {_UNITS[unit]}"
        if unit == 0 or amount >= 10
        else (f"{amount:.1f} {_UNITS[unit]}")
    )


def rate(states: int, seconds: float) -> float:
    """States per second; 0 when it went too fast to tell."""
    return states / seconds if seconds > 0 else 0.0
