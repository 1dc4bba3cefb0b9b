"""Compares what was extracted with the facts: which were found, which answers are right."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from rebsync.records import dataclass
from tests.reverse.corpus.facts import Pair, pair_at_site, paired
from tests.reverse.corpus.values import OPEN, RIGHT, WRONG, Json, Verdict, judge_null

Place: TypeAlias = "tuple[str, int, str]"

KINDS = {
    "nodes": "node",
    "publishers": "publisher",
    "subscriptions": "subscription",
    "timers": "timer",
    "rates": "rate",
    "parameters": "parameter",
    "services": "service",
    "clients": "client",
}


@dataclass(frozen=True, slots=True)
class Comparison:
    """Facts and answers of one repository, each fact and each answer once."""

    pairs: tuple[Pair, ...]
    missed: tuple[Json, ...]
    extra: tuple[Json, ...]
    at_sites: tuple[Pair, ...] = ()

    @property
    def facts(self) -> int:
        return len(self.pairs) + len(self.missed)

    @property
    def found(self) -> int:
        """Facts that were found; one whose callers were all found in its place is."""
        at_sites = {_place(p.answer) for p in self.at_sites if p.verdict is RIGHT}
        waiting = [p.fact for p in self.pairs if p.verdict is not RIGHT] + list(self.missed)
        by_sites = sum(_sites_in(fact, at_sites) for fact in waiting)
        return sum(p.verdict is RIGHT for p in self.pairs) + by_sites

    @property
    def answers(self) -> tuple[Pair, ...]:
        return self.pairs + self.at_sites

    @property
    def reported(self) -> int:
        return len(self.answers) + len(self.extra)

    def count(self, verdict: Verdict) -> int:
        """Answers of a worth; those without a fact are wrong."""
        extra = len(self.extra) if verdict is WRONG else 0
        return sum(p.verdict is verdict for p in self.answers) + extra

    @property
    def recall(self) -> float:
        return share(self.found, self.facts)

    @property
    def precision(self) -> float:
        """Of the answers that are given, those that are right; open ones are none."""
        return share(self.count(RIGHT), self.reported - self.count(OPEN))

    @property
    def unresolved(self) -> float:
        """Of all answers those that are open where the fact is not."""
        return share(self.count(OPEN), self.reported, 0.0)

    @property
    def unknown(self) -> float:
        """Of all answers those with an unknown name or type, whether one can know it or not."""
        answers = [*(p.answer for p in self.answers), *self.extra]
        return share(sum(map(_has_unknown, answers)), len(answers), 0.0)

    def details(self) -> dict[str, Counter[Verdict]]:
        """The verdicts on each further key."""
        found: defaultdict[str, Counter[Verdict]] = defaultdict(Counter)
        for pair in self.pairs:
            for key, verdict in pair.details.items():
                found[key][verdict] += 1
        return dict(found)


def share(part: int, whole: int, of_nothing: float = 1.0) -> float:
    """A part of a whole."""
    return part / whole if whole else of_nothing


def together(comparisons: Iterable[Comparison]) -> Comparison:
    """Several repositories as one; the files of each need their own names for that."""
    every = list(comparisons)
    return Comparison(
        tuple(p for c in every for p in c.pairs),
        tuple(m for c in every for m in c.missed),
        tuple(e for c in every for e in c.extra),
        tuple(p for c in every for p in c.at_sites),
    )


def _has_unknown(answer: Json) -> bool:
    if answer.get("nodelet"):
        return False
    return judge_null(answer.get("name")) is RIGHT or judge_null(answer.get("type")) is RIGHT


# --- matching -----------------------------------------------------------------------------------


def answers_of(graph: Mapping[str, Json]) -> Iterator[Json]:
    """The items of `extract --format json`, each with its kind, named as facts name things."""
    for list_name, kind in KINDS.items():
        for item in graph[list_name]:
            name = item.get("topic", item.get("name"))
            yield {**item, "kind": kind, "name": name, "node_class": item["within"]}


def compare(facts: Iterable[Json], answers: Iterable[Json]) -> Comparison:
    """Facts and answers at one place are paired so that most agree."""
    wanted, given = _by_place(facts), _by_place(answers)
    pairs = [p for place, here in wanted.items() for p in _matched(here, given.get(place, ()))]
    known = {id(p.fact) for p in pairs} | {id(p.answer) for p in pairs}
    missed = tuple(f for here in wanted.values() for f in here if id(f) not in known)
    rest = [a for there in given.values() for a in there if id(a) not in known]
    sites = _sites(f for here in wanted.values() for f in here)
    at_sites = tuple(pair_at_site(sites[_place(a)], a) for a in rest if _place(a) in sites)
    extra = tuple(a for a in rest if _place(a) not in sites)
    return Comparison(tuple(pairs), missed, extra, at_sites)


def _matched(facts: Sequence[Json], answers: Sequence[Json]) -> list[Pair]:
    """The facts and answers of one place, those first that agree most."""
    possible = [paired(fact, answer) for fact in facts for answer in answers]
    found = []
    while possible:
        best = max(possible, key=lambda p: p.agreement)
        found.append(best)
        possible = [p for p in possible if p.fact is not best.fact and p.answer is not best.answer]
    return found


def _place(item: Json) -> Place:
    return item["file"], item["line"], item["kind"]


def _by_place(items: Iterable[Json]) -> dict[Place, list[Json]]:
    found: defaultdict[Place, list[Json]] = defaultdict(list)
    for item in items:
        found[_place(item)].append(item)
    return found


def _sites(facts: Iterable[Json]) -> dict[Place, Json]:
    """The calls of helpers whose argument names a parameter, by place."""
    return {
        (site["file"], site["line"], fact["kind"]): site
        for fact in facts
        for site in fact.get("sites", ())
    }


def _sites_in(fact: Json, places: set[Place]) -> bool:
    """Whether all calls of the helper that a fact is in are among some places."""
    sites = {(s["file"], s["line"], fact["kind"]) for s in fact.get("sites", ())}
    return bool(sites) and sites <= places
