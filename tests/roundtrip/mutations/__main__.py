"""python -m tests.roundtrip.mutations [--dialect D] [--most N] [--seed N] [--only WORD] [NAME]"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence

from tests.roundtrip.mutations.harness import Result, Said, Task, results
from tests.roundtrip.mutations.kinds import BEHAVIOUR, NEUTRAL, made_by
from tests.roundtrip.mutations.package import BY_NAME, DIALECTS, Kind

_FINE = {True: (Said.AT_ELEMENT, Said.AT_FILE, Said.ALIKE), False: (Said.IN_STEP, Said.ALIKE)}


def main(arguments: Sequence[str]) -> int:
    """0 where all that changes behaviour is reported and nothing else is."""
    parser = argparse.ArgumentParser(prog="python -m tests.roundtrip.mutations")
    parser.add_argument("examples", nargs="*", default=sorted(BY_NAME), metavar="EXAMPLE")
    parser.add_argument("--dialect", choices=DIALECTS, default="ros1-cpp")
    parser.add_argument("--most", type=int, default=10**6, help="of a kind in an example")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    parser.add_argument("--only", default="", help="kinds with this in their name")
    parser.add_argument("--module", default="", help="kinds of modules whose names begin so")
    given = parser.parse_args(arguments)
    changing, quiet = BEHAVIOUR[given.dialect], NEUTRAL[given.dialect]
    own = {k.name for k in made_by(given.module)} if given.module else None
    kinds = [k for k in (*changing, *quiet) if given.only in k.name]
    kinds = [k for k in kinds if own is None or k.name in own]
    names = [k.name for k in kinds]
    parts = [tuple(names[i : i + 20]) for i in range(0, len(names), 20)]
    tasks = [
        Task(example, part, given.most, given.seed, given.dialect)
        for example in given.examples
        for part in parts
    ]
    start = time.monotonic()
    found = list(results(tasks, given.jobs))
    wrong = _table("what changes behaviour", [k for k in kinds if k in changing], found, True)
    wrong += _table("what changes nothing", [k for k in kinds if k in quiet], found, False)
    for result in wrong:
        print(result)
    print(f"{len(found)} mutants in {time.monotonic() - start:.0f} s")
    return int(bool(wrong))


def _table(
    title: str, kinds: Sequence[Kind], found: Sequence[Result], changes: bool
) -> list[Result]:
    """Prints what was said of each kind; gives what should not have been said."""
    print(f"{title:40} {'mutants':>8} " + " ".join(f"{s.value:>14}" for s in Said))
    total: Counter[Said] = Counter()
    names = {kind.name for kind in kinds}
    for kind in kinds:
        own = Counter(r.said for r in found if r.kind == kind.name)
        total += own
        print(_row(kind.name, own))
    print(_row(f"all {len(kinds)} kinds", total))
    return [r for r in found if r.kind in names and r.said not in _FINE[changes]]


def _row(title: str, counts: Counter[Said]) -> str:
    cells = (counts[said] or "" for said in Said)
    return f"{title:40} {counts.total():>8} " + " ".join(f"{cell:>14}" for cell in cells)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
