"""How alike the graphs of a node for ROS 1 and of its counterpart for ROS 2 are.

`python -m tests.reverse.corpus.pairs DIR_A DIR_B` compares two files or folders; with one folder,
the pairs of `PAIRS` whose checkouts are in it.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from rebsync.records import dataclass
from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import is_python
from rebsync.reverse.files.reading import Chosen, packages
from rebsync.reverse.graph_json import graph_data
from rebsync.reverse.python.values.py_calls import graph_with
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse as parse_python
from tests.reverse.corpus.compare import share
from tests.reverse.corpus.generations import Entity, agree, entities
from tests.reverse.corpus.reasons import Sides, reason_of, unlike
from tests.reverse.corpus.values import Json

_TB3 = "turtlebot3_example"
_TB3_1, _TB3_2 = f"turtlebot3-ros1/{_TB3}/nodes", f"turtlebot3/{_TB3}/{_TB3}"
_ROSPY, _DEMO = "ros_tutorials/rospy_tutorials", "demos/demo_nodes_py/demo_nodes_py"
_SIM_1, _SIM_2 = "turtlebot3_simulations-ros1", "turtlebot3_simulations-ros2"
_TOOLS_1, _TOOLS_2 = "teleop_tools-ros1", "teleop_tools-ros2"
# Nodes ported from one generation to the other, counterparts that were written anew, C++.
PORTS = {
    "twist_mux joystick_relay": (
        "twist_mux-ros1/scripts/joystick_relay.py",
        "twist_mux-ros2/scripts/joystick_relay.py",
    ),
    "teleop_tools key_teleop": (f"{_TOOLS_1}/key_teleop", f"{_TOOLS_2}/key_teleop"),
    "teleop_tools mouse_teleop": (f"{_TOOLS_1}/mouse_teleop", f"{_TOOLS_2}/mouse_teleop"),
    "teleop_tools joy_teleop": (
        f"{_TOOLS_1}/joy_teleop/scripts/joy_teleop.py",
        f"{_TOOLS_2}/joy_teleop/joy_teleop/joy_teleop.py",
    ),
    "teleop_tools incrementer": (
        f"{_TOOLS_1}/joy_teleop/scripts/incrementer_server.py",
        f"{_TOOLS_2}/joy_teleop/joy_teleop/incrementer_server.py",
    ),
    "teleop_twist_keyboard": (
        "teleop_twist_keyboard/teleop_twist_keyboard.py",
        "teleop_twist_keyboard-ros2/teleop_twist_keyboard.py",
    ),
    "turtlebot3 teleop": (
        "turtlebot3-ros1/turtlebot3_teleop/nodes/turtlebot3_teleop_key",
        "turtlebot3/turtlebot3_teleop/turtlebot3_teleop/script/teleop_keyboard.py",
    ),
    "turtlebot3 marker": (
        f"{_TB3_1}/turtlebot3_marker_server",
        f"{_TB3_2}/turtlebot3_interactive_marker/turtlebot3_interactive_marker.py",
    ),
    "turtlebot3 obstacle": (
        f"{_TB3_1}/turtlebot3_obstacle",
        f"{_TB3_2}/turtlebot3_obstacle_detection/turtlebot3_obstacle_detection.py",
    ),
    "turtlebot3 point": (
        f"{_TB3_1}/turtlebot3_pointop_key",
        f"{_TB3_2}/turtlebot3_absolute_move/turtlebot3_absolute_move.py",
    ),
    "turtlebot3 patrol server": (
        f"{_TB3_1}/turtlebot3_server",
        f"{_TB3_2}/turtlebot3_patrol/turtlebot3_patrol_server.py",
    ),
    "turtlebot3 patrol client": (
        f"{_TB3_1}/turtlebot3_client",
        f"{_TB3_2}/turtlebot3_patrol/turtlebot3_patrol_client.py",
    ),
}
REWRITTEN = {
    "talker": (f"{_ROSPY}/001_talker_listener/talker_timer.py", f"{_DEMO}/topics/talker.py"),
    "listener": (f"{_ROSPY}/001_talker_listener/listener.py", f"{_DEMO}/topics/listener.py"),
    "add_two_ints server": (
        f"{_ROSPY}/005_add_two_ints/add_two_ints_server",
        f"{_DEMO}/services/add_two_ints_server.py",
    ),
    "add_two_ints client": (
        f"{_ROSPY}/005_add_two_ints/add_two_ints_client",
        f"{_DEMO}/services/add_two_ints_client.py",
    ),
}
IN_CPP = {
    "twist_mux": ("twist_mux-ros1/src", "twist_mux-ros2/src"),
    "turtlesim": ("ros_tutorials/turtlesim/src", "ros_tutorials-ros2/turtlesim/src"),
    "turtlesim tutorials": (
        "ros_tutorials/turtlesim/tutorials",
        "ros_tutorials-ros2/turtlesim/tutorials",
    ),
    "pointcloud_to_laserscan": ("pointcloud_to_laserscan/src", "pointcloud_to_laserscan-ros2/src"),
    "teleop_twist_joy": ("teleop_twist_joy/src", "teleop_twist_joy-ros2/src"),
    "usb_cam": ("usb_cam/src", "usb_cam-ros2/src"),
    "robot_localization": ("robot_localization-ros1/src", "robot_localization-ros2/src"),
    "depthimage_to_laserscan": (
        "depthimage_to_laserscan-ros1/src",
        "depthimage_to_laserscan-ros2/src",
    ),
    "turtlebot3 fake": (f"{_SIM_1}/turtlebot3_fake/src", f"{_SIM_2}/turtlebot3_fake_node/src"),
    "turtlebot3 drive": (f"{_SIM_1}/turtlebot3_gazebo/src", f"{_SIM_2}/turtlebot3_gazebo/src"),
    "cmd_vel_mux": ("yujin_ocs/yocs_cmd_vel_mux/src", "cmd_vel_mux/src"),
}
PAIRS = {**PORTS, **REWRITTEN, **IN_CPP}


@dataclass(frozen=True, slots=True)
class Alike:
    """Two graphs side by side: pairs of entities, and those that only one of the two has."""

    pairs: tuple[tuple[Entity, Entity], ...]
    only: tuple[tuple[str, Entity], ...]

    @property
    def total(self) -> int:
        """Entities, those that both have once."""
        return len(self.pairs) + len(self.only)

    @property
    def shared(self) -> int:
        """Pairs with one name and one type."""
        return sum(not unlike(a, b) for a, b in self.pairs)

    @property
    def details(self) -> tuple[int, int]:
        """Further keys of the shared that say the same, and all of them."""
        shared = [(a, b) for a, b in self.pairs if not unlike(a, b)]
        every = [agree(a.details[k], b.details.get(k)) for a, b in shared for k in a.details]
        return sum(every), len(every)

    @property
    def unlike(self) -> list[Sides]:
        """The differences as the list of reasons has them."""
        found: list[Sides] = [(a.label, b.label) for a, b in self.pairs if unlike(a, b)]
        return found + [(e.label, None) if w == "1" else (None, e.label) for w, e in self.only]


# --- reading ------------------------------------------------------------------------------------


def read(path: Path) -> list[Entity]:
    """What the nodes in a file or below a folder ask of ROS."""
    root = next((d for d in (path, *path.parents) if (d / "package.xml").is_file()), path)
    given = packages([str(root)])
    return [e for chosen in given for g in _graphs(chosen) for e in entities(g, str(path))]


def _graphs(given: Chosen) -> Iterator[dict[str, list[Json]]]:
    """The graphs of a package: of its C++ and of its Python."""
    cpp = [s for p, s in sorted(given.files.items()) if Path(p).suffix in CODE]
    python = [s for p, s in sorted(given.files.items()) if is_python(p, s)]
    yield {**graph_data(Asking(Code.of(map(parse, cpp))).graph)}
    yield {**graph_data(graph_with(PyValues(PyCode.of(map(parse_python, python)))))}


# --- comparing ----------------------------------------------------------------------------------


def aligned(first: Sequence[Entity], second: Sequence[Entity]) -> Alike:
    """Entities of one kind side by side: those first that agree most."""
    possible = sorted(
        ((_agreement(a, b), i, j) for i, a in enumerate(first) for j, b in enumerate(second)),
        key=lambda found: (-found[0], found[1:]),
    )
    left, right = set(range(len(first))), set(range(len(second)))
    pairs = []
    for worth, i, j in possible:
        if worth and i in left and j in right:
            left.remove(i)
            right.remove(j)
            pairs.append((first[i], second[j]))
    alone = [("1", first[i]) for i in sorted(left)] + [("2", second[j]) for j in sorted(right)]
    return Alike(tuple(pairs), tuple(alone))


def _agreement(a: Entity, b: Entity) -> int:
    """How much two entities agree; 0 where they are none of a pair."""
    if a.kind != b.kind:
        return 0
    named = agree(a.name, b.name)
    if not named and a.kind not in ("timer", "node"):
        return 0
    details = sum(agree(a.details[k], b.details.get(k)) for k in a.details)
    return 1 + 100 * named + 10 * agree(a.type, b.type) + details


def differences(found: Alike, pair: str = "") -> Iterator[str]:
    """Every difference, on one line each, with its reason where there is one for the pair."""

    def why(one: str | None, other: str | None) -> str:
        reason = reason_of(pair, (one, other))
        return f" [{reason}]" if reason is not None else ""

    for a, b in found.pairs:
        if unlike(a, b):
            yield f"differs: {a.shown}, {b.shown}{why(a.label, b.label)}"
        else:
            for key in (k for k in a.details if not agree(a.details[k], b.details.get(k))):
                yield f"{key}: {a.details[key]}, {b.details.get(key)} of {a.shown}"
    for which, entity in found.only:
        reason = why(entity.label, None) if which == "1" else why(None, entity.label)
        yield f"only in ROS {which}: {entity.shown}{reason}"


# --- printing -----------------------------------------------------------------------------------


def table(found: Iterable[tuple[str, Alike]], short: bool) -> Iterator[str]:
    """The figures of each pair and of all, then what differs."""
    every = list(found)
    yield f"{'pair':28}{'alike':>9}{'':8}{'details':>9}"
    for name, alike in [*every, ("all", _together(a for _, a in every))]:
        right, keys = alike.details
        part = f"{alike.shared}/{alike.total}"
        yield f"{name:28}{part:>9}{share(alike.shared, alike.total):8.1%}{right:>5}/{keys}"
    reasons = Counter(
        reason_of(name, sides) or "no reason" for name, alike in every for sides in alike.unlike
    )
    yield ", ".join(f"{reason} {count}" for reason, count in reasons.most_common())
    for name, alike in () if short else every:
        yield from ("", f"{name}:", *(f"  {line}" for line in differences(alike, name)))


def _together(found: Iterable[Alike]) -> Alike:
    every = list(found)
    return Alike(tuple(p for a in every for p in a.pairs), tuple(o for a in every for o in a.only))


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the comparison; 1 where nothing can be compared."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.reverse.corpus.pairs", description=__doc__
    )
    parser.add_argument("first", type=Path, metavar="DIR_A")
    parser.add_argument("second", type=Path, metavar="DIR_B", nargs="?")
    parser.add_argument("--short", action="store_true", help="no list of what differs")
    given = parser.parse_args(arguments)
    if given.second is not None:
        paths = {given.first.name: (given.first, given.second)}
    else:
        paths = {n: (given.first / a, given.first / b) for n, (a, b) in PAIRS.items()}
    there = {name: pair for name, pair in paths.items() if all(p.exists() for p in pair)}
    if not there:
        print(f"{given.first}: no pair of nodes is here", file=sys.stderr)
        return 1
    found = [(name, aligned(read(a), read(b))) for name, (a, b) in there.items()]
    print("\n".join(table(found, given.short)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
