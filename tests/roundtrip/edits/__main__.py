"""Runs edits by hand through all steps, and prints what is not as it is to be.

python -m tests.roundtrip.edits [--said] [--once] [--judged] [FILE.toml...] [CASE...]
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import traceback
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.roundtrip.edits.drawing import in_one_dialect
from tests.roundtrip.edits.steps import all_steps, is_judged
from tests.roundtrip.edits.trial import FILES, HERE, Case, Trial, cases, made


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--said", action="store_true", help="print what is said of each")
    parser.add_argument("--dialect", help="of one dialect only")
    parser.add_argument("--once", action="store_true", help="each in the dialect of the tests")
    parser.add_argument("--judged", action="store_true", help="what is said, and no sync")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    files = [n for n in options.names if n.endswith(".toml")] or [*FILES]
    names = [n for n in options.names if not n.endswith(".toml")]
    found = [c for f in files for c in (in_one_dialect(f) if options.once else cases(HERE / f))]
    chosen = [c for c in found if not names or c.name in names or str(c) in names]
    chosen = [c for c in chosen if options.dialect in (None, c.dialect)]
    steps = is_judged if options.judged else all_steps
    wrong = sum(not _tried(case, options.said, steps) for case in chosen)
    print(f"{len(chosen)} edits, {wrong} not as they are to be")
    return 1 if wrong else 0


def _tried(case: Case, is_said: bool, steps: Callable[[Trial], None]) -> bool:
    out = io.StringIO()
    with TemporaryDirectory() as folder:
        os.environ["REBSYNC_CACHE"] = f"{folder}/cache"
        try:
            trial = made(case, Path(folder, case.example))
            if is_said:
                print(f"--- {case}\n    {trial.check()}", flush=True)
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                steps(trial)
        except AssertionError as error:
            where = traceback.extract_tb(error.__traceback__)[-1]
            print(
                f"{case}: {where.line}\n    {error}\n    " + out.getvalue().replace("\n", "\n    ")
            )
            return False
    return True


if __name__ == "__main__":
    raise SystemExit(main())
