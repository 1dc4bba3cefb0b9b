"""What the run-time part costs: a ping-pong of generated nodes against one written by hand.

    python bench/overhead.py [--rounds N] [--windows N] [--seconds S] [DIALECT...]

Both publish the same messages and the same state. They run in turns on a roscore of their own; the
time of a round trip is the median over windows, each of which counts what `a` has served. Needs
ROS 1 (tools/test says which packages).
"""

from __future__ import annotations

import argparse
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from statistics import median

from running import MODELS, ROOT

sys.path.insert(0, str(ROOT))

from tests.ros1.workspace import SYSTEM_PYTHON, Workspace, build, missing_ros  # noqa: E402

NODES = ROOT / "bench" / "overhead_nodes"
DIALECTS = ("ros1-cpp", "ros1-py")
_BY_HAND = """
add_executable(by_hand src/by_hand.cpp)
add_dependencies(by_hand ${${PROJECT_NAME}_EXPORTED_TARGETS})
target_link_libraries(by_hand ${catkin_LIBRARIES})
"""


def built(dialect: str, folder: Path) -> Workspace:
    """A workspace with the generated package and the nodes written by hand."""
    model = MODELS / "ping.rebeca"
    generate = ("generate", str(model), "-o", str(folder / "made"), "--target", dialect)
    subprocess.run([sys.executable, "-m", "rebsync", *generate], check=True, capture_output=True)
    package = folder / "made" / "ping"
    if dialect == "ros1-cpp":
        shutil.copy(NODES / "by_hand1.cpp", package / "src" / "by_hand.cpp")
        with (package / "CMakeLists.txt").open("a") as file:
            file.write(_BY_HAND)
    return build([package], folder / "workspace")


def commands(dialect: str, workspace: Workspace, kind: str) -> list[list[str]]:
    """What starts the nodes."""
    if kind == "generated":
        return [["roslaunch", "--wait", "--skip-log-check", "ping", "ping.launch"]]
    if dialect == "ros1-cpp":
        return [[str(workspace.executable("ping", "by_hand")), name] for name in "ba"]
    return [[SYSTEM_PYTHON, str(NODES / "by_hand1.py"), name] for name in "ba"]


@contextmanager
def running(command: Sequence[str], environment: Mapping[str, str]) -> Iterator[None]:
    """A program while the block runs."""
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen(list(command), env=dict(environment), **quiet)
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(30)


def sampled(dialect: str, workspace: Workspace, kind: str, windows: int, seconds: float) -> float:
    """The median seconds of a round trip."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    own = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1"}
    environment = workspace.environment(**own, ROS_HOME=str(workspace.root / "home"))
    with running(["rosmaster", "--core", "-p", str(port)], environment):
        time.sleep(2)
        return _played(commands(dialect, workspace, kind), environment, windows, seconds)


def _played(
    commands_: list[list[str]], environment: Mapping[str, str], windows: int, seconds: float
) -> float:
    if commands_:
        with running(commands_[0], environment):
            return _played(commands_[1:], environment, windows, seconds)
    sample = [SYSTEM_PYTHON, str(NODES / "sample1.py"), str(windows), str(seconds)]
    done = subprocess.run(
        sample, env=dict(environment), check=True, stdout=subprocess.PIPE, text=True
    )
    return median(float(line) for line in done.stdout.split())


def main() -> None:
    """Prints a line for each dialect."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("dialects", nargs="*", default=DIALECTS, choices=[*DIALECTS, []])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--windows", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=2.0)
    options = parser.parse_args()
    if (reason := missing_ros()) is not None:
        raise SystemExit(reason)
    print(f"{'':10} {'generated':>12} {'by hand':>12} {'ratio':>7}")
    for dialect in options.dialects:
        with tempfile.TemporaryDirectory() as folder:
            workspace = build_of(dialect, Path(folder), options)
            print(workspace, flush=True)


def build_of(dialect: str, folder: Path, options: argparse.Namespace) -> str:
    """The line of a dialect."""
    workspace = built(dialect, folder)
    found: dict[str, list[float]] = {"generated": [], "by hand": []}
    for _ in range(options.rounds):
        for kind, times in found.items():
            times.append(sampled(dialect, workspace, kind, options.windows, options.seconds))
    generated, by_hand = (1e6 * median(times) for times in found.values())
    return f"{dialect:10} {generated:9.0f} us {by_hand:9.0f} us {generated / by_hand:7.2f}"


if __name__ == "__main__":
    main()
