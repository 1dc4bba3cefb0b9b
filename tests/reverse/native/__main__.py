"""python -m tests.reverse.native: writes the verdict of each case into its `case.toml` anew."""

from __future__ import annotations

import re
import tempfile
from collections import Counter
from pathlib import Path

from tests.reverse.native.closing import cases, verdicts

_VERDICT = re.compile(r"^verdict\..*\n", re.MULTILINE)


def main() -> None:
    """Counts what is said of values that runs show, and of some that none shows."""
    counted: Counter[tuple[str, str]] = Counter()
    found: dict[Path, list[str]] = {}
    for case in cases():
        with tempfile.TemporaryDirectory() as temporary:
            both = verdicts(case, Path(temporary))
        counted[both] += 1
        line = f'verdict.{case.language} = "{both[0]}"'
        found.setdefault(case.folder, []).append(line)
    for folder, lines in found.items():
        path = folder / "case.toml"
        text = _VERDICT.sub("", path.read_text(encoding="utf-8"))
        path.write_text(text + "\n".join(lines) + "\n", encoding="utf-8")
    for (shown, never), count in sorted(counted.items()):
        print(f"{count:4} of what a run shows: {shown}; of what none shows: {never}")


if __name__ == "__main__":
    main()
