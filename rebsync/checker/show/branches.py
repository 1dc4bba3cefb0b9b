"""What else could happen in a run, for the script of the page that shows it step by step."""

from __future__ import annotations

from typing import Any, TypeAlias

from rebsync.checker.branching import Branching, Branchings, Successor
from rebsync.checker.show import words
from rebsync.checker.show.markup import Markup, element
from rebsync.terminal import json_text

Json: TypeAlias = dict[str, Any]


def branches_data(found: Branchings) -> Markup:
    """The data of a run: for each step what was possible in its place; last, what is after it."""
    data = json_text([_branching(each) for each in found]).replace("<", "\\u003c")
    return element("script", Markup(data), type="application/json", class_="branches-data")


def branches_section(live: str | None) -> Markup:
    """The place where the script shows what is possible; `live` is the address that runs steps.

    Without an address the steps can be looked at, and `rebsync simulate --serve` makes them.
    """
    return element(
        "section",
        element("h2", "What else could happen"),
        element("div", class_="possible"),
        class_="branches",
        id="branches",
        data_live=live,
        tabindex="0",
    )


def _branching(found: Branching) -> Json:
    return {
        "steps": [_successor(each) for each in found.successors],
        "more": found.count - len(found.successors),
        "unknown": found.unknown,
    }


def _successor(each: Successor) -> Json:
    step = each.step
    changed = [f"{change.rebec}.{words.difference(change)}" for change in step.changes]
    sent = [f"sends {words.sending(message, step.time)}" for message in step.sent]
    return {
        "ordinal": each.ordinal,
        "what": words.option(step),
        "does": [*changed, *sent],
        "failure": step.failure,
        "taken": each.is_taken,
    }
