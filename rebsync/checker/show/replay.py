"""Reading a run back from JSON, to replay it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, TypeAlias, get_args

from rebsync.checker.steps import Action, Semantics
from rebsync.diagnostics import RebsyncError, did_you_mean
from rebsync.long_numbers import long_number
from rebsync.records import dataclass
from rebsync.source import Source

_Json: TypeAlias = Any
_VIEWS: dict[str, Semantics] = {view: view for view in get_args(Semantics)}


@dataclass(frozen=True, slots=True)
class Recorded:
    """What a replay needs of a run: the model it is of, the view, what was done in each step.

    The first action is that of the step "start". `loop` is as in `Trace`.
    """

    model: str
    semantics: Semantics
    actions: tuple[Action, ...]
    loop: int | None


@dataclass(frozen=True, slots=True)
class _Part:
    """A part of the text and the way to it, such as `trace[3].action`."""

    path: str
    value: _Json
    place: str

    def wrong(self, wanted: str) -> RebsyncError:
        """The error that this part is not what it should be."""
        message = f"{self.place or 'the text'} is not {wanted}"
        return RebsyncError.of(self.path, "RS922", message)

    def member(self, name: str) -> _Part:
        """The member of an object."""
        if not isinstance(self.value, dict):
            raise self.wrong("an object")
        place = f"{self.place}.{name}" if self.place else name
        if name not in self.value:
            raise RebsyncError.of(self.path, "RS922", f"{place} is missing")
        return _Part(self.path, self.value[name], place)

    def items(self) -> Sequence[_Part]:
        """The items of a list."""
        if not isinstance(self.value, list):
            raise self.wrong("a list")
        return [_Part(self.path, v, f"{self.place}[{i}]") for i, v in enumerate(self.value)]

    def text(self) -> str:
        """The text that this part is."""
        if not isinstance(self.value, str):
            raise self.wrong("a text")
        return self.value

    def number(self, least: int) -> int:
        """The whole number that this part is."""
        if type(self.value) is not int or self.value < least:
            raise self.wrong(f"a whole number from {least} on")
        return self.value


def trace_from_json(source: Source, violation: str | None = None) -> Recorded:
    """The run that a text records: of `trace_json`, or of a violation in `result_json`.

    Of a result it is the violation with the name `violation`, by default the first. Raises
    RebsyncError when the text is no JSON (RS921), when a part is missing or wrong (RS922), when
    there is no such run in it (RS923).
    """
    whole = _Part(source.path, _parsed(source), "")
    if isinstance(whole.value, dict) and "violations" in whole.value:
        whole = _chosen(whole.member("violations"), violation)
    view = whole.member("semantics")
    if view.text() not in _VIEWS:
        raise view.wrong("one of " + ", ".join(_VIEWS))
    steps = whole.member("trace")
    actions = tuple(_action(step.member("action")) for step in steps.items())
    if not actions:
        raise RebsyncError.of(source.path, "RS923", "the run has no steps")
    loop = whole.member("loop")
    return Recorded(
        whole.member("model").text(),
        _VIEWS[view.text()],
        actions,
        None if loop.value is None else loop.number(0),
    )


def _parsed(source: Source) -> _Json:
    try:
        if long_number(source.text) is None:
            return json.loads(source.text)
        message = "a number in this is too long"
    except json.JSONDecodeError as error:
        message = f"this is no JSON: {error.msg} in line {error.lineno}, column {error.colno}"
    except RecursionError:
        message = "this nests deeper than rebsync reads"
    except ValueError:  # where Python's own limit is in force
        message = "a number in this is too long"
    hint = "a run is what `--format json` prints"
    raise RebsyncError.of(source.path, "RS921", message, hint)


def _chosen(violations: _Part, name: str | None) -> _Part:
    found = violations.items()
    if not found:
        message = "there is no run in this: it is a result without violations"
        raise RebsyncError.of(violations.path, "RS923", message)
    if name is None:
        return found[0]
    names = [each.member("name").text() for each in found]
    if name not in names:
        hint = did_you_mean(name, names) or f"there are {', '.join(dict.fromkeys(names))}"
        raise RebsyncError.of(violations.path, "RS923", f'no violation is called "{name}"', hint)
    return found[names.index(name)]


def _action(part: _Part) -> Action:
    return Action(
        part.member("actor").number(-1),
        part.member("slot").number(-1),
        tuple(choice.number(0) for choice in part.member("choices").items()),
    )
