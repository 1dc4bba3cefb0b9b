"""Where a call stands, and where the code keeps what it gives."""

from __future__ import annotations

import pytest

from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.graph import Fact, PublisherFact
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source

_CALL = 'n.advertise<std_msgs::Bool>("x", 1)'


def _fact(text: str) -> Fact:
    code = Code.of([parse(Source("a.cpp", text))])
    (fact,) = (f for f in Asking(code).graph.facts if isinstance(f, PublisherFact))
    return fact


@pytest.mark.parametrize(
    ("statement", "kept"),
    [
        (f"{_CALL};", ""),
        (f"pub_ = {_CALL};", "pub_"),
        (f"this->pub_ = {_CALL};", "this->pub_"),
        (f"pubs_[i] = {_CALL};", "pubs_[i]"),
        (f"pubs_.push_back({_CALL});", "pubs_"),
        (f"ros::Publisher pub = {_CALL};", "pub"),
        (f"ros::Publisher pub({_CALL});", "pub"),
        (f"auto pub = new ros::Publisher({_CALL});", "pub"),
        (f"pub_ = boost::make_shared<ros::Publisher>({_CALL});", "pub_"),
        (f"pub_.reset(new ros::Publisher({_CALL}));", "pub_"),
        (f"pub_ = ready ? {_CALL} : pub_;", "pub_"),
        (f"return {_CALL};", ""),
    ],
)
def test_what_a_call_gives_is_kept(statement: str, kept: str) -> None:
    assert _fact(f"void f(ros::NodeHandle n) {{ {statement} }}").site.kept == kept


def test_constructors_keep_it_in_members() -> None:
    text = f"struct C {{ C(ros::NodeHandle n) : pub_({_CALL}) {{}} ros::Publisher pub_; }};"
    site = _fact(text).site
    assert (site.kept, site.owner) == ("pub_", "C")


@pytest.mark.parametrize(
    ("text", "owner"),
    [
        ("namespace a { void f(ros::NodeHandle n) { $; } }", "f"),
        ("void a::C::f(ros::NodeHandle n) { $; }", "C"),
        ("template <class T> void C<T>::f(ros::NodeHandle n) { $; }", "C"),
        ("struct C { struct D { void f(ros::NodeHandle n) { $; } }; };", "D"),
        ("void f(ros::NodeHandle n) { auto g = [&] { $; }; }", "f"),
        ("ros::NodeHandle n; ros::Publisher p = $;", None),
    ],
)
def test_calls_belong_to_classes_or_functions(text: str, owner: str | None) -> None:
    site = _fact(text.replace("$", _CALL)).site
    assert site.owner == owner


def test_the_place_is_the_name_of_the_called_function() -> None:
    place = _fact("void f(ros::NodeHandle n) {\n  n.\n\n  advertise<A::B>(\n'x', 1);\n}").site.place
    assert (place.line, place.source.slice(place.span)) == (4, "advertise")


@pytest.mark.parametrize("between", ["", " ", "\n\t", "/* of */", " // of\n", "\\\n"])
def test_what_may_stand_between_a_name_and_its_arguments(between: str) -> None:
    call = f'n.advertise{between}<std_msgs::Bool>("x", 1)'
    assert _fact(f"void f(ros::NodeHandle n) {{ {call}; }}").site.owner == "f"
