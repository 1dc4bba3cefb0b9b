"""What the parser is given, and what is listed because it cannot be read as it is compiled."""

from __future__ import annotations

import pytest

from rebsync.reverse.findings import Grade
from rebsync.reverse.syntax.cpp_conditions import blank, conditionals
from rebsync.reverse.syntax.cpp_text import readable
from rebsync.reverse.syntax.cpp_tree import parse, text_of
from rebsync.reverse.syntax.cpp_words import Plain
from rebsync.reverse.syntax.unparsed import unparsed
from rebsync.source import Source

# `~` stands for a blank that was made.
MENDED = [
    ("class FOO_EXPORT Foo : public Bar {};", "class ~~~~~~~~~~ Foo : public Bar {};"),
    ("struct FOO Foo {};", "struct ~~~ Foo {};"),
    ("class FOO foo;", "class FOO foo;"),
    ("\nFOO_DEPRECATED const char* f();", "\n~~~~~~~~~~~~~~ const char* f();"),
    ("\n  FOO_BAR + const_value;", "\n  FOO_BAR + const_value;"),
    ("#define FOO_BAR const int", "#define FOO_BAR const int"),
    ("__global__ void f(); f<<<a, b>>>(c);", "~~~~~~~~~~ void f(); f~~~~~~~~~~(c);"),
    ("class A { Q_OBJECT\npublic slots:\n f();", "class A { ~~~~~~~~\npublic ~~~~~:\n f();"),
    ("\nprivate Q_SLOTS:\n", "\nprivate ~~~~~~~:\n"),
    ("\n emit changed(3);\n", "\n ~~~~ changed(3);\n"),
    ("\n emit = 3; signals(a);\n", "\n emit = 3; signals(a);\n"),
    ("connect(SIGNAL(a(bool)), SLOT(b()));", "connect(SIGNAL(~~~~~~~), SLOT(~~~));"),
    ("#if 0\nf();\n#endif\n", "~~~~~\n~~~~\n~~~~~~\n"),
    ("#if 1\nf();\n#else\ng();\n#endif\n", "~~~~~\nf();\n~~~~~\n~~~~\n~~~~~~\n"),
    ("#ifdef _WIN32\nf();\n#endif\n", "~~~~~~~~~~~~~\n~~~~\n~~~~~~\n"),
    ("#ifdef X\nf();\n#endif\n", "#ifdef X\nf();\n#endif\n"),
    ("#ifdef X\nif (a) {\n#else\n{\n#endif\n}", "~~~~~~~~\n~~~~~~~~\n~~~~~\n{\n~~~~~~\n}"),
    ("#ifdef X\nif (a) {\n#endif\n}", "~~~~~~~~\n~~~~~~~~\n~~~~~~\n}"),
    ("#ifndef X\nif (a) {\n#endif\n}", "~~~~~~~~~\nif (a) {\n~~~~~~\n}"),
    ("/*\n#if 0\n*/ f();\n#endif\n", "/*\n#if 0\n*/ f();\n#endif\n"),
    ("#if 0 // it's \"odd\n#endif\r\n", "~~~~~~~~~~~~~~~~~~\n~~~~~~\r\n"),
    ("#ifndef A_H\n#define A_H\nint x;\n#endif", "#ifndef A_H\n#define A_H\nint x;\n#endif"),
]


@pytest.mark.parametrize(("text", "wanted"), MENDED)
def test_places_stay(text: str, wanted: str) -> None:
    assert readable(text, Plain(text.encode())) == wanted.replace("~", " ")


def test_signals_are_public() -> None:
    text = "class A {\n signals:\n void f(); };"
    assert readable(text, Plain(text.encode())) == "class A {\n public :\n void f(); };"


@pytest.mark.parametrize(
    ("before", "condition", "taken"),
    [
        ("", "if 0", False),
        ("", "if 0x10 && !0", True),
        ("", "if true", True),
        ("", "ifdef __linux__", True),
        ("", "ifndef _WIN32", True),
        ("", "if defined(_MSC_VER) || defined __APPLE__", False),
        ("", "if defined(FOO)", None),
        ("", "if defined(FOO) && 0", False),
        ("", "if defined(FOO) || 1", True),
        ("", "if __cplusplus >= 201103L", True),
        ("", "if __cplusplus > 201402", None),
        ("", "if __cplusplus < 201402", False),
        ("", "if ROS_VERSION_MINIMUM(1, 14, 0)", True),
        ("", "if ROS_VERSION_MINIMUM(2, 0, 0)", False),
        ("", "if PCL_VERSION_COMPARE(>=, 1, 8, 0)", None),
        ("", "if FOO > 1", None),
        ("", "if (1", None),
        ("", "if ", None),
        ("", "if ((1 < 2) == 1) && \\\n !defined(WIN32)", True),
        ("#define FOO 2", "if FOO > 1", True),
        ("#define FOO", "ifdef FOO", True),
        ("#define FOO 2\n#undef FOO", "ifdef FOO", False),
        ("#ifdef BAR\n#define FOO\n#endif", "ifdef FOO", None),
        ("#ifdef _WIN32\n#define FOO\n#endif", "ifdef FOO", None),
    ],
)
def test_conditions(before: str, condition: str, taken: bool | None) -> None:
    found = conditionals(blank(f"{before}\n#{condition}\nf();\n#endif\n"))
    assert found[-1].branches[0].taken is taken


def test_alternatives_exclude_each_other() -> None:
    text = "#if FOO\n#elif 1\n#elif BAR\n#else\n#endif\n#if 0\n#elif FOO\n#else\n#endif\n"
    taken = [[b.taken for b in c.branches] for c in conditionals(text)]
    assert taken == [[None, None, False, False], [False, None, None]]


LISTED = [
    ("int f() { return 1; }", []),
    ("int f( {", [(1, Grade.UNREADABLE)]),
    ("int x = = 3;\nvoid f() { g(; }", [(1, Grade.UNREADABLE), (2, Grade.UNREADABLE)]),
    ("PLUGINLIB_EXPORT_CLASS(a::B, c::D)", []),
    ("template class Ring<int>;", []),
    ("#if 0\nint f( {\n#endif", []),
    ("#ifdef X\n#include <a>\n#endif", []),
    ("#ifdef X\nvoid f() {}\n#else\nvoid f() { g(); }\n#endif", [(1, Grade.ASSUMED)]),
    ("void f() {\n#ifdef X\ng();\n#endif\n}", []),
    ("void f() {\n#ifdef X\nn.subscribe(1);\n#endif\n}", [(2, Grade.ASSUMED)]),
    ("void f() {\n#ifdef X\nif (x) {\n#else\n{\n#endif\ng();\n}\n}", [(2, Grade.UNREADABLE)]),
    ("#if 0\n#ifdef X\nint x;\n#endif\n#endif", []),
    ("// \u00e9\u00e9\nvoid f() {\n#ifdef X\ng();\n#endif\n}", []),
]


@pytest.mark.parametrize(("text", "wanted"), LISTED)
def test_what_is_listed(text: str, wanted: list[tuple[int, Grade]]) -> None:
    cpp = parse(Source("a.cpp", text))
    found = [(cpp.source.position(f.span.start).line, f.grade) for f in unparsed(cpp)]
    assert sorted(found, key=lambda f: f[0]) == wanted


def test_an_alternative_that_is_dropped_is_not_in_the_tree() -> None:
    cpp = parse(Source("a.cpp", "int f() {\n#if 0\nreturn 1;\n#else\nreturn 2;\n#endif\n}\n"))
    (function,) = cpp.root.named_children
    assert [text_of(s) for s in function.named_children[-1].named_children] == ["return 2;"]
