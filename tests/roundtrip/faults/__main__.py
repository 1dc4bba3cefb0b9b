"""python -m tests.roundtrip.faults [--dialect D] [--action WORD] [--step N]"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.roundtrip.faults.faults import faults, outcome
from tests.roundtrip.faults.interruptions import ACTIONS, Action, Stop, operations, tried, whole
from tests.roundtrip.faults.package import PATROLS, Patrol, copied, prepare, run

_MANY = 10_000


def main(arguments: Sequence[str]) -> int:
    """0 where each fault is told of, and nothing is lost by any."""
    parser = argparse.ArgumentParser(prog="python -m tests.roundtrip.faults")
    parser.add_argument("--dialect", choices=PATROLS, default="ros1-cpp")
    parser.add_argument("--action", default="", help="stop only what has this in its name")
    parser.add_argument("--step", type=int, default=1, help="every so many operations")
    given = parser.parse_args(arguments)
    patrol = PATROLS[given.dialect]
    with TemporaryDirectory() as folder:
        made = Path(folder, "made")
        made.mkdir()
        Path(folder).chmod(0o755)
        prepare(made, patrol)
        wrong = 0
        if not given.action:
            _large(made)
            wrong += _faults(made, patrol)
        for action in (a for a in ACTIONS if given.action in a.name):
            wrong += _stops(made, action, given.step)
        return int(wrong > 0)


def _large(made: Path) -> None:
    """Prints how long a sync takes among many files, in a repository and in the package."""
    for where in ("others", "patrol/data"):
        folder = copied(made, made.parent / "tried")
        for number in range(_MANY):
            path = folder / where / f"{number // 100}" / f"file{number}.txt"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"{number}\n", encoding="utf-8")
        (folder / ".git").mkdir()
        times = []
        for _ in range(2):
            start = time.monotonic()
            assert run(folder, "sync").status == 0
            times.append(time.monotonic() - start)
        print(f"{_MANY} files in {where}: sync {times[0]:.2f} s, nothing to do {times[1]:.2f} s")


def _faults(made: Path, patrol: Patrol) -> int:
    wrong = 0
    print(f"{'fault':44} status  told")
    for fault in faults(patrol):
        ended, broken = outcome(fault, made, made.parent / "tried", patrol)
        first = next((x for x in ended.told.split("\n") if " RS" in x or "RS" in x), "")
        print(f"{fault.name:44} {ended.status:>6}  {first[:110]}")
        print("".join(f"    {each}\n" for each in broken), end="")
        wrong += bool(broken)
    return wrong


def _stops(made: Path, action: Action, step: int) -> int:
    folder = made.parent / "tried"
    wanted, _ = whole(action, made, folder)
    count = operations(action, made, folder)
    ends: Counter[tuple[str, int]] = Counter()
    wrong = 0
    for is_killed in (True, False):
        how = "killed" if is_killed else "failed"
        for number in range(1, count + 1, step):
            done = tried(made, wanted, folder, Stop(number, is_killed, action))
            ends[how, done.ended.status] += 1
            for each in done.wrong:
                print(f"{action.name}, operation {number}, {how}: {each}")
            wrong += bool(done.wrong)
    print(f"{action.name}: {count} operations that write; stopped {ends.total()}, {wrong} wrong")
    for (how, status), number in sorted(ends.items()):
        print(f"  {how}, exit status {status}: {number}")
    return wrong


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
