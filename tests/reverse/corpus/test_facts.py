"""The files of facts are what README.md says, and agree with themselves."""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path

import pytest

from tests.reverse.corpus.compare import KINDS, compare
from tests.reverse.corpus.facts import TYPED
from tests.reverse.corpus.packages import PACKAGES, PYTHON, ROS2, facts_of
from tests.reverse.corpus.values import RIGHT, Json

HERE = Path(__file__).parent
NAMES = sorted(path.stem for path in HERE.glob("*.json"))
README = (HERE / "README.md").read_text(encoding="utf-8")
USUAL = {"file", "line", "node_class", "kind", "name", "type"}
OF_KIND = {
    "node": {"anonymous", "nodelet"},
    "publisher": {"depth", "latched", "transport"},
    "subscription": {"depth", "callback", "single", "through", "transport"},
    "timer": {"period", "one_shot", "callback", "through", "autostart"},
    "rate": {"hz"},
    "parameter": {"access", "default", "value", "fallback", "sites"},
    "service": {"callback"},
    "client": set[str](),
}


def answer_to(fact: Json) -> Json:
    """The answer that says what a fact says."""
    said = dict(fact)
    for key in ("name", "period", "depth", "latched"):
        if said.get(key, "") is None and "nodelet" not in fact:
            said[key] = {"unknown": fact.get("why"), "partial": fact.get("partial")}
    if fact["kind"] in TYPED and fact["type"] is None:
        said["type"] = {"unknown": fact["why"]}
    called = fact.get("callback")
    if isinstance(called, dict):
        said["callback"] = {"one_of": [{"function": name} for name in called["one_of"]]}
    elif called is not None:
        said["callback"] = {"function": called}
    return said


@pytest.mark.parametrize("name", NAMES)
def test_facts_have_the_keys_of_their_kind(name: str) -> None:
    for fact in facts_of(name):
        assert set(fact) >= USUAL
        assert set(fact) <= USUAL | OF_KIND[fact["kind"]] | {"why", "partial", "note"}, fact
        assert fact["line"] >= 1
        open_name = fact["name"] is None and fact["kind"] not in ("timer", "rate")
        assert not open_name or fact["why"], fact


@pytest.mark.parametrize("name", NAMES)
def test_facts_stand_in_their_order_one_per_line(name: str) -> None:
    text = (HERE / f"{name}.json").read_text(encoding="utf-8")
    facts = [json.loads(line.rstrip(",")) for line in text.splitlines()[1:-1]]
    assert facts == facts_of(name)
    places = [(fact["file"], fact["line"]) for fact in facts]
    assert places == sorted(places)


@pytest.mark.parametrize(
    ("title", "names"),
    [
        *((name, [name]) for name in NAMES),
        ("C\\+\\+", [*PACKAGES]),
        ("C\\+\\+ for ROS 2", [*ROS2]),
        ("all", NAMES),
    ],
)
def test_the_figures_of_the_page(title: str, names: list[str]) -> None:
    row = re.search(rf"^\| {title} ((?:\| *\d+ *)+)\|$", README, re.MULTILINE)
    assert row is not None
    facts = [fact for name in names for fact in facts_of(name)]
    kinds = Counter(fact["kind"] for fact in facts)
    nodelets = sum("nodelet" in fact for fact in facts)
    nameless = [f for f in facts if f["name"] is None and f["kind"] not in ("timer", "rate")]
    shown = [int(cell) for cell in row[1].split("|")[1:]]
    figures = [kinds[kind] for kind in KINDS.values()]
    assert shown == [*figures, len(facts), len(nameless) - nodelets, nodelets]


@pytest.mark.parametrize("name", [*PACKAGES, *ROS2, *PYTHON])
def test_facts_agree_with_themselves(name: str) -> None:
    facts = facts_of(name)
    found = compare(facts, map(answer_to, facts))
    assert (found.found, found.reported, found.count(RIGHT)) == (len(facts),) * 3
    assert {v for counts in found.details().values() for v in counts} == {RIGHT}


@pytest.mark.parametrize("name", [*PACKAGES, *ROS2])
def test_facts_are_about_the_packages_that_are_read(name: str) -> None:
    packages = set(PACKAGES[name] if name in PACKAGES else ROS2[name][1])
    if packages != {"."}:
        assert {fact["file"].partition("/")[0] for fact in facts_of(name)} == packages
