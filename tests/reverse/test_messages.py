"""Message files: fields, constants, comments; malformed lines are told, the others are read."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.reverse.build.messages import full_type, plain_type, read_message
from rebsync.source import Source

_TEXT = """# The state of a robot.
# Published often.
Header header
int32 id          # who
bool[3] wanted

float64[] data
Own[2] others
geometry_msgs/Twist twist

byte OK=0   # fine
string NAME = a # b
int8 _LOW=-1
Header[] headers
float32 HALF=.5
bool YES=True
"""


def test_a_message() -> None:
    found = read_message(Source("State.msg", _TEXT), "pkg", "State")
    assert found.full_name == "pkg/State"
    assert [(f.type, f.name, f.length) for f in found.fields] == [
        ("std_msgs/Header", "header", None),
        ("int32", "id", None),
        ("bool", "wanted", 3),
        ("float64", "data", 0),
        ("pkg/Own", "others", 2),
        ("geometry_msgs/Twist", "twist", None),
        ("pkg/Header", "headers", 0),
    ]
    assert [(c.type, c.name, c.value) for c in found.constants] == [
        ("byte", "OK", 0),
        ("string", "NAME", "a # b"),
        ("int8", "_LOW", -1),
        ("float32", "HALF", 0.5),
        ("bool", "YES", True),
    ]
    assert found.fields[0].comments == ("The state of a robot.", "Published often.")
    assert found.fields[1].comments == ("who",)
    assert [c.comments for c in found.constants] == [("fine",), (), (), (), ()]
    assert [found.source.slice(f.span) for f in found.fields[:2]] == ["Header header", "int32 id"]
    assert found.field("id") is found.fields[1]
    assert not found.unknowns


def test_types() -> None:
    assert [full_type(t, "p") for t in ("Header", "string", "time", "X", "q/X")] == [
        *("std_msgs/Header", "string", "time", "p/X", "q/X")
    ]
    assert [plain_type(t) for t in ("byte", "char", "int8")] == ["int8", "uint8", "int8"]


@pytest.mark.parametrize(
    "line",
    [
        "int32",
        "int32 a b",
        "int32 1a",
        "int32[-1] a",
        "int32[0] a",
        "int32[2][3] a",
        "string<=5 s",
        "int32 d 5",
        "int32\ta",
        "1nt a",
        "a//b c",
        "int8 BIG=128",
        "uint8 LOW=-1",
        "int32 X=y",
        "time T=1",
        "int32 =1",
        "X A=1",
        "bool B=f()",
        "int32 id",
    ],
)
def test_a_malformed_line_is_told(line: str) -> None:
    found = read_message(Source("M.msg", f"int32 id\n  {line}  # why\nbool last\n"), "p", "M")
    assert [f.name for f in found.fields] == ["id", "last"]
    (unknown,) = found.unknowns
    assert found.source.slice(unknown.span) == line
    assert unknown.what == f"`{line}`"


def test_line_ends_of_windows() -> None:
    found = read_message(Source("M.msg", "int32 a # x\r\nint32 b\r\n"), "p", "M")
    assert [(f.name, f.comments) for f in found.fields] == [("a", ("x",)), ("b", ())]


@given(st.text() | st.text("int32 string=#[]/a\n\t'"))
def test_any_text_is_read(text: str) -> None:
    found = read_message(Source("M.msg", text), "p", "M")
    lines = [(f.name, f.span) for f in found.fields]
    lines += [(c.name, c.span) for c in found.constants]
    assert all(name in found.source.slice(span) for name, span in lines)
