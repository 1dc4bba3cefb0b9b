"""Figures on public packages: `python -m tests.reverse.corpus DIR`.

DIR holds checkouts of the repositories that README.md lists, each in a folder of its name.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from tests.reverse.corpus.packages import PACKAGES
from tests.reverse.corpus.printing import as_data, as_text
from tests.reverse.corpus.repositories import results


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the comparison; 1 where nothing can be compared."""
    parser = argparse.ArgumentParser(prog="python -m tests.reverse.corpus", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--json", action="store_true", help="one object instead of text")
    parser.add_argument("--short", action="store_true", help="no list of what differs")
    parser.add_argument("--bodies", action="store_true", help="how bodies are read as well")
    given = parser.parse_args(arguments)
    found = list(results(given.folder, given.bodies))
    if not found:
        print(f"{given.folder}: no checkout of {', '.join(PACKAGES)}", file=sys.stderr)
        return 1
    if given.json:
        print(json.dumps(as_data(found), indent=2, ensure_ascii=False))
    else:
        print(as_text(found, given.short), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
