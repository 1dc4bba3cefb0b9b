"""The table of the states of a run: a row for each step, a column for each variable and bag."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.checker.show import words
from rebsync.checker.show.markup import Markup, element, escaped, joined
from rebsync.checker.trace import ShownMessage, ShownRebec, Trace, TraceStep


def states_table(
    trace: Trace, name: str, ending: str | None, falsified: Sequence[tuple[str, ...]] = ()
) -> Markup:
    """The table of a run that is called `name` in the page; changed cells are marked.

    `ending` is what is wrong after the last step, `falsified` after each of the first ones.
    """
    rows = []
    before: tuple[ShownRebec, ...] = ()
    for position, step in enumerate(trace.steps):
        told = [step.failure or (ending if step is trace.steps[-1] else None)]
        told += falsified[position] if position < len(falsified) else ()
        wrong = [each for each in told if each is not None]
        repeats = trace.loop is not None and step.number > trace.loop
        rows.append(_row(step, before, name, wrong, repeats))
        before = step.rebecs
    parts = [element("caption", "States"), _head(trace), element("tbody", joined(*rows))]
    if trace.loop is not None:
        said = f"The run repeats for ever: back to the state after step {trace.loop}."
        parts.append(element("tfoot", element("tr", element("td", said, colspan="99"))))
    return element("table", joined(*parts), class_="states")


def _head(trace: Trace) -> Markup:
    rebecs = trace.steps[0].rebecs
    fixed = [
        element("th", text, rowspan="2", scope="col", class_=kind)
        for text, kind in (("step", "at"), ("time", "when"), ("what", None), ("line", None))
    ]
    groups = [
        element("th", rebec.name, colspan=str(len(rebec.variables) + 1), scope="colgroup")
        for rebec in rebecs
    ]
    columns = [
        element("th", text, scope="col", class_=None if place else "first")
        for rebec in rebecs
        for place, text in enumerate([*(name for name, _ in rebec.variables), "bag"])
    ]
    return element("thead", element("tr", *fixed, *groups), element("tr", *columns))


def _row(
    step: TraceStep, before: tuple[ShownRebec, ...], name: str, wrong: Sequence[str], repeats: bool
) -> Markup:
    kinds = [kind for kind, is_so in (("wrong", wrong), ("repeats", repeats)) if is_so]
    what = [element("div", words.heading(step))]
    if step.choices:
        what.append(element("small", f"chooses {', '.join(step.choices)}"))
    what += [element("strong", each) for each in wrong]
    line = element("a", str(step.line), href=f"#L{step.line}") if step.line else None
    return element(
        "tr",
        element("th", str(step.number), scope="row", class_="at"),
        element("td", f"{step.time:,}", class_="number when"),
        element("td", *what, class_="what"),
        element("td", line, class_="number"),
        *_cells(step, before),
        id=f"{name}-s{step.number}",
        data_step=str(step.number),
        data_line=str(step.line) if step.line else None,
        class_=" ".join(kinds) or None,
    )


def _cells(step: TraceStep, before: tuple[ShownRebec, ...]) -> list[Markup]:
    cells = []
    for position, rebec in enumerate(step.rebecs):
        old = before[position] if before else rebec
        for place, (name, value) in enumerate(rebec.variables):
            is_new = old.variables[place] != (name, value)
            cells.append(_cell(escaped(value), place == 0, is_new))
        is_new = _held(old) != _held(rebec)
        cells.append(_cell(_bag(rebec, step.until), not rebec.variables, is_new))
    return cells


def _cell(content: Markup, first: bool, changed: bool) -> Markup:
    """A cell; the first one of each rebec has a rule on its left."""
    kinds = [kind for kind, is_so in (("first", first), ("changed", changed)) if is_so]
    return element("td", content, class_=" ".join(kinds) or None)


def _held(rebec: ShownRebec) -> tuple[object, ...]:
    return rebec.bag, rebec.busy_until, rebec.suspended_at


def _bag(rebec: ShownRebec, now: int) -> Markup:
    """What a rebec does and the messages that it has."""
    doing = words.doing(rebec)
    told = [element("em", doing)] if doing else []
    told += [_message(message, now) for message in rebec.bag]
    return element("div", joined(*told, between=" "), class_="bag") if told else Markup("")


def _message(message: ShownMessage, now: int) -> Markup:
    late = f" at {message.arrival}" if message.arrival > now else ""
    due = f", due by {message.deadline}" if message.deadline is not None else ""
    return element("span", f"{words.call(message)}{late}{due}", title=words.waiting(message))
