"""python -m tests.roundtrip.histories [--seed N] [--count N] [--length N] [--dialect D]"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial

from tests.roundtrip.histories.history import History, history
from tests.roundtrip.mutations.package import DIALECTS


def main(arguments: Sequence[str]) -> int:
    """0 where every law held after every step."""
    parser = argparse.ArgumentParser(prog="python -m tests.roundtrip.histories")
    parser.add_argument("--seed", type=int, default=0, help="of the first history")
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--length", type=int, default=3, help="steps of each")
    parser.add_argument("--dialect", choices=DIALECTS, default=DIALECTS[0])
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    given = parser.parse_args(arguments)
    start = time.monotonic()
    seeds = range(given.seed, given.seed + given.count)
    one = partial(history, length=given.length, dialect=given.dialect)
    if given.jobs == 1:
        broken = told(map(one, seeds))
    else:
        with ProcessPoolExecutor(given.jobs) as pool:
            broken = told(pool.map(one, seeds))
    print(f"{time.monotonic() - start:.0f} s")
    return int(broken)


def told(histories: Iterable[History]) -> bool:
    """Prints what came of histories; whether a law was broken."""
    results: Counter[str] = Counter()
    count = broken = 0
    for each in histories:
        count += 1
        results.update(step.result for step in each.steps)
        for step in each.steps:
            if step.broken:
                broken += 1
                print(f"seed {each.seed}, {each.example}, step {len(each.steps)}: {step.edits}")
                print("".join(f"  {line}\n" for line in step.broken), end="", flush=True)
    print(f"{count} histories, {results.total()} steps, {broken} with a law that did not hold")
    for result, number in results.most_common():
        print(f"  {result:50} {number:>6}")
    return bool(broken)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
