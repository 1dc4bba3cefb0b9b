"""python -m tests.reverse.soundness [FIRST LAST]: compares drawn nodes, and tells figures."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.reverse.soundness.comparing import tallied
from tests.reverse.soundness.effects import Tally

_BATCH = 25


def main(arguments: list[str]) -> int:
    """0 where every model can do what its code does, and no more where it is said to be exact."""
    first, last = map(int, arguments) if arguments else (0, 99)
    tally = Tally()
    for start in range(first, last + 1, _BATCH):
        with tempfile.TemporaryDirectory() as folder:
            tally += tallied(Path(folder), range(start, min(start + _BATCH, last + 1)))
    print(f"calls compared: {tally.exact} exact, {tally.approximated} over-approximated")
    print(f"calls of what is listed as unreadable: {tally.unreadable}")
    wrong = {"refused": tally.refused, "unsound": tally.unsound, "inexact": tally.inexact}
    for title, places in wrong.items():
        print(f"{title}: {len(places)}")
        for place in places[:20]:
            print(f"  {place}")
    return int(any(wrong.values()))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
