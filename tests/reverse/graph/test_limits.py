"""Code that goes on and on: values that are too far away are unknown, and soon."""

from __future__ import annotations

from time import process_time

import pytest

from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.graph import FromParameter, OneOf, PublisherFact, RateFact, Unresolved
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source

_LONG = 400
_MAIN = "int main() { ros::NodeHandle n; "
_ASK = "n.advertise<std_msgs::Bool>(s, 1);"


def _each(piece: str, count: int = _LONG) -> str:
    return "\n".join(
        piece.replace("$1", str(i - 1)).replace("$2", str(i + 1)).replace("$", str(i))
        for i in range(1, count)
    )


CASES = {
    "variables": _MAIN
    + 'std::string s0 = "x";'
    + _each("std::string s$ = s$1;")
    + f"std::string s = s{_LONG - 1};{_ASK}}}",
    "sums": _MAIN + 'std::string s = "x";' + _each('s = s + "$";') + _ASK + "}",
    "branches": _MAIN + "std::string s;" + _each('if (c$) s = "$";') + _ASK + "}",
    "conditions": _MAIN + 'std::string s = "1";' + _each('if (s == "$") s = "$2";') + _ASK + "}",
    "functions": 'std::string f0() { return "x"; }'
    + _each("std::string f$() { return f$1(); }")
    + f"{_MAIN} std::string s = f{_LONG - 1}(); {_ASK} }}",
    "references": "void f0(std::string& s) { std::cin >> s; }"
    + _each("void f$(std::string& s) { f$1(s); }")
    + f"{_MAIN} std::string s; f{_LONG - 1}(s); {_ASK} }}",
    "callers": f"void f0(ros::NodeHandle n, std::string s) {{ {_ASK} }}"
    + _each("void f$(ros::NodeHandle n, std::string s) { f$1(n, s); }")
    + f'{_MAIN} f{_LONG - 1}(n, "x"); }}',
    "many callers": f"void f(ros::NodeHandle n, std::string s) {{ {_ASK} }}{_MAIN}"
    + _each('f(n, "$");')
    + "}",
}


@pytest.mark.parametrize("case", CASES)
def test_what_is_too_far_away_is_unknown(case: str) -> None:
    code = Code.of([parse(Source("a.cpp", CASES[case]))])
    found = [f for f in Asking(code).graph.facts if isinstance(f, PublisherFact)]
    assert [type(f.topic) for f in found] == [Unresolved]


_STAGES = 30
_SECONDS = 10  # of the processor: each takes a tenth of one, and twice as many stages not much more
_RATE = "ros::Rate r(x); }"
# Code whose values are twice as large, or are asked for twice as often, with each stage.
GROWING = {
    "defaults": "int main() { ros::NodeHandle n; int x0 = 1;"
    + _each('int x$; if (c) n.param("a$", x$, x$1); else n.param("b$", x$, x$1);', _STAGES)
    + f"int x = x{_STAGES - 1}; {_RATE}",
    "values before": "int main() { ros::NodeHandle n; int x = 1;"
    + _each('if (c) n.getParam("a$", x); else n.getParam("b$", x);', _STAGES)
    + _RATE,
    "functions": "struct C { ros::NodeHandle n; int x;"
    + _each('void f$() { n.getParam("a$", x); }', _STAGES)
    + f"void g() {{ {_RATE} }};",
    "texts": "int main() { std::string s;"
    + _each('if (c) s = s + "a"; else s = s + "b";', _STAGES)
    + f"ros::NodeHandle n; {_ASK} ros::Rate r(s.size()); }}",
    "one text": 'int main() { std::string s0 = "ab";'
    + _each("std::string s$ = s$1 + s$1;", _STAGES)
    + f"ros::Rate r(s{_STAGES - 1}.size()); }}",
    "one number": "int main() { int x0 = 3;"
    + _each("int x$ = x$1 * x$1;", _STAGES)
    + f"int x = x{_STAGES - 1}; {_RATE}",
}


@pytest.mark.parametrize("case", GROWING)
def test_what_doubles_with_each_stage_takes_no_longer(case: str) -> None:
    before = process_time()
    code = Code.of([parse(Source("a.cpp", GROWING[case]))])
    found = [f for f in Asking(code).graph.facts if isinstance(f, RateFact)]
    assert len(found) == 1
    assert process_time() - before < _SECONDS


def test_what_other_functions_read_stands_in_for_a_parameter() -> None:
    text = 'struct C { ros::NodeHandle n; int x = 2; void f() { n.getParam("a", x); }'
    text += f"void g() {{ x = 7; }} void h() {{ {_RATE} }};"
    facts = Asking(Code.of([parse(Source("a.cpp", text))])).graph.facts
    rates = [f.hz for f in facts if isinstance(f, RateFact)]
    assert rates == [OneOf((FromParameter("a", 7), 7))]


def test_many_facts_of_one_function() -> None:
    body = _each('n.param("p$", v$_, $); n.advertise<std_msgs::Bool>("t$", v$_);')
    members = _each("int v$_;")
    text = f"struct C {{ C(ros::NodeHandle n) {{ {body} }} {members} }};"
    text += f"{_MAIN} C c(n); }}"
    found = Asking(Code.of([parse(Source("a.cpp", text))])).graph.facts
    assert len(found) == 2 * (_LONG - 1)
