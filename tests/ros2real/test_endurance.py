"""Systems that serve for long and in quick succession, on a real ROS 2: nobody ever stops.

A minute each; REBSYNC_ENDURANCE says for how many seconds otherwise.
"""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest
import yaml

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.run import launched
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder

_WATCHER = Path(__file__).parent / "nodes" / "watcher.py"
_SECONDS = float(os.environ.get("REBSYNC_ENDURANCE", "60"))
_PAUSE = 10.0  # s without a body: a busy machine is slow, but not that slow
# A robot, a periodic sensor with its stand-in, and moves.
_LIDAR = """
@Robot reactiveclass Car(10) {
  statevars { boolean near; int x; int turns; }
  Car() { self.scan(); self.step(); }
  @Sensor msgsrv scan() { near = ?(true, false); self.scan() after(1); }
  msgsrv step() {
    if (near) { turns += 1; } else { @Move(X+1, Y); x += 1; }
    delay(1);
    self.step() after(1);
  }
}
main { Car car():(); }
"""
# Each ticks and tells the next one; half of them drive. They have room for what a busy machine is
# late with: a tick that is dropped would be the last one.
_RING = """
@Robot reactiveclass Walker(30000) {
  knownrebecs { Runner next; }
  statevars { int heard; }
  Walker() { self.tick() after(1); }
  msgsrv tick() { next.poke(heard); @Move(X+1, Y); delay(1); self.tick() after(1); }
  msgsrv poke(int x) { heard += 1; }
}
reactiveclass Runner(30000) {
  knownrebecs { Walker next; }
  statevars { int heard; }
  Runner() { self.tick() after(1); }
  msgsrv tick() { next.poke(heard); self.tick() after(2); }
  msgsrv poke(int x) { heard += 1; }
}
main {
  Walker a(b):(); Runner b(c):(); Walker c(d):(); Runner d(e):(); Walker e(f):(); Runner f(a):();
}
"""
_SYSTEMS = {
    "lidar": (_LIDAR, ["car"], {"time_unit": 0.1}),
    "ring": (_RING, list("abcdef"), {"time_unit": 0.02, "slack": 1000.0}),
}


@pytest.mark.parametrize("dialect", DIALECTS)
@pytest.mark.parametrize("name", sorted(_SYSTEMS))
@pytest.mark.timeout(_SECONDS + 900)
def test_nobody_stops_serving(name: str, dialect: str, build_real: Builder, tmp_path: Path) -> None:
    model, rebecs, options = _SYSTEMS[name]
    config = Config(target=dialect)
    package = written(generated(model, name, config), tmp_path, name, config)
    workspace = build_real(package, f"{name}_{dialect}")
    own = tmp_path / "own.yaml"
    own.write_text(yaml.safe_dump({"/**": {"ros__parameters": {"mailbox": options}}}))
    launch = workspace.root / "install/share" / name / "launch" / f"{name}.launch.py"
    environment = workspace.environment(tmp_path)
    command = ["ros2", "launch", str(launch), f"params_file:={own}"]
    with launched(command, tmp_path, environment):
        watcher = [SYSTEM_PYTHON, str(_WATCHER), str(len(rebecs)), str(_SECONDS)]
        done = subprocess.run(
            watcher, env=environment, stdout=subprocess.PIPE, text=True, check=True
        )
    print(done.stdout)
    found = json.loads(done.stdout)
    output = (tmp_path / "output").read_text()
    assert sorted(found["served"]) == rebecs, output
    assert max(found["pauses"].values()) < _PAUSE, found
    assert found["stalls"] == []
    for word in ("stall:", "overflow:", "lost ", "Traceback", "exit code"):
        assert word not in output, output
