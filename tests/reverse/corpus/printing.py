"""The comparison as tables for people, or as one object."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence

from tests.reverse.corpus.compare import KINDS, Comparison, share, together
from tests.reverse.corpus.facts import Pair
from tests.reverse.corpus.repositories import Bodies, Result
from tests.reverse.corpus.repositories import together as all_bodies
from tests.reverse.corpus.values import OPEN, RIGHT, WRONG, Json, Verdict

_HEAD = (
    *("repository", "facts", "found", "recall", "reported", "right", "wrong", "precision"),
    *("open", "unresolved", "unknown", "files", "KB", "seconds"),
)
_GRADES = ("over-approximated", "assumed", "unreadable")
_PACKAGES = ("no model", "exact", *_GRADES)
_MOST = 15


def as_text(results: Sequence[Result], short: bool = False) -> str:
    """The table of repositories, those of kinds and keys, and everything that differs."""
    every = together(r.comparison for r in results)
    blocks = [
        _table([_HEAD, *map(_row, results), _row(_all(results))]),
        _table([("kind", "facts", "found", "recall"), *_kinds(every)]),
        _table([("detail", "facts", "right", "open", "wrong", "recall"), *_details(every)]),
    ]
    blocks += _bodies(results)
    if not short:
        for result in results:
            lines = [_line(d) for d in differences(result.comparison)]
            blocks.append("".join(f"{line}\n" for line in [f"{result.name}:", *lines]))
    return "\n".join(blocks)


def as_data(results: Sequence[Result]) -> Json:
    """The same for other programs."""
    return {
        "repositories": {r.name: _data(r) for r in results},
        "all": _data(_all(results)),
    }


def _all(results: Sequence[Result]) -> Result:
    bodies = [r.bodies for r in results if r.bodies is not None]
    return Result(
        "all",
        together(r.comparison for r in results),
        sum(r.files for r in results),
        sum(r.size for r in results),
        sum(r.seconds for r in results),
        all_bodies(bodies) if bodies else None,
    )


# --- figures ------------------------------------------------------------------------------------


def _row(result: Result) -> tuple[str, ...]:
    c = result.comparison
    return (
        *(result.name, str(c.facts), str(c.found), _percent(c.recall)),
        *(str(c.reported), str(c.count(RIGHT)), str(c.count(WRONG)), _percent(c.precision)),
        *(str(c.count(OPEN)), _percent(c.unresolved), _percent(c.unknown)),
        *(str(result.files), str(result.size // 1000), f"{result.seconds:.2f}"),
    )


def _percent(part: float) -> str:
    return f"{100 * part:.1f} %"


def _kinds(comparison: Comparison) -> Iterator[tuple[str, ...]]:
    for kind in KINDS.values():
        pairs = [p for p in comparison.pairs if p.fact["kind"] == kind]
        missed = [m for m in comparison.missed if m["kind"] == kind]
        found = sum(p.verdict is RIGHT for p in pairs)
        facts = len(pairs) + len(missed)
        yield kind, str(facts), str(found), _percent(share(found, facts))


def _details(comparison: Comparison) -> Iterator[tuple[str, ...]]:
    for key, counts in comparison.details().items():
        each = [counts[v] for v in (RIGHT, OPEN, WRONG)]
        recall = _percent(share(counts[RIGHT], sum(each)))
        yield key, str(sum(each)), *map(str, each), recall


def _bodies(results: Sequence[Result]) -> Iterator[str]:
    """The table of what is exact, and the reasons why something is not."""
    every = [(r.name, r.bodies) for r in [*results, _all(results)] if r.bodies is not None]
    if not every:
        return
    head = ("bodies", "statements", *_GRADES, "exact", *(f"packages: {g}" for g in _PACKAGES))
    yield _table([(*head, "seconds"), *(_grades(name, bodies) for name, bodies in every)])
    reasons = every[-1][1].reasons
    for grade in _GRADES:
        most = [(why, n) for (g, why), n in reasons.most_common() if g == grade][:_MOST]
        yield _table([(f"{grade} because", "places"), *((why, str(n)) for why, n in most)])


def _grades(name: str, bodies: Bodies) -> tuple[str, ...]:
    places = [bodies.grades[grade] for grade in _GRADES]
    exact = share(max(bodies.statements - sum(places), 0), bodies.statements)
    packages = [bodies.packages[grade] for grade in _PACKAGES]
    counts = map(str, [bodies.statements, *places])
    return name, *counts, _percent(exact), *map(str, packages), f"{bodies.seconds:.2f}"


def _table(rows: Iterable[tuple[str, ...]]) -> str:
    """Columns as wide as they must be; the first to the left, others to the right."""
    every = list(rows)
    widths = [max(map(len, column)) for column in zip(*every, strict=True)]
    lines = []
    for first, *others in every:
        cells = [f"{cell:>{width}}" for cell, width in zip(others, widths[1:], strict=True)]
        lines.append("  ".join([f"{first:{widths[0]}}", *cells]))
    return "".join(f"{line}\n" for line in lines)


def _data(result: Result) -> Json:
    c = result.comparison
    return {
        "facts": c.facts,
        "found": c.found,
        "recall": c.recall,
        "reported": c.reported,
        "right": c.count(RIGHT),
        "wrong": c.count(WRONG),
        "open": c.count(OPEN),
        "precision": c.precision,
        "unresolved": c.unresolved,
        "unknown": c.unknown,
        "files": result.files,
        "characters": result.size,
        "seconds": result.seconds,
        "details": {
            key: {v.value: counts[v] for v in Verdict} for key, counts in c.details().items()
        },
        "bodies": None if result.bodies is None else _bodies_data(result.bodies),
        "differences": list(differences(c)),
    }


def _bodies_data(bodies: Bodies) -> Json:
    return {
        "statements": bodies.statements,
        "places": dict(bodies.grades),
        "packages": dict(bodies.packages),
        "reasons": [
            {"grade": grade, "why": why, "places": n}
            for (grade, why), n in bodies.reasons.most_common()
        ],
        "seconds": bodies.seconds,
    }


# --- what differs -------------------------------------------------------------------------------


def differences(comparison: Comparison) -> Iterator[Json]:
    """Everything that is not right, in the order of places."""
    found: list[Json] = []
    for fact in comparison.missed:
        found.append(_difference("missed", fact, "name", fact["name"], None))
    for answer in comparison.extra:
        found.append(_difference("extra", answer, "name", None, answer["name"]))
    for pair in comparison.answers:
        found += _in_pair(pair)
    yield from sorted(found, key=lambda d: (d["file"], d["line"]))


def _in_pair(pair: Pair) -> Iterator[Json]:
    for key, verdict in {**pair.details, **pair.keys}.items():
        if verdict is not RIGHT:
            what = verdict.value if key in pair.keys else f"{verdict.value} detail"
            yield _difference(what, pair.answer, key, pair.fact.get(key), pair.answer.get(key))


def _difference(what: str, item: Json, key: str, fact: Json, answer: Json) -> Json:
    return {
        "what": what,
        "file": item["file"],
        "line": item["line"],
        "kind": item["kind"],
        "key": key,
        "fact": fact,
        "answer": answer,
    }


def _line(difference: Json) -> str:
    place = f"{difference['file']}:{difference['line']}"
    what = f"{difference['what']} {difference['kind']} {difference['key']}"
    fact, answer = (_short(difference[k]) for k in ("fact", "answer"))
    return f"  {place}: {what}: fact {fact}, answer {answer}"


def _short(value: Json) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 160 else text[:157] + "..."
