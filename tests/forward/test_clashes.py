"""Names of topics and services that would mean two things are refused, and no others."""

from __future__ import annotations

import pytest

from rebsync.config import TARGETS, Config, SensorBinding
from rebsync.forward.limits import limits
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.forward.compiling import CASES, case_config

_ROS1 = ("ros1-cpp", "ros1-py")
_ROS2 = ("ros2-cpp", "ros2-py")
_MODEL = """
@Robot reactiveclass Robot(5) {
  knownrebecs { Control %s; }
  statevars { int x; boolean near; }
  Robot() { self.look() after(1); }
  @Sensor msgsrv look() { near = ?(true, false); self.look() after(2); }
  %s msgsrv %s(int to) { ((Control)sender).done(to); }
  %s msgsrv %s() { x = 1; %s.%s(); }
}
reactiveclass Control(5) {
  statevars { int y; }
  Control() { y = 0; }
  msgsrv done(int to) { y = to; }
  msgsrv goal() { y = 1; }
  msgsrv other() { y = 2; }
}
main { Robot robot(control):(); Control control():(); }
"""


def _model(
    known: str = "control",
    offer: str = "@Action(done)",
    server: str = "go",
    second: str = "",
    beside: str = "stop",
    sends: str = "other",
) -> str:
    return _MODEL % (known, offer, server, second, beside, known, sends)


def _clashes(text: str, config: Config) -> list[str]:
    model = parse_model(Source("m.rebeca", text)).model
    analysis = analyse(model)
    assert not analysis.errors, analysis.errors
    return [d.message for d in limits(model, analysis, config, "m") if d.code == "RS712"]


@pytest.mark.parametrize("target", TARGETS)
def test_an_action_called_port_beside_ports(target: str) -> None:
    text = _model(server="port", second="@Port", beside="status")
    wanted = (
        'the status of the action "port" of "robot" and "status" of "robot" would be one topic, '
        '"/robot/port/status"'
    )
    assert _clashes(text, Config(target=target)) == ([wanted] if target in _ROS1 else [])


@pytest.mark.parametrize("target", TARGETS)
def test_an_action_called_as_a_known_rebec(target: str) -> None:
    """What the launch file remaps for messages to the rebec would be remapped for the action."""
    text = _model(known="way", server="way", sends="goal")
    found = _clashes(text, Config(target=target))
    assert len(found) == (1 if target in _ROS1 else 0)
    assert not found or '"/robot/way/goal"' in found[0]
    assert _clashes(_model(known="way", server="way"), Config(target=target)) == []


@pytest.mark.parametrize("target", TARGETS)
def test_a_sensor_on_the_topic_of_an_action_or_a_server(target: str) -> None:
    def bound(topic: str) -> Config:
        sensor = SensorBinding("Robot.look", topic, "std_msgs/Bool")
        return Config(target=target, sensors=(sensor,))

    assert len(_clashes(_model(), bound("/robot/go/feedback"))) == (target in _ROS1)
    assert len(_clashes(_model(), bound("~stop"))) == 1
    assert len(_clashes(_model(), bound("/control/done"))) == 1
    assert len(_clashes(_model(), bound("/robot/state"))) == 1
    assert _clashes(_model(), bound("/scan")) == []


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    ("name", "ros"), [("get_parameters", "ros2"), ("set_logger_level", "ros1"), ("get_state", "")]
)
def test_a_service_that_every_node_has(name: str, ros: str, target: str) -> None:
    text = _model(offer="@Service(done)", server=name)
    assert len(_clashes(text, Config(target=target))) == (target[:4] == ros)
    managed = Config(target=target, lifecycle=True)
    assert len(_clashes(text, managed)) == (target[:4] == (ros or "ros2"))


@pytest.mark.parametrize("target", TARGETS)
def test_what_may_be_shared_and_what_is_apart(target: str) -> None:
    two = _model().replace("main { ", "main { Robot other(control):(); ")
    scan = (SensorBinding("Robot.look", "/scan", "std_msgs/Bool"),)
    assert _clashes(two, Config(target=target, sensors=scan, odometry="/odom")) == []
    for case in CASES.glob("*.rebeca"):
        settings = case_config(case)
        options = {"sensors": settings.sensors, "odometry": settings.odometry}
        assert _clashes(case.read_text("utf-8"), Config(target=target, **options)) == []  # type: ignore[arg-type]
