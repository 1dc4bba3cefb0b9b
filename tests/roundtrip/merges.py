"""How many merges of edited code end in conflicts.

python -m tests.roundtrip.merges [--count N] [--seed N] [--shown]

Each is an edit of `edits/*.toml` in a dialect, met by some changes of the model by chance.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from random import Random

from rebsync.config import Config
from rebsync.diagnostics import RebsyncError
from rebsync.roundtrip.merge.code import LABELS, merged_file
from rebsync.roundtrip.merge.text import merged_text
from rebsync.roundtrip.package.generation import generated
from rebsync.source import Source
from tests.reverse.test_edits import BY_NAME
from tests.roundtrip.edits.trial import HERE, Case, Trial, cases
from tests.roundtrip.histories.model_edits import edited_model

_TRIED = ("python.toml", "rclcpp.toml", "cpp.toml")


@dataclass(frozen=True)
class Merge:
    """One file: as edited, as generated for what it says, and for the changed model."""

    case: str
    path: str
    ours: str
    base: str
    theirs: str
    is_edited: bool


@cache
def _texts(example: str, model: str, dialect: str) -> dict[str, str]:
    return generated(Source(f"{example}.rebeca", model), Config(target=dialect), example)


def merges(seed: int, count: int) -> Iterator[Merge]:
    """Merges by chance, of files that both sides have changed."""
    rng = Random(seed)
    found = [c for name in _TRIED for c in cases(HERE / name)]
    for number in range(count):
        case = rng.choice(found)
        try:
            yield from _of(case, rng)
        except (AssertionError, RebsyncError):
            print(f"{number}: {case} cannot be tried")


def _of(case: Case, rng: Random) -> Iterator[Merge]:
    plain = (BY_NAME[case.example] / f"{case.example}.rebeca").read_text(encoding="utf-8")
    told = plain
    for old, new, *_ in case.data.get("model", ()):
        told = told.replace(old, new, 1)
    today = told
    for _ in range(3):
        today = edited_model(rng, today)[1]
    if "later" in case.data or today == told:
        return
    before, base, now = (_texts(case.example, t, case.dialect) for t in (plain, told, today))
    edited = dict(before)
    for end, old, new in case.edits():
        ending = Trial(case, HERE).ending(end)
        paths = [p for p in edited if p.endswith(ending)]
        if len(paths) != 1 or old not in edited[paths[0]]:
            return
        edited[paths[0]] = edited[paths[0]].replace(old, new)
    for path in sorted(base.keys() & now.keys() & edited.keys()):
        texts = edited[path], base[path], now[path]
        if len(set(texts)) == 3:
            yield Merge(str(case), path, *texts, edited[path] != before.get(path))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--shown", action="store_true", help="print what is in conflict")
    given = parser.parse_args()
    counted: Counter[str] = Counter()
    for each in merges(given.seed, given.count):
        texts = (each.ours, each.base, each.theirs)
        merged = merged_file(each.path, texts, each.is_edited)
        counted["merges"] += 1
        counted["in conflict line by line"] += bool(merged_text(*texts, LABELS).conflicts)
        counted["in conflict"] += bool(merged.conflicts)
        if given.shown and merged.conflicts:
            print(f"--- {each.case} {each.path}\n{_marked(merged.text)}")
    for what, number in counted.items():
        print(f"{number:>6} {what}")


def _marked(text: str) -> str:
    """The conflicts of a text."""
    lines, within, found = text.splitlines(), False, []
    for line in lines:
        within = within or line.startswith("<<<<<<< ")
        if within:
            found.append(line)
        within = within and not line.startswith(">>>>>>> ")
    return "\n".join(found)


if __name__ == "__main__":
    main()
