"""Rebecs that are killed and come back, or told something from outside, on a real ROS 2."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder
from tests.ros2real.running import run_command
from tests.ros2real.workspace import Workspace

_REAPER = Path(__file__).parent / "nodes" / "reaper.py"
_CLOCK = Clock(until=28, quiet=28, rate=None, startup=60)
_MODEL = """
reactiveclass Ticker(20) {
  knownrebecs { Counter c; }
  Ticker() { self.tick() after(1); }
  msgsrv tick() { c.count(1); self.tick() after(1); }
}
reactiveclass Counter(20) {
  statevars { int n; }
  Counter() { self.own() after(2); }
  msgsrv count(int by) { n = n + by; }
  msgsrv own() { n = n + 100; }
}
main { Ticker t(c):(); Counter c():(); }
"""
_LAUNCH = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def generate_launch_description():
    system = IncludeLaunchDescription(
        PythonLaunchDescriptionSource({launch!r}),
        launch_arguments={{"respawn": {respawn!r}}}.items(),
    )
    return LaunchDescription([ExecuteProcess(cmd={beside!r}, output="screen"), system])
"""


@dataclass(frozen=True)
class Relay:
    """A ticker and a counter, as installed."""

    workspace: Workspace
    dialect: str

    @property
    def messages(self) -> str:
        """The package that has the messages."""
        return "relay_interfaces" if self.dialect == "ros2-py" else "relay"

    def killed(self, directory: Path, respawned: bool) -> Recording:
        """Kill the counter after some seconds; who starts it again is the launcher, or nobody."""
        words = [self.messages, "counter_node", "respawned" if respawned else "by hand"]
        reaper = [SYSTEM_PYTHON, str(_REAPER), *words]
        return self.run(directory, reaper, _CLOCK, respawned)

    def run(
        self, directory: Path, beside: Sequence[str], clock: Clock, respawned: bool = False
    ) -> Recording:
        """Run the system with a command beside it."""
        launch = self.workspace.root / "install/share/relay/launch/relay.launch.py"
        wrapper = directory / "wrapper.launch.py"
        text = _LAUNCH.format(launch=str(launch), respawn=str(respawned).lower(), beside=beside)
        wrapper.write_text(text)
        command = ["ros2", "launch", str(wrapper)]
        return run_command(self.workspace, command, ["/t", "/c"], ["t", "c"], directory, clock)


@pytest.fixture(scope="module", params=DIALECTS)
def relay(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Relay:
    dialect = str(request.param)
    config = Config(target=dialect)
    folder = tmp_path_factory.mktemp("relay")
    package = written(generated(_MODEL, "relay", config), folder, "relay", config)
    return Relay(build_real(package, f"relay_{dialect}"), dialect)


@pytest.mark.parametrize("respawned", [True, False], ids=["respawned", "by hand"])
def test_a_killed_rebec_comes_back_to_the_common_time(
    relay: Relay, tmp_path: Path, respawned: bool
) -> None:
    recording = relay.killed(tmp_path, respawned)
    said = [r.facts for r in recording.reports("restarted") if r.rebec == "c"]
    assert len(said) == 1, recording.problems()
    found = re.fullmatch(r"serves from (\d+) on, what came before is lost", said[0])
    assert found is not None
    begin = int(found[1])
    after = [b for b in recording.bodies("c") if b.start >= begin]
    assert f"own()@{begin + 2}" in recording.order("c")
    assert len(after) > 4
    # On a busy machine a few come late.
    lateness = sorted(body.stamp - body.start for body in after)
    assert lateness[0] >= 0
    assert lateness[len(lateness) // 2] < 0.5
    others = [r.facts for r in recording.reports("startup") if r.rebec == "t"]
    assert others == (["restarted c"] if respawned else ["lost c", "back c", "restarted c"])
    # Neither the death nor what follows holds up the one that stays.
    ticks = recording.bodies("t")
    assert [b.start for b in ticks] == list(range(1, len(ticks) + 1))
    assert len(ticks) > 20
    # What nobody stamped, by 0: it is served when it comes.
    (stray,) = [b for b in recording.bodies("c") if b.arguments == "0"]
    assert stray.start == stray.arrival > 0
    assert stray.start - 0.5 < stray.stamp < stray.start + 1.5


def test_an_empty_message_from_a_shell_is_served_when_it_comes(
    relay: Relay, tmp_path: Path
) -> None:
    say = f"sleep 5; exec ros2 topic pub --once /c/count {relay.messages}/msg/CounterCount '{{}}'"
    clock = replace(_CLOCK, until=16, quiet=16)
    recording = relay.run(tmp_path, ["sh", "-c", say], clock)
    (empty,) = [b for b in recording.bodies("c") if b.arguments == "0"]
    assert empty.start == empty.arrival > 0
    assert empty.start - 0.5 < empty.stamp < empty.start + 1.5
    assert recording.reports() == ()
