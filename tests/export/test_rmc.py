"""`rebsync export --for rmc`: what is taken out, what stays, what is said about the rest."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given

from rebsync import model as m
from rebsync.forward.rmc import KEPT_ANNOTATIONS, export_rmc
from rebsync.grammars.parser import parse_model
from rebsync.printing import print_model
from rebsync.source import Source
from tests.printing.test_laws import rebuilt
from tests.strategies import models

MODEL = """\
env int e = 0x10;
@Robot @Class(1, 2)
reactiveclass R(0x4) { // size
  statevars { int[ 0x3 ] a; @doNotExport boolean b; byte c; }
  R() { c = 010; b = true; a[0] = 1_0; self.m(); }
  /* keep me */
  @Port @priority(0x1)
  msgsrv m() {
    @Move(X+1, Y);
    @Move(X, Y) @Note; // there
    if (b) @Move(X, Y-(0x2)); // and here
    else { @Move(X,Y); ; }
    @Note(0x1) c = 1;
  }
}
main { @globalPriority(2) @Other R r():(); }
"""
EXPECTED = """\
env int e = 16;

reactiveclass R(4) { // size
  statevars { int[3] a; boolean b; byte c; }
  R() { c = 8; b = true; a[0] = 10; self.m(); }
  /* keep me */
  @priority(1)
  msgsrv m() {

    // there
    if (b) ; // and here
    else { ; }
    c = 1;
  }
}
main { @globalPriority(2) R r():(); }
"""


def exported(text: str) -> tuple[str, list[str]]:
    """The exported text, and the findings as `line code`."""
    source = Source("model.rebeca", text)
    parsed = parse_model(source)
    assert not parsed.diagnostics
    result, found = export_rmc(source, parsed.model)
    return result, [f"{source.position(d.span.start).line} {d.code}" for d in found]


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_the_text_stays_but_for_what_the_compiler_does_not_know(newline: str) -> None:
    text, found = exported(MODEL.replace("\n", newline))
    assert text == EXPECTED.replace("\n", newline)
    assert not found


def test_a_model_that_the_compiler_accepts_stays_as_it_is() -> None:
    text, found = exported(EXPECTED)
    assert (text, found) == (EXPECTED, [])


def test_limits() -> None:
    text = """\
interface I { msgsrv m(); }
reactiveclass A extends B implements I(3) {
  statevars { int[128] long; int[127] fine; int x; }
  msgsrv m() {
    x = ?(1, 2);
    x = ?(1, (1));
    while (x > 1) {
      x = ?(1, 2);
      continue;
    }
    x = now;
  }
}
abstract reactiveclass B(3) {}
main { A a():(); }
"""
    assert exported(text)[1] == [
        "1 RS750",
        "1 RS752",
        "2 RS750",
        "3 RS750",
        "6 RS750",
        "8 RS751",
        "9 RS751",
        "11 RS751",
    ]


@given(models())
def test_only_annotations_and_their_blanks_go(model: m.Model) -> None:
    text, _ = export_rmc(Source("drawn", printed := print_model(model)), parse(printed))
    assert rebuilt(parse(text), _stripped) == rebuilt(parse(printed), _stripped)
    notes = {n.name for n in m.walk(parse(text)) if isinstance(n, m.Annotation)}
    assert notes <= KEPT_ANNOTATIONS
    assert text.count("\n") == printed.count("\n")


def parse(text: str) -> m.Model:
    """The tree of a text without mistakes."""
    return parse_model(Source("drawn", text)).model


def _stripped(node: m.Node) -> m.Node:
    """Without annotations, and without empty statements in lists."""
    if isinstance(node, m.Block | m.Case):
        kept = tuple(s for s in node.statements if not isinstance(s, m.Empty))
        node = replace(node, statements=kept)
    if hasattr(node, "annotations"):
        return replace(node, annotations=())  # type: ignore[arg-type]
    return node
