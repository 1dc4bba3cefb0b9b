"""The run-time part of our own generated code: the mailbox, the drive, times of sends.

Methods of the mailbox give what a name of the model stands for, which is their `result`.
"""

from __future__ import annotations

from rebsync.reverse.libraries.routines import Effect, Kind, Language, Library, Routine

MAILBOX, DRIVE = "Mailbox", "Drive"
_CLOCK = {
    "now": "now",
    "arrival": "currentMessageArrival",
    "expiry": "currentMessageDeadline",
    "waitingTime": "currentMessageWaitingTime",
}
_IN_BOTH = {
    "post": Routine(arguments=("server", "when", "text", "callback"), does=Effect.SENDS),
    "publish": Routine(Kind.PUBLISH, ("publisher", "message", "when")),
    "delay": Routine(Kind.SLEEP, ("period",), does=Effect.TIME),
    "choose": Routine(arguments=("options",), does=Effect.RANDOM),
    "assertion": Routine(Kind.CHECK, ("condition",)),
    "construct": Routine(arguments=("callback",), does=Effect.ASKS),
    "receive": Routine(arguments=("", "", "", "", "callback"), does=Effect.ASKS),
    "sender": Routine(Kind.TOLD, result="sender"),
    "self": Routine(Kind.TOLD, result="self"),
}


def _cpp() -> dict[str, Routine]:
    clock = {n: Routine(Kind.TOLD, result=r, does=Effect.CLOCK) for n, r in _CLOCK.items()}
    unit = {"timeUnit": Routine(does=Effect.NONE)}
    return {**_IN_BOTH, **clock, **unit, "isA": Routine(Kind.TOLD, ("object", "class"))}


# The same in Python: what gives times of the model, which are whole numbers.
CLOCK = {
    **{"now": "now", "arrival": "currentMessageArrival"},
    **{"expiry": "currentMessageDeadline", "waiting_time": "currentMessageWaitingTime"},
}


def _python() -> dict[str, Routine]:
    clock = {n: Routine(Kind.TOLD, result=r, does=Effect.CLOCK) for n, r in CLOCK.items()}
    return {**_IN_BOTH, **clock, "is_a": Routine(Kind.TOLD, ("object", "class"))}


def names_in_model(language: Language) -> dict[str, str]:
    """The methods of the mailbox without arguments that give what the model has a name for."""
    methods = _cpp() if language is Language.CPP else _python()
    found = {n: r for n, r in methods.items() if r.kind is Kind.TOLD and r.result}
    return {n: r.result for n, r in found.items() if n != "self"}


# What gives whole numbers alone in Python, whatever it is given, if it gives something.
WHOLE = frozenset(
    {
        *("int8", "int16", "int32", "boolean", "truncated", "divide", "shift_left"),
        *("to_byte", "to_short", "to_int"),
    }
)
_MOVE = {"move": Routine(arguments=("motion", "callback"), does=Effect.ASKS)}

LIBRARIES = (
    Library(
        "rebsync run-time part",
        Language.CPP,
        methods={MAILBOX: _cpp(), DRIVE: _MOVE},
        nodes=frozenset({"lifecycle::RebecNode"}),
        marks=("rebsync:", "Mailbox"),
        starts=("rebsync:", "Mailbox"),
        flat=False,
        generated=True,
    ),
    Library(
        "rebsync run-time part",
        Language.PYTHON,
        methods={MAILBOX: _python(), DRIVE: _MOVE},
        marks=("rebsync:",),
        flat=False,
        generated=True,
    ),
)
