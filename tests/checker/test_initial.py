"""What public models have: `initial` of core Rebeca up to 2.0, features, misplaced annotations."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.run import rebsync

MODEL = """\
reactiveclass A(3) {
    knownrebecs { A o; }
    statevars { int n; }
    BEGIN(int m) { n = m; o.go(); }
    msgsrv go() { n = (n + 1) % 3; o.go(); }
}
main { A a(b):(1); A b(a):(2); }
"""


def verified(folder: Path, text: str, *options: str) -> tuple[int, dict[str, object]]:
    (folder / "m.rebeca").write_text(text)
    done = rebsync("verify", "m.rebeca", "--format", "json", *options, cwd=folder)
    return done.status, json.loads(done.out)


def test_core_rebeca_sends_initial_at_the_start(tmp_path: Path) -> None:
    written = MODEL.replace("BEGIN(", "A(int m) { self.initial(m); } msgsrv initial(")
    expected = verified(tmp_path, written, "--language", "core")
    found = verified(tmp_path, MODEL.replace("BEGIN", "msgsrv initial"), "--language", "core")
    assert found[0] == expected[0] == 0
    figures = ("verdict", "states", "transitions", "depth")
    assert [found[1][f] for f in figures] == [expected[1][f] for f in figures]
    assert found[1]["states"] == 12


def test_a_class_with_a_constructor_begins_by_itself(tmp_path: Path) -> None:
    text = MODEL.replace("BEGIN(int m) {", "msgsrv initial() { } A(int m) {")
    status, found = verified(
        tmp_path, text.replace("o.go(); }", "self.go(); }"), "--language", "core"
    )
    assert (status, found["verdict"]) == (0, "satisfied")
    assert found["coverage"]["servers"] == ["A.initial"]  # type: ignore[index]


def test_misplaced_annotations_are_no_mistake_until_code_is_made(tmp_path: Path) -> None:
    text = """\
@Sensor reactiveclass A(3) {
    A() { self.go(); }
    msgsrv go() { self.go() after(1); }
}
main { @Port A a():(); }
"""
    assert verified(tmp_path, text)[1]["verdict"] == "satisfied"
    lint = rebsync("lint", "m.rebeca", cwd=tmp_path)
    assert "RS427 @Sensor does not belong to a class" in lint.out
    assert "RS427 @Port does not belong to an instance" in lint.out
    generated = rebsync("generate", "m.rebeca", "-o", "out", cwd=tmp_path)
    assert generated.status == 2
    assert "RS427 @Sensor on a class cannot be generated" in generated.out + generated.err


FEATURES = """\
featurevar FAST;
@feature(!FAST) reactiveclass B(1) { }
reactiveclass A(3) {
    statevars { @feature(FAST && !false) int n; @feature(!(FAST || false)) boolean n; }
    A() { self.go(); @feature(FAST && !FAST) self.go(); }
    @feature(FAST) msgsrv go() { if (FAST) { n = (n + 1) % 3; } self.go() after(1); }
    @feature(!FAST) msgsrv go() { unknown(); }
}
main { A a():(); @feature(!FAST) B b():(); }
"""
SELECTED = """\
reactiveclass A(3) {
    statevars { int n; }
    A() { self.go(); }
    msgsrv go() { if (true) { n = (n + 1) % 3; } self.go() after(1); }
}
main { A a():(); }
"""


def test_features_are_true(tmp_path: Path) -> None:
    """What needs one to be false is no part of a model, as the official compiler has it."""
    (status, found), (_, selected) = (verified(tmp_path, m) for m in (FEATURES, SELECTED))
    figures = ("verdict", "states", "transitions", "properties")
    assert status == 0
    assert [found[f] for f in figures] == [selected[f] for f in figures]


@pytest.mark.parametrize(
    "change",
    [("(FAST) msgsrv", "(QUICK) msgsrv"), ("statevars {", "statevars { int FAST;")],
    ids=["one that is not declared", "one that is a variable too"],
)
def test_features_that_are_not_known_are_refused(tmp_path: Path, change: tuple[str, str]) -> None:
    (tmp_path / "m.rebeca").write_text(FEATURES.replace(*change))
    done = rebsync("verify", "m.rebeca", cwd=tmp_path)
    assert done.status == 2
    assert 'RS110 "@feature" is not supported' in done.err
