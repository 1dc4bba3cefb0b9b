"""The controls of a run in a page: a step forward and back, playing, the time.

The script of it is the one that knows step and time of a run. It tells them to what draws them by
the event `timeshown`, and takes them by `stepselected` and `timewanted`; what shows the steps
themselves it asks by `stepwanted`.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.checker.show.markup import Markup, element
from rebsync.terminal import json_text

SPEEDS = ("0.25", "0.5", "1", "2", "5", "10", "50")


def playback_controls(
    name: str,
    steps: Sequence[tuple[int, float]],
    begin: float,
    end: float,
    chart: str | None = None,
) -> Markup:
    """The controls of the run `name`, of steps by their numbers and times.

    The run plays from `begin` to `end`; where these are one time, it plays step by step. `chart` is
    the id of what has the chart of the steps, in a page without a script of its own.
    """
    speeds = [
        element("option", f"{speed} units/s", value=speed, selected=speed == "1")
        for speed in SPEEDS
    ]
    is_timed = end > begin
    slider = element(
        "input",
        type="range",
        class_="time",
        min=repr(begin) if is_timed else "0",
        max=repr(end) if is_timed else str(len(steps) - 1),
        step="0.05" if is_timed else "1",
        value=repr(begin) if is_timed else "0",
        aria_label="Time" if is_timed else "Step",
        id=f"{name}-time",
    )
    data = {"begin": begin, "end": end, "steps": [list(step) for step in steps]}
    return element(
        "div",
        _button("first", "First", "Home"),
        _button("back", "Step back", "K"),
        _button("play", "Play", "P"),
        _button("forward", "Step", "J"),
        _button("last", "Last", "End"),
        slider,
        element("output", "", class_="clock", for_=f"{name}-time", aria_live="off"),
        element("select", *speeds, class_="speed", aria_label="Speed", title="Speed")
        if is_timed
        else element("input", type="hidden", class_="speed", value="1"),
        element("script", Markup(json_text(data)), type="application/json", class_="playback-data"),
        class_="controls",
        role="group",
        aria_label="Playback",
        data_chart=chart,
    )


def _button(act: str, text: str, key: str) -> Markup:
    return element(
        "button", text, type="button", data_act=act, title=f"{text} ({key.lower()})",
        aria_keyshortcuts=key,
    )  # fmt: skip
