"""Packages in Python that people edit come in step with their models, and nothing else changes."""

from __future__ import annotations

import difflib
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.roundtrip.verdict.drift import Verdict
from tests.roundtrip.python.packages import checked, made, python_of
from tests.roundtrip.python.test_check import PLAIN

TARGETS = ("ros1-py", "ros2-py")

# What is put for what in the code, and the lines of the model that go and come.
OF_CODE = {
    "guard": (
        "if cmd == 0:",
        "if cmd == 1:",
        ["    if (cmd == 0) {"],
        ["    if (cmd == 1) {"],
    ),
    "send": ("        self.send_self_begin()\n", "", ["    self.begin();"], []),
    "delay": (
        "delay(self._e11)",
        "delay(int32(2 * self._e11))",
        ["    delay(e11);"],
        ["    delay(2 * e11);"],
    ),
    "after": (
        "When(after=self._sr11)",
        "When(after=self._e11, deadline=9)",
        ["    self.S11() after(sr11);"],
        ["    self.S11() after(e11) deadline(9);"],
    ),
    "return": (
        "            self.send_self_A11()\n",
        "            if self._pos[0] == 2:\n                return\n"
        "            self.send_self_A11()\n",
        [],
        ["      if (pos[0] == 2) {", "        return;", "      }"],
    ),
    "state variable": (
        "        self._data: int = 0  # rebsync: statevar R1.data\n",
        "        self._data: int = 0  # rebsync: statevar R1.data\n        self._tries: int = 0\n",
        [],
        ["    int tries;"],
    ),
}

# What is put for what in the model, with the same of the code: how many lines of it go.
OF_MODEL = {
    "delay": ([("delay(e11);", "delay(e11 + 1);")], 1),
    "server": (
        [
            (
                "  msgsrv A11() {",
                "  msgsrv rest(int n) {\n    delay(n);\n  }\n\n  msgsrv A11() {\n    self.rest(2);",
            )
        ],
        1,
    ),
    "variable": (
        [
            ("    int data;", "    int data;\n    boolean seen;"),
            ("    data = 0;\n", "    data = 0;\n    seen = false;\n"),
        ],
        0,
    ),
    "constant": ([("env int e11 = 2;", "env int e11 = 5;")], 2),
    "queue": ([("reactiveclass R1(3)", "reactiveclass R1(6)")], 1),
    "argument": ([("R1 robot1(controller):(1, 0, 2)", "R1 robot1(controller):(1, 0, 3)")], 1),
}

# What somebody has made of the code by hand, without another meaning.
HAND = [
    (
        "r1.py",
        "    def begin(self) -> None:\n",
        '    def begin(self) -> None:\n        """Asks."""\n        print("begins")  # mine\n',
    ),
    (
        "r1.py",
        "    def _receive_P1(self, msg: R1P1) -> None:\n",
        "    # My remark.\n    def _receive_P1(self, msg: R1P1) -> None:\n",
    ),
    ("r1_sensors.py", "    return msg.data\n", "    return int(msg.data > 0)  # mine\n"),
]

# Of loops in `PLAIN`: an edit of the code, and a line of the model then.
LOOPS = {
    "body": (
        "self._a + k)",
        "self._a + 2 * k)",
        "for (int k = 0; k < 3; k++) { a = a + 2 * k; }",
    ),
    "start": ("range(3)", "range(2, 3)", "for (int k = 2; k < 3; k++) { a = a + k; }"),
    "start in a branch": (
        "k = 5",
        "k = 6",
        "if (a > 3) for (int k = 6; k > 3;",
    ),
    "behind the start": ("k = 5", "k = 1\n            self._a = 7", "    int k = 1;"),
    "bound": ("while i < 3:", "while i < 4:", "for (i = 0; i < 4; i += 1) a--;"),
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def cases(of: dict[str, object]) -> pytest.MarkDecorator:
    """Each case in one of the dialects, in turn."""
    found = [(name, TARGETS[number % 2]) for number, name in enumerate(of)]
    return pytest.mark.parametrize(("name", "target"), found)


@cases({**OF_CODE})
def test_changes_of_code_come_into_the_model(name: str, target: str, here: Path) -> None:
    root = made("running_example", target, here)
    old, new, gone, come = OF_CODE[name]
    _put(root, "r1.py", old, new)
    model = here / "running_example.rebeca"
    before, code = model.read_text(), _files(root)
    assert main(["sync", "."]) == 0
    assert _changed(before, model.read_text()) == (gone, come)
    assert _files(root) == code, "the code has it already"
    assert main(["check", "."]) == 0
    after = _files(here)
    assert main(["sync", "."]) == 0
    assert _files(here) == after, "nothing is left to do"


@cases({**OF_MODEL})
def test_changes_of_the_model_come_into_edited_code(name: str, target: str, here: Path) -> None:
    root = made("running_example", target, here)
    for each in HAND:
        _put(root, *each)
    _put(root, "/c.py", "self._moving = 0", "self._moving = 3")
    model = here / "running_example.rebeca"
    changes, lines = OF_MODEL[name]
    _change(model, changes)
    code = _files(root)
    assert main(["sync", "."]) == 0
    assert main(["check", "."]) == 0
    assert _verdict(root) is Verdict.IN_STEP
    text = model.read_text()
    assert "moving = 3" in text
    assert all(new in text for _, new in changes)
    for end, _, new in HAND:
        assert new in _file(root, end).read_text()
    gone = [line for path, old in code.items() for line in _changed(old, _now(root, path))[0]]
    assert len(gone) <= lines + 1, gone


@pytest.mark.parametrize("name", LOOPS)
def test_starts_of_loops_stay_in_their_heads(name: str, here: Path) -> None:
    root = made("counter", "ros1-py", here, PLAIN)
    old, new, line = LOOPS[name]
    _put(root, "/counter.py", old, new)
    assert main(["sync", "."]) == 0
    assert main(["check", "."]) == 0
    assert line in (here / "counter.rebeca").read_text()


@pytest.mark.parametrize("target", TARGETS)
def test_what_both_have_changed_is_left_to_decide(target: str, here: Path) -> None:
    root = made("running_example", target, here)
    _put(root, "r1.py", "delay(self._e11)", "delay(int32(2 * self._e11))")
    model = here / "running_example.rebeca"
    _change(model, [("delay(e11);", "delay(e11 + 1);")])
    code = _files(root)
    assert main(["check", "."]) == 1
    assert main(["sync", "."]) == 1
    text = model.read_text()
    assert "<<<<<<< model\n    delay(e11 + 1);\n" in text
    assert "    delay(2 * e11);\n>>>>>>> code\n" in text
    assert _files(root) == code
    _change(model, [(text, _decided(text))])
    assert main(["sync", "."]) == 0
    assert main(["check", "."]) == 0
    assert "delay(int32(self._e11 + 1))" in _file(root, "r1.py").read_text()


@pytest.mark.parametrize("target", TARGETS)
def test_generation_keeps_edits_by_hand(target: str, here: Path) -> None:
    root = made("running_example", target, here)
    for each in HAND:
        _put(root, *each)
    model = here / "running_example.rebeca"
    _change(model, [("delay(e11);", "delay(e11 + 1);")])
    assert main(["generate", model.name]) == 0
    for end, _, new in HAND:
        assert new in _file(root, end).read_text()
    assert not list(root.rglob("*.orig"))
    assert main(["check", "."]) == 0


def test_a_mixed_package_comes_in_step(here: Path) -> None:
    root = made("running_example", "mixed", here)
    _put(root, "/c.py", "self._moving = 0", "self._moving = 3")
    _put(root, "r1.cpp", "stopped_ = true;", "stopped_ = false;")
    model = here / "running_example.rebeca"
    _change(model, [("reactiveclass R1(3)", "reactiveclass R1(6)")])
    assert main(["sync", "."]) == 0
    assert main(["check", "."]) == 0
    assert "moving = 3" in model.read_text()


@pytest.mark.parametrize("target", TARGETS)
def test_both_sides_of_a_difference_may_be_packages(
    target: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    root = made("running_example", target, here)
    assert main(["diff", "running_example.rebeca", str(root)]) == 0
    _put(root, "r1.py", "self._data = 0", "self._data = 1")
    assert main(["diff", "running_example.rebeca", str(root)]) == 1
    assert "constructor R1: expression of data changed from 0 to 1" in capsys.readouterr().out


# What is left of a file of the running example, as a part of its text.
CUT = {"in a statement": ("r1.py", 0.2), "in a body": ("r1.py", 0.5), "launch": (".launch", 0.5)}


@pytest.mark.parametrize("name", CUT)
def test_what_a_cut_file_lacks_stays_in_the_model(name: str, here: Path) -> None:
    root = made("running_example", "ros1-py", here)
    end, part = CUT[name]
    path = next(p for p in root.rglob(f"*{end}") if ".rebsync" not in p.parts)
    text = path.read_text()
    path.write_text(text[: int(len(text) * part)])
    before = _files(here)
    assert main(["check", "."]) == 4
    assert main(["sync", "."]) == 4
    assert _files(here) == before


def test_check_says_of_a_lost_file_what_sync_says(here: Path) -> None:
    root = made("running_example", "ros2-py", here)
    _file(root, "/r1.py").unlink()
    before = _files(here)
    assert main(["check", "."]) == 4
    assert main(["sync", "."]) == 4
    assert _files(here) == before


# --- files --------------------------------------------------------------------------------------


def _put(root: Path, end: str, old: str, new: str) -> None:
    _change(_file(root, end), [(old, new)])


def _change(path: Path, changes: list[tuple[str, str]]) -> None:
    text = path.read_text()
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    path.write_text(text)


def _file(root: Path, end: str) -> Path:
    every = [*python_of(root), *(p for p in root.rglob("*.cpp") if ".rebsync" not in p.parts)]
    return next(p for p in every if p.as_posix().endswith(end))


def _files(root: Path) -> dict[str, str]:
    skipped = {".cache", ".rebsync", "README.md"}  # that page follows the model
    return {
        p.relative_to(root).as_posix(): p.read_text()
        for p in sorted(root.rglob("*"))
        if p.is_file() and not skipped & set(p.relative_to(root).parts)
    }


def _now(root: Path, path: str) -> str:
    return (root / path).read_text() if (root / path).is_file() else ""


def _changed(old: str, new: str) -> tuple[list[str], list[str]]:
    """The lines that go and those that come."""
    lines = list(difflib.ndiff(old.split("\n"), new.split("\n")))
    gone, come = ([x[2:] for x in lines if x.startswith(s)] for s in ("- ", "+ "))
    return gone, come


def _decided(text: str) -> str:
    """What the model has, of a text with one conflict."""
    before, _, rest = text.partition("<<<<<<< model\n")
    mine, _, rest = rest.partition("=======\n")
    return before + mine.partition("|||||||")[0] + rest.partition(">>>>>>> code\n")[2]


def _verdict(root: Path) -> Verdict:
    drift = checked(root).drift
    return drift.verdict if drift is not None else Verdict.IN_STEP
