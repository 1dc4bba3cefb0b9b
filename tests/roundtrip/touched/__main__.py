"""python -m tests.roundtrip.touched [--form NAME] [--target NAME] [--drawn N] [WORD]

Touches the package of every model in every dialect, in every form, and lists what `rebsync check`
then says that it should not; `--drawn` takes so many drawn models in place of those of the tests,
with `--target mixed` alone those whose classes have drawn languages.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import sys
import time
import traceback
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.strategies import SearchStrategy

from rebsync import model as m
from rebsync.config import ClassTarget
from rebsync.printing import print_model
from tests.reverse.mixed import mixed
from tests.roundtrip.touched.forms import TOUCHED, files_of, forms
from tests.roundtrip.touched.packages import DIALECTS, MIXED, Case, cases, made, out_of_step
from tests.strategies import models


def main(arguments: Sequence[str]) -> int:
    """0 where every package stays in step."""
    parser = argparse.ArgumentParser(prog="python -m tests.roundtrip.touched")
    parser.add_argument("word", nargs="?", default="", help="models with this in their name")
    parser.add_argument("--form", action="append", choices=sorted(forms()), help="all if not given")
    parser.add_argument("--target", action="append", choices=(*DIALECTS, *MIXED))
    parser.add_argument("--drawn", type=int, default=0, metavar="N", help="this many drawn models")
    parser.add_argument("--seed", type=int, default=1, help="of drawn models")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    asked = parser.parse_args(arguments)
    one = of_models() if asked.target != [MIXED[0]] else of_mixed()
    known = drawn(one, asked.drawn, asked.seed) if asked.drawn else [*cases().values()]
    tasks = [
        (case, target, tuple(asked.form or forms()))
        for case in known
        for target in case.targets()
        if asked.word in case.name and target in (asked.target or target)
    ]
    start = time.monotonic()
    count = wrong = 0
    with ProcessPoolExecutor(asked.jobs) as pool:
        for lines, done in pool.map(tried, tasks):
            count, wrong = count + done, wrong + len(lines)
            for line in lines:
                print(line, flush=True)
    print(f"{count} packages in {time.monotonic() - start:.0f} s, {wrong} out of step")
    return int(bool(wrong))


def of_models() -> SearchStrategy[Case]:
    """Models of the strategy of the tests."""
    return models().map(lambda model: Case("drawn", print_model(model), model))


def of_mixed() -> SearchStrategy[Case]:
    """The same with classes in two languages, each in one that is drawn."""
    return mixed().map(_with_languages)


def _with_languages(found: tuple[m.Model, tuple[ClassTarget, ...]]) -> Case:
    model, targets = found
    in_python = frozenset(c.name for c in targets if c.target.endswith("-py"))
    return Case("drawn", print_model(model), model, in_python=in_python)


def drawn(one: SearchStrategy[Case], count: int, number: int) -> list[Case]:
    """So many cases of a strategy."""
    found: list[Case] = []

    @seed(number)
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        phases=(Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )
    @given(one)
    def draw(case: Case) -> None:
        found.append(replace(case, name=f"drawn {number}.{len(found)}"))

    draw()
    return found


def tried(task: tuple[Case, str, tuple[str, ...]]) -> tuple[list[str], int]:
    """What is wrong with the forms of one package, a line each; and how many there were."""
    case, target, names = task
    asked = [name for name in names if applies(name, target)]
    with TemporaryDirectory() as directory:
        folder = Path(directory)
        os.environ["REBSYNC_CACHE"] = f"{folder}/.cache"
        lines = [
            f"{case.name}, {target}, {form}: {'; '.join(told[:4])}"
            for form, told in _told(case, target, asked, folder)
            if told
        ]
    return lines, len(asked)


def applies(form: str, target: str) -> bool:
    """Whether a form changes anything of a dialect."""
    is_python = form == "quotes" or form.startswith(("ruff", "black"))
    if form in (TOUCHED, "crlf") or target in MIXED:
        return True
    return is_python == target.endswith("-py")


def _told(
    case: Case, target: str, asked: Sequence[str], folder: Path
) -> Iterator[tuple[str, Sequence[str]]]:
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            made(case, target, folder)
        generated = {path: path.read_bytes() for path in files_of(folder)}
        for form in asked:
            for path, text in generated.items():
                path.write_bytes(text)
            forms()[form](folder)
            yield form, out_of_step(folder)
    except Exception:  # whatever it is, it is told with the model's name
        yield "any form", (traceback.format_exc(),)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
