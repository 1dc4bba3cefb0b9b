"""The real rclpy has no member of a node that a generated class could hide."""

from __future__ import annotations

import json
import subprocess

from rebsync.reserved import PYTHON_FUNCTIONS, PYTHON_MEMBERS
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.workspace import sourced

_MEMBERS = """
import json, rclpy
from rclpy.node import Node
rclpy.init()
node = Node("names")
print(json.dumps(sorted({*dir(node), *vars(node)})))
"""


def test_every_member_of_a_node_gives_way() -> None:
    done = subprocess.run(
        [SYSTEM_PYTHON, "-c", _MEMBERS], env=sourced(), capture_output=True, text=True, check=True
    )
    names = [n for n in json.loads(done.stdout) if not n.startswith(("__", "_Node__"))]
    assert len(names) > 50
    open_ = [n for n in names if n not in PYTHON_FUNCTIONS and n[1:] not in PYTHON_MEMBERS]
    assert open_ == []
