"""Results as text: everything is said, no line is too wide, colours only where they are wanted."""

from __future__ import annotations

import io
import os
import re
from pathlib import Path

import pytest

from rebsync.checker.show.pieces import columns, line, plain, print_lines
from rebsync.checker.show.text import print_result, print_trace, result_lines, trace_lines
from tests.checker.show.runs import Recorder, crossing, lasso, long_run, result, violation

SHOWN = Path(__file__).parent / "crossing.txt"


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_violated_result_as_it_is_printed() -> None:
    found = result(violation(crossing()), violation(lasso(), "property", "Ends"))
    stream = io.StringIO()
    print_result(found, "crossing.rebeca", stream)
    assert stream.getvalue() == SHOWN.read_text(encoding="utf-8")


def test_the_failing_step_is_marked() -> None:
    marked = [row for row in plain(trace_lines(crossing())).splitlines() if row.startswith(">")]
    assert marked == [
        ">   10     7  controller.request(0, false) from left  crossing.rebeca:12",
        ">             an assertion fails: one <at> a time",
    ]


def test_a_violating_state_marks_the_step_that_leads_to_it() -> None:
    text = plain(trace_lines(crossing(failing=False), "Safe does not hold"))
    marked = [row for row in text.splitlines() if row.startswith(">")]
    assert "left goes on with request()" not in marked[0]
    assert marked[0].startswith(">    9     7  left goes on")
    assert marked[-1] == "> Safe does not hold"


def test_the_loop_is_marked() -> None:
    rows = plain(trace_lines(lasso())).splitlines()
    at = rows.index("| from here on the run repeats for ever:")
    assert all(row.startswith("|") for row in rows[at:])
    assert not any(row.startswith("|") for row in rows[:at])
    assert rows[-1] == "| back to the state after step 2"


def test_a_run_that_stays_where_it_is() -> None:
    run = Recorder({"a": {}})
    run.start()
    assert plain(trace_lines(run.trace(loop=0))).endswith("| the run stays here for ever\n")


def test_every_step_of_a_long_run_is_shown() -> None:
    text = plain(trace_lines(long_run(12, 1000)))
    assert re.findall(r"^ {2,5}(\d+) ", text, re.MULTILINE) == [str(n) for n in range(1001)]


@pytest.mark.parametrize("width", [40, 80, 120])
def test_nothing_is_wider_than_the_terminal(width: int) -> None:
    found = result(violation(crossing()), violation(long_run(5, 60)))
    wide = plain(result_lines(found, "crossing.rebeca"), width)
    assert max(map(columns, wide.splitlines())) <= width
    flowing = plain(result_lines(found, "crossing.rebeca"))
    assert wide.split() == flowing.split()


def test_a_word_that_is_too_long_stands_alone() -> None:
    assert plain([line("  abc ", "b" * 50, " c", hang=4)], 40) == f"  abc\n    {'b' * 50}\n    c\n"


def test_wide_characters_count_twice() -> None:
    assert plain([line("日本 日本 日本", hang=2)], 9) == "日本 日本\n  日本\n"


def test_a_pipe_gets_plain_text(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    print_trace(crossing(), stream)
    assert "\x1b" not in stream.getvalue()


def test_a_terminal_gets_colours_unless_it_refuses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setattr("shutil.get_terminal_size", lambda *_, **__: os.terminal_size((80, 24)))
    coloured, bare = Terminal(), Terminal()
    lines = result_lines(result(violation(crossing())), "crossing.rebeca")
    print_lines(lines, coloured)
    monkeypatch.setenv("NO_COLOR", "1")
    print_lines(lines, bare)
    assert "\x1b[1;31m" in coloured.getvalue()
    assert bare.getvalue() == plain(lines, 80)
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured.getvalue()) == bare.getvalue()


def test_control_characters_do_not_reach_the_terminal() -> None:
    run = Recorder({"a": {}}, model="\x1b[31m.rebeca")
    run.start(run.message("a", "a", "m", {"x": "1"}, 0, None))
    run.take("a", failure="\x1b]0;text\x07")
    assert "\x1b" not in plain(trace_lines(run.trace()))
    assert "\x07" not in plain(trace_lines(run.trace()))
