"""`rebsync extract` as a user runs it."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import jsonschema  # type: ignore[import-untyped]
import pytest

from tests.cli.run import rebsync
from tests.consoles import ROOT

SCHEMA = json.loads((ROOT / "docs" / "extract.schema.json").read_text(encoding="utf-8"))
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
    edit(
        source,
        "void R_1::moveForward() {\n",
        "void R_1::moveForward() {\n  std::sort(&e11_, &e12_);\n",
    )
    done = rebsync("extract", "experiment1", cwd=package.parent)
    assert done.status == 4
    assert "@Unreadable;" in done.out
    line = 1 + source.read_text().split("\n").index("  std::sort(&e11_, &e12_);")
    assert f"experiment1/src/r_1.cpp:{line}:3: RS941 unreadable: " in done.err
    assert done.err.endswith("experiment1: 31 of 32 statements exact, 1 unreadable\n")
    report = rebsync("extract", "experiment1", "--report", "json", cwd=package.parent)
    assert report.status == 4
    found = json.loads(report.out)
    assert found["grade"] == "unreadable"
    assert [f["text"] for f in found["findings"]] == ["std::sort(&e11_, &e12_)"]
    assert {b["name"]: b["unreadable"] for b in found["bodies"]}["R_1.moveForward"] == 1


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("  begin_sub_ = mailbox_", "  // begin_sub_ = mailbox_", "those of others do not arrive"),
        ("  mailbox_.construct(", "  // mailbox_.construct(", "no constructor has this run"),
        ("  msg.pos_x = posX;", "  msg.pos_x = posX + 1;", "more than to send"),
        ("  msg.pos_x = posX;\n", "", "more than to send"),
        ("[this, msg] { P1(msg->cmd); }", "[this, msg] { P1(msg->cmd + 1); }", "hand a message"),
        ("[this] { begin(); }", "[this] { begin(); begin(); }", "more than to send"),
        ("  e1_ = global", "  pos_[0] = 3;\n  e1_ = global", "only sets up"),
        ("init_y); });\n", "init_y); });\n  pos_[0] = 3;\n", "may be served by now"),
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


def test_one_object_tells_everything(package: Path) -> None:
    done = rebsync("extract", "experiment1", "--format", "json", cwd=package.parent)
    assert (done.status, done.err) == (0, "")
    found = json.loads(done.out)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    assert (found["package"], found["path"], found["file"]) == ("experiment1", "experiment1", None)
    assert found["model"] == rebsync("extract", "experiment1", cwd=package.parent).out
    report = rebsync("extract", "experiment1", "--report", "json", cwd=package.parent).out
    assert found["report"] == json.loads(report)


def test_the_object_lists_what_cannot_be_read(package: Path) -> None:
    source = package / "src" / "r_1.cpp"
    edit(
        source,
        "void R_1::moveForward() {\n",
        "void R_1::moveForward() {\n  std::sort(&e11_, &e12_);\n",
    )
    done = rebsync("extract", "experiment1/src/r_1.cpp", "--format", "json", cwd=package.parent)
    assert (done.status, done.err) == (4, "")
    found = json.loads(done.out)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    assert found["file"] == "src/r_1.cpp"
    assert [f["text"] for f in found["report"]["findings"]] == ["std::sort(&e11_, &e12_)"]


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Two packages and one without code."""
    for name in ("experiment1", "experiment2"):
        shutil.copytree(ROOT / "examples" / name / name, tmp_path / "src" / name)
    (tmp_path / "src" / "messages").mkdir()
    manifest = "<package><name>messages</name></package>\n"
    (tmp_path / "src" / "messages" / "package.xml").write_text(manifest)
    return tmp_path


def test_several_packages_give_a_model_each(workspace: Path) -> None:
    done = rebsync("extract", "src", cwd=workspace)
    assert (done.status, done.err) == (0, "")
    heads = [line for line in done.out.splitlines() if line.startswith("// ")]
    assert heads == ["// src/experiment1", "// src/experiment2"]
    named = rebsync("extract", "src/experiment1", "src/experiment2", cwd=workspace)
    assert named.out == done.out
    report = rebsync("extract", "src", "--report", "text", cwd=workspace).out
    assert [line for line in report.splitlines() if line.startswith("src/")] == [
        "src/experiment1:",
        "src/experiment2:",
    ]
    lines = rebsync("extract", "src", "--report", "json", cwd=workspace).out.splitlines()
    reports = [json.loads(line) for line in lines]
    assert [(r["path"], r["grade"]) for r in reports] == [
        ("src/experiment1", "exact"),
        ("src/experiment2", "exact"),
    ]


def test_several_packages_give_an_object_each(workspace: Path) -> None:
    done = rebsync("extract", "src", "--format", "json", cwd=workspace)
    assert done.status == 0
    found = [json.loads(line) for line in done.out.splitlines()]
    assert [f["package"] for f in found] == ["experiment1", "experiment2"]


def test_several_packages_go_to_a_directory(workspace: Path) -> None:
    refused = rebsync("extract", "src", "-o", "models", cwd=workspace)
    assert (refused.status, refused.out) == (2, "")
    assert "models: RS802 for several packages a directory is wanted" in refused.err
    (workspace / "models").mkdir()
    assert rebsync("extract", "src", "-o", "models", cwd=workspace).status == 0
    done = rebsync("extract", "src", "-o", "models", "--format", "json", cwd=workspace)
    assert (done.status, done.out) == (0, "")
    written = sorted(p.name for p in (workspace / "models").iterdir())
    assert written == [f"experiment{n}.{suffix}" for n in (1, 2) for suffix in ("json", "rebeca")]
    assert "reactiveclass" in (workspace / "models" / "experiment2.rebeca").read_text()


def test_the_worst_of_several_packages_is_the_status(workspace: Path) -> None:
    source = workspace / "src" / "experiment1" / "src" / "r_1.cpp"
    edit(
        source,
        "void R_1::moveForward() {\n",
        "void R_1::moveForward() {\n  std::sort(&e11_, &e12_);\n",
    )
    assert rebsync("extract", "src", cwd=workspace).status == 4


def test_the_object_and_the_report_exclude_each_other(package: Path) -> None:
    done = rebsync(
        "extract", "experiment1", "--format", "json", "--report", "json", cwd=package.parent
    )
    assert (done.status, done.out) == (2, "")
    assert "leave out --report" in done.err


def test_an_output_is_no_input(package: Path) -> None:
    source = "experiment1/src/r_1.cpp"
    done = rebsync("extract", "experiment1", source, "-o", source, cwd=package.parent)
    assert done.status == 2
    assert "RS802" in done.err


CALLER = """\
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "caller");
  ros::NodeHandle node("~");
  std::string name;
  node.getParam(argv[1], name);
  ros::service::waitForService("add");
}
"""


def test_code_without_a_class_is_told_as_json(tmp_path: Path) -> None:
    (tmp_path / "caller.cpp").write_text(CALLER)
    done = rebsync("extract", "caller.cpp", "--format", "json", cwd=tmp_path)
    found = json.loads(done.out)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    assert found["model"] is None
    (node,) = found["nodes"]
    assert (node["name"], node["file"], node["line"]) == ("caller", "caller.cpp", 4)
    (unknown,) = found["unknowns"]
    assert (unknown["of"], unknown["key"], unknown["line"]) == ("parameters", "name", 7)
    alone = rebsync("extract", "caller.cpp", cwd=tmp_path)
    assert (alone.status, alone.out) == (2, "")
    assert "hint: --format json tells what the code asks of ROS" in alone.err


def test_a_file_that_is_no_text(tmp_path: Path) -> None:
    (tmp_path / "node.cpp").write_bytes("int main() {}\n".encode("utf-16"))
    done = rebsync("extract", "node.cpp", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "RS941" in done.err
    assert "node.cpp: RS943" in done.err
    told = rebsync("extract", "node.cpp", "--format", "json", cwd=tmp_path)
    assert told.status == 2
    assert [f["file"] for f in json.loads(told.out)["report"]["findings"]] == ["node.cpp"]


def test_packages_of_one_name_do_not_overwrite_each_other(tmp_path: Path) -> None:
    for place in ("first", "second"):
        shutil.copytree(EXAMPLE, tmp_path / place / "experiment1")
    (tmp_path / "models").mkdir()
    assert rebsync("extract", "first", "second", "-o", "models", cwd=tmp_path).status == 0
    written = {p.name: p.read_text() for p in (tmp_path / "models").iterdir()}
    assert set(written) == {"experiment1.rebeca", "experiment1_2.rebeca"}


def test_two_packages_of_one_system_give_one_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(EXAMPLE.parent / "experiment1.rebeca", tmp_path)
    monkeypatch.chdir(tmp_path)
    given = ("experiment1.rebeca", "-o", "ros/src", "--target", "ros2-py")
    assert rebsync("generate", *given, cwd=tmp_path).status == 0
    shutil.rmtree("ros/src/experiment1/.rebsync")
    wanted = rebsync("extract", "ros/src/experiment1/experiment1", cwd=tmp_path).out
    for path in ("ros/src/experiment1", "ros/src", "."):
        shown = rebsync("extract", path, cwd=tmp_path)
        assert (shown.status, shown.out, shown.err) == (0, wanted, "")
        done = rebsync("extract", path, "-o", "out.rebeca", cwd=tmp_path)
        assert (done.status, done.out) == (0, ""), done.err
        assert Path("out.rebeca").read_text() == wanted


def test_packages_without_a_class_do_not_count(workspace: Path) -> None:
    shutil.rmtree(workspace / "src/experiment2")
    for name in ("all_messages", "bringup"):
        (workspace / "src" / name).mkdir()
        (workspace / "src" / name / "package.xml").write_text(
            f"<package><name>{name}</name></package>"
        )
    done = rebsync("extract", "src", "-o", "one.rebeca", cwd=workspace)
    assert (done.status, done.out) == (0, ""), done.err
    assert (workspace / "one.rebeca").read_text().startswith("env ")
