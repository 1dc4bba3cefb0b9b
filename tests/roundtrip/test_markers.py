"""Markers name elements; user blocks survive; digests do not see layout."""

from __future__ import annotations

from rebsync.roundtrip.package.markers import elements, user_blocks, with_user_blocks

SOURCE = """\
// rebsync: msgsrv Robot.go
// rebsync: annotation @priority(1)
void Robot::go(int32_t x) {
  if (x > 1) {
    stop();
  }
}

// rebsync: msgsrv Robot.stop
void Robot::stop() {}

class Robot {
  int32_t x_{};  // rebsync: statevar Robot.x
  bool on_{};    // rebsync: statevar Robot.on
};
"""


def test_each_marker_holds_its_element() -> None:
    found = {e.name: e.text for e in elements(SOURCE)}
    assert list(found) == [
        "msgsrv Robot.go",
        "msgsrv Robot.stop",
        "statevar Robot.x",
        "statevar Robot.on",
    ]
    assert found["msgsrv Robot.go"].endswith("    stop();\n  }\n}")
    assert found["msgsrv Robot.stop"] == "void Robot::stop() {}"
    assert found["statevar Robot.x"] == "int32_t x_{};"


def test_digests_see_tokens_only() -> None:
    digests = {e.name: e.digest for e in elements(SOURCE)}
    laid_out = SOURCE.replace("if (x > 1) {", "// why\n  if (x>1)\n  {")
    assert {e.name: e.digest for e in elements(laid_out)} == digests
    edited = {e.name: e.digest for e in elements(SOURCE.replace("x > 1", "x > 2"))}
    assert [n for n in digests if digests[n] != edited[n]] == ["msgsrv Robot.go"]


def test_launch_files_and_yaml_have_markers_too() -> None:
    text = """\
  <!-- rebsync: rebec robot1 -->
  <node name="robot1">
    <param name="x" value="1"/>
  </node>
  # rebsync: env e
"""
    found = {e.name: e.text for e in elements(text)}
    assert found["rebec robot1"].endswith("</node>")


USER = "a\n// rebsync: user R.sensors\n{}// rebsync: end\nz\n"


def test_user_code_is_put_back_byte_for_byte() -> None:
    edited = USER.format("  mine(\\1) \t\n\n// even this\n")
    fresh = USER.format("generated\n")
    blocks = user_blocks(edited)
    assert blocks == {"R.sensors": "  mine(\\1) \t\n\n// even this\n"}
    assert with_user_blocks(fresh, blocks) == edited
    assert with_user_blocks(fresh, {}) == fresh
    assert with_user_blocks(edited, user_blocks(edited)) == edited
