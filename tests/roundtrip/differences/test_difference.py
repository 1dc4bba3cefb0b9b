"""What a difference says of itself, and where it is."""

from __future__ import annotations

import pytest

from rebsync import model as m
from rebsync.diagnostics import RebsyncError
from rebsync.roundtrip.diff.alignment import aligned, longest_increasing, overlap
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import (
    Aspect,
    Changed,
    Element,
    Place,
    explain,
    place,
)
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.source import NOWHERE, Source, Span
from tests.roundtrip.differences.lines import line_of

SOURCE = Source("a.rebeca", "one\ntwo\nthree\n")
ELEMENT = Element("msgsrv", "A.m")


def changed(old: str, new: str) -> Changed:
    return Changed(ELEMENT, Aspect.CONDITION, "if", old, new, Place(SOURCE, Span(4, 7)), None)


def test_a_line() -> None:
    assert (
        line_of(changed("x", "y")) == "a.rebeca:2 - msgsrv A.m: condition of if changed from x to y"
    )
    assert explain(changed("", "y")) == "condition of if added: y"
    assert explain(changed("x", "")) == "condition of if removed: x"


def test_long_texts_show_where_they_differ() -> None:
    long = " + ".join(f"number{n}" for n in range(20))
    told = explain(changed(f"{long} + 1", f"{long} + 2"))
    assert told == (
        "condition of if changed from ...mber18 + number19 + 1 to ...mber18 + number19 + 2"
    )
    assert len(explain(changed(long, "x" * 500))) < 220


def test_places() -> None:
    other = Source("b.cpp", "four\n")
    assert str(place(Span(4, 7), SOURCE)) == "a.rebeca:2"
    assert str(place(other.within(Span(0, 2)), SOURCE)) == "b.cpp:1"
    assert place(NOWHERE, SOURCE) is None
    assert str(Place(SOURCE, NOWHERE)) == "a.rebeca"


def test_groups() -> None:
    assert [Element(k, p).group for k, p in (("env", "e"), ("rebec", "r"), ("msgsrv", "A.m"))] == [
        "",
        "",
        "A",
    ]


@pytest.mark.parametrize(
    ("left", "right", "wanted"),
    [
        ("abc", "abc", "aa bb cc"),
        ("abc", "axc", "aa b- -x cc"),
        ("abc", "ac", "aa b- cc"),
        ("aab", "ab", "aa a- bb"),
        ("aB", "Ab", "aA Bb"),
        ("", "ab", "-a -b"),
    ],
)
def test_alignment(left: str, right: str, wanted: str) -> None:
    def similarity(x: str, y: str) -> float:
        return 0.8 if x.lower() == y.lower() else 0.0

    found = aligned(list(left), list(right), similarity)
    assert " ".join(f"{x or '-'}{y or '-'}" for x, y in found) == wanted


def test_long_sequences_are_aligned_by_what_is_equal() -> None:
    left = [str(n) for n in range(300)]
    right = [*left[100:], "new", *left[:20]]
    found = list(aligned(left, right, lambda x, y: 0.0))
    assert [x for x, y in found if x is not None] == left
    assert [y for x, y in found if y is not None] == right
    assert sum(x == y for x, y in found) == 200


def test_helpers() -> None:
    assert longest_increasing([3, 1, 2, 5, 4]) in ({1, 2, 4}, {1, 2, 5})
    assert longest_increasing([]) == frozenset()
    from collections import Counter

    assert overlap(Counter("aab"), Counter("ab")) == 0.8
    assert overlap(Counter(), Counter()) == 1.0


def chain(length: int) -> SourcedModel:
    """A chain of `else if`, which nests as deep as it is long."""
    statement: m.Statement = m.Empty()
    for _ in range(length):
        statement = m.If(m.Name("x"), m.Empty((m.Annotation("note"),)), statement)
    server = m.MessageServer("m", (), m.Block((statement,)))
    return SourcedModel(m.Model((), (m.ReactiveClass("A", 2, (server,)),), None), SOURCE)


def test_what_nests_too_deeply_is_a_mistake_of_the_model() -> None:
    assert compare(chain(30), chain(31)).differences
    with pytest.raises(RebsyncError) as raised:
        compare(chain(3000), chain(3001))
    assert raised.value.findings[0].diagnostics[0].code == "RS111"


def test_what_could_not_be_read_is_like_nothing() -> None:
    body = m.Block((m.Empty((m.Annotation("Unreadable"),)),))
    model = m.Model((), (m.ReactiveClass("A", 2, (m.MessageServer("m", (), body),)),), None)
    comparison = compare(SourcedModel(model, SOURCE), SourcedModel(model, SOURCE))
    assert comparison.is_undetermined
    assert {str(d.element) for d in comparison.differences} == {"msgsrv A.m"}
