"""`rebsync sync` as a user meets it: both directions, conflicts, and what it refuses."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.drift import Verdict
from tests.cli.test_check import MODEL, SOURCE, made, package, replace, snapshot

__all__ = ["made", "package"]  # fixtures

HEADER = "patrol/include/patrol/robot.h"
Run = Callable[..., tuple[int, str]]


@pytest.fixture
def sync(package: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs the command in-process; gives the exit status and all that is printed."""

    def run(*arguments: str) -> tuple[int, str]:
        capsys.readouterr()
        status = main(["sync", *arguments])
        shown = capsys.readouterr()
        return status, shown.out + shown.err

    return run


def test_nothing_to_do(sync: Run) -> None:
    before = snapshot(Path())
    assert sync() == (0, "patrol: in step with patrol.rebeca\n")
    assert snapshot(Path()) == before


def test_the_model_goes_into_edited_code(sync: Run) -> None:
    replace(SOURCE, "  mailbox_.delay(1);", "  // slow\n  mailbox_.delay(1);")
    replace("patrol.rebeca", "% 4", "% 5")
    assert sync("patrol")[0] == 0
    text = Path(SOURCE).read_text()
    assert "// slow" in text
    assert "% 5" in text
    assert main(["check"]) == 0


def test_the_code_goes_into_the_text_of_the_model(sync: Run) -> None:
    odd = MODEL.replace("    on = n > 3;", "    on   =   n > 3; // why")
    Path("patrol.rebeca").write_text(odd)
    assert sync()[0] == 0
    replace(SOURCE, "(x_ + 1) % 4", "(x_ + 1) % 9")
    code = Path(SOURCE).read_bytes()
    assert sync()[0] == 0
    assert Path("patrol.rebeca").read_text() == odd.replace("% 4", "% 9")
    assert Path(SOURCE).read_bytes() == code
    assert main(["check"]) == 0


def test_line_ends_and_marks_of_files_stay(sync: Run) -> None:
    model, source = Path("patrol.rebeca"), Path(SOURCE)
    model.write_bytes(b"\xef\xbb\xbf" + model.read_bytes().replace(b"\n", b"\r\n"))
    source.write_bytes(source.read_bytes().replace(b"\n", b"\r\n"))
    source.write_bytes(source.read_bytes().replace(b"n > 3", b"n > 5"))
    model.write_bytes(model.read_bytes().replace(b"% 4", b"% 5"))
    wanted = model.read_bytes().replace(b"n > 3", b"n > 5")
    code = source.read_bytes().replace(b"% 4", b"% 5")
    assert sync()[0] == 0
    assert model.read_bytes() == wanted
    assert source.read_bytes() == code


def test_edited_code_is_known_by_its_digest_afterwards(sync: Run) -> None:
    replace(SOURCE, "  mailbox_.delay(1);", "  // slow\n  mailbox_.delay(1);")
    replace(SOURCE, "n > 3", "n > 5")
    assert sync()[0] == 0
    (package,) = find(["."])
    assert check(package).drift is None, "nothing was read"
    assert main(["generate", "patrol.rebeca"]) == 0
    assert check(package).drift is None
    replace(SOURCE, "// slow", "// slower")
    drift = check(package).drift
    assert drift is not None, "it is other code now"
    assert drift.verdict is Verdict.IN_STEP


def test_a_dry_run_shows_the_patch_and_writes_nothing(sync: Run) -> None:
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "% 4", "% 5")
    before = snapshot(Path())
    status, shown = sync("--dry-run")
    assert status == 1
    assert "+    on = n > 5;" in shown
    assert "+  x_ = (x_ + 1) % 5;" in shown
    assert ".rebsync" not in shown
    assert snapshot(Path()) == before


def conflict() -> None:
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "n > 3", "n >= 4")
    replace(SOURCE, "% 4", "% 6")


def test_a_conflict_is_marked_and_can_be_decided(sync: Run) -> None:
    conflict()
    status, shown = sync()
    assert status == 1
    assert "patrol.rebeca: RS966" in shown
    text = Path("patrol.rebeca").read_text()
    assert "<<<<<<< model\n    on = n >= 4;\n=======\n    on = n > 5;\n>>>>>>> code\n" in text
    assert "% 6" in text, "what is apart is merged all the same"
    assert sync()[0] == 2, "it is not decided yet"
    assert main(["check"]) == 2
    head, _, rest = text.partition("<<<<<<< model\n")
    mine, _, rest = rest.partition("=======\n")
    Path("patrol.rebeca").write_text(head + mine + rest.partition(">>>>>>> code\n")[2])
    assert sync()[0] == 0
    assert "n >= 4" in Path(SOURCE).read_text()
    assert main(["check"]) == 0


@pytest.mark.parametrize(("side", "wanted"), [("ours", "n >= 4"), ("theirs", "n > 5")])
def test_one_side_can_be_taken(sync: Run, side: str, wanted: str) -> None:
    conflict()
    assert sync("--conflict", side)[0] == 0
    for path in ("patrol.rebeca", SOURCE):
        assert wanted in Path(path).read_text()
        assert "% 6" in Path(path).read_text()
    assert main(["check"]) == 0


def test_a_conflict_of_lines_is_marked_in_the_code(sync: Run) -> None:
    replace(SOURCE, "  mailbox_.delay(1);", '  ROS_INFO("x"); mailbox_.delay(1);')
    replace("patrol.rebeca", "delay(1)", "delay(2)")
    status, shown = sync()
    assert status == 1
    assert f"{SOURCE}: RS966" in shown
    text = Path(SOURCE).read_text()
    assert "<<<<<<< as edited\n" in text
    assert sync()[0] == 2
    head, _, rest = text.partition("<<<<<<< as edited\n")
    decided = '  ROS_INFO("x");\n  mailbox_.delay(2);\n'
    Path(SOURCE).write_text(head + decided + rest.partition(">>>>>>> as generated now\n")[2])
    assert sync()[0] == 0
    assert main(["check"]) == 0


def test_git_knows_of_conflicts(sync: Run) -> None:
    git("init", "-q")
    git("add", "-A", ":!.cache")
    git("commit", "-q", "-m", "all")
    conflict()
    base = Path("patrol.rebeca").read_text().replace("n >= 4", "n > 3")
    mine = Path("patrol.rebeca").read_text()
    assert sync()[0] == 1
    listed = git("ls-files", "-u").split("\n")
    assert [line.split()[2:] for line in listed if line] == [
        [number, "patrol.rebeca"] for number in "123"
    ]
    assert git("show", ":1:patrol.rebeca") == base
    assert git("show", ":2:patrol.rebeca") == mine
    assert "n > 5" in git("show", ":3:patrol.rebeca")
    git("add", "patrol.rebeca")
    assert git("ls-files", "-u") == ""


def git(*arguments: str) -> str:
    names = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    for role in ("AUTHOR", "COMMITTER"):
        names |= {f"GIT_{role}_NAME": "a", f"GIT_{role}_EMAIL": "a@example.org"}
    done = subprocess.run(
        ["git", *arguments], env=os.environ | names, capture_output=True, text=True, check=True
    )
    return done.stdout


def test_what_cannot_be_read_is_not_taken_over(sync: Run) -> None:
    replace(SOURCE, "  on_ = n > 3;", "  on_ = n > 5;\n  goto end;\nend:;")
    before = snapshot(Path())
    status, shown = sync()
    assert status == 4
    assert "RS959" in shown
    assert snapshot(Path()) == before


def test_what_cannot_be_read_stays_as_in_the_model(sync: Run) -> None:
    replace(SOURCE, "  on_ = n > 3;", "  on_ = n > 3;\n  goto end;\nend:;")
    replace("patrol.rebeca", "% 4", "% 5")
    model = Path("patrol.rebeca").read_text()
    assert sync()[0] == 4
    assert Path("patrol.rebeca").read_text() == model
    assert "% 5" in Path(SOURCE).read_text()


def test_a_file_that_is_gone_is_not_made_up(sync: Run) -> None:
    Path("patrol/config/params.yaml").unlink()
    replace("patrol.rebeca", "env int e = 2", "env int e = 3")
    before = snapshot(Path())
    status, shown = sync()
    assert status in (1, 4)
    assert "nothing was written" in shown
    assert snapshot(Path()) == before


@pytest.mark.parametrize("stop", range(1, 7))
def test_a_sync_that_fails_at_any_file_leaves_the_old_ones(sync: Run, stop: int) -> None:
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "% 4", "% 5")
    before = snapshot(Path())
    calls = iter(range(1, 100))
    real = Path.replace

    def failing(self: Path, target: Path) -> Path:
        if self.name.endswith(".rebsync.tmp") and next(calls) == stop:
            raise OSError(28, "No space left on device")
        return real(self, target)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Path, "replace", failing)
        status, _ = sync()
    if next(calls) > stop:
        assert status == 2
        assert snapshot(Path()) == before
    assert main(["sync"]) == 0
    assert main(["check"]) == 0


def test_without_the_model_of_last_time_all_is_a_conflict(sync: Run) -> None:
    Path("patrol/.rebsync/base.rebeca").unlink()
    conflict()
    assert sync("--dry-run")[0] == 1
    assert sync("--conflict", "theirs")[0] == 0
    assert "n > 5" in Path("patrol.rebeca").read_text()
    assert main(["check"]) == 0


def test_a_package_behind_a_link(sync: Run) -> None:
    Path("elsewhere").mkdir()
    Path("patrol").rename("elsewhere/patrol")
    Path("patrol").symlink_to("elsewhere/patrol")
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "% 4", "% 5")
    assert sync("patrol", "--model", "patrol.rebeca")[0] == 0
    assert "n > 5" in Path("patrol.rebeca").read_text()
    assert "% 5" in Path(SOURCE).read_text()
    assert [p.name for p in Path("elsewhere").iterdir()] == ["patrol"]


def test_links_that_lead_out_are_not_followed(sync: Run, tmp_path: Path) -> None:
    Path(SOURCE).rename(tmp_path / "robot.cpp")
    Path(SOURCE).symlink_to(tmp_path / "robot.cpp")
    replace("patrol.rebeca", "% 4", "% 5")
    before = snapshot(tmp_path)
    assert sync()[0] != 0
    assert snapshot(tmp_path) == before


def test_what_the_model_has_no_type_for_is_told_where_it_is(sync: Run) -> None:
    before = snapshot(Path())
    replace(HEADER, "int32_t x_", "uint64_t x_")
    status, shown = sync()
    assert status == 4
    assert f"{HEADER}:43:3: RS959 constructor Robot was changed in the code" in shown
    assert 'the model has no type "uint64_t"' in shown
    replace(HEADER, "uint64_t x_", "int32_t x_")
    assert snapshot(Path()) == before


def test_what_makes_no_model_is_told(sync: Run, capsys: pytest.CaptureFixture[str]) -> None:
    replace(SOURCE, "  sendSelfLook(after(e_));", "  x_ = 0.5 * x_;\n  sendSelfLook(after(e_));")
    before = snapshot(Path())
    status, shown = sync()
    assert status == 1
    assert "RS967 the changes of the code make no model" in shown
    assert "hint: it would say `x = 0.5d * x;`" in shown
    assert main(["check"]) == 1
    assert "RS967 the changes of the code make no model" in capsys.readouterr().out
    assert snapshot(Path()) == before


def test_what_makes_no_model_together_is_told_of_the_model(
    sync: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    replace("patrol.rebeca", "    on = n > 3;\n", "")
    replace("patrol.rebeca", "    boolean on;\n", "")
    replace(SOURCE, "  sendSelfLook(after(e_));", "  on_ = true;\n  sendSelfLook(after(e_));")
    status, shown = sync()
    assert status == 1
    assert "patrol.rebeca: RS967 the changes of model and code cannot be put together" in shown
    assert 'hint: it would say `on = true;`: unknown variable "on"' in shown
    assert main(["check"]) == 1
    assert "RS967 the changes of model and code cannot be put together" in capsys.readouterr().out


@pytest.mark.parametrize(
    "edit",
    [None, lambda path: path.write_text("# Ours\n"), Path.unlink],
    ids=["as generated", "written anew", "gone"],
)
def test_the_page_about_a_package_follows_its_launch_file(
    sync: Run, edit: Callable[[Path], object] | None
) -> None:
    page = Path("patrol/README.md")
    if edit is not None:
        edit(page)
    left = page.read_text() if page.exists() else None
    launch = Path("patrol/launch/patrol.launch")
    text = launch.read_text()
    block = text[text.index("  <!-- rebsync: rebec robot2") : text.index("</launch>")]
    text = text.replace(
        "</launch>", "\n" + block.replace("rebec robot2", "rebec robot3") + "</launch>"
    )
    head, _, tail = text.rpartition('name="robot2"')
    launch.write_text(
        f'{head}name="robot3"{tail}'.replace("[robot1, robot2]", "[robot1, robot2, robot3]")
    )
    assert sync()[0] == 0
    found = page.read_text() if page.exists() else None
    assert "`/robot3/go`" in str(found) if edit is None else found == left
    assert main(["check"]) == 0
    before = snapshot(Path("patrol"))
    assert main(["generate", "patrol.rebeca"]) in (0, 1)
    assert edit is Path.unlink or snapshot(Path("patrol")) == before
