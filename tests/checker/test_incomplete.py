"""Models with code that was not read, or that are open: nothing is known to hold of them."""

from __future__ import annotations

import pytest

from rebsync.checker.problem import Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.verify import verify
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.source import Source
from rebsync.static import analyse

_MODEL = """reactiveclass A(3) {
  statevars { int x; }
  A() { x = 0; self.go(); }
  msgsrv go() {
    BODY
    self.go() after(1);
  }
  SERVERS
}
main { A a():(); }
"""
_PROPERTY = """property {
  define { one = (a.x == 1); }
  Assertion { Never: !one; }
  LTL { Always: G(!one); }
}
"""


def _lines(body: str) -> str:
    """The same with each statement on a line of its own."""
    return body.replace("; ", ";\n").replace("{ ", "{\n")


def _checked(body: str, servers: str = "") -> Result:
    source = Source("a.rebeca", _MODEL.replace("BODY", _lines(body)).replace("SERVERS", servers))
    analysis = analyse(parse_model(source).model)
    assert not analysis.errors
    properties = Source("a.property", _PROPERTY)
    read = parse_properties(properties).properties
    return verify(Problem(source, analysis, read, properties), Options())


def test_nothing_is_known_to_hold() -> None:
    assert _checked("x = 0;").verdict == "satisfied"
    result = _checked("@Unreadable;")
    assert result.verdict == "undetermined"
    assert dict(result.properties) == {"Never": "undetermined", "Always": "undetermined"}
    assert result.reason is not None and result.reason.endswith("may do anything: line 5")


def test_what_passes_unread_code_is_shown_but_not_certain() -> None:
    assert _checked("x = 1;").verdict == "violated"
    for body in ("@Unreadable; x = 1;", "if (x == 0) { @Unreadable; } x = 1;"):
        result = _checked(body)
        assert result.verdict == "undetermined"
        assert dict(result.properties) == {"Never": "undetermined", "Always": "undetermined"}
        assert [v.name for v in result.violations if v.name == "Never"] == ["Never"]


@pytest.mark.parametrize(
    "body",
    [
        "if (x == 1) { x = 2; @Unreadable; } x = x + 1; if (x > 2) { x = 0; }",
        "if (x == 1) { x = 0; @Unreadable; } x = 1;",
        "x = ?(0, 1); delay(1); if (x == 1) { @Unreadable; x = 0; }",
    ],
)
def test_a_run_past_unread_code_is_certain(body: str) -> None:
    result = _checked(body)
    assert result.verdict == "violated"
    assert dict(result.properties)["Never"] == "violated"


def test_a_run_that_goes_on_after_a_delay_passes_what_is_behind_it() -> None:
    result = _checked("delay(1); @Unreadable; x = 1;")
    assert (result.verdict, dict(result.properties)["Never"]) == ("undetermined", "undetermined")


_OPEN = "@Open msgsrv told(boolean danger) { if (danger) x = 1; }"


def test_nothing_holds_of_a_model_that_gets_messages_from_outside() -> None:
    assert _checked("x = 0;", _OPEN.removeprefix("@Open ")).verdict == "satisfied"
    result = _checked("x = 0;", _OPEN)
    assert result.verdict == "undetermined"
    assert dict(result.properties) == {"Never": "undetermined", "Always": "undetermined"}
    assert result.reason == "nobody in the model sends what comes from outside to A.told"


def test_what_an_open_model_does_by_itself_is_certain() -> None:
    result = _checked("x = 1;", _OPEN)
    assert result.verdict == "violated"
    assert dict(result.properties)["Never"] == "violated"
    assert _checked("@Unreadable; x = 1;", _OPEN).verdict == "undetermined"
