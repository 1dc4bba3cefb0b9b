"""`rebsync extract` as a user runs it."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.cli.run import rebsync
from tests.consoles import ROOT

EXAMPLE = ROOT / "examples" / "experiment1" / "experiment1"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package that can be edited."""
    return Path(shutil.copytree(EXAMPLE, tmp_path / "experiment1"))


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_what_is_extracted_has_no_mistakes(package: Path) -> None:
    done = rebsync("extract", "experiment1", "-o", "back.rebeca", cwd=package.parent)
    assert (done.status, done.out, done.err) == (0, "", "")
    shutil.copy(EXAMPLE.parent / "experiment1.property", package.parent / "back.property")
    verified = rebsync("verify", "back.rebeca", "--format", "json", cwd=package.parent)
    assert verified.status == 0
    assert json.loads(verified.out)["states"] == 89


def test_one_file_gives_its_classes(package: Path) -> None:
    done = rebsync("extract", "experiment1/src/r_1.cpp", cwd=package.parent)
    assert done.status == 0
    assert "reactiveclass R_1(" in done.out
    assert "main {" not in done.out


def test_a_file_alone(package: Path, tmp_path: Path) -> None:
    (tmp_path / "alone").mkdir()
    shutil.copy(package / "src" / "r_1.cpp", tmp_path / "alone")
    done = rebsync("extract", "alone/r_1.cpp", cwd=tmp_path)
    assert done.status == 2
    assert "RS943" in done.err


def test_what_cannot_be_read_is_listed(package: Path) -> None:
    source = package / "src" / "r_1.cpp"
    edit(source, "void R_1::moveForward() {\n", "void R_1::moveForward() {\n  std::sort(a, b);\n")
    done = rebsync("extract", "experiment1", cwd=package.parent)
    assert done.status == 4
    assert "@Unreadable;" in done.out
    line = 1 + source.read_text().split("\n").index("  std::sort(a, b);")
    assert f"experiment1/src/r_1.cpp:{line}:3: RS941 unreadable: " in done.err
    report = rebsync("extract", "experiment1", "--report", "json", cwd=package.parent)
    assert report.status == 4
    found = json.loads(report.out)
    assert found["grade"] == "unreadable"
    assert [f["text"] for f in found["findings"]] == ["std::sort(a, b)"]
    assert {b["name"]: b["unreadable"] for b in found["bodies"]}["R_1.moveForward"] == 1


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("  begin_sub_ = mailbox_", "  // begin_sub_ = mailbox_", "those of others do not arrive"),
        ("  mailbox_.construct(", "  // mailbox_.construct(", "no constructor has this run"),
        ("  msg_.pos_x = posX;", "  msg_.pos_x = posX + 1;", "more than to send"),
        ("  msg_.pos_x = posX;\n", "", "more than to send"),
        ("[this, msg] { P1(msg->cmd); }", "[this, msg] { P1(msg->cmd + 1); }", "hand a message"),
        ("[this] { begin(); }", "[this] { begin(); begin(); }", "hand a message"),
        ("  e1_ = global", "  pos_[0] = 3;\n  e1_ = global", "only sets up"),
        ("[=] { MoveInX(); }", "[=] { if (stopped_) MoveInX(); }", "more than to send"),
    ],
)
def test_what_the_model_cannot_show_is_listed(tmp_path: Path, old: str, new: str, why: str) -> None:
    shutil.copytree(ROOT / "examples" / "experiment2" / "experiment2", tmp_path / "package")
    edit(tmp_path / "package" / "src" / "r1.cpp", old, new)
    done = rebsync("extract", "package", cwd=tmp_path)
    assert done.status == 4
    assert why in done.err


def test_the_report_counts_statements(package: Path) -> None:
    done = rebsync("extract", "experiment1", "--report", "text", cwd=package.parent)
    assert (done.status, done.err) == (0, "")
    assert done.out.endswith("31 of 31 statements exact\n")


def test_what_is_no_package(tmp_path: Path) -> None:
    (tmp_path / "node.cpp").write_text("int main() { ros::spin(); }\n")
    done = rebsync("extract", "node.cpp", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "node.cpp: RS943 no class of a model was found here" in done.err
    assert rebsync("extract", "none", cwd=tmp_path).status == 2
