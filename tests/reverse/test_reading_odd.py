"""Code that nobody wrote by hand: it is read or listed, in a moment, and nothing breaks."""

from __future__ import annotations

from time import process_time

import pytest

from rebsync.reverse.files.relevance import relevant
from rebsync.reverse.findings import Grade
from rebsync.reverse.recovery import extract
from rebsync.reverse.syntax.cpp_tree import parse, text_of
from rebsync.reverse.syntax.unparsed import unparsed
from rebsync.source import Source

NODE = """\
#include <ros/ros.h>
#include <std_msgs/Int32.h>
class Node {{
 public:
  Node() {{ sub_ = nh_.subscribe("in", 1, &Node::take, this); }}
  void take(const std_msgs::Int32::ConstPtr& msg) {{
    count_ = 1;
    {statement}
    count_ = msg->data;
  }}
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  int count_ = 0;
}};
int main(int argc, char** argv) {{ ros::init(argc, argv, "node"); Node node; ros::spin(); }}
"""
N = 3000
DEEP = {
    "brackets": f"count_ = {'(' * N}1{')' * N};",
    "braces": "{" * N + "}" * N,
    "sums": f"count_ = 1{' + 1' * N};",
    "signs": f"count_ = {'- ' * N}1;",
    "branches": "if (count_ == 0) { }" + " else if (count_ == 1) { }" * N,
    "alternatives": f"count_ = {'count_ == 1 ? 2 : ' * N}3;",
    "conditions without braces": "if (count_) " * N + ";",
    "calls of calls": f"f(){'()' * N};",
    "assignments": "count_ = " * N + "1;",
    "lambdas": "auto f = " + "[&]() { return " * N + "1" + "; }" * N + ";",
    "output": f"std::cout{' << 1' * N};",
}


@pytest.mark.parametrize("name", DEEP)
def test_what_nests_too_deep_is_listed_and_the_rest_is_read(name: str) -> None:
    source = Source("n.cpp", NODE.format(statement=DEEP[name]))
    deep = [f for f in unparsed(parse(source)) if "deeper" in f.why]
    assert [(source.position(f.span.start).line, f.grade) for f in deep] == [(8, Grade.UNREADABLE)]
    found = extract({"n.cpp": source})
    assert any("deeper" in f.why for f in found.findings)
    assert [c.name for c in found.model.classes] == ["Node"]


def test_what_people_nest_is_read() -> None:
    statement = f"count_ = {'(' * 40}1{' + 1' * 80}{')' * 40};"
    assert parse(Source("n.cpp", NODE.format(statement=statement))).deep == ()


def test_places_stay_where_something_is_taken_out() -> None:
    statement = f"/* \u00e9 */ count_ = {'(' * N}1{')' * N}; last();"
    source = Source("n.cpp", NODE.format(statement=statement))
    cpp = parse(source)
    (start, end), *others = cpp.deep
    assert not others
    assert source.slice(cpp.characters(start, end)).startswith("count_ = (((")
    call = cpp.root.descendant_for_byte_range(end + 1, end + 2)
    assert call is not None
    assert source.slice(cpp.span(call)) == text_of(call) == "last"


ODD = {
    "one line": "int f() { " + "x = x + 1; y(x);" * 3000 + "}",
    "one name": "a" * 300_000,
    "a text that does not end": 'auto x = "' + "a " * 50_000,
    "a comment that does not end": "/*" * 50_000,
    "quotes": "\n#if 0\n" + '"\\' * 50_000,
    "brackets that do not end": "(" * 50_000,
    "braces that do not end": "int f() " + "{" * 20_000,
    "comments": "// x\n" * 20_000 + "void f() {}",
    "a table": "int t[] = {" + "1, " * 50_000 + "};",
    "templates": "a<b>c " * 10_000,
    "less than": "<" * 30_000,
    "words": "typedef " * 3000 + "enum " * 3000 + "static x " * 3000,
    "capitals": "\n" + "A_" * 50_000 + " \n" + "A_B " * 10_000,
    "spaces": "\n#if" + " " * 50_000 + "\n#define " + " " * 50_000,
    "inner conditionals": "\n" + "#ifdef A\n" * 1000 + "int x;\n" + "#endif\n" * 1000,
    "conditionals that do not end": "\n" + "#if 0\n" * 3000,
    "hashes": "\n#if A\n" + " " * 50_000 + "#" * 50_000 + "\n#endif",
    "stars": "\n#if A\n/*" + "**x" * 30_000,
    "alternatives": "\n#if A\n" + "#elif B\nint x;\n" * 2000 + "#endif",
    "a long condition": f"\n#if {'(' * 3000}1{')' * 3000}\n#endif",
    "functions": "".join(f"void f{i}(int a) {{ f{i + 1}(a - 1); }}\n" for i in range(1500)),
    "bases in a circle": "class A : B { ros::Timer t; }; class B : A { Mailbox m; };",
}


@pytest.mark.parametrize("name", ODD)
def test_odd_code_takes_a_moment(name: str) -> None:
    text = f"#include <ros/ros.h>\n{ODD[name]}\n"
    started = process_time()
    extract({"n.cpp": Source("n.cpp", text)})
    relevant({"a.cpp": b'#include "b.h"\nros::init();', "b.h": ODD[name].encode() * 2})
    assert process_time() - started < 20


def test_abstract_classes_of_people_are_no_interfaces() -> None:
    queue = "class Queue {\n public:\n  virtual ~Queue() {}\n  virtual void call(int x) = 0;\n};\n"
    assert extract({"queue.h": Source("queue.h", queue)}).model.classes == ()
    assert (
        len(
            extract(
                {"queue.cpp": Source("queue.cpp", queue + NODE.format(statement=""))}
            ).model.classes
        )
        == 1
    )
    marked = f"// rebsync: interface Queue\n{queue}"
    assert len(extract({"queue.h": Source("queue.h", marked)}).model.classes) == 1


@pytest.mark.parametrize(
    "body", ["{ {} }", "{\n  {\n    {}\n  }\n}", "{ {} {} }", "{ { {} }\n ++x[0]; }"]
)
def test_nothing_is_missing_in_a_body_of_empty_blocks(body: str) -> None:
    assert list(unparsed(parse(Source("a.cpp", f"void A::f() {body}\nvoid g() {{}}\n")))) == []


def test_a_constant_that_no_integer_holds_takes_no_time() -> None:
    enum = "enum { A = 1 << 31, B = 1 << 99, C = 1 << 2147483648, D = 7 / 0, E = A * A };\n"
    text = enum + NODE.format(statement="count_ = B;")
    start = process_time()
    extract({"n.cpp": Source("n.cpp", text)})
    assert process_time() - start < 10


@pytest.mark.parametrize(
    "statement",
    [
        "~Node();",
        "operator bool();",
        "explicit Node(int a = 1, double b = 2);",
        "for (const auto& v : b) {} auto&& [b, c] = std::make_tuple(c); count_ = b;",
    ],
)
def test_what_only_the_grammar_takes_for_a_declaration_is_listed(statement: str) -> None:
    source = Source("n.cpp", NODE.format(statement=statement))
    found = extract({"n.cpp": source})
    assert 8 in [source.position(f.span.start).line for f in found.findings]


def test_a_member_of_a_type_of_the_global_namespace_is_read() -> None:
    code = NODE.format(statement="").replace(
        "int count_ = 0;", "::pair<int, int> p_; int count_ = 0;"
    )
    found = extract({"n.cpp": Source("n.cpp", code)})
    assert [c.name for c in found.model.classes] == ["Node"]
