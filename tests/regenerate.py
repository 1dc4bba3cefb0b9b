"""Make everything that tests compare with anew: `python tests/regenerate.py`."""

from __future__ import annotations

import shutil
from pathlib import Path

from rebsync.cli import main

EXAMPLES = Path(__file__).parent.parent / "examples"


def models() -> tuple[Path, ...]:
    """The model of every example."""
    return tuple(sorted(EXAMPLES.glob("*/*.rebeca")))


def regenerate_examples() -> None:
    """The committed package of every example, from nothing."""
    for model in models():
        shutil.rmtree(model.parent / model.stem, ignore_errors=True)
        status = main(["generate", str(model), "-o", str(model.parent)])
        assert status == 0, f"{model}: exit status {status}"


def regenerate_monitors() -> None:
    """What depends on the model in the monitor of a small one, in all dialects."""
    from rebsync.config import TARGETS
    from tests.forward.test_monitor_files import GOLDEN, own_files

    shutil.rmtree(GOLDEN, ignore_errors=True)
    for target in TARGETS:
        for path, text in own_files(target).items():
            place = GOLDEN / target / path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    regenerate_examples()
    regenerate_monitors()
