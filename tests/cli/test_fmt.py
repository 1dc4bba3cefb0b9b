"""`rebsync fmt` as a user runs it."""

from __future__ import annotations

from pathlib import Path

from tests.cli.run import rebsync

UGLY = b"env int  a=1;\r\nreactiveclass R(2){R(){}}\r\nmain{R r():();}"
NEAT = b"env int a = 1;\n\nreactiveclass R(2) {\n  R() {}\n}\n\nmain {\n  R r():();\n}\n"
NEAT = NEAT.replace(b"\n", b"\r\n")
BROKEN = b"reactiveclass R(2) { R() { x = ; } }\nmain { }\n"


def test_files_are_formatted_in_place_and_then_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_bytes(UGLY)
    first = rebsync("fmt", "a.rebeca", cwd=tmp_path)
    assert (first.status, first.out, first.err) == (0, "", "formatted a.rebeca\n")
    assert path.read_bytes() == NEAT
    before = path.stat()
    second = rebsync("fmt", "a.rebeca", cwd=tmp_path)
    assert (second.status, second.err) == (0, "")
    assert path.stat() == before


def test_standard_input_goes_to_standard_output(tmp_path: Path) -> None:
    done = rebsync("fmt", "-", cwd=tmp_path, stdin=UGLY)
    assert (done.status, done.out.encode()) == (0, NEAT)


def test_check_writes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_bytes(UGLY)
    (tmp_path / "b.rebeca").write_bytes(NEAT)
    done = rebsync("fmt", "--check", ".", cwd=tmp_path)
    assert (done.status, done.err) == (1, "would format a.rebeca\n")
    assert path.read_bytes() == UGLY
    assert rebsync("fmt", "--check", "b.rebeca", cwd=tmp_path).status == 0


def test_diff_shows_and_writes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_bytes(UGLY)
    done = rebsync("fmt", "--diff", "a.rebeca", cwd=tmp_path)
    assert done.status == 1
    assert "\n-env int  a=1;\r\n" in done.out
    assert "\n+env int a = 1;\r\n" in done.out
    assert "\\ No newline at end of file\n" in done.out
    assert path.read_bytes() == UGLY


def test_a_model_with_mistakes_is_left_alone_and_the_others_are_formatted(tmp_path: Path) -> None:
    (tmp_path / "a.rebeca").write_bytes(BROKEN)
    (tmp_path / "b.rebeca").write_bytes(UGLY)
    done = rebsync("fmt", "a.rebeca", "b.rebeca", "c.rebeca", cwd=tmp_path)
    assert done.status == 2
    assert done.err.startswith("a.rebeca:1:32: RS101 unexpected `;`\n")
    assert "formatted b.rebeca\n" in done.err
    assert "c.rebeca: RS801 no such file or directory\n" in done.err
    assert (tmp_path / "a.rebeca").read_bytes() == BROKEN
    assert (tmp_path / "b.rebeca").read_bytes() == NEAT


def test_a_directory_means_the_models_below_it(tmp_path: Path) -> None:
    for name in ("x/a.rebeca", "x/y/b.rebeca", "x/.hidden/c.rebeca", "x/d.txt", ".e.rebeca"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(UGLY)
    done = rebsync("fmt", ".", "x/a.rebeca", cwd=tmp_path)
    assert done.err == "formatted x/a.rebeca\nformatted x/y/b.rebeca\n"


def test_a_directory_without_models_is_said_so(tmp_path: Path) -> None:
    done = rebsync("fmt", ".", cwd=tmp_path)
    assert (done.status, done.err) == (2, ".: RS811 there is no *.rebeca below this directory\n")
