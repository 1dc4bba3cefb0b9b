"""What stands in each row of a message sequence chart: the words of a step, cut to fit."""

from __future__ import annotations

from textwrap import wrap

from rebsync.checker.show import words
from rebsync.checker.show.flights import departures
from rebsync.checker.show.pieces import columns
from rebsync.checker.trace import TraceStep
from rebsync.records import dataclass

CELL = 6.8  # width of a character of the fixed-width font
LINE = 15.0
SEND = 18.0
_PAD = 5.0
_LEAST = 24.0
_LABEL = 40  # characters
_NOTE = 36
_CUT = "…"


@dataclass(frozen=True, slots=True)
class Words:
    """A line of text beside a lifeline, `y` from the top of its row; `kind` is its class."""

    column: int
    y: float
    text: str
    kind: str


@dataclass(frozen=True, slots=True)
class Row:
    """One step: its texts, the places (from its top) where messages leave, and its height.

    `notes` are the vertical extents of the box behind what changed.
    """

    step: TraceStep
    column: int
    texts: tuple[Words, ...]
    leaving: tuple[float, ...]
    notes: tuple[float, float] | None
    height: float


def row_of(step: TraceStep, names: tuple[str, ...]) -> Row:
    """The row of a step; rebecs are columns in the order of `names`."""
    if step.kind in ("start", "time"):
        return _common_row(step, names)
    column = names.index(step.rebec)
    texts: list[Words] = []
    y = _PAD

    def write(kind: str, lines: list[str]) -> tuple[float, float]:
        nonlocal y
        top = y
        for text in lines:
            texts.append(Words(column, y + LINE - 4, text, kind))
            y += LINE
        return top, y

    write("label", [cut(_label(step), _LABEL)])
    if step.choices:
        write("choice", _wrapped(f"chooses {', '.join(step.choices)}"))
    changed = [c for change in step.changes for c in _wrapped(words.difference(change))]
    notes = write("note", changed) if changed else None
    if step.failure is not None:
        write("failure", _wrapped(step.failure))
    leaving = []
    for message in step.sent:
        text = cut(words.sending(message, step.time), _LABEL)
        texts.append(Words(column, y + SEND - 7, text, "send"))
        y += SEND
        leaving.append(y - 3)
    return Row(step, column, tuple(texts), tuple(leaving), notes, max(y + _PAD, _LEAST))


def cut(text: str, most: int) -> str:
    """A text that is no longer than `most` characters."""
    return text if len(text) <= most else text[: most - 1] + _CUT


def width_of(text: str) -> float:
    """How wide a text is."""
    return columns(text) * CELL


def _label(step: TraceStep) -> str:
    told = words.call(step.message) if step.message is not None else "constructor"
    return f"{told} goes on" if step.kind == "resume" else told


def _wrapped(text: str) -> list[str]:
    return wrap(text, _NOTE, subsequent_indent="  ") or [""]


def _common_row(step: TraceStep, names: tuple[str, ...]) -> Row:
    """A row of nobody: time passes, or the constructors run, each sending to its own rebec."""
    y = _PAD + LINE
    texts = [Words(-1, y - 4, words.heading(step), "choice")]
    below = dict.fromkeys(names, y)
    leaving = []
    for message in departures(step):
        alone = message.sender == message.receiver
        y = below[message.sender] if alone else max(below.values())
        text = cut(words.sending(message, step.time), _LABEL)
        texts.append(Words(names.index(message.sender), y + SEND - 7, text, "send"))
        leaving.append(y + SEND - 3)
        for name in (message.sender,) if alone else names:
            below[name] = y + SEND
    return Row(step, -1, tuple(texts), tuple(leaving), None, max((*below.values(), y)) + _PAD)
