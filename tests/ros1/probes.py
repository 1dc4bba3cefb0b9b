"""Systems of scripted rebecs: which node runs which script, as a launch file."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from tests.ros1.recording import Recording
from tests.ros1.run import Clock, run
from tests.ros1.workspace import SYSTEM_PYTHON, Workspace

_USUAL = Clock(until=30, quiet=8)
_SERVERS = ("plain", "low", "high")
_SHIFTED = Path(__file__).parent / "nodes" / "shifted_clock.py"


@dataclass(frozen=True, slots=True)
class Rebec:
    """A node of the probe package: the lines that each of its servers runs.

    `low` has priority 2, `high` priority 1, `plain` none. The sensor hears a topic, by default
    one to which nobody sends. The node starts after a `wait`, in seconds of the real clock. Its own
    simulated clock is off by an `offset`, as that of another machine is.
    """

    constructor: Sequence[str] = ()
    plain: Sequence[str] = ()
    low: Sequence[str] = ()
    high: Sequence[str] = ()
    capacity: int = 20
    wait: float = 0.0
    offset: float = 0.0
    respawn: bool = False
    hears: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def private(self, peers: Sequence[str]) -> dict[str, Any]:
        """The node's private parameters."""
        scripts = {name: list(getattr(self, name)) for name in ("constructor", *_SERVERS)}
        own = {"script": scripts, "capacity": self.capacity}
        return {**own, "peers": list(peers), **self.parameters}


class Player(Protocol):
    """What runs systems of rebecs without a workspace."""

    def play(
        self,
        rebecs: Mapping[str, Rebec],
        clock: Clock,
        parameters: Mapping[str, Any],
        names: Sequence[str],
    ) -> Recording:
        """Run rebecs of which each knows all the names."""


def play(
    workspace: Workspace | Player,
    directory: Path,
    rebecs: Mapping[str, Rebec],
    clock: Clock = _USUAL,
    parameters: Mapping[str, Any] | None = None,
    absent: Sequence[str] = (),
    namespace: str = "",
) -> Recording:
    """Run rebecs that each know all others, those that are `absent` included."""
    names = [*rebecs, *absent]
    if not isinstance(workspace, Workspace):
        return workspace.play(rebecs, clock, parameters or {}, names)
    nodes = [_node(n, r, [peer for peer in names if peer != n]) for n, r in rebecs.items()]
    common = _parameter("mailbox", {"rebecs": names, "instances": {"Script": list(rebecs)}})
    launch = directory / "probe.launch"
    system = (
        f'<group ns="{namespace}">\n{common}{"".join(nodes)}</group>\n'
        if namespace
        else (common + "".join(nodes))
    )
    launch.write_text(f"<launch>\n{system}</launch>\n")
    return run(workspace, launch, directory, clock, parameters)


def _node(name: str, rebec: Rebec, peers: Sequence[str]) -> str:
    remaps = "".join(
        f'<remap from="~{peer}/{server}" to="{peer}/{server}"/>\n'
        for peer in peers
        for server in _SERVERS
    )
    private = "".join(_parameter(key, value) for key, value in rebec.private(peers).items())
    prefix = f"sh -c 'sleep {rebec.wait}; exec $0 $*'"
    start = f'<node name="{name}" pkg="probe" type="script_node" launch-prefix="{prefix}"'
    respawn = f'respawn="{str(rebec.respawn).lower()}">'
    sensor = f'<remap from="~sensor" to="{rebec.hears or name + "/sensed"}"/>\n'
    clock, shifted = _clock(name, rebec)
    return f"{start} {respawn}\n{private}{remaps}{sensor}{clock}</node>\n{shifted}"


def _clock(name: str, rebec: Rebec) -> tuple[str, str]:
    """Where a node has its time from, and the node that shows it."""
    if not rebec.offset:
        return "", ""
    prefix = f"exec {SYSTEM_PYTHON} {_SHIFTED} /clock_of_{name} {rebec.offset} $*"
    return (
        f'<remap from="/clock" to="/clock_of_{name}"/>\n',
        f'<node name="shift_{name}" pkg="probe" type="script_node" '
        f"launch-prefix=\"sh -c '{prefix}'\"/>\n",
    )


def _parameter(name: str, value: object) -> str:
    return f'<rosparam param="{name}">{json.dumps(value)}</rosparam>\n'
