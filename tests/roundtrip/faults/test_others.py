"""Others at work while a command runs: editors that save a file, signals that end it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.run import environment
from tests.roundtrip.faults.package import MODEL_FILE, PATROLS, copied, prepare, run, snapshot
from tests.roundtrip.faults.signals import ENDING, signalled, statuses

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork")

_DIALECTS = ("ros1-cpp", "ros2-py")
_LATE = "late"


def saved(file: Path, text: str) -> Callable[[], None]:
    """Makes the process in which it is called meet an editor, which saves when it is to write."""

    def install() -> None:
        is_done = False

        def hook(event: str, arguments: tuple[object, ...]) -> None:
            nonlocal is_done
            if event == "open" and not is_done and str(arguments[0]).endswith(".rebsync.tmp"):
                is_done = True
                file.write_text(file.read_text(encoding="utf-8") + text, encoding="utf-8")

        sys.addaudithook(hook)

    return install


@pytest.fixture(scope="module", params=_DIALECTS)
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package that model and code have both moved away from."""
    folder = tmp_path_factory.mktemp("others") / "made"
    folder.mkdir()
    prepare(folder, PATROLS[str(request.param)])
    (folder / "dialect").write_text(str(request.param), encoding="utf-8")
    return folder


@pytest.mark.parametrize("is_model", [True, False], ids=["model", "code"])
def test_what_an_editor_saves_during_a_sync_is_not_lost(
    is_model: bool, made: Path, tmp_path: Path
) -> None:
    folder = copied(made, tmp_path / "tried")
    patrol = PATROLS[(folder / "dialect").read_text(encoding="utf-8")]
    name = MODEL_FILE if is_model else patrol.edits[0][0]
    line = f"{'//' if is_model else patrol.comment} {_LATE}\n"
    old = snapshot(folder)
    ended = run(folder, "sync", before=saved(folder / name, line))
    assert (ended.status, "RS812" in ended.told) == (2, True), ended.told
    assert snapshot(folder) == {**old, name: old[name] + line.encode()}
    again = run(folder, "sync")
    assert again.status == 0, again.told
    assert _LATE in (folder / name).read_text(encoding="utf-8")


def test_what_an_editor_saves_during_generate_is_not_lost(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path / "tried")
    patrol = PATROLS[(folder / "dialect").read_text(encoding="utf-8")]
    name, line = patrol.edits[0][0], f"{patrol.comment} {_LATE}\n"
    ended = run(folder, "generate", MODEL_FILE, before=saved(folder / name, line))
    assert (ended.status, "RS812" in ended.told) == (2, True), ended.told
    assert _LATE in (folder / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("number", ENDING, ids=lambda number: number.name)
def test_a_signal_loses_nothing(number: signal.Signals, made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path / "wanted")
    assert run(folder, "sync").status == 0
    wanted = snapshot(folder)
    # `python -m tests.roundtrip.faults.signals` draws many moments.
    status, wrong = signalled(made, wanted, tmp_path / "tried", number, 0.5)
    assert wrong == []
    assert status in statuses(number)


# What a signal raises in there comes out as another exception: RuntimeError before Python 3.12, and
# ctypes.ArgumentError.
_WHERE_IT_BECOMES_ANOTHER = {
    "while a class is made": """
class Field:
    def __set_name__(self, owner, name):
        kill()

command = lambda *_, **__: type("Made", (), {"field": Field()})
""",
    "while an argument is converted": """
class Argument:
    @classmethod
    def from_param(cls, value):
        kill()

foreign = ctypes.CDLL(None).abs
foreign.argtypes = [Argument]
command = lambda *_, **__: foreign(1)
""",
}
_ENDED = """
import ctypes, os, signal, sys, time
from rebsync import cli

def kill():
    os.kill(os.getpid(), signal.{name})
    time.sleep(60)  # a busy system may deliver it later

{code}
cli.rebsync.main = command
sys.exit(cli.main())
"""


@pytest.mark.parametrize("code", _WHERE_IT_BECOMES_ANOTHER.values(), ids=_WHERE_IT_BECOMES_ANOTHER)
@pytest.mark.parametrize("number", ENDING, ids=lambda number: number.name)
def test_a_signal_that_becomes_another_exception(number: signal.Signals, code: str) -> None:
    command = [sys.executable, "-c", _ENDED.format(name=number.name, code=code)]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True)
    assert (done.returncode, "Traceback" in done.stderr) == (128 + number, False), done.stderr
