"""Runs inputs by number, for a time or a count: `python -m tests.fuzz --seconds 240 --seed 1`."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from tests.fuzz.running import Figures, Finding, run_inputs, warm_up


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="the number of the first input")
    parser.add_argument("--inputs", type=int, default=10**9, help="end after so many")
    parser.add_argument("--seconds", type=float, default=60.0, help="end after so long")
    parser.add_argument("--limit", type=float, default=20.0, help="seconds for one command")
    parser.add_argument("--keep", type=Path, help="a folder for the inputs that found something")
    given = parser.parse_args()
    numbers = range(given.first, given.first + given.inputs)
    began = time.monotonic()
    figures = Figures()
    warm_up()
    for each in run_inputs(given.seed, numbers, given.seconds, given.limit, given.keep):
        figures = figures.with_(each)
        if isinstance(each, Finding):
            print(each.text(), flush=True)
    took = time.monotonic() - began
    print(f"{figures.text()} in {took:,.0f} s (seed {given.seed}, from {given.first})")
    return 1 if figures.findings else 0


if __name__ == "__main__":
    sys.exit(main())
