"""python -m tests.roundtrip.faults.signals [--dialect D] [--count N] [--seed N]

Ends real commands by signals at moments drawn at random, and looks at what they have left.
"""

from __future__ import annotations

import argparse
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.cli.run import environment
from tests.roundtrip.faults.interruptions import SYNC, after, whole
from tests.roundtrip.faults.package import PATROLS, Ended, Snapshot, copied, prepare, snapshot

ENDING = (signal.SIGINT, signal.SIGTERM)


def statuses(number: signal.Signals) -> tuple[int, ...]:
    """The exit statuses of a command that gets a signal: early, late, or after it is done."""
    return -number, 128 + number, 0


def _heed() -> None:
    """Ends by a signal even if what has started the tests does not, as in the background."""
    for number in ENDING:
        signal.signal(number, signal.SIG_DFL)


def started(folder: Path) -> subprocess.Popen[str]:
    """A sync in a process of its own, as a shell starts it: Ctrl-C ends it."""
    return subprocess.Popen(
        [sys.executable, "-m", "rebsync", "sync"],
        cwd=folder,
        env=environment() | {"REBSYNC_CACHE": str(folder / ".cache")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        preexec_fn=_heed,
    )


def signalled(
    made: Path, wanted: Snapshot, folder: Path, number: signal.Signals, pause: float
) -> tuple[int, list[str]]:
    """How a sync ends that gets a signal after a while, in seconds, and all that is wrong then."""
    old = snapshot(copied(made, folder))
    process = started(folder)
    time.sleep(pause)
    process.send_signal(number)
    told = process.communicate()[0]
    ended = Ended(process.returncode, told)
    wrong = after(SYNC, old, wanted, folder)
    if ended.status not in statuses(number):
        wrong.append(f"status {ended.status}: {told}")
    # Before that Python itself tells where it was.
    if "in main\n" in told:
        wrong.append(told)
    return ended.status, wrong


def main(arguments: Sequence[str]) -> int:
    """0 where no signal loses anything."""
    parser = argparse.ArgumentParser(prog="python -m tests.roundtrip.faults.signals")
    parser.add_argument("--dialect", choices=PATROLS, default="ros1-cpp")
    parser.add_argument("--count", type=int, default=50, help="of each signal")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    with TemporaryDirectory() as folder:
        made = Path(folder, "made")
        made.mkdir()
        prepare(made, PATROLS[given.dialect])
        return int(_all(made, random.Random(given.seed), given.dialect, given.count))


def _all(made: Path, draws: random.Random, dialect: str, count: int) -> bool:
    folder = made.parent / "tried"
    wanted, _ = whole(SYNC, made, folder)
    began = time.monotonic()
    copied(made, folder)
    started(folder).communicate()
    longest = time.monotonic() - began
    ends: Counter[tuple[str, int]] = Counter()
    wrong = 0
    for number in (*ENDING,) * count:
        pause = draws.uniform(0, longest)
        status, found = signalled(made, wanted, folder, number, pause)
        ends[number.name, status] += 1
        wrong += bool(found)
        for each in found:
            print(f"{dialect}, {number.name} after {pause:.3f} s: {each}", flush=True)
    print(f"{dialect}: {ends.total()} signals within {longest:.2f} s, {wrong} wrong")
    for (name, status), times in sorted(ends.items()):
        print(f"  {name}, exit status {status}: {times}")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
