"""`rebsync diff` as a user runs it."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import jsonschema  # type: ignore[import-untyped]
import pytest

from tests.cli.run import rebsync
from tests.consoles import ROOT
from tests.test_report import SCHEMA as SARIF

SCHEMA = json.loads((ROOT / "docs" / "diff.schema.json").read_text(encoding="utf-8"))
EXAMPLE = ROOT / "examples" / "experiment1"
GUARD = ("this->current_segment_ < 10", "this->current_segment_ < 8")
MODEL, PACKAGE = "experiment1/experiment1.rebeca", "experiment1/experiment1"
CODE = f"{PACKAGE}/src/r_1.cpp"


@pytest.fixture
def example(tmp_path: Path) -> Path:
    """A directory with a model and its package, both to be edited."""
    shutil.copytree(EXAMPLE, tmp_path / "experiment1")
    return tmp_path


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def line_of(path: Path, part: str) -> int:
    """The line of the first place of a text."""
    return path.read_text(encoding="utf-8").split(part)[0].count("\n") + 1


def test_a_package_says_what_its_model_does(example: Path) -> None:
    done = rebsync("diff", MODEL, PACKAGE, cwd=example)
    assert (done.status, done.out, done.err) == (0, "", "")


def test_a_difference_is_a_line_with_both_places(example: Path) -> None:
    edit(example / CODE, *GUARD)
    done = rebsync("diff", MODEL, PACKAGE, cwd=example)
    assert (done.status, done.err) == (1, "1 difference\n")
    lines = [
        line_of(example / MODEL, "self.current_segment < 10"),
        line_of(example / CODE, GUARD[1]),
    ]
    assert done.out == (
        f"R_1\n  {MODEL}:{lines[0]}  {CODE}:{lines[1]}  msgsrv R_1.taskControl: condition of if "
        "changed from self.current_segment < 10 to self.current_segment < 8\n"
    )


def test_what_cannot_be_read_is_undetermined(example: Path) -> None:
    edit(example / CODE, "void R_1::moveForward() {\n", "void R_1::moveForward() {\n  f(&e11_);\n")
    done = rebsync("diff", MODEL, PACKAGE, "--format", "json", cwd=example)
    assert done.status == 4
    found = json.loads(done.out)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    assert found["verdict"] == "undetermined"
    assert [d["kind"] for d in found["differences"]] == ["undetermined"]
    assert found["differences"][0]["right"]["region"]["startLine"] == line_of(
        example / CODE, "f(&e11_)"
    )


def test_one_object(example: Path) -> None:
    edit(example / CODE, *GUARD)
    edit(example / CODE, "    sendSelfWaitForCharge();\n", "")
    done = rebsync("diff", MODEL, PACKAGE, "--format", "json", cwd=example)
    assert (done.status, done.err) == (1, "")
    found = json.loads(done.out)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    changed, removed = found["differences"]
    assert (changed["kind"], changed["aspect"], changed["of"]) == ("changed", "condition", "if")
    assert removed["kind"] == "statement removed"
    assert removed["statement"] == "self.waitForCharge();"
    assert removed["left"]["path"] == MODEL
    assert removed["class"] == "R_1"


def test_sarif_has_fingerprints_that_stay(example: Path) -> None:
    edit(example / CODE, *GUARD)
    first = json.loads(rebsync("diff", MODEL, PACKAGE, "--format", "sarif", cwd=example).out)
    edit(example / CODE, "#include", "// a comment\n\n#include")
    second = json.loads(rebsync("diff", MODEL, PACKAGE, "--format", "sarif", cwd=example).out)
    for log in (first, second):
        jsonschema.validate(log, SARIF)
    one, two = (log["runs"][0]["results"] for log in (first, second))
    assert [r["ruleId"] for r in one] == ["RS977"]
    assert one[0]["partialFingerprints"] == two[0]["partialFingerprints"]
    places = [r[0]["locations"][0]["physicalLocation"] for r in (one, two)]
    assert [p["artifactLocation"]["uri"] for p in places] == [CODE, CODE]
    assert places[0]["region"]["startLine"] < places[1]["region"]["startLine"]
    related = one[0]["relatedLocations"]
    assert [r["physicalLocation"]["artifactLocation"]["uri"] for r in related] == [MODEL, CODE]


def test_github_commands(example: Path) -> None:
    edit(example / CODE, *GUARD)
    done = rebsync("diff", MODEL, PACKAGE, "--format", "github", cwd=example)
    line = line_of(example / CODE, GUARD[1])
    assert done.out.startswith(f"::warning file={CODE},line={line},")
    assert "title=RS977::msgsrv R_1.taskControl: condition of if changed" in done.out


def test_depths(example: Path) -> None:
    shutil.copy(example / MODEL, example / "other.rebeca")
    edit(example / "other.rebeca", "self.current_segment < 10", "(self.current_segment < 10)")
    assert rebsync("diff", MODEL, "other.rebeca", cwd=example).status == 0
    done = rebsync("diff", MODEL, "other.rebeca", "--depth", "identical", cwd=example)
    assert done.status == 1
    assert "(self.current_segment < 10)" in done.out


def test_a_file_of_the_code_tells_of_its_classes_only(example: Path) -> None:
    assert rebsync("diff", MODEL, CODE, cwd=example).status == 0
    edit(example / CODE, *GUARD)
    done = rebsync("diff", MODEL, CODE, cwd=example)
    assert (done.status, done.err) == (1, "1 difference\n")


@pytest.fixture
def repository(example: Path) -> Path:
    """The same in git, committed, and edited since."""
    for command in (
        ["init", "-q"],
        ["add", "."],
        ["-c", "user.name=A", "-c", "user.email=a@b.c", "commit", "-q", "-m", "all"],
    ):
        subprocess.run(["git", *command], cwd=example, check=True)
    edit(example / CODE, *GUARD)
    return example


def test_revisions(repository: Path) -> None:
    done = rebsync("diff", f"HEAD:{PACKAGE}", PACKAGE, cwd=repository)
    line = line_of(repository / CODE, GUARD[1])
    assert (done.status, done.err) == (1, "1 difference\n")
    assert f"  HEAD:{CODE}:{line}  {CODE}:{line}  msgsrv R_1.taskControl: " in done.out
    assert rebsync("diff", f"HEAD:{MODEL}", MODEL, cwd=repository).status == 0
    assert rebsync("diff", f"HEAD:{MODEL}", f"HEAD:{PACKAGE}", cwd=repository).status == 0


def test_a_revision_is_named_from_the_top_or_from_here(repository: Path) -> None:
    here = repository / "experiment1"
    assert rebsync("diff", "HEAD:experiment1.rebeca", "HEAD:experiment1", cwd=here).status == 0
    assert rebsync("diff", f"HEAD:{MODEL}", f"HEAD:{PACKAGE}", cwd=here).status == 0


def test_a_file_of_a_revision_is_read_within_its_package(repository: Path) -> None:
    line = line_of(repository / CODE, GUARD[1])
    done = rebsync("diff", f"HEAD:{CODE}", CODE, cwd=repository)
    assert (done.status, done.err) == (1, "1 difference\n")
    assert f"  HEAD:{CODE}:{line}  {CODE}:{line}  msgsrv R_1.taskControl: " in done.out
    inside = CODE.removeprefix(f"{PACKAGE}/")
    done = rebsync("diff", f"HEAD:{inside}", inside, cwd=repository / PACKAGE)
    assert (done.status, done.err) == (1, "1 difference\n")
    assert f"  HEAD:{CODE}:{line}  {inside}:{line}  msgsrv R_1.taskControl: " in done.out


def test_a_file_may_have_had_another_name(repository: Path) -> None:
    new = CODE.replace("r_1.cpp", "robot.cpp")
    subprocess.run(["git", "mv", CODE, new], cwd=repository, check=True)
    done = rebsync("diff", f"HEAD:{new}", new, cwd=repository)
    assert done.status == 2
    assert f"hint: there it was {CODE}: HEAD:{CODE}" in done.err
    assert rebsync("diff", f"HEAD:{CODE}", new, cwd=repository).status == 1


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("none.rebeca", "none.rebeca: RS801 no such file or directory"),
        ("HEAD~9:experiment1", 'no such file, and git knows no revision "HEAD~9" here'),
        ("HEAD:nowhere", 'the revision "HEAD" has no "nowhere"'),
        ("HEAD:experiment1/experiment1/msg", "no class of a model was found here"),
        ("experiment1/README.md", "RS943 no class of a model was found here"),
    ],
)
def test_what_cannot_be_compared(repository: Path, name: str, told: str) -> None:
    done = rebsync("diff", MODEL, name, cwd=repository)
    assert (done.status, done.out) == (2, "")
    assert told in done.err


def test_a_model_with_mistakes(example: Path) -> None:
    edit(example / MODEL, "main {", "main ")
    done = rebsync("diff", MODEL, PACKAGE, cwd=example)
    assert (done.status, done.out) == (2, "")
    assert f"{MODEL}:" in done.err


def test_a_directory_with_one_model_is_that_model(example: Path) -> None:
    shutil.rmtree(example / PACKAGE)
    assert rebsync("diff", "experiment1", MODEL, cwd=example).status == 0


def test_several_packages(tmp_path: Path) -> None:
    for name in ("experiment1", "experiment2"):
        shutil.copytree(ROOT / "examples" / name / name, tmp_path / "src" / name)
    done = rebsync("diff", "src", "src", cwd=tmp_path)
    assert done.status == 2
    assert "there are several packages here" in done.err
    assert "src/experiment1 or src/experiment2" in done.err


def test_standard_input(example: Path) -> None:
    text = (example / MODEL).read_bytes()
    assert rebsync("diff", "-", PACKAGE, cwd=example, stdin=text).status == 0
    assert rebsync("diff", "-", "-", cwd=example, stdin=text).status == 2


# --- behaviour ----------------------------------------------------------------------------------


def test_what_is_written_in_another_way_does_the_same(example: Path) -> None:
    shutil.copy(example / MODEL, example / "other.rebeca")
    edit(example / "other.rebeca", "self.current_segment < 10", "!(self.current_segment >= 10)")
    assert rebsync("diff", MODEL, "other.rebeca", cwd=example).status == 1
    done = rebsync("diff", MODEL, "other.rebeca", "--behaviour", cwd=example)
    assert done.status == 0
    assert done.out.endswith("behaviour: same (89 and 89 states)\n")


def test_a_run_that_only_one_side_has(example: Path) -> None:
    edit(example / CODE, *GUARD)
    done = rebsync("diff", MODEL, PACKAGE, "--behaviour", cwd=example)
    assert done.status == 1
    lines = done.out.splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("behaviour: different ("))
    assert lines[at + 1].startswith("  a shortest run that only the ")
    steps = [line for line in lines[at + 2 :] if not line.startswith("  where")]
    assert steps[0].endswith("the constructors run")
    assert steps[-1].startswith("  > ")
    assert "robot1 takes taskControl()" in steps[-1]
    both = f"{MODEL}:{line_of(example / MODEL, 'msgsrv taskControl')}  {CODE}:"
    assert any(both in step for step in steps)
    done = rebsync("diff", MODEL, PACKAGE, "--behaviour", "--format", "json", cwd=example)
    found = json.loads(done.out)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    assert found["behaviour"]["verdict"] == "different"
    assert len(found["behaviour"]["run"]) == len(steps)


def test_more_states_than_the_bound(example: Path) -> None:
    shutil.copy(example / MODEL, example / "other.rebeca")
    edit(example / "other.rebeca", "self.current_segment < 10", "!(self.current_segment >= 10)")
    bounded = ("--behaviour", "--max-states", "20")
    done = rebsync("diff", MODEL, "other.rebeca", *bounded, cwd=example)
    assert done.status == 4
    assert "behaviour: undetermined: the bound of 20 states was reached" in done.out


@pytest.mark.parametrize("style", ["sarif", "github", "html"])
def test_behaviour_in_other_formats(example: Path, style: str) -> None:
    edit(example / CODE, *GUARD)
    done = rebsync("diff", MODEL, PACKAGE, "--behaviour", "--format", style, cwd=example)
    assert (done.status, done.err) == (1, "")
    assert "behaviour: different" in done.out
    if style == "sarif":
        jsonschema.validate(json.loads(done.out), SARIF)
        rules = [result["ruleId"] for result in json.loads(done.out)["runs"][0]["results"]]
        assert rules == ["RS977", "RS979"]
