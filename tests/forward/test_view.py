"""The view of a small model as data, and the first law: the same bytes anywhere."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rebsync.config import Config
from rebsync.forward.view import view
from rebsync.grammars.parser import parse_model
from rebsync.package import Package, Remap
from rebsync.source import Source
from rebsync.static import analyse
from tests.forward.compiling import CASES, case_files

_MODEL = """
env int mailbox = 3;
@Controller reactiveclass Control(5) {
  knownrebecs { Bot bot; }
  msgsrv report(int x) { bot.move(x); ((Bot) sender).stop() after(2); }
}
@Robot reactiveclass Bot(4) {
  knownrebecs { Control ctrl; }
  statevars { int posX; byte[2][3] map; }
  Bot(int start, boolean class) { posX = start; if (class) self.stop(); }
  @Port @priority(2) msgsrv move(int dX) { posX += dX + mailbox; ctrl.report(posX); }
  msgsrv stop() { }
}
main { Control rosout(r1):(); Bot r1(rosout):(1 + 2, true); }
"""


@pytest.fixture(scope="module")
def package() -> Package:
    parsed = parse_model(Source("small.rebeca", _MODEL))
    analysis = analyse(parsed.model)
    assert not analysis.errors
    return view(parsed.model, analysis, Config(), "small")[0]


def test_message_types(package: Package) -> None:
    found = {m.name: [f"{f.type} {f.name}" for f in m.fields] for m in package.messages}
    assert found == {"ControlReport": ["int x"], "BotMove": ["int d_x"], "BotStop": []}
    assert [m.name for m in package.messages if m.carries_sender] == ["ControlReport"]


def test_topics(package: Package) -> None:
    found = {s.path: (s.topic, s.on_bridge) for c in package.classes for s in c.subscriptions}
    assert found == {
        "Control.report": ("report", True),
        "Bot.move": ("port/move", False),
        "Bot.stop": ("stop", False),
    }
    assert package.node_class("Bot").subscriptions[0].priority == 2


def test_remaps(package: Package) -> None:
    control, bot = package.instances
    assert (control.name, control.rebec) == ("rosout_v", "rosout")
    assert control.remaps == (
        Remap("~bot/move", "r1/port/move"),
        Remap("~Bot/r1/stop", "r1/stop"),
    )
    assert bot.remaps == (Remap("~ctrl/report", "control_bridge/rosout_v/report"),)


def test_parameters(package: Package) -> None:
    bot = package.instances[1]
    assert [(p.key, p.value) for p in bot.parameters] == [
        ("knownrebecs/ctrl", "rosout_v"),
        ("start", 3),
        ("class", True),
    ]
    assert [(e.name, e.key, e.value) for e in package.env] == [("mailbox", "mailbox_v", 3)]


def test_state_types(package: Package) -> None:
    state = package.node_class("Bot").state
    assert [(f.name, str(f.type)) for f in state.fields] == [
        ("pos_x", "int"),
        ("map", "byte[2][3]"),
    ]


@pytest.mark.parametrize("case", sorted(CASES.glob("*.rebeca")), ids=lambda c: c.stem)
def test_same_bytes_again(case: Path) -> None:
    assert case_files(case) == case_files(case)


def test_same_bytes_elsewhere(tmp_path: Path) -> None:
    root = str(CASES.parents[2])
    digests = {
        subprocess.run(
            [sys.executable, "-c", _DIGEST],
            cwd=cwd,
            env={**os.environ, "PYTHONPATH": root, "PYTHONHASHSEED": str(n), "LC_ALL": locale},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for n, (locale, cwd) in enumerate(
            (("C", "/"), ("C.UTF-8", str(tmp_path)), ("tr_TR.UTF-8", root))
        )
    }
    here = [sorted(case_files(c).items()) for c in sorted(CASES.glob("*.rebeca"))]
    digests.add(hashlib.sha256(repr(here).encode()).hexdigest() + "\n")
    assert len(digests) == 1


_DIGEST = """
import hashlib
from tests.forward.compiling import CASES, case_files
files = [sorted(case_files(c).items()) for c in sorted(CASES.glob("*.rebeca"))]
print(hashlib.sha256(repr(files).encode()).hexdigest())
"""
