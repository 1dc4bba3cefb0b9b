"""The movement of robots in a page: a drawing that plays, with the variables of the robots.

Without scripts it shows where the robots go. What the script needs is data in the page; which time
it draws, `playback.py` says.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.checker.movement.ways import Encounter, Movement, Way
from rebsync.checker.show.markup import Markup, element, joined
from rebsync.checker.show.movement_board import COLOURS, drawing
from rebsync.checker.show.movement_data import Frame, scene, short
from rebsync.checker.show.playback import playback_controls
from rebsync.terminal import json_text

_SAID = 8  # encounters that are listed


def movement_section(
    movement: Movement, steps: Sequence[Frame], name: str, chart: str | None = None
) -> Markup:
    """The section of a run; `name` is unique in the page.

    `chart` is the id of what has the chart of the steps, in a page without a script of its own:
    there the section has the controls, else they stand beside it (`movement_controls`).
    """
    controls = [] if chart is None else [movement_controls(movement, steps, name, chart)]
    data = json_text(scene(movement, steps)).replace("<", "\\u003c")
    variables = {r.name: r.variables for step in reversed(steps) for r in step.rebecs}
    rows = [
        _robot(way, place, variables.get(way.robot, ())) for place, way in enumerate(movement.ways)
    ]
    table = element(
        "table",
        element("caption", "Robots"),
        element("tbody", joined(*rows)),
        class_="robots",
    )
    facts = element("div", table, *_remarks(movement), class_="facts", tabindex="0", role="group",
                    aria_label="Robots")  # fmt: skip
    ground = element("div", drawing(movement, f"{name}-board"), class_="ground")
    return element(
        "details",
        joined(
            element("summary", "Movement"),
            *controls,
            element("div", ground, facts, class_="scene"),
            element("script", Markup(data), type="application/json", class_="scene-data"),
        ),
        class_="movement view-movement",
        open=True,
        id=f"{name}-movement",
    )


def movement_controls(
    movement: Movement, steps: Sequence[Frame], name: str, chart: str | None = None
) -> Markup:
    """The controls that play a run of robots, until the moves that it began have ended."""
    told = [(frame.number, short(frame.time)) for frame in steps]
    return playback_controls(name, told, short(movement.begin), short(movement.end), chart)


def _robot(way: Way, place: int, variables: Sequence[tuple[str, str]]) -> Markup:
    """A row: the colour and name of a robot, its cell, its variables."""
    swatch = element("span", class_=f"swatch r{place % COLOURS}")
    values = [
        element("span", name, " ", element("b", value, data_variable=str(number)), class_="value")
        for number, (name, value) in enumerate(variables)
    ]
    return element(
        "tr",
        element("th", swatch, way.robot, scope="row"),
        element("td", class_="place"),
        element("td", joined(*values, between=" ")),
        data_robot=str(place),
    )


def _remarks(movement: Movement) -> list[Markup]:
    """What a drawing alone does not say: who meets whom, and what is not known."""
    said = [element("ul", *map(_meeting, movement.encounters[:_SAID]), class_="encounters")]
    if len(movement.encounters) > _SAID:
        said.append(element("p", f"and {len(movement.encounters) - _SAID} more encounters"))
    if not movement.encounters and movement.nearest is not None:
        one, other = movement.nearest.robots
        far = f"{movement.nearest.distance:.2f} cells apart at {round(movement.nearest.time, 2):g}"
        said.append(element("p", f"Nearest: {one} and {other}, {far}.", class_="quiet"))
    if movement.end > movement.until:
        text = "moves that it began are drawn to their end."
        text = f"The run ends at {round(movement.until, 2):g}; {text}"
        said.append(element("p", text, class_="quiet"))
    unknown = [way.robot for way in movement.ways if not way.start.known]
    if len(movement.ways) > 1 and unknown:
        text = (
            f"The cells of {', '.join(unknown)} are not known: drawn from 0 on, and left out of "
            "encounters. [cells] in rebsync.toml says them."
        )
        said.append(element("p", text, class_="quiet"))
    said += [
        element(
            "p",
            f"Where {way.robot} is after {round(way.lost, 2):g} cannot be computed.",
            class_="quiet",
        )
        for way in movement.ways
        if way.lost is not None
    ]
    return said


def _meeting(each: Encounter) -> Markup:
    """A button that shows an encounter."""
    one, other = each.robots
    text = f"{one} and {other} collide: {each.distance:.2f} cells apart at {round(each.time, 2):g}"
    button = element("button", text, type="button", data_time=repr(each.time))
    return element("li", button)
