"""Links that are read, or that directories hold, and what must go on working."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import rebsync.writing
from tests.cli.test_check import SOURCE, made, package, replace
from tests.security.hostile import Run, everything, git
from tests.security.test_links import linked, run

__all__ = ["made", "package", "run"]  # fixtures

# --- reading ------------------------------------------------------------------------------------


@pytest.mark.timeout(60)
@pytest.mark.parametrize("target", ["/", "/proc", "/sys", "../../.."])
@pytest.mark.parametrize(
    "command",
    [
        ["extract", "patrol"],
        ["extract", "."],
        ["check"],
        ["sync"],
        ["diff", "patrol.rebeca", "patrol"],
    ],
)
def test_a_link_to_everything(run: Run, package: Path, target: str, command: list[str]) -> None:
    Path("patrol/src/all").symlink_to(target)
    Path("patrol/all").symlink_to(target)
    status, shown = run(*command)
    assert (status, "a link that leads out of the tree" in shown) == (4, True), shown


def test_code_behind_a_link_out_is_not_told(run: Run, package: Path, tmp_path: Path) -> None:
    git("init", "-q")
    (tmp_path / "secret.cpp").write_text("int secret_word;\n")
    Path("patrol/src/more.cpp").symlink_to(tmp_path / "secret.cpp")
    for command in (["extract", "patrol"], ["extract", "patrol/src/more.cpp"], ["check"]):
        status, shown = run(*command)
        assert status != 0
        assert "secret_word" not in shown


# --- what must go on working --------------------------------------------------------------------


def test_a_workspace_behind_a_link(
    run: Run, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    link = package.parent.parent / "ws"
    link.symlink_to(package.parent)
    replace(str(link / SOURCE), "% 4", "% 7")
    assert run("sync", str(link))[0] == 0
    assert "% 7" in Path("patrol.rebeca").read_text()
    assert run("generate", str(link / "patrol.rebeca"), "-o", str(link))[0] == 0
    assert run("lint", str(link / "patrol.rebeca"))[0] == 0
    monkeypatch.chdir(link)
    for command in (["check"], ["extract", "patrol"], ["sync"], ["fmt", "patrol.rebeca"]):
        assert run(*command)[0] == 0
    git("init", "-q")
    for command in (["check"], ["check", str(link)], ["extract", "patrol"], ["sync"]):
        assert run(*command)[0] == 0


def test_a_workspace_of_linked_packages(run: Run, package: Path) -> None:
    git("init", "-q")
    source = package.parent.parent / "ws" / "src"
    share = source.parent / "install" / "patrol" / "share" / "patrol"
    source.mkdir(parents=True)
    share.mkdir(parents=True)
    (source / "patrol").symlink_to(package)
    for name in ("package.xml", "launch/patrol.launch", "config/params.yaml"):
        (share / name).parent.mkdir(exist_ok=True)
        (share / name).symlink_to(package / name)
    (source.parent / "install" / "COLCON_IGNORE").touch()
    ws = str(source.parent)
    assert run("check", ws) == (0, f"{ws}/src/patrol: in step\n")
    assert run("extract", ws)[0] == 0
    replace(SOURCE, "% 4", "% 7")
    assert run("sync", ws)[0] == 0
    assert "% 7" in Path("patrol.rebeca").read_text()


def test_code_behind_a_link_within_the_repository(run: Run, package: Path) -> None:
    git("init", "-q")
    linked(package / "src" / "robot.cpp", package.parent / "common" / "robot.cpp")
    linked(package / "include" / "patrol", package.parent / "headers")
    assert run("check") == (0, "patrol: in step\n")
    assert run("extract", "patrol")[0] == 0
    replace("common/robot.cpp", "% 4", "% 7")
    assert run("check")[0] == 1
    assert run("sync")[0] == 0  # the code is as it is to be
    assert "% 7" in Path("patrol.rebeca").read_text()
    assert Path(SOURCE).is_symlink()


def test_a_package_that_is_a_link_to_outside_is_not_written(package: Path, run: Run) -> None:
    """Not even where what it leads to looks like a package."""
    victim = package.parent.parent / "victim"
    shutil.rmtree(victim, ignore_errors=True)
    (victim / ".rebsync").mkdir(parents=True)
    git("init", "-q")
    shutil.rmtree("patrol")
    Path("patrol").symlink_to(victim)
    assert run("generate", "patrol.rebeca")[0] == 2
    assert sorted(p.name for p in victim.iterdir()) == [".rebsync"]


# --- packages and files behind links that a directory holds -------------------------------------


@pytest.fixture
def elsewhere(package: Path, tmp_path: Path) -> Path:
    """The package is a link out of the directory, and its model has moved on."""
    away = tmp_path / "away"
    away.mkdir()
    linked(package, away / "patrol")
    shutil.copy("patrol.rebeca", away)
    replace(str(away / "patrol.rebeca"), "% 4", "% 5")
    replace("patrol.rebeca", "% 4", "% 5")
    return away


@pytest.mark.parametrize("named", [[], ["."], ["patrol"], ["patrol/src/robot.cpp"]])
def test_a_linked_package_out_of_the_repository_is_read_only(
    run: Run, elsewhere: Path, named: list[str]
) -> None:
    git("init", "-q")
    before = everything(elsewhere)
    for option in ([], ["--dry-run"]):
        status, shown = run("sync", *option, *named)
        assert (status, "patrol: RS813 this link leads out of the repository" in shown) == (2, True)
        assert f"`rebsync sync {elsewhere}/patrol` writes there" in shown
    assert everything(elsewhere) == before
    assert run("check", *named)[0] == 1
    assert run("sync", f"{elsewhere}/patrol")[0] == 0
    assert "% 5" in (elsewhere / SOURCE).read_text()


@pytest.mark.parametrize("named", [[], ["."], ["../ws"]])
def test_nor_out_of_the_directory_that_was_named(
    run: Run, elsewhere: Path, named: list[str]
) -> None:
    """An archive that was unpacked is no repository."""
    Path("../ws").symlink_to(Path.cwd())
    before = everything(elsewhere)
    status, shown = run("sync", *named)
    assert (status, "leads out of the directory that was named" in shown) == (2, True), shown
    assert run("generate", "patrol.rebeca")[0] == 2
    assert everything(elsewhere) == before


@pytest.mark.parametrize("named", ["patrol", "patrol/", "patrol/src/robot.cpp", ".."])
def test_but_where_it_is_named(run: Run, elsewhere: Path, named: str) -> None:
    status, shown = run("sync", named)
    assert status == 0, shown
    assert "% 5" in (elsewhere / SOURCE).read_text()


def test_a_package_that_becomes_a_link_out_meanwhile(
    run: Run, package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    git("init", "-q")
    replace("patrol.rebeca", "% 4", "% 5")
    away = tmp_path / "away"
    shutil.copytree(package, away)
    before = everything(away)

    def late(*arguments: object, **others: object) -> tuple[str, ...]:
        shutil.rmtree(package)
        package.symlink_to(away)
        return rebsync.writing.replace_tree(*arguments, **others)  # type: ignore[arg-type]

    monkeypatch.setattr("rebsync.roundtrip.sync.writing.replace_tree", late)
    status, _ = run("sync")
    assert status == 2
    assert everything(away) == before


@pytest.mark.parametrize("is_repository", [True, False])
@pytest.mark.parametrize("command", ["fmt", "fmt --check", "lint", "lint --fix"])
def test_models_behind_links_that_a_directory_holds(
    run: Run, package: Path, tmp_path: Path, command: str, is_repository: bool
) -> None:
    if is_repository:
        git("init", "-q")
    outside = tmp_path / "secret.rebeca"
    outside.write_text("reactiveclass  Secret(4){msgsrv m(){?<1,2>;}}\n")
    text = outside.read_text()
    Path("in").mkdir()
    Path("in/a.rebeca").symlink_to(outside)
    Path("in/b.rebeca").symlink_to("../patrol.rebeca")
    status, shown = run(*command.split(), "in")
    assert (status, "in/a.rebeca: RS813" in shown, "Secret" in shown) == (2, True, False), shown
    assert ("in/b.rebeca: RS813" in shown) is not is_repository
    assert outside.read_text() == text
    assert run(*command.split(), ".")[1].count("RS813") == 1
    if not is_repository and command == "fmt":
        assert run("fmt", "in/a.rebeca")[0] == 2  # it is read, and is no model
        assert "RS813" not in run("fmt", "in/a.rebeca")[1]


def test_a_model_is_not_extracted_behind_a_link(run: Run, package: Path, tmp_path: Path) -> None:
    outside = tmp_path / "start_up"
    outside.write_text("here\n")
    Path("out").mkdir()
    Path("out/patrol.rebeca").symlink_to(outside)
    status, shown = run("extract", "patrol", "-o", "out")
    assert (status, "RS813" in shown, outside.read_text()) == (2, True, "here\n")


def test_code_behind_links_where_no_repository_is(
    run: Run, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    linked(package / "src" / "robot.cpp", package.parent / "common" / "robot.cpp")
    assert run("check", ".")[0] == 0
    assert "leads out" not in run("extract", ".")[1]
    assert run("check", "patrol")[0] == 0
    monkeypatch.chdir("patrol")
    for command in ("check", "extract"):
        status, shown = run(command, str(package))
        assert (status, "a link that leads out of the tree" in shown) == (4, True), shown
