"""Why nodes that exist for both generations of ROS differ: a reason for each difference.

`differences/reasons.json` has one difference on each line: the pair of `pairs.PAIRS`, what each of
the two has (null where it has nothing of the kind), and one of `REASONS`. What differs is taken
from the facts, so that no checkout is needed; `pairs` says it of what is read from checkouts.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TypeAlias

from tests.reverse.corpus.compare import KINDS
from tests.reverse.corpus.generations import Entity, agree, entities
from tests.reverse.corpus.packages import PACKAGES, PYTHON, ROS2, facts_of
from tests.reverse.corpus.values import Json

FILE = Path(__file__).parent / "differences" / "reasons.json"

# Of each difference one of these is the reason.
REASONS = {
    "renamed": "has another name in the port",
    "new": "only the port has it",
    "dropped": "the port left it out",
    "later": "came to the branch for ROS 1 after the port was made",
    "type": "its messages have another type, most of them now with a header",
    "timing": "has another period",
    "sleep": "the other loop sleeps by itself, without a rate",
    "rewritten": "the port does the same in another way",
    "nodelet": "a nodelet, which the launch file names, became a component or a node",
    "library": "a library of ROS 1 made it by itself: parameters that can be reconfigured, cameras",
    "declared": "each is declared by itself, where ROS 1 reads them as one map",
    "generation": "the other generation of ROS has no such thing",
}

# What ROS 1 and what ROS 2 has; None for nothing.
Sides: TypeAlias = "tuple[str | None, str | None]"


@cache
def listed() -> dict[str, list[tuple[Sides, str]]]:
    """The differences that have a reason, by pair."""
    found: dict[str, list[tuple[Sides, str]]] = {}
    for one in json.loads(FILE.read_text(encoding="utf-8")):
        sides = one["ros1"], one["ros2"]
        found.setdefault(one["pair"], []).append((sides, one["reason"]))
    return found


def unlike(a: Entity, b: Entity) -> bool:
    """Whether two entities of one kind differ in their names or types."""
    return not (agree(a.name, b.name) and agree(a.type, b.type))


def reason_of(pair: str, sides: Sides) -> str | None:
    """The reason for a difference."""
    return next((reason for known, reason in listed().get(pair, []) if known == sides), None)


def unexplained(pair: str, found: list[Sides]) -> list[Sides]:
    """The differences that have no reason."""
    return [*(Counter(found) - Counter(sides for sides, _ in listed().get(pair, []))).elements()]


def stale(pair: str, found: list[Sides]) -> list[Sides]:
    """The reasons that nothing needs any more."""
    return [*(Counter(sides for sides, _ in listed().get(pair, [])) - Counter(found)).elements()]


# --- facts --------------------------------------------------------------------------------------


def in_facts(path: str) -> list[Entity]:
    """What facts say of a file or folder, whose path begins with the folder of a checkout."""
    checkout, _, _ = path.partition("/")
    places: Mapping[str, str] = {
        **{name: name for name in PACKAGES},
        **{name: folder for name, (folder, _) in (*ROS2.items(), *PYTHON.items())},
    }
    given = [f for name, at in places.items() if at == checkout for f in facts_of(name)]
    graph: dict[str, list[Json]] = {name: [] for name in KINDS}
    lists = {kind: name for name, kind in KINDS.items()}
    for fact in given:
        graph[lists[fact["kind"]]].append(_answer(fact, checkout))
    return entities(graph, path)


def _answer(fact: Json, checkout: str) -> Json:
    """A fact as an item of `extract --format json`."""
    item = {"callback": None, **fact, "file": f"{checkout}/{fact['file']}"}
    for key in ("name", "period", "depth", "default"):
        if item.get(key, "") is None and "why" in fact:
            partial = {"partial": fact["partial"]} if fact.get("partial") and key == "name" else {}
            item[key] = {"unknown": fact["why"], **partial}
    return item


def counts() -> Counter[str]:
    """How many differences each reason has."""
    return Counter(reason for found in listed().values() for _, reason in found)
