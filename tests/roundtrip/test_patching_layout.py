"""What comes into a model from the code is laid out as its author does it."""

from __future__ import annotations

import pytest

from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.models import Favour, merged_model
from rebsync.roundtrip.package.models import parsed
from rebsync.source import Source

BASE = """reactiveclass Robot(3) {
  statevars {
    int x;
  }

  Robot() {
    x = 0;
    self.go();
  }

  msgsrv go() {
    x = x + 1;
  }
}

main {
  Robot robot():();
}
"""
CODE = (
    BASE.replace("    int x;\n", "    int x;\n    int y;\n")
    .replace(
        "    x = x + 1;\n", "    if ((x == 3) && ((y) > 2)) {\n      x = ((y + 1)) * 2;\n    }\n"
    )
    .replace(
        "main {", "reactiveclass Other(1) {\n  msgsrv no() {\n    delay((1));\n  }\n}\n\nmain {"
    )
)
WANTED = (
    BASE.replace("    int x;\n", "    int x;\n    int y;\n")
    .replace("    x = x + 1;\n", "    if (x == 3 && y > 2) {\n      x = (y + 1) * 2;\n    }\n")
    .replace("main {", "reactiveclass Other(1) {\n  msgsrv no() {\n    delay(1);\n  }\n}\n\nmain {")
)


def given(text: str) -> SourcedModel:
    source = Source("m.rebeca", text)
    return SourcedModel(parsed(source), source)


@pytest.mark.parametrize("step", ["  ", "    ", "\t"])
def test_by_the_indentation_of_the_file_and_without_parentheses(step: str) -> None:
    base = given(BASE.replace("  ", step))
    merged = merged_model(base, base, given(CODE), Favour.MARKERS)
    assert merged.text == WANTED.replace("  ", step)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("x < 0 || x > 9", "x < 0 || x > 9 || x == 5"),
        ("x > 1 && x < 5", "x > 1 && x < 5 && x != 3"),
        ("x + 1 > 3", "x + 1 + 2 * x > 3"),
        ("x - 1 > 3", "x - (1 - x) > 3"),
        ("x * 2 > 3", "(x + 1) * 2 > 3"),
        ("x * 2 > 3", "x * (2 + x) > 3"),
        ("!(x > 3)", "!(x > 4)"),
        ("-x > 3", "-(x + 1) > 3"),
    ],
)
def test_parts_of_an_expression_have_no_more_parentheses_than_they_need(
    before: str, after: str
) -> None:
    text = BASE.replace("x = x + 1;", f"if ({before}) x = 1;")
    base = given(text)
    wanted = text.replace(f"if ({before})", f"if ({after})")
    merged = merged_model(base, base, given(wanted), Favour.MARKERS)
    assert merged.text == wanted


NOTED = """// The page of the file.
env int e = 1;  // of e
env int f = 2;

reactiveclass Robot(3) /* head { */ {
  statevars // of { all ;
  {
    int x;
    int z /* of ; z */;
  }

  Robot() {
    x = 0;
    self.go();
  }

  msgsrv go() {
    // first
    x = x + f; // more
    switch (x) { // by x
      case 0: // none
        z = 1;
        break;
      default: // some
        z = 2;
    }
    self.go() after(x); // again
  }
}

main /* of { all */ {
  Robot robot():(); // the one
}
"""


@pytest.mark.parametrize(
    ("changes", "wanted"),
    [
        (
            [("    int x;", "    int y;\n    int x;")],
            [("  {\n    int x;", "  {\n    int y;\n    int x;")],
        ),
        (
            [("z */;", "z */;\n    int y;")],
            [("z */;", "z */;\n    int y;")],
        ),
        (
            [("(3)", "(4)")],
            [("reactiveclass Robot(3) /* head { */", "/* head { */ reactiveclass Robot(4)")],
        ),
        (
            [("  Robot robot", "  Robot first():();\n  Robot robot")],
            [("// the one", "// the one\n  Robot first():();")],
        ),
        ([("env int e = 1;  // of e\n", "")], [("env int e = 1;  // of e\n", "")]),
        (
            [
                (
                    "        break;\n",
                    "        break;\n      case 1:\n        z = 5;\n        break;\n",
                )
            ],
            [
                (
                    "    switch (x) { // by x",
                    "    // by x\n    // none\n    // some\n    switch (x) {",
                ),
                ("case 0: // none", "case 0:"),
                ("default: // some", "default:"),
                (
                    "        break;\n",
                    "        break;\n      case 1:\n        z = 5;\n        break;\n",
                ),
            ],
        ),
        (
            [
                ("    self.go() after(x); // again\n", ""),
                ("    x = x + f; // more\n", "    self.go() after(x);\n    x = x + f;\n"),
            ],
            [
                ("    self.go() after(x); // again\n", ""),
                ("    // first\n", "    // again\n    self.go() after(x);\n    // first\n"),
            ],
        ),
    ],
)
def test_comments_are_kept_and_count_as_no_code(
    changes: list[tuple[str, str]], wanted: list[tuple[str, str]]
) -> None:
    base = given(NOTED)
    code, text = NOTED, NOTED
    for old, new in changes:
        code = code.replace(old, new)
    for old, new in wanted:
        text = text.replace(old, new)
    assert merged_model(base, base, given(code), Favour.MARKERS).text == text


def test_what_each_side_adds_is_not_taken_for_one_that_is_renamed() -> None:
    base = given(BASE)
    end = "  msgsrv go() {"
    today = BASE.replace(end, f"  msgsrv mine() {{\n    x = 3;\n  }}\n\n{end}")
    code = BASE.replace(end, f"  msgsrv theirs() {{\n    x = 4;\n  }}\n\n{end}")
    code = code.replace("self.go();", "self.go();\n    self.theirs();")
    merged = merged_model(base, given(today), given(code), Favour.MARKERS)
    assert merged.conflicts
    assert "msgsrv mine() {" in merged.text and "msgsrv theirs() {" in merged.text
