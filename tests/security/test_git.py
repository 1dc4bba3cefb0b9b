"""Repositories that mean harm: trees that git itself makes none of, and configuration that runs."""

from __future__ import annotations

import ast
import stat
import subprocess
from contextlib import suppress
from pathlib import Path

import pytest

from tests.cli.test_check import SOURCE, made, package, replace
from tests.consoles import ROOT
from tests.security.hostile import NAMES, Run, everything, git, runner

__all__ = ["made", "package"]  # fixtures


@pytest.fixture
def run(package: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs the command in a repository with a commit, and nothing of this machine's settings."""
    for name, value in NAMES.items():
        monkeypatch.setenv(name, value)
    git("init", "-q")
    Path(".gitignore").write_text(".cache\n")
    git("add", "-A")
    git("commit", "-q", "-m", "all")
    return runner(capsys, monkeypatch)


# --- objects ------------------------------------------------------------------------------------


def blob(text: str) -> bytes:
    return bytes.fromhex(git("hash-object", "-w", "--stdin", given=text.encode()))


def tree(*entries: tuple[str, bytes, bytes], kind: str = "tree") -> bytes:
    """An object that git makes without looking at what is in it."""
    data = b"".join(b"%s %s\0%s" % (mode.encode(), name, id_) for mode, name, id_ in entries)
    made = git("hash-object", "-t", kind, "--literally", "-w", "--stdin", given=data)
    return bytes.fromhex(made)


def committed(top: bytes) -> str:
    return git("commit-tree", top.hex(), "-m", "evil")


def evil(name: bytes, text: str = "stolen") -> str:
    """A commit with a package in `robots`, in which one entry has an odd name."""
    inner = tree(
        ("100644", name, blob(text)),
        ("100644", b"package.xml", blob("<package><name>robots</name></package>")),
    )
    return committed(tree(("40000", b"robots", inner)))


ODD = [
    b"..",
    b".",
    b"",
    b".git",
    b".GIT",
    b"../../stolen",
    b"/tmp/stolen",
    b"a/../../stolen",
    b"a/b",
]


@pytest.mark.parametrize("name", ODD)
@pytest.mark.parametrize("path", ["robots", "", "robots/package.xml", "robots/.."])
def test_a_tree_with_odd_names(run: Run, tmp_path: Path, name: bytes, path: str) -> None:
    revision = evil(name)
    before = everything(tmp_path)
    status, shown = run("diff", "patrol.rebeca", f"{revision}:{path}")
    assert (status, "RS815" in shown or path == "robots/..") == (2, True), shown
    assert everything(tmp_path) == before


@pytest.mark.parametrize("name", [b"..", b"../../../stolen"])
def test_a_tree_within_a_tree_of_an_odd_name(run: Run, tmp_path: Path, name: bytes) -> None:
    deep = tree(("40000", name, tree(("100644", b"stolen", blob("x")))))
    revision = committed(tree(("40000", b"robots", deep)))
    before = everything(tmp_path)
    assert run("diff", "patrol.rebeca", f"{revision}:robots")[0] == 2
    assert everything(tmp_path) == before


def test_a_name_twice(run: Run) -> None:
    inner = tree(("100644", b"a.cpp", blob("1")), ("100644", b"a.cpp", blob("2")))
    revision = committed(tree(("40000", b"robots", inner)))
    status, shown = run("diff", "patrol.rebeca", f"{revision}:robots")
    assert (status, "RS815" in shown) == (2, True)


@pytest.mark.timeout(60)
def test_a_few_trees_that_stand_for_many_files(run: Run) -> None:
    inner = tree(*(("100644", b"f%d.cpp" % i, blob("int x;")) for i in range(10)))
    for _ in range(10):
        inner = tree(*(("40000", b"d%d" % i, inner) for i in range(10)))
    revision = committed(tree(("40000", b"robots", inner)))
    status, shown = run("diff", "patrol.rebeca", f"{revision}:robots")
    assert (status, "more than 100,000 files" in shown) == (2, True), shown


@pytest.mark.timeout(60)
def test_trees_nested_without_end(run: Run) -> None:
    inner = tree(("100644", b"f.cpp", blob("int x;")))
    for _ in range(300):
        inner = tree(("40000", b"a-name-of-some-length", inner))
    revision = committed(tree(("40000", b"robots", inner)))
    status, shown = run("diff", "patrol.rebeca", f"{revision}:robots")
    assert (status, "paths longer than those of files" in shown) == (2, True), shown


@pytest.mark.parametrize("kind", ["a blob", "nothing", "cut short", "no mode"])
def test_damaged_trees(run: Run, kind: str) -> None:
    match kind:
        case "a blob":
            inner = blob("x")
        case "nothing":
            inner = b"\1" * 20
        case "cut short":
            data = git(
                "hash-object", "-t", "tree", "--literally", "-w", "--stdin", given=b"100644 a\0xy"
            )
            inner = bytes.fromhex(data)
        case _:
            inner = tree(("", b"a.cpp", blob("x")), ("9z", b"b.cpp", blob("x")))
    revision = committed(tree(("40000", b"robots", inner)))
    assert run("diff", "patrol.rebeca", f"{revision}:robots")[0] == 2


def test_links_in_a_revision(run: Run, package: Path, tmp_path: Path) -> None:
    (tmp_path / "secret.cpp").write_text("int secret_word;\n")
    Path("common").mkdir()
    (package / "src" / "robot.cpp").rename("common/robot.cpp")
    (package / "src" / "robot.cpp").symlink_to("../../common/robot.cpp")
    git("add", "-A")
    git("commit", "-q", "-m", "links")
    assert run("diff", "patrol.rebeca", "HEAD:patrol") == (0, "")
    (package / "src" / "loop").symlink_to(".")
    (package / "src" / "out.cpp").symlink_to(tmp_path / "secret.cpp")
    (package / "src" / "above").symlink_to("../../../../..")
    (package / "src" / "round.cpp").symlink_to("round.cpp")
    git("add", "-A")
    git("commit", "-q", "-m", "more")
    status, shown = run("diff", "patrol.rebeca", "HEAD:patrol", "--format", "json")
    assert (status, "secret_word" in shown) == (4, False)
    _, shown = run("extract", "patrol")
    assert "patrol/src/out.cpp: RS941" in shown


def test_a_revision_that_is_an_option(run: Run, tmp_path: Path) -> None:
    before = everything(tmp_path)
    for name in ("--output=stolen:x", "--git-dir=/tmp:x", "-:x"):
        assert run("diff", "patrol.rebeca", "--", name)[0] == 2
    assert everything(tmp_path) == before


# --- configuration ------------------------------------------------------------------------------


def trap(folder: Path, name: str, answer: str = "cat") -> str:
    """A program that leaves a trace, and goes on as one that means no harm would."""
    program = folder / f"{name}.sh"
    program.write_text(f'#!/bin/sh\necho "$0 $@" >> "{folder}/trace"\n{answer}\n')
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return str(program)


@pytest.fixture
def traps(run: Run, tmp_path: Path) -> Path:
    """Where a trace is left by all that a repository can have git run."""
    folder = tmp_path / "traps"
    (folder / "hooks").mkdir(parents=True)
    hooks = (
        "post-index-change",
        "pre-commit",
        "post-checkout",
        "pre-auto-gc",
        "fsmonitor-watchman",
        "reference-transaction",
    )
    for name in hooks:
        Path(trap(folder, name)).rename(folder / "hooks" / name)
        Path(trap(folder, name)).rename(Path(".git/hooks") / name)
    settings = {
        "core.fsmonitor": trap(folder, "fsmonitor", "exit 1"),
        "core.hooksPath": str(folder / "hooks"),
        "core.pager": trap(folder, "pager"),
        "core.editor": trap(folder, "editor"),
        "core.sshCommand": trap(folder, "ssh"),
        "core.askPass": trap(folder, "askpass"),
        "core.alternateRefsCommand": trap(folder, "refs"),
        "core.gitProxy": trap(folder, "proxy"),
        "credential.helper": trap(folder, "credential"),
        "diff.external": trap(folder, "differ"),
        "diff.all.command": trap(folder, "driver"),
        "diff.all.textconv": trap(folder, "textconv", 'cat "$1"'),
        "filter.all.clean": trap(folder, "clean"),
        "filter.all.smudge": trap(folder, "smudge"),
        "filter.all.process": trap(folder, "process", "exit 1"),
        "filter.all.required": "true",
        "merge.all.driver": trap(folder, "merge"),
        "merge.default": "all",
        "gpg.program": trap(folder, "gpg"),
        "pager.diff-index": trap(folder, "pagers"),
        "remote.origin.url": f"ext::{trap(folder, 'ext')} %S",
        "remote.origin.uploadpack": trap(folder, "uploadpack"),
        "remote.origin.promisor": "true",
        "remote.origin.partialclonefilter": "blob:none",
        "remote.origin.vcs": "ext",
        "protocol.allow": "always",
        "protocol.ext.allow": "always",
        "extensions.partialClone": "origin",
        "core.repositoryFormatVersion": "1",
        "alias.cat-file": f"!{trap(folder, 'alias')}",
        "uploadpack.packObjectsHook": trap(folder, "pack"),
        "interactive.diffFilter": trap(folder, "interactive"),
        "trailer.x.command": trap(folder, "trailer"),
        "submodule.x.update": f"!{trap(folder, 'submodule')}",
    }
    Path(".gitattributes").write_text("* filter=all diff=all merge=all\n")
    for key, value in settings.items():
        git("config", key, value)
    return folder


def test_the_traps_work(traps: Path) -> None:
    replace("patrol.rebeca", "n > 3", "n > 4")
    with suppress(subprocess.CalledProcessError):  # the filter says that it has failed
        git("diff", "--ext-diff", "HEAD", "--", "patrol.rebeca")
    git("config", "--unset", "filter.all.process")
    git("hash-object", "patrol.rebeca")
    trace = (traps / "trace").read_text()
    assert "fsmonitor" in trace
    for name in ("process.sh", "clean.sh"):
        assert name in trace


def test_nothing_that_a_repository_says_is_run(run: Run, traps: Path) -> None:
    (traps / "trace").unlink(missing_ok=True)
    top = git("rev-parse", "HEAD^{tree}")
    (traps / "trace").unlink(missing_ok=True)
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "n > 3", "n >= 4")
    Path(".git/objects/info/alternates").write_text("/nowhere/objects\n")
    lost = f"{top[:2]}/{top[2:]}"
    assert run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")[0] == 0
    assert run("diff", "HEAD:patrol/src/robot.cpp", SOURCE)[0] == 1
    assert run("diff", "HEAD:gone.cpp", SOURCE)[0] == 2
    assert run("diff", "none:gone.cpp", SOURCE)[0] == 2
    for command in (["check"], ["check", "--verify"], ["extract", "patrol"], ["lint", "."]):
        run(*command)
    assert run("sync", "--dry-run")[0] == 1
    assert run("sync")[0] == 1  # a conflict, which git is told of
    for command in (["fmt", "."], ["generate", "patrol.rebeca"]):
        run(*command)
    Path(f".git/objects/{lost}").rename("aside")  # what a partial clone would fetch
    assert run("diff", "HEAD:patrol.rebeca", SOURCE)[0] == 2
    assert not (traps / "trace").exists(), (traps / "trace").read_text()
    Path("aside").rename(f".git/objects/{lost}")
    Path(".git/config").write_text("[core]\n\trepositoryFormatVersion = 0\n")
    assert len(git("ls-files", "-u").splitlines()) == 3, "the conflict is in the index all the same"


def test_what_the_environment_says_is_run_is_not(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("GIT_EXTERNAL_DIFF", "GIT_PAGER", "GIT_SSH_COMMAND", "GIT_ASKPASS", "GIT_PROXY"):
        monkeypatch.setenv(name, trap(tmp_path, name))
    monkeypatch.setenv("GIT_TRACE", str(tmp_path / "trace"))
    monkeypatch.setenv("GIT_INDEX_FILE", str(tmp_path / "index"))
    assert run("diff", "HEAD:patrol.rebeca", "patrol")[0] == 0
    assert run("diff", "HEAD:gone", "patrol")[0] == 2
    assert not (tmp_path / "trace").exists()


def test_a_hook_says_which_repository_it_is_for(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bare = tmp_path / "bare.git"
    git("clone", "-q", "--bare", ".", str(bare))
    monkeypatch.chdir(bare)
    assert run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")[0] == 2
    monkeypatch.setenv("GIT_DIR", ".")
    assert run("diff", "HEAD:patrol.rebeca", "HEAD:patrol") == (0, "")


def test_a_repository_among_the_files_of_another_is_none(
    run: Run, tmp_path: Path, traps: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A bare one, which a branch can bring: its configuration would hold in that directory."""
    bare = Path("docs").absolute()
    git("clone", "-q", "--bare", ".", str(bare))
    Path(bare, "config").write_text(
        Path(".git/config").read_text().replace("[core]", "[core]\n\tbare = true", 1)
    )
    git("config", "--unset", "core.fsmonitor")
    (traps / "trace").unlink(missing_ok=True)
    monkeypatch.chdir(bare)
    run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")
    run("check", "..")
    assert not (traps / "trace").exists()


def test_a_repository_of_somebody_else(
    run: Run, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    monkeypatch.setattr("rebsync.git._KEPT", ("GIT_",))
    status, shown = run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")
    assert (status, "git does not trust this repository" in shown) == (2, True), shown


# --- the house ----------------------------------------------------------------------------------


def test_git_is_run_in_one_place_only() -> None:
    """Whoever starts a program must be known here."""
    starting = set()
    for folder in ("rebsync", "forward", "reverse", "roundtrip", "grammars"):
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                names = {n.name for n in node.names} if isinstance(node, ast.Import) else set()
                if isinstance(node, ast.ImportFrom):
                    names = {node.module or ""}
                if names & {"subprocess", "pty", "asyncio"}:
                    starting.add(path.resolve().relative_to(ROOT).as_posix())
    own = "rebsync/cli/watch.py"  # starts rebsync itself
    assert starting == {
        "rebsync/git.py",
        "rebsync/checker/build.py",
        "rebsync/lsp/handlers/actions.py",
        "rebsync/lsp/session.py",  # only waits with asyncio
        own,
    }
