"""What ROS 2 asks of names, beyond what other tests of generation look at."""

from __future__ import annotations

import re

from rebsync.config import Config
from rebsync.names import header_stem
from tests.forward.compiling import generated

_CONFIG = Config(target="ros2-cpp")
_FIELD = re.compile(r"(?!.*__)(?!.*_$)[a-z][a-z0-9_]*\Z")
_MODEL = """
reactiveclass AB(3) { statevars { int _odd; int camelCase; } AB() { self.go(1); }
  msgsrv go(int None) { camelCase = None; } }
reactiveclass Ab(3) { Ab() { self.go(1); } msgsrv go(int x) { } }
main { AB on():(); Ab b():(); }
"""


def test_no_two_message_types_have_one_header() -> None:
    files = generated(_MODEL, "twins", _CONFIG)
    types = [path[4:-4] for path in files if path.startswith("msg/")]
    assert len({header_stem(t) for t in types}) == len(types)
    assert {"ABGo", "AbGo2", "ABState", "AbState2"} <= set(types)


def test_fields_are_as_rosidl_asks() -> None:
    files = generated(_MODEL, "twins", _CONFIG)
    lines = [
        line for path, text in files.items() if path.endswith(".msg") for line in text.split("\n")
    ]
    assert [line for line in lines if line and not _FIELD.match(line.split()[1])] == []


def test_names_that_launch_would_take_for_truth_values_are_typed() -> None:
    text = generated(_MODEL, "twins", _CONFIG)["launch/twins.launch.py"]
    assert '"mailbox.rebecs": ParameterValue(["on", "b"], value_type=list[str])' in text
    assert "from launch_ros.parameter_descriptions import ParameterValue" in text


def test_header_names() -> None:
    names = {"HTTPState": "http_state", "R1MoveForward": "r1_move_forward", "Go": "go"}
    assert {name: header_stem(name) for name in names} == names
