"""Each difference between the generations of ROS has a reason, and each reason a difference."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.reverse.corpus.pairs import IN_CPP, PAIRS, PORTS, REWRITTEN, Alike, aligned
from tests.reverse.corpus.reasons import (
    FILE,
    REASONS,
    Sides,
    counts,
    in_facts,
    reason_of,
    stale,
    unexplained,
)

README = (Path(__file__).parent / "README.md").read_text(encoding="utf-8")


def by_facts(pair: str) -> Alike:
    """A pair as the facts have it."""
    first, second = PAIRS[pair]
    return aligned(in_facts(first), in_facts(second))


@pytest.fixture(scope="module")
def every() -> dict[str, Alike]:
    """All pairs as the facts have them."""
    return {pair: by_facts(pair) for pair in PAIRS}


@pytest.mark.parametrize("pair", PAIRS)
def test_differences_and_reasons_are_the_same(every: dict[str, Alike], pair: str) -> None:
    found = every[pair].unlike
    assert unexplained(pair, found) == []
    assert stale(pair, found) == []
    assert {reason_of(pair, sides) for sides in found} <= set(REASONS)


def test_a_difference_without_a_reason_and_a_reason_without_one() -> None:
    missing: Sides = (None, "parameter nobody")
    assert unexplained("twist_mux", [missing]) == [missing]
    assert reason_of("twist_mux", missing) is None
    assert (None, "parameter scale") in stale("twist_mux", [missing])


def test_reasons_are_about_pairs_and_stand_one_on_a_line() -> None:
    text = FILE.read_text(encoding="utf-8")
    listed = [json.loads(line.rstrip(",")) for line in text.splitlines()[1:-1]]
    assert listed == json.loads(text)
    assert {one["pair"] for one in listed} <= set(PAIRS)
    assert set(counts()) == set(REASONS)


def test_the_reasons_of_the_page() -> None:
    rows = re.findall(r"^\| `([a-z]+)` \| ([^|]+) \| (\d+) \|$", README, re.MULTILINE)
    assert {name: (meaning, int(count)) for name, meaning, count in rows} == {
        name: (meaning, counts()[name]) for name, meaning in REASONS.items()
    }


def test_the_figures_of_the_page(every: dict[str, Alike]) -> None:
    examples = [n for n in PORTS if n.startswith("turtlebot3") and n != "turtlebot3 teleop"]
    together = {
        "turtlebot3, five examples": examples,
        "rospy_tutorials and demo_nodes_py, four nodes": list(REWRITTEN),
        "all of Python": [*PORTS, *REWRITTEN],
        "all of C++": list(IN_CPP),
        "all": list(PAIRS),
        **{name: [name] for name in PAIRS if name not in (*examples, *REWRITTEN)},
    }
    section = README.partition("\n## Pairs\n")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| ([^|]+) \| (\d+) of (\d+) \| +(\d+) % \|", section, re.MULTILINE)
    assert [name for name, *_ in rows] and {name for name, *_ in rows} == set(together)
    for name, shared, total, share in rows:
        found = [every[pair] for pair in together[name]]
        alike, both = sum(f.shared for f in found), sum(f.total for f in found)
        assert (int(shared), int(total), int(share)) == (alike, both, round(100 * alike / both))
