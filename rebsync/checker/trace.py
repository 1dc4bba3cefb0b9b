"""A run of a model as people read it: values, no longer cells."""

from __future__ import annotations

from rebsync.checker.steps import Action, Semantics
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class ShownMessage:
    """A message in a bag; times are counted from the start, `deadline` None without one."""

    server: str
    arguments: tuple[tuple[str, str], ...]  # parameter, value
    sender: str
    arrival: int
    deadline: int | None
    receiver: str = ""


@dataclass(frozen=True, slots=True)
class ShownRebec:
    """A rebec in a state: its variables (name or name[i], value), its bag, until when it is busy.

    `suspended_at` is the line of the model where its body goes on, None when it is idle.
    """

    name: str
    variables: tuple[tuple[str, str], ...]
    bag: tuple[ShownMessage, ...]
    busy_until: int | None = None
    suspended_at: int | None = None


@dataclass(frozen=True, slots=True)
class Change:
    """A variable that a step changed."""

    rebec: str
    variable: str
    before: str
    after: str


@dataclass(frozen=True, slots=True)
class TraceStep:
    """One step: what happened (`kind`), when, to whom, and what it did.

    `kind`: "start" (constructors), "take" (a message), "resume" (after a delay), "time" (time
    passes). `time` is when it happens, `line` where its body starts or goes on (0: nowhere).
    `failure` is what went wrong in it, as a sentence, else None. `rebecs` is the state afterwards
    (before, when it failed); `until` is the time of that state. `code` is the place in the code
    that `line` was extracted from, if it was.
    """

    number: int
    kind: str
    time: int
    until: int
    rebec: str
    message: ShownMessage | None
    choices: tuple[str, ...]
    sent: tuple[ShownMessage, ...]
    changes: tuple[Change, ...]
    line: int
    rebecs: tuple[ShownRebec, ...]
    action: Action
    failure: str | None = None
    code: str = ""


@dataclass(frozen=True, slots=True)
class Trace:
    """A run; `loop` is the number of the step after which it repeats for ever, None when finite.

    In a lasso the steps after `loop` lead back to the state after step `loop`.
    """

    model: str
    semantics: Semantics
    steps: tuple[TraceStep, ...]
    loop: int | None = None
