"""The steps that an edit by hand goes through, each with what must hold after it."""

from __future__ import annotations

from tests.roundtrip.edits.trial import LATER, Trial


def all_steps(trial: Trial) -> None:
    """What is said of an edit, and what a sync makes of it."""
    if trial.case.listed:
        is_listed(trial)
        is_left_alone(trial)
        return
    if trial.case.elsewhere:
        is_elsewhere(trial)
        is_left_alone(trial, 1)
        return
    if trial.case.data.get("refused", False):
        is_refused(trial)
        return
    is_said(trial)
    comes_back(trial)
    model_goes_into_edited_code(trial)


def is_judged(trial: Trial) -> None:
    """What is said of an edit."""
    if trial.case.listed:
        is_listed(trial)
    elif trial.case.elsewhere:
        is_elsewhere(trial)
    elif trial.case.data.get("refused", False):
        is_refused(trial)
    else:
        is_said(trial)


def is_listed(trial: Trial) -> None:
    """No verdict is given on what no model shows, and each place is told."""
    verdict, told, texts = trial.check()
    assert verdict == "undetermined", (verdict, told, texts)
    for text in trial.case.listed:
        assert any(text in each for each in texts), (text, texts)


def is_elsewhere(trial: Trial) -> None:
    """The code is known to differ where messages get elsewhere, and each place is told."""
    verdict, told, texts = trial.check()
    assert verdict == "code ahead", (verdict, told, texts)
    for text in trial.case.elsewhere:
        assert any(text in each for each in texts), (text, texts)


def is_refused(trial: Trial) -> None:
    """The code has moved to what would break a rule of the model, which a sync says."""
    assert trial.check()[0] == "code ahead"
    text = trial.model.read_bytes()
    is_left_alone(trial, 1)
    assert trial.model.read_bytes() == text


def is_left_alone(trial: Trial, status: int = 4) -> None:
    """No code changes where not all is known, or no model can say what is.

    Only a message that a node just sends itself may come in.
    """
    before = trial.code()
    assert trial.status("sync") == status
    after = trial.code()
    assert {name: after.get(name) for name in before} == before
    assert all(name.endswith(".msg") for name in after.keys() - before.keys())


def is_said(trial: Trial) -> None:
    """The code says the model that the edit is, and check that it is ahead, if it is."""
    wanted = trial.wanted()
    is_same = wanted == trial.model.read_text(encoding="utf-8")
    verdict, told, texts = trial.check()
    is_same = is_same or trial.case.data.get("alike", False)
    possible = ["in step"] if is_same else ["code ahead", "in step"]
    assert verdict in possible, (verdict, told, texts)
    assert all("does the same" in text for text in texts), texts
    assert_says(trial, wanted)


def assert_says(trial: Trial, wanted: str) -> None:
    """The code is in step with another text of the model."""
    text = trial.model.read_text(encoding="utf-8")
    trial.model.write_text(wanted, encoding="utf-8")
    verdict, told, texts = trial.check()
    if trial.case.data.get("alike", False) or trial.case.data.get("otherwise", False):
        texts = [text for text in texts if "does the same" not in text]
    assert (verdict, texts) == ("in step", []), (told, texts)
    trial.model.write_text(text, encoding="utf-8")


def comes_back(trial: Trial) -> None:
    """A sync makes the model the one that the edit is, and leaves the code.

    Only a message that nothing has yet, as a node just sends it itself, is written.
    """
    wanted, code = trial.wanted(), trial.code()
    assert trial.status("sync") == 0
    after = trial.code()
    left_out = "stand_in" if trial.case.data.get("stand_in") else "\0"
    code = {name: text for name, text in code.items() if left_out not in name}
    after = {name: text for name, text in after.items() if left_out not in name}
    assert {name: after.get(name) for name in code} == code, "the code has it already"
    assert all(name.endswith(".msg") for name in after.keys() - code.keys())
    assert trial.status("check") == 0
    assert_says(trial, wanted)


def model_goes_into_edited_code(trial: Trial) -> None:
    """A later change of the model comes into the code, of which nothing else changes."""
    old, new = trial.case.data.get("later", LATER[trial.case.example])
    text = trial.model.read_text(encoding="utf-8")
    assert old in text, old
    trial.model.write_text(text.replace(old, new), encoding="utf-8")
    before = trial.code()
    assert trial.status("sync") == 0
    after = trial.code()
    changed = [p for p in sorted({*before, *after}) if before.get(p) != after.get(p)]
    assert changed
    gone = [line for p in changed for line in _lines_gone(before.get(p, b""), after.get(p, b""))]
    assert len(gone) <= 2, gone
    assert trial.status("check") == 0
    assert trial.check()[0] == "in step"


def _lines_gone(before: bytes, after: bytes) -> list[bytes]:
    left = set(after.splitlines())
    return [line for line in before.splitlines() if line not in left]
