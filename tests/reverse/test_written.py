"""Annotations in markers: the plain ones are known without the parser, and as it reads them."""

from __future__ import annotations

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.model import Annotation, ReactiveClass
from rebsync.reverse.bodies.written import annotation
from rebsync.source import Source, Span

TEXTS = ["Robot", "X_1", "a$", "priority(1)", "priority(007)", "priority(-1)", "Move(X + 1, Y)"]


def parsed(text: str) -> Annotation:
    (class_,) = parse_model(Source("a", f"@{text} reactiveclass A(1) {{}}")).model.classes
    assert isinstance(class_, ReactiveClass)
    return class_.annotations[0]


@pytest.mark.parametrize("text", TEXTS)
def test_they_are_as_the_parser_reads_them(text: str) -> None:
    found = annotation(f"annotation @{text}", Span(3, 9))
    assert found == parsed(text)
    assert found is not None
    assert found.span == Span(3, 9)


@pytest.mark.parametrize("text", ["Robot", "priority(1)"])
def test_what_follows_does_not_count(text: str) -> None:
    assert annotation(f"annotation @{text} as ever", Span(0, 0)) == parsed(text)
    assert annotation(f"msgsrv {text}", Span(0, 0)) is None
