"""Systems of scripted rebecs in one process."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from rebsync.config import Config
from rebsync.forward.templating import fill
from tests.forward.compiling import generated, written
from tests.ros1.conftest import rendered
from tests.ros1.probes import Player, Rebec
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros2py.messages import Message
from tests.ros2py.playing import installed, recorded
from tests.ros2py.quality import DurabilityPolicy, QoSProfile
from tests.ros2py.world import Launched, Node, World

_HERE = Path(__file__).parent
_MESSAGES = _HERE.parent / "ros1" / "packages" / "probe" / "msg"
_MODULES = {
    **{
        name: f"ros2_py/{name}.py" for name in ("drive", "mailbox", "sensor", "startup", "watchdog")
    },
    "values": "py/values.py",
}
_SERVERS = ("plain", "low", "high")
_MODEL = "reactiveclass Script(3) { Script() { } } main { Script s():(); }"
_MAIN = "from probe.script import main\n\n__all__ = ['main']\n"


@dataclass(frozen=True)
class _InProcess:
    """Plays with the package in a folder; `foreign` are topics to which no rebec subscribes.

    That subscription asks for what was sent before it, which rebecs do not keep. The `deaf` hear
    what others announce some seconds late.
    """

    folder: Path
    foreign: tuple[str, ...] = ()
    deaf: tuple[tuple[str, float], ...] = ()

    def play(
        self,
        rebecs: Mapping[str, Rebec],
        clock: Clock,
        parameters: Mapping[str, Any],
        names: Sequence[str],
    ) -> Recording:
        """Run rebecs of which each knows all the names, until the clock's end."""
        world = World()
        world.deaf |= dict(self.deaf)
        nodes = probe_nodes(rebecs, parameters, names)
        with installed(world, self.folder, self.folder / "probe_interfaces"):
            main = import_module("probe.script").main
            mains = [(node, main) for node in nodes]
            listeners = [(Launched("tool"), partial(_listen, world, t)) for t in self.foreign]
            world.run([*listeners, *mains], clock.until, clock.quiet)
        return recorded(world)


def _listen(world: World, topic: str) -> None:
    """A node that is no rebec and asks for what was sent before it came."""
    node = Node(world, world.context.launched)
    world.add(node)
    kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(Message, topic, lambda message: None, kept)
    world.spin(node)


def probe_nodes(
    rebecs: Mapping[str, Rebec], parameters: Mapping[str, Any], names: Sequence[str]
) -> list[Launched]:
    """The nodes of rebecs that run scripts; an empty list of texts has one empty text in it."""
    common: dict[str, Any] = {"mailbox.rebecs": list(names)}
    common["mailbox.instances.Script"] = list(rebecs)
    for key, value in parameters.items():
        name = key if key.startswith("qos_overrides.") else key.replace("/", ".")
        common[name] = [""] if value == [] else value
    return [_launched(name, rebec, names, common) for name, rebec in rebecs.items()]


def _launched(
    name: str, rebec: Rebec, names: Sequence[str], common: Mapping[str, object]
) -> Launched:
    peers = [peer for peer in names if peer != name]
    own: dict[str, object] = dict(common)
    for key, value in rebec.private(peers).items():
        if isinstance(value, Mapping):
            own |= {f"{key}.{inner}": list(lines) or [""] for inner, lines in value.items()}
        else:
            own[key.replace("/", ".")] = [""] if value == [] else value
    remaps = {f"~/{p}/{s}": f"{p}/{s}" for p in peers for s in _SERVERS}
    remaps["~/sensor"] = rebec.hears or f"{name}/sensed"
    return Launched(name, own, remaps)


@pytest.fixture(scope="session")
def probe(tmp_path_factory: pytest.TempPathFactory) -> Player:
    """The package whose rebecs run scripts, with the run-time part as it is now."""
    folder = tmp_path_factory.mktemp("probe")
    write_probe(folder / "probe", folder / "probe_interfaces")
    return _InProcess(folder)


def write_probe(package: Path, interfaces: Path) -> None:
    """The modules and the messages of the package whose rebecs run scripts."""
    package.mkdir(parents=True, exist_ok=True)
    (package / "__init__.py").touch()
    shutil.copy(_HERE / "script" / "script.py", package)
    for name, path in _MODULES.items():
        (package / f"{name}.py").write_text(rendered(path, "probe"))
    messages = interfaces / "msg"
    messages.mkdir(parents=True, exist_ok=True)
    for file in _MESSAGES.glob("*.msg"):
        text = file.read_text().replace("Timing timing", "probe_interfaces/Timing timing")
        (messages / file.name).write_text(text)


def probe_packages(folder: Path) -> Path:
    """The two packages for colcon whose rebecs run scripts, made in a folder."""
    config = Config(target="ros2-py")
    package = written(generated(_MODEL, "probe", config), folder, "probe", config)
    shutil.rmtree(package / "probe_interfaces" / "msg")
    write_probe(package / "probe" / "probe", package / "probe_interfaces")
    (package / "probe" / "probe" / "script_node.py").write_text(_MAIN)
    messages = sorted(f.stem for f in (package / "probe_interfaces" / "msg").glob("*.msg"))
    build_file = fill(
        "ros2_py/CMakeLists.txt.j2",
        package="probe_interfaces",
        messages=messages,
        services=(),
        actions=(),
    )
    (package / "probe_interfaces" / "CMakeLists.txt").write_text(build_file)
    return package
