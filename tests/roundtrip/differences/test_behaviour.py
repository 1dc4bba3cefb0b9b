"""What two models do is compared: names do not matter, what is seen does."""

from __future__ import annotations

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.behaviour.bisimulation import compare_behaviour
from rebsync.roundtrip.diff.behaviour import Behaviour, lines
from rebsync.roundtrip.diff.difference import Place
from rebsync.roundtrip.diff.operands import SourcedModel, UnreadPlace
from rebsync.source import NOWHERE, Source

MODEL = """\
reactiveclass Sender(3) {
  knownrebecs { Receiver to; }
  statevars { int count; }
  Sender() { self.run(); }
  msgsrv run() {
    count = (count + 1) % 3;
    to.take(count);
    to.note() after(1);
    self.run() after(4);
  }
}
reactiveclass Receiver(4) {
  statevars { int last; boolean busy; }
  msgsrv take(int value) {
    last = value;
    busy = true;
    delay(2);
    busy = false;
  }
  msgsrv note() { }
}
main {
  Sender s(r):();
  Receiver r():();
}
"""

SAME = {
    "renamed": [
        ("Receiver", "Sink"),
        ("count", "number"),
        ("take", "accept"),
        (" s(r)", " first(r)"),
        ("value", "given"),
    ],
    "written in another way": [("(count + 1) % 3", "count == 2 ? 0 : count + 1")],
    "sent in another order": [
        ("    to.take(count);\n    to.note() after(1);\n", ""),
        (
            "    self.run() after(4);",
            "    self.run() after(4); to.note() after(1); to.take(count);",
        ),
    ],
    "something more to remember": [
        ("int count;", "int count; int laps;"),
        ("to.take(count);", "to.take(count); laps = (laps + 1) % 5;"),
    ],
    "a local variable": [("to.take(count);", "int x = count; to.take(x);")],
    "a method": [
        ("count = (count + 1) % 3;", "count = next();"),
        ("  msgsrv run", "  int next() { return (count + 1) % 3; }\n  msgsrv run"),
    ],
    "declared in another order": [
        ("statevars { int last; boolean busy; }", "statevars { boolean busy; int last; }")
    ],
}

DIFFERENT = {
    "another value": [("% 3", "% 4"), ("s takes run(); sends ", "s.count = 3")],
    "another time": [("after(4)", "after(5)"), ("s.run() after 5", "s.run() after 5")],
    "another delay": [
        ("delay(2)", "delay(3)"),
        ("r goes on; r.busy = false", "units of time pass"),
    ],
    "a message less": [("to.note() after(1);", ""), ("s takes run(); sends", "sends r.take(1)")],
    "another receiver": [("to.note() after(1)", "to.take(0) after(1)"), ("r.take(0)", "")],
    "a deadline": [("to.take(count)", "to.take(count) deadline(7)"), ("deadline 7", "")],
    "a variable set later": [
        ("busy = true;\n    delay(2);", "delay(2);\n    busy = true;"),
        ("r takes take(1)", ""),
    ],
    "a queue that is full": [("Receiver(4)", "Receiver(1)"), ("fails: overflow", "")],
}

CHOICE = """\
reactiveclass A(3) {
  statevars { int x; }
  A() { self.begin(); }
  msgsrv begin() { %s }
  msgsrv middle(int y) { %s }
  msgsrv end(int y) { x = y; }
}
main { A a():(); }
"""
EARLY = "self.middle(?(1, 2));", "self.end(y);"


def given(text: str) -> SourcedModel:
    source = Source("model.rebeca", text)
    parsed = parse_model(source)
    assert not parsed.diagnostics
    return SourcedModel(parsed.model, source)


def changed(changes: list[tuple[str, str]]) -> str:
    text = MODEL
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return text


def compared(left: str, right: str, most: int = 1000) -> Behaviour:
    return compare_behaviour(given(left), given(right), most)


@pytest.mark.parametrize("name", SAME)
def test_the_same(name: str) -> None:
    for sides in ((MODEL, changed(SAME[name])), (changed(SAME[name]), MODEL)):
        found = compared(*sides)
        assert (found.verdict, found.run) == ("same", ()), "\n".join(lines(found))


@pytest.mark.parametrize("name", DIFFERENT)
def test_different(name: str) -> None:
    change, shown = DIFFERENT[name]
    found = compared(MODEL, changed([change]))
    assert found.verdict == "different"
    assert found.only is not None
    assert found.run[0].text == "the constructors run"
    assert any(part in found.run[-1].text for part in shown if part), found.run[-1]
    mirrored = compared(changed([change]), MODEL)
    assert mirrored.verdict == "different"
    assert len(mirrored.run) == len(found.run)


def test_the_last_step_is_one_that_the_other_side_lacks() -> None:
    found = compared(MODEL, changed([("Receiver(4)", "Receiver(1)")]))
    told = list(lines(found))
    assert told[0].startswith("behaviour: different (")
    assert told[-2].startswith("  > ")
    assert told[-2].endswith("s takes run(); fails: overflow")
    assert told[-1].startswith("  where the first side can do this: s takes run(); sends ")
    assert found.run[-1].left is None or found.run[-1].right is None
    line = MODEL[: MODEL.index("msgsrv run")].count("\n") + 1
    takes = [s for s in found.run if s.text.startswith("s takes run()")]
    assert {p.line for s in takes for p in (s.left, s.right) if p is not None} == {line}


def test_a_choice_that_is_made_later() -> None:
    middle = "self.end(?(1, 2));"
    found = compared(CHOICE % EARLY, CHOICE % ("self.middle(0);", middle))
    assert found.verdict == "different"
    assert found.run  # the argument of middle tells them apart
    hidden = CHOICE.replace("msgsrv middle(int y)", "msgsrv middle(boolean hidden)")
    early = "if (?(true, false)) n = 1; else n = 2; self.middle(true);", "self.end(n);"
    late = "self.middle(true);", "if (?(true, false)) m = 1; else m = 2; self.end(m);"
    found = compared(
        hidden.replace("int x;", "int x; int n;") % early,
        hidden.replace("int x;", "int x; byte m;") % late,
    )
    assert (found.verdict, found.run) == ("different", ())
    assert "both have the same runs" in found.reason


def test_a_difference_within_the_bound_is_one() -> None:
    endless = MODEL.replace("(count + 1) % 3", "count + 1")
    assert compared(endless, endless.replace("count", "number"), 40).verdict == "undetermined"
    found = compared(endless, endless.replace("after(4)", "after(5)"), 40)
    assert found.verdict == "different"


def test_what_cannot_be_run_is_undetermined() -> None:
    whole = given(MODEL)
    unread = SourcedModel(
        whole.model, whole.source, (UnreadPlace(Place(whole.source, NOWHERE), "why"),)
    )
    found = compare_behaviour(whole, unread)
    assert (found.verdict, found.reason) == (
        "undetermined",
        "not all of the second side could be read",
    )
    without = MODEL[: MODEL.index("main {")]
    found = compared(without, MODEL)
    assert (found.verdict, found.reason) == (
        "undetermined",
        "the first side cannot be run: it has no main",
    )
    endless = MODEL.replace("last = value;", "while (true) { last = value; }")
    found = compared(endless, MODEL)
    assert found.verdict in ("undetermined", "different")
