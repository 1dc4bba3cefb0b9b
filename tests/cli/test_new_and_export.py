"""`rebsync new` and `rebsync export` as a user runs them."""

from __future__ import annotations

from pathlib import Path

from tests.cli.run import rebsync

CONCEPT = "robots.R.activities.go = { time = 2, move = [1, 0] }\n"


def test_from_a_concept_to_the_official_compiler(tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text(CONCEPT)
    begun = rebsync("new", "c.toml", "-o", "m.rebeca", cwd=tmp_path)
    assert (begun.status, begun.out, begun.err) == (0, "", "")
    text = (tmp_path / "m.rebeca").read_text()
    assert "@Robot" in text
    assert "@Move(X + 1, Y);" in text
    printed = rebsync("export", "--for", "rmc", "m.rebeca", cwd=tmp_path)
    assert (printed.status, printed.err) == (0, "")
    assert "@" not in printed.out
    assert printed.out.count("\n") == text.count("\n")


def test_an_existing_model_is_not_replaced_silently(tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text(CONCEPT)
    (tmp_path / "m.rebeca").write_text("mine")
    done = rebsync("new", "c.toml", "-o", "m.rebeca", cwd=tmp_path)
    assert done.status == 2
    assert done.err.startswith("m.rebeca: RS802 there is a file of this name already\n")
    assert (tmp_path / "m.rebeca").read_text() == "mine"
    assert rebsync("new", "c.toml", "-o", "m.rebeca", "--force", cwd=tmp_path).status == 0


def test_a_concept_with_mistakes(tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text("robot = 1\n")
    done = rebsync("new", "c.toml", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "c.toml:1:1: RS808 unknown key `robot`\n" in done.err


def test_a_model_with_mistakes_is_not_exported(tmp_path: Path) -> None:
    (tmp_path / "m.rebeca").write_text(
        "reactiveclass R(2) { R() { x = 1; } }\nmain { R r():(); }\n"
    )
    done = rebsync("export", "--for", "rmc", "m.rebeca", cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert "RS203" in done.err


def test_limits_of_rmc_are_a_finding_beside_the_text(tmp_path: Path) -> None:
    model = "reactiveclass R(2) { msgsrv m() { while (true) continue; } }\nmain { R r():(); }\n"
    (tmp_path / "m.rebeca").write_text(model)
    done = rebsync("export", "--for", "rmc", "m.rebeca", cwd=tmp_path)
    assert (done.status, done.out) == (1, model)
    assert "RS751" in done.err
