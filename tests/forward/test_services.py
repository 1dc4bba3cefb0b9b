"""Services and actions that no package can offer are refused, each with its reason and place."""

from __future__ import annotations

import pytest

from rebsync.config import Config
from rebsync.forward.limits import limits
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.forward.compiling import generated

_MODEL = """
interface Asked {{ {interface} msgsrv ask(int n); }}
reactiveclass Base(3) implements Asked {{ }}
reactiveclass Shop(3) {{
  knownrebecs {{ Guest guest; }}
  {server} msgsrv buy(int n) {{ {body} }}
}}
reactiveclass Branch extends Shop(3) {{
  knownrebecs {{ Other other; }}
  {below} msgsrv buy(int n) {{ ((Guest)sender).sold(1); }}
}}
reactiveclass Guest(3) {{ msgsrv sold(int n) {{ }} }}
reactiveclass Other(3) {{ msgsrv sold(boolean n) {{ }} msgsrv gone(int m) {{ }} }}
main {{ Branch b(guest, other):(); Guest guest():(); Other other():(); }}
"""
_REPLY = "((Guest)sender).sold(1);"


def _found(**parts: str) -> list[str]:
    given = {"interface": "", "server": "", "below": "", "body": _REPLY, **parts}
    text = _MODEL.format(**given).replace("reactiveclass Base(3) implements Asked { }\n", "")
    model = parse_model(Source("m.rebeca", text)).model
    analysis = analyse(model)
    found = [d for d in analysis.diagnostics if d.code.startswith("RS4")]
    found += [] if found else list(limits(model, analysis, Config(), "m"))
    odd = [d for d in found if d.code in ("RS427", "RS711")]
    return [f"{text[d.span.start : d.span.end]}: {d.code} {d.message}" for d in odd]


@pytest.mark.parametrize(
    ("parts", "wanted"),
    [
        ({"server": "@Service(sold)"}, None),
        ({"server": "@Service(sold) @Port"}, None),
        (
            {"server": "@Service(gone)"},
            '@Service(gone): RS711 "Shop" sends no "gone" to its sender, nor to whom a variable '
            "holds",
        ),
        (
            {"server": "@Service(sold)", "body": "guest.sold(1);", "below": "@priority(1)"},
            None,  # those below reply
        ),
        (
            {"server": "@Service(sold)", "body": _REPLY + " ((Other)sender).sold(true);"},
            '@Service(sold): RS711 "sold" is not one reply: "Guest.sold" and "Other.sold" have '
            "messages of their own",
        ),
        (
            {"below": "@Service(sold)"},
            '@Service(sold): RS711 "buy" of "Branch" is not where its service is offered',
        ),
        (
            {"interface": "@Service(sold)"},
            '@Service(sold): RS711 "ask" of "Asked" is not where its service is offered',
        ),
        ({"server": "@Service"}, "@Service: RS427 @Service takes the name of the reply"),
        (
            {"server": "@Service(sold, gone)"},
            "@Service(sold, gone): RS427 @Service takes the name of the reply",
        ),
        (
            {"server": "@Sensor @Service(sold)"},
            "@Service(sold): RS427 @Service and @Sensor exclude each other",
        ),
        ({"server": "@Action(sold) @Port"}, None),
        (
            {"server": "@Action(gone)"},
            '@Action(gone): RS711 "Shop" sends no "gone" to its sender, nor to whom a variable '
            "holds",
        ),
        (
            {"server": "@Action(sold, gone)"},
            '@Action(sold, gone): RS711 "Shop" sends no "gone" to its sender, nor to whom a '
            "variable holds",
        ),
        (
            {"server": "@Action(sold, sold)"},
            '@Action(sold, sold): RS711 "sold" is the reply, and so no feedback',
        ),
        (
            {"below": "@Action(sold)"},
            '@Action(sold): RS711 "buy" of "Branch" is not where its action is offered',
        ),
        (
            {"server": "@Action"},
            "@Action: RS427 @Action takes the name of the reply, and of the feedback",
        ),
        (
            {"server": "@Action(sold, gone, more)"},
            "@Action(sold, gone, more): RS427 @Action takes the name of the reply, and of the "
            "feedback",
        ),
        (
            {"server": "@Service(sold) @Action(sold)"},
            "@Action(sold): RS427 @Action and @Service exclude each other",
        ),
        (
            {"server": "@Service(sold) @Service(sold)"},
            "@Service(sold): RS427 @Service stands here twice",
        ),
    ],
)
def test_services_that_no_package_can_offer(parts: dict[str, str], wanted: str | None) -> None:
    assert _found(**parts) == ([] if wanted is None else [wanted])


def test_who_never_asks_for_the_sender_cannot_answer() -> None:
    text = (
        "reactiveclass A(3) { knownrebecs { B b; } statevars { B last; }\n"
        "  @Service(told) msgsrv ask() { last.told(); }\n"
        "  msgsrv other() { last = (B)sender; } }\n"
        "reactiveclass B(3) { msgsrv told() { } }\n"
        "main { A a(b):(); B b():(); }\n"
    )
    model = parse_model(Source("m.rebeca", text)).model
    (found,) = (d for d in limits(model, analyse(model), Config(), "m") if d.code == "RS711")
    assert found.message == '"ask" does not ask who its sender is, so nobody can be answered'


def test_fields_are_those_of_both_messages() -> None:
    text = (
        "reactiveclass A(3) { knownrebecs { B b; }\n"
        "  @Service(told) msgsrv ask(int answered, byte[2] of) {\n"
        "    ((B)sender).told(true, answered); } }\n"
        "reactiveclass B(3) { msgsrv told(boolean answered, int sender) { } }\n"
        "main { A a(b):(); B b():(); }\n"
    )
    files = generated(text, "m")
    assert files["srv/AAskCall.srv"] == (
        "int32 answered_2\nint8[2] of\n---\nbool answered\nbool answered_2\nint32 sender_2\n"
    )


def test_an_action_has_goals_results_and_feedback() -> None:
    text = (
        "reactiveclass A(3) { knownrebecs { B b; }\n"
        "  @Action(told, seen) msgsrv ask(int timing, byte[2] of) {\n"
        "    ((B)sender).seen(1.5); ((B)sender).told(true, timing); } }\n"
        "reactiveclass B(3) { msgsrv told(boolean answered, int sender) { }\n"
        "  msgsrv seen(double share) { } }\n"
        "main { A a(b):(); B b():(); }\n"
    )
    files = generated(text, "m")
    assert files["action/AAskTask.action"] == (
        "int32 timing_2\nint8[2] of\n---\nbool answered_2\nint32 sender_2\n---\nfloat64 share\n"
    )
