"""package.xml, in the three formats."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.package import Maintainer
from rebsync.reverse.build.manifests import read_manifest
from rebsync.source import Source

_PARTS = """
  <name>patrol</name>
  <version>1.2.0</version>
  <description>
    Robots &amp; <b>their</b>
    patrols.
  </description>
  <maintainer email="a@b.c">Ann</maintainer>
  <maintainer email="d@e.f">Dan &lt;x&gt;</maintainer>
  <license>BSD</license>
"""


@pytest.mark.parametrize(
    ("head", "depends", "number"),
    [
        ("<package>", "<build_depend>roscpp</build_depend><run_depend>roscpp</run_depend>", 1),
        ('<package format="2">', "<depend>roscpp</depend>", 2),
        ('<package format="3">', '<depend condition="$ROS_VERSION == 1">roscpp</depend>', 3),
    ],
)
def test_a_manifest(head: str, depends: str, number: int) -> None:
    text = f'<?xml version="1.0"?>\n{head}{_PARTS}<license>MIT</license>{depends}</package>\n'
    found = read_manifest(Source("package.xml", text))
    assert (found.name, found.version, found.format) == ("patrol", "1.2.0", number)
    assert found.license == "BSD, MIT"
    assert found.maintainers == (Maintainer("Ann", "a@b.c"), Maintainer("Dan <x>", "d@e.f"))
    assert found.depends == ("roscpp",)
    assert not found.unknowns
    assert found.description is not None
    assert set(found.description.split()) == {"Robots", "&", "their", "patrols."}


def test_what_is_missing_is_told() -> None:
    found = read_manifest(Source("package.xml", '<package format="9"><name/></package>'))
    assert (found.name, found.version, found.maintainers) == (None, None, ())
    assert [u.why for u in found.unknowns] == [
        "the format `9` is not known",
        *(f"it has no <{n}>" for n in ("name", "version", "description", "license", "maintainer")),
    ]


@given(st.text() | st.text('<>package/= "&;!-').map(lambda t: f"<package>{t}</package>"))
def test_any_text_is_read(text: str) -> None:
    found = read_manifest(Source("package.xml", text))
    assert found.unknowns
