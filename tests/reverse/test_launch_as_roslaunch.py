"""Random launch files: roslaunch itself, loaded but not started, has the same nodes and values.

What roslaunch refuses has at least one unknown here, and what has none here it takes.
"""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest

from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.launch.parameters import ParameterValue, Struct
from rebsync.reverse.unknowns import Open
from rebsync.source import Source
from tests.reverse.random_launch import Writer
from tests.ros1.workspace import SYSTEM_PATH, SYSTEM_PYTHON, missing_ros

_SEEDS = range(400)
_REASON = missing_ros()
pytestmark = [
    pytest.mark.ros1,
    pytest.mark.skipif(
        _REASON is not None and os.environ.get("CI") != "true", reason=_REASON or ""
    ),
]
# run by the Python of the system, which has roslaunch
_LOADER = """
import contextlib, io, json, sys
import roslaunch.config, roslaunch.xmlloader

def loaded(path):
    loader = roslaunch.xmlloader.XmlLoader()
    loader.ignore_unset_args = False
    config = roslaunch.config.ROSLaunchConfig()
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            loader.load(path, config, argv=[path], verbose=False)
    except Exception as error:
        return None
    nodes = [[n.namespace + n.name, n.package, n.type, n.remap_args] for n in config.nodes]
    return [nodes, {key: p.value for key, p in config.params.items()}]

for line in sys.stdin:
    print(json.dumps(loaded(line.strip())))
"""


def read(path: Path) -> Launch:
    def load(name: str) -> Source | None:
        file = Path(name)
        return Source(name, file.read_text(encoding="utf-8")) if file.is_file() else None

    return read_launch(Source(str(path), path.read_text(encoding="utf-8")), Surroundings(load))


@pytest.fixture(scope="module")
def cases(tmp_path_factory: pytest.TempPathFactory) -> dict[Path, Any]:
    """Random launch files, each with what roslaunch makes of it; None where it refuses."""
    paths = []
    for seed in _SEEDS:
        folder = tmp_path_factory.mktemp("launch")
        writer = Writer(seed)
        (folder / "main.launch").write_text(writer.file(), encoding="utf-8")
        for name, text in writer.included.items():
            (folder / name).write_text(text, encoding="utf-8")
        paths.append(folder / "main.launch")
    done = subprocess.run(
        [SYSTEM_PYTHON, "-c", _LOADER],
        input="\n".join(map(str, paths)),
        env={"PATH": SYSTEM_PATH, "HOME": str(paths[0].parent), "LANG": "C.UTF-8"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return dict(zip(paths, map(json.loads, done.stdout.splitlines()), strict=True))


def _flat(name: str, value: object) -> dict[str, object]:
    if isinstance(value, dict):
        return {k: v for n, inner in value.items() for k, v in _flat(f"{name}/{n}", inner).items()}
    return {name: value}


def _plain(value: ParameterValue | Open) -> object:
    match value:
        case Struct(entries):
            return {k: _plain(v) for k, v in entries}
        case tuple():
            return [_plain(v) for v in value]
        case _:
            return value


def test_both_have_the_same(cases: dict[Path, Any]) -> None:
    compared = 0
    for path, expected in cases.items():
        found = read(path)
        if found.unknowns:
            continue
        assert expected is not None, f"{path}: roslaunch refuses it"
        nodes, parameters = expected
        assert [
            [n.path, n.package, n.type, [[r.private, r.target] for r in n.remaps]]
            for n in found.nodes
        ] == nodes, path
        values = {p.name: _plain(p.value) for p in found.parameters}
        for node in found.nodes:
            values |= {f"{node.path}/{p.name}": _plain(p.value) for p in node.parameters}
        flat = {k: v for name, value in parameters.items() for k, v in _flat(name, value).items()}
        assert repr(sorted(values.items())) == repr(sorted(flat.items())), path
        compared += 1
    assert compared > len(_SEEDS) // 3


def test_what_roslaunch_refuses_is_noted(cases: dict[Path, Any]) -> None:
    refused = [path for path, expected in cases.items() if expected is None]
    assert refused
    assert [path for path in refused if not read(path).unknowns] == []
