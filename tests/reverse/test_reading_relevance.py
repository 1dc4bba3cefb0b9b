"""Which files can matter: too many now and then, never too few."""

from __future__ import annotations

import pytest

from rebsync.reverse.files import relevance
from rebsync.reverse.files.relevance import relevant

NODE = b'#include "node.h"\nvoid Node::f() { ros::spin(); gain(2); }\n'
CASES: dict[str, tuple[dict[str, bytes], set[str]]] = {
    "what speaks to ROS": ({"a.cpp": b"ros::init();", "b.cpp": b"int x;"}, {"a.cpp"}),
    "what is included, and what that includes": (
        {
            "a.cpp": b'#include "pack/b.h"\nros::init();',
            "include/pack/b.h": b"#include <pack/c.hpp>",
            "include/pack/c.hpp": b"struct C {};",
            "d.h": b"struct D {};",
        },
        {"a.cpp", "include/pack/b.h", "include/pack/c.hpp"},
    ),
    "the sources of a header that is included": (
        {"a.cpp": b'#include "b.h"\nros::init();', "b.h": b"int f();", "b.cpp": b'#include "b.h"'},
        {"a.cpp", "b.h", "b.cpp"},
    ),
    "a program of nothing but a class that speaks to ROS": (
        {"node.h": b"class Node { ros::NodeHandle n; };", "main.cpp": b'#include "node.h"\n'},
        {"node.h", "main.cpp"},
    ),
    "what declares for itself what others define": (
        {"a.cpp": b"ros::init();", "b.cpp": b"extern int f();", "c.cpp": b"int g;"},
        {"a.cpp", "b.cpp"},
    ),
    "nothing": ({"a.cpp": b"int x;"}, set()),
}
# Ties by includes are not enough here: names decide.
NAMED: dict[str, tuple[dict[str, bytes], set[str]]] = {
    "a class that is used, and where it is defined": (
        {
            "node.cpp": b'#include "all.h"\nros::Timer t; Filter f;',
            "all.h": b'#include "filter.h"\n#include "other.h"\n',
            "filter.h": b"class PACK_EXPORT Filter { double g(); };",
            "filter.cpp": b'#include "filter.h"\ndouble Filter::g() { return 1; }',
            "other.h": b"class Other { double h(); };",
            "other.cpp": b'#include "other.h"\ndouble Other::h() { return 1; }',
        },
        {"node.cpp", "filter.h", "filter.cpp"},
    ),
    "macros, constants, enumerators, aliases, functions": (
        {
            "node.cpp": b'#include "all.h"\nros::Rate(RATE * kGain + SLOW); Alias a; help(Old{});',
            "all.h": b"".join(b'#include "%d.h"\n' % n for n in range(1, 9)),
            "1.h": b"#define RATE 10",
            "2.h": b"static const double kGain = 3.0;",
            "3.h": b"enum Speed { FAST, SLOW = 2 };",
            "4.h": b"using Alias = int;",
            "5.h": b"inline std::string help(int) {}",
            "6.h": b"typedef std::vector<int> Old;",
            "7.h": b"template <class T> struct Unused { T help_; };",
            "8.h": b'/* RATE */ // SLOW\nconst char* text = "help()"; int x = y.help();',
        },
        {"node.cpp", "1.h", "2.h", "3.h", "4.h", "5.h", "6.h"},
    ),
    "what uses a class that speaks to ROS": (
        {
            "node.h": b'#include "all.h"\nclass Node { ros::Timer t; };',
            "all.h": b"",
            "main.cpp": b'#include "node.h"\nint main() { Node n; }',
            "start.cpp": b'#include "node.h"\nvoid start(int x) { Node n(x); }',
            "calls.cpp": b'#include "all.h"\nint go() { start(3); }',
            "apart.cpp": b'#include "all.h"\nint stay() { return 3; }',
        },
        {"node.h", "main.cpp", "start.cpp", "calls.cpp"},
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_ties(name: str) -> None:
    code, wanted = CASES[name]
    assert relevant(code) == wanted


@pytest.mark.parametrize("name", NAMED)
def test_names(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    code, wanted = NAMED[name]
    assert relevant(code) == code.keys()
    monkeypatch.setattr(relevance, "_MUCH", 0)
    code = {**code, "much.cpp": b'#include "all.h"\n' + b"int much;" * 100}
    assert relevant(code) == wanted


def test_the_file_that_is_asked_for_matters() -> None:
    assert relevant({"a.cpp": b"int x;", "b.cpp": b"int y;"}, "b.cpp") == {"b.cpp"}
