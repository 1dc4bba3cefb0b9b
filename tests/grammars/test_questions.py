"""Questions about topics, in words."""

from __future__ import annotations

import pytest

from rebsync import questions as q
from rebsync.diagnostics import RebsyncError
from rebsync.grammars.questions import parse_question
from rebsync.source import Source

TEXTS = (
    ("'stop'", "stop"),
    ('"stop"', "stop"),
    (r'"a\nb"', "a\nb"),
    (r'"\t\r\\"', "\t\r\\"),
    (r'"say \"no\""', 'say "no"'),
    (r"'it\'s'", "it's"),
)


@pytest.mark.parametrize(("written", "text"), TEXTS)
def test_texts_have_the_escapes_of_code(written: str, text: str) -> None:
    question = parse_question(Source("q", f"never mode.data == {written}"))
    assert list(q.texts_in(question)) == [text]


@pytest.mark.parametrize("written", [r'"\x41"', r'"\d"', '"\\"', r'"\u0041"'])
def test_other_escapes_are_refused(written: str) -> None:
    with pytest.raises(RebsyncError):
        parse_question(Source("q", f"never mode.data == {written}"))
