"""`rebsync lint` as a user runs it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.cli.run import rebsync

CLEAN = """\
reactiveclass R(2) {
  R() {
    self.go();
  }

  msgsrv go() {
    self.go() after(1);
  }
}

main {
  R r():();
}
"""
SLIPS = CLEAN.replace("self.go();", "self.go()").replace("main", "mian")
WRONG = CLEAN.replace("self.go();", "self.stop();")


@pytest.mark.parametrize("style", ["text", "json", "sarif", "github"])
def test_a_clean_model(tmp_path: Path, style: str) -> None:
    (tmp_path / "a.rebeca").write_text(CLEAN)
    done = rebsync("lint", "a.rebeca", "--format", style, cwd=tmp_path)
    assert (done.status, done.err) == (0, "")
    if style in ("text", "github"):
        assert done.out == ""
    else:
        assert json.loads(done.out)


def test_all_findings_of_all_files(tmp_path: Path) -> None:
    (tmp_path / "a.rebeca").write_text(WRONG)
    (tmp_path / "b.rebeca").write_text(SLIPS)
    done = rebsync("lint", ".", cwd=tmp_path)
    assert done.status == 1
    heads = [line.split(":") for line in done.out.splitlines() if ".rebeca:" in line]
    codes = {(path, text.split()[0]) for path, _, _, text, *_ in heads}
    assert codes == {("a.rebeca", "RS204"), ("b.rebeca", "RS104"), ("b.rebeca", "RS105")}
    assert done.err.endswith("in 2 files\n")


def test_an_unreadable_file_is_a_finding_in_every_format(tmp_path: Path) -> None:
    (tmp_path / "a.rebeca").write_text(WRONG)
    (tmp_path / "b.rebeca").write_bytes(b"\xff")
    done = rebsync("lint", "a.rebeca", "b.rebeca", "--format", "json", cwd=tmp_path)
    assert done.status == 2
    found = json.loads(done.out)["findings"]
    assert {"RS804"} < {each["code"] for each in found}


def test_certain_corrections_are_made(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_text(SLIPS)
    done = rebsync("lint", "--fix", "a.rebeca", cwd=tmp_path)
    assert (done.status, done.out) == (0, "")
    assert done.err == "corrected a.rebeca\n"
    assert path.read_text() == CLEAN


def test_what_is_not_certain_stays(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_text(WRONG)
    assert rebsync("lint", "--fix", "a.rebeca", cwd=tmp_path).status == 1
    assert path.read_text() == WRONG


def test_a_property_file_is_checked_against_the_model_beside_it(tmp_path: Path) -> None:
    (tmp_path / "a.rebeca").write_text(CLEAN)
    (tmp_path / "a.property").write_text("property { Assertion { x: r.y == 1; } }\n")
    done = rebsync("lint", ".", cwd=tmp_path)
    assert done.status == 1
    assert done.out.startswith('a.property:1:29: RS902 "R" has no state variable "y"\n')


MUTED = """\
env int e = 2;
reactiveclass A(2) {
  A() {}
  msgsrv x() {}
}
main { A a():(); }
"""


def codes(folder: Path, text: str) -> list[str]:
    """The codes that are told of a model."""
    (folder / "muted.rebeca").write_text(text, encoding="utf-8")
    return re.findall(r"\b(RS\d+) ", rebsync("lint", "muted.rebeca", cwd=folder).out)


@pytest.mark.parametrize(
    ("old", "new", "left"),
    [
        ("e = 2;", "e = 2; // rebsync: ignore RS515", ["RS503"]),
        ("e = 2;", "e = 2; // kept: rebsync: ignore RS515", ["RS515", "RS503"]),
        ("e = 2;", "e = 2; // rebsync: ignore RS501, RS515: of the next robot", ["RS503"]),
        ("e = 2;\n", "e = 2;\n// rebsync: ignore RS503\n", ["RS515", "RS503"]),  # another line
        ("  msgsrv", "  // rebsync: ignore RS503\n  msgsrv", ["RS515"]),
        ("A() {}\n", "A() {} // rebsync: ignore RS503\n", ["RS515", "RS503"]),  # not alone
        ("A() {}", "A() { y = 1; } // rebsync: ignore RS203", ["RS203"]),
    ],
)
def test_a_remark_switches_warnings_off(
    tmp_path: Path, old: str, new: str, left: list[str]
) -> None:
    assert codes(tmp_path, MUTED) == ["RS515", "RS503"]
    assert old in MUTED
    assert codes(tmp_path, MUTED.replace(old, new)) == left


def test_settings_switch_warnings_off(tmp_path: Path) -> None:
    settings = tmp_path / "rebsync.toml"
    settings.write_text('[lint]\nignore = ["RS503", "RS203"]\n', encoding="utf-8")
    assert codes(tmp_path, MUTED.replace("A() {}", "A() { y = 1; }")) == ["RS203"]
    assert codes(tmp_path, MUTED) == ["RS515"]
    settings.write_text('[lint]\nignore = ["RS53"]\n', encoding="utf-8")
    assert codes(tmp_path, MUTED) == ["RS515", "RS503"]
    said = rebsync("verify", "muted.rebeca", cwd=tmp_path).err
    assert 'RS809 `ignore` cannot have "RS53"' in said
