"""What model and code have changed, put together: renames, elements that come and go, conflicts."""

from __future__ import annotations

import re

import pytest

from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.models import Favour, MergedModel, merged_model
from rebsync.roundtrip.merge.text import merged_text
from rebsync.roundtrip.package.models import parsed
from rebsync.source import Source

BASE = """\
env int e = 2;

@Robot
reactiveclass Robot(3) {
  knownrebecs { Robot other; }
  statevars {
    int x, y;  // where it is
    boolean on;
  }

  Robot(int x0) {
    x = x0;
    self.look();
  }

  msgsrv look() {
    x = (x+1) % 4;   // round
    if (on) self.look() after(e);
    other.go(x);
  }

  // Goes on.
  msgsrv go(int n) {
    delay(1);
    on = n > 3;
  }
}

main {
  Robot robot1(robot2):(1);
  Robot robot2(robot1):(2);
}
"""


def changed(text: str, changes: dict[str, str]) -> str:
    """A text with replacements; a key of one word stands for this word wherever it is."""
    for old, new in changes.items():
        assert old in text
        text = re.sub(rf"\b{old}\b", new, text) if old.isalnum() else text.replace(old, new)
    return text


def given_of(text: str) -> SourcedModel:
    source = Source("robot.rebeca", text)
    return SourcedModel(parsed(source), source)


def merged(model: dict[str, str], code: dict[str, str]) -> MergedModel:
    base, today, read = (given_of(changed(BASE, changes)) for changes in ({}, model, code))
    return merged_model(base, today, read, Favour.MARKERS)


GO = "  // Goes on.\n  msgsrv go(int n) {\n    delay(1);\n    on = n > 3;\n  }\n"
APART: dict[str, tuple[dict[str, str], dict[str, str], dict[str, str]]] = {
    "renamed in the model": (
        {"go": "move"},
        {"(x+1) % 4": "(x + 1) % 7", "other.go(x);": "other.go(x);\n    other.go(1);"},
        {"go": "move", "% 4": "% 7", "other.move(x);": "other.move(x);\n    other.move(1);"},
    ),
    "renamed in the code": (
        {"on = n > 3;": "on = n > 3;\n    x = 2;  // mine"},
        {"x": "place"},
        {"on = n > 3;": "on = n > 3;\n    x = 2;  // mine", "x": "place"},
    ),
    "new and gone": (
        {"% 4": "% 5"},
        {
            "env int e = 2;": "env int e = 2;\nenv int f = 3;",
            "delay(1)": "delay(f)",
            "int x, y;  // where it is": "int x;",
            "robot1):(2);": "robot1):(2);\n  Robot robot3(robot1):(3);",
        },
        {
            "% 4": "% 5",
            "env int e = 2;": "env int e = 2;\nenv int f = 3;",
            "delay(1)": "delay(f)",
            "int x, y;": "int x;",
            "robot1):(2);": "robot1):(2);\n  Robot robot3(robot1):(3);",
        },
    ),
    "a server is gone": (
        {},
        {GO: "", "    other.go(x);\n": ""},
        {f"\n{GO}": "", "    other.go(x);\n": ""},
    ),
    "a branch without braces": (
        {},
        {"if (on) self.look() after(e);": "if (on) { self.look() after(e); other.go(2); }"},
        {
            "if (on) self.look() after(e);": "if (on) {\n      self.look() after(e);\n"
            "      other.go(2);\n    }"
        },
    ),
}


@pytest.mark.parametrize("name", APART)
def test_changes_apart(name: str) -> None:
    model, code, wanted = APART[name]
    found = merged(model, code)
    assert not found.conflicts
    assert found.text == changed(BASE, wanted)


CONFLICTS: dict[str, tuple[dict[str, str], dict[str, str], str]] = {
    "two values": ({"% 4": "% 5"}, {"% 4": "% 6"}, "msgsrv Robot.look"),
    "two names": ({"go": "move"}, {"go": "walk"}, "msgsrv Robot.move"),
    "changed and gone": (
        {"n > 3": "n > 4"},
        {GO: "", "    other.go(x);\n": ""},
        "msgsrv Robot.go",
    ),
    "gone and changed": (
        {"  Robot robot2(robot1):(2);\n": "", "robot1(robot2)": "robot1(robot1)"},
        {"(robot1):(2)": "(robot1):(9)"},
        "rebec robot2",
    ),
}


@pytest.mark.parametrize("name", CONFLICTS)
def test_conflicts(name: str) -> None:
    model, code, element = CONFLICTS[name]
    found = merged(model, code)
    assert {str(d.element) for d in found.conflicts} == {element}
    assert "<<<<<<< model\n" in found.text
    assert ">>>>>>> code\n" in found.text


LABELS = ("mine", "theirs")
LINES = "a\nb\nc\nd\ne\n"


def test_lines() -> None:
    apart = merged_text(LINES.replace("a", "A"), LINES, LINES.replace("e", "E\nf"), LABELS)
    assert (apart.text, apart.conflicts) == ("A\nb\nc\nd\nE\nf\n", 0)
    both = merged_text(LINES.replace("c", "x"), LINES, LINES.replace("c", "y"), LABELS)
    wanted = "a\nb\n<<<<<<< mine\nx\n=======\ny\n>>>>>>> theirs\nd\ne\n"
    assert (both.text, both.conflicts) == (wanted, 1)
    same = merged_text(LINES.replace("c", "x"), LINES, LINES.replace("c", "x"), LABELS)
    assert (same.text, same.conflicts) == (LINES.replace("c", "x"), 0)
    nearly = merged_text(
        LINES.replace("c", "n\nx\nm"), LINES, LINES.replace("c", "n\ny\nz\nm"), LABELS
    )
    wanted = "a\nb\nn\n<<<<<<< mine\nx\n=======\ny\nz\n>>>>>>> theirs\nm\nd\ne\n"
    assert (nearly.text, nearly.conflicts) == (wanted, 1)
