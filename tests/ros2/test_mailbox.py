"""The run-time part for rclcpp on the stub: order, times, and what is reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.recording import Recording
from tests.ros2.building import build_driver, make_messages
from tests.ros2.running import RunError, run

MODEL = """
env int[2][2] grid = {{1, 2}, {3, 4}};
env byte small = 7;
reactiveclass Server(3) {
  knownrebecs { Client client; }
  statevars { int last; int[2] at; byte b; boolean ready; }
  Server(int first, boolean flag) { last = first + grid[1][0]; ready = flag; b = small; }
  msgsrv plain(int x, int[2] place) { last = x; at[0] = place[1]; delay(2); }
  @priority(1) msgsrv urgent(int x) { last = x; ((Client) sender).answer(x * 2); }
  msgsrv wrong(int x) { last = 100; last = 1 / x; last = 200; }
  msgsrv claims(int x) { assertion(x > 5); at[x] = 1; last = 300; }
}
reactiveclass Client(5) {
  knownrebecs { Server server; }
  statevars { int got; int[2] where; }
  Client() {
    where[0] = 8;
    where[1] = 9;
    self.flood() after(10);
    self.order() after(20);
    self.late() after(40);
    self.broken() after(60);
  }
  msgsrv flood() {
    server.plain(1, where); server.plain(2, where); server.plain(3, where); server.plain(4, where);
  }
  msgsrv order() { server.plain(5, where); server.plain(6, where); server.urgent(7); }
  msgsrv late() { server.plain(8, where); server.plain(9, where) deadline(1); }
  msgsrv broken() { server.wrong(0); server.claims(2) after(1); server.urgent(11) after(3); }
  msgsrv answer(int x) { got = x; }
}
@Robot reactiveclass Robot(5) {
  statevars { int x; }
  Robot() { self.go() after(30); }
  msgsrv go() { @Move(X+1, Y); delay(100); }
}
main { Server s(c):(4, true); Client c(s):(); Robot r():(); }
"""


@pytest.fixture(scope="module")
def package(headers: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory, config = tmp_path_factory.mktemp("mailbox"), Config(target="ros2-cpp")
    package = written(generated(MODEL, "office", config), directory, "office", config)
    make_messages([package], headers)
    return package


@pytest.fixture(scope="module")
def driver(package: Path, headers: Path) -> Path:
    """With the thread sanitizer: what it finds ends the run."""
    return build_driver(package, headers, package.parent / "build", ["-fsanitize=thread", "-g"])


@pytest.fixture(scope="module")
def recording(package: Path, driver: Path) -> Recording:
    # The start may not wait for a subscription that never matches.
    return run(package, driver, package.parent, 90, foreign=["/s/plain"])


def _between(recording: Recording, start: int, end: int) -> list[str]:
    bodies = [b for b in recording.bodies("s") if start <= b.start < end]
    return [f"{b.server}({b.arguments})@{b.start}" for b in bodies]


def test_parameters_reach_the_constructor(recording: Recording) -> None:
    constructed = next(s for s in recording.served if s.rebec == "s")
    assert constructed.state == {"last": 7, "at": [0, 0], "b": 7, "ready": True}


def test_the_newest_message_beyond_the_capacity_is_dropped(recording: Recording) -> None:
    flood = [f"plain({x}, [8, 9])@{t}" for x, t in ((1, 10), (2, 12), (3, 14))]
    assert _between(recording, 10, 20) == flood
    (report,) = recording.reports("overflow")
    assert (report.rebec, report.server) == ("s", "plain")
    assert report.facts == "capacity 3, arrival 10"


def test_the_more_urgent_message_goes_first_and_is_answered(recording: Recording) -> None:
    first, *others = _between(recording, 20, 40)
    assert first == "urgent(7)@20"
    assert others == ["plain(5, [8, 9])@20", "plain(6, [8, 9])@22"]
    assert ("answer", "14") in {(b.server, b.arguments) for b in recording.bodies("c")}


def test_what_is_not_taken_in_time_is_dropped(recording: Recording) -> None:
    assert _between(recording, 40, 60) == ["plain(8, [8, 9])@40"]
    (report,) = recording.reports("deadline")
    assert report.facts == "arrival 40, deadline 41, now 42"


def test_violations_are_reported_and_serving_goes_on(recording: Recording) -> None:
    kinds = [(r.kind, r.server, r.facts.partition(":")[0]) for r in recording.reports()]
    violations = ["division", "assertion", "index"]
    assert [k for k, _, _ in kinds if k not in ("overflow", "deadline")] == violations
    served = _between(recording, 60, 90)
    assert [s.partition("(")[0] for s in served] == ["wrong", "claims", "urgent"]
    assert served[-1] == "urgent(11)@63"
    states = [b.state["last"] for b in recording.bodies("s") if b.start >= 60]
    assert states == [100, 100, 11]


def test_the_last_velocity_is_zero_when_the_node_ends_in_mid_move(recording: Recording) -> None:
    *_, moving, last = recording.velocities("r")
    assert moving.x != 0
    assert (last.x, last.y, last.turn) == (0, 0, 0)


def test_a_simulated_clock_wakes_who_waits(
    recording: Recording, package: Path, driver: Path
) -> None:
    simulated = run(package, driver, package.parent, 15, step=0.05)
    found = [b for b in simulated.bodies("s") if 0 < b.start < 13]
    assert found
    assert [f"{b.server}({b.arguments})@{b.start}" for b in found] == _between(recording, 1, 13)
    # With the settling time of what may be overtaken, and the time of a step.
    assert all(b.stamp < b.now + 0.05 + 0.07 for b in found)


def test_no_state_is_published_where_nobody_wants_it(
    recording: Recording, package: Path, driver: Path
) -> None:
    silent = run(package, driver, package.parent, 30, parameters={"mailbox.publish_state": False})
    assert silent.served == ()
    answers = [m.fields["x"] for m in silent.messages if m.topic.endswith("/answer")]
    assert answers == [14]
    assert len(silent.reports("overflow")) == len(recording.reports("overflow")) == 1


@pytest.mark.parametrize("policy", ["depth", "reliability"])
def test_no_parameter_may_have_messages_of_the_model_lost(
    package: Path, driver: Path, policy: str
) -> None:
    value: object = 10 if policy == "depth" else "best_effort"
    parameters = {f"qos_overrides./s/plain.subscription.{policy}": value}
    with pytest.raises(RunError, match="/s/plain carries messages of the model"):
        run(package, driver, package.parent, 5, parameters=parameters)
