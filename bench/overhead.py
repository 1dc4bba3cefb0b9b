"""What generated nodes cost: a ping-pong without times against the same written by hand.

    python bench/overhead.py [--pairs N] [--seconds S] [--cpus LIST] [DIALECT...]

The nodes written by hand (overhead_nodes/) send the same messages and publish the same state. Both
take turns, so that what else the machine does slows both down; a run's figure is the median over
every 200 round trips. Dialects whose ROS is missing are left out: ROS 1 needs what tools/test
installs, ROS 2 a shell that has sourced one. `--cpus 0` keeps all nodes on one processor.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from running import MODELS, ROOT

sys.path.insert(0, str(ROOT))

from tests.ros1 import workspace as ros1
from tests.ros2real import workspace as ros2

DIALECTS = ("ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py")
KINDS = ("generated", "by hand")
NODES = ROOT / "bench" / "overhead_nodes"
RELEASE = "-DCMAKE_BUILD_TYPE=Release"
BUILD = {
    "ros1-cpp": """
add_executable(by_hand src/by_hand.cpp)
add_dependencies(by_hand ${${PROJECT_NAME}_EXPORTED_TARGETS})
target_link_libraries(by_hand ${catkin_LIBRARIES})
""",
    "ros2-cpp": """
add_executable(by_hand src/by_hand.cpp)
target_link_libraries(by_hand ${libraries})
install(TARGETS by_hand DESTINATION lib/${PROJECT_NAME})
ament_package()
""",
}


@dataclass(frozen=True, slots=True)
class Players:
    """What starts the nodes of both kinds, and who prints the seconds of their round trips."""

    environment: Mapping[str, str]
    launch: Sequence[str]
    by_hand: Sequence[str]
    marks: Sequence[str]

    def commands(self, kind: str) -> list[Sequence[str]]:
        return [self.launch] if kind == "generated" else [[*self.by_hand, name] for name in "ba"]


def missing(dialect: str) -> str | None:
    """Why a dialect cannot be measured here, or None."""
    return ros1.missing_ros() if dialect.startswith("ros1") else ros2.missing_ros2()


def generated(dialect: str, folder: Path) -> Path:
    """The generated package; in C++ with the nodes written by hand in it."""
    options = ("-o", str(folder / "generated"), "--target", dialect)
    command = (sys.executable, "-m", "rebsync", "generate", str(MODELS / "ping.rebeca"), *options)
    subprocess.run(command, check=True, capture_output=True, cwd=ROOT)
    package = folder / "generated" / "ping"
    if dialect in BUILD:
        shutil.copy(NODES / f"{dialect[:4]}.cpp", package / "src" / "by_hand.cpp")
        lists = package / "CMakeLists.txt"
        lists.write_text(lists.read_text().replace("\nament_package()\n", "") + BUILD[dialect])
    return package


def built(dialect: str, folder: Path, seconds: float) -> Players:
    """Builds both kinds, optimised."""
    package = generated(dialect, folder)
    script = str(NODES / f"{dialect[:4]}.py")
    python = [ros1.SYSTEM_PYTHON, script]
    if dialect.startswith("ros1"):
        workspace = ros1.build([package], folder / "built", [RELEASE])
        by_hand = [str(workspace.executable("ping", "by_hand"))]
        launch = ["roslaunch", "--skip-log-check", "ping", "ping.launch"]
        marks = [ros1.SYSTEM_PYTHON, str(NODES / "marks1.py"), str(seconds)]
        home = workspace.environment(ROS_HOME=str(folder / "home"), ROS_IP="127.0.0.1")
        return Players(home, launch, by_hand if dialect == "ros1-cpp" else python, marks)
    installed = ros2.build(package, folder / "built", options=[RELEASE])
    by_hand = [str(installed.root / "install/lib/ping/by_hand")]
    launch = ["ros2", "launch", "ping", "ping.launch.py"]
    interfaces = "ping" if dialect == "ros2-cpp" else "ping_interfaces"
    marks = [ros1.SYSTEM_PYTHON, str(NODES / "marks2.py"), interfaces, str(seconds)]
    home = installed.environment(folder)
    return Players(home, launch, by_hand if dialect == "ros2-cpp" else python, marks)


@contextmanager
def running(command: Sequence[str], environment: Mapping[str, str]) -> Iterator[None]:
    """A program, and all that it starts, while the block runs."""
    quiet = subprocess.DEVNULL
    process = subprocess.Popen(
        list(command), env=dict(environment), stdout=quiet, stderr=quiet, start_new_session=True
    )
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        try:
            with suppress(subprocess.TimeoutExpired):
                process.wait(30)
        finally:  # what is left over would play in the next run
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


@contextmanager
def middleware(dialect: str, environment: Mapping[str, str]) -> Iterator[Mapping[str, str]]:
    """The environment of nodes that find one another and nobody else: ROS 1 by a master."""
    if dialect.startswith("ros2"):
        yield environment
        return
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    own = {**environment, "ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
    with running(["rosmaster", "--core", "-p", str(port)], own):
        while subprocess.run(["rosparam", "list"], env=own, capture_output=True).returncode != 0:
            continue
        yield own


def played(dialect: str, players: Players, kind: str, cpus: str | None) -> float:
    """The median seconds of a round trip of one run."""
    pinned = ["taskset", "-c", cpus] if cpus else []
    with ExitStack() as stack:
        environment = stack.enter_context(middleware(dialect, players.environment))
        for command in players.commands(kind):
            stack.enter_context(running([*pinned, *command], environment))
        done = subprocess.run(
            list(players.marks),
            env=dict(environment),
            check=True,
            stdout=subprocess.PIPE,
            text=True,
            timeout=300,
        )
    return median(map(float, done.stdout.split()))


def measured(dialect: str, pairs: int, seconds: float, cpus: str | None) -> str:
    """The line of a dialect: medians of both kinds, and of the ratio of each pair of runs."""
    found: dict[str, list[float]] = {kind: [] for kind in KINDS}
    with tempfile.TemporaryDirectory() as folder:
        players = built(dialect, Path(folder), seconds)
        for _ in range(pairs):
            for kind, times in found.items():
                times.append(played(dialect, players, kind, cpus))
    ratios = [made / by_hand for made, by_hand in zip(*found.values(), strict=True)]
    cells = [
        f"{1e6 * median(t):7.0f} ({1e6 * min(t):.0f}-{1e6 * max(t):.0f})" for t in found.values()
    ]
    spread = f"({min(ratios):.2f}-{max(ratios):.2f})"
    return f"{dialect:9}{cells[0]:>20}{cells[1]:>20}{median(ratios):8.2f} {spread}"


def interruptible() -> None:
    """Has SIGINT end the nodes also where a shell that starts this with `&` has it ignored."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def main() -> None:
    """Prints a line for each dialect."""
    interruptible()
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("dialects", nargs="*", metavar="DIALECT", help=", ".join(DIALECTS))
    parser.add_argument("--pairs", type=int, default=5, help="runs of each kind")
    parser.add_argument("--seconds", type=float, default=5.0, help="of a run")
    parser.add_argument("--cpus", help="the processors that all nodes share, as taskset has them")
    options = parser.parse_args()
    if unknown := set(options.dialects) - set(DIALECTS):
        parser.error(f"no dialect {', '.join(sorted(unknown))}")
    print(f"round trips in microseconds, medians (least-most) of {options.pairs} runs")
    print(f"{'':9}{KINDS[0]:>20}{KINDS[1]:>20}{'ratio':>8}      load", flush=True)
    for dialect in options.dialects or DIALECTS:
        if (reason := missing(dialect)) is not None:
            print(f"{dialect:9} left out: {reason}", flush=True)
            continue
        line = measured(dialect, options.pairs, options.seconds, options.cpus)
        print(f"{line}  {os.getloadavg()[0]:.1f}", flush=True)


if __name__ == "__main__":
    main()
