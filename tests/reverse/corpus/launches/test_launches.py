"""The comparison of launch files, on one that is made up; and the facts, by their form."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.reverse.corpus.launches import __main__ as tool
from tests.reverse.corpus.values import Json

FILE = "robots/launch/a.launch.py"
TEXT = """\
from launch import LaunchDescription
def generate_launch_description():
    path = os.path.join(get_package_share_directory('robots'), 'config', 'p.yaml')
    return LaunchDescription([
        Node(package='robots', executable='robot', name='r', parameters=[path, {'x': 1}]),
        Node(package='robots', executable='other', parameters=[{'y': f()}]),
    ])
"""


def fact(type_: str, name: str | None, files: list[str], **parameters: Json) -> Json:
    return {
        "file": FILE,
        "package": "robots",
        "type": type_,
        "name": name,
        "namespace": "/",
        "parameters": parameters,
        "files": files,
        "remaps": {},
        "if": False,
    }


FACTS = [fact("robot", "r", ["config/p.yaml"], x=1), fact("other", None, [], y=2)]


def test_the_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in (
        (FILE, TEXT),
        ("robots/package.xml", "<package><name>robots</name></package>"),
        ("robots/config/p.yaml", "r:\n  ros__parameters: {a: 1}\n"),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    facts = tmp_path / "facts.json"
    facts.write_text(json.dumps(FACTS))
    monkeypatch.setattr(tool, "FACTS", facts)
    assert tool.main([str(tmp_path)]) == 0
    shown = capsys.readouterr().out.splitlines()
    assert shown[0] == "nodes 2, found 2, right 1"
    assert shown[2].startswith("answer") and '"parameters": {"y": null}' in shown[2]
    assert tool.main([str(tmp_path / "robots")]) == 1
    assert "none of the launch files" in capsys.readouterr().err


def test_facts_have_their_keys() -> None:
    for one in json.loads(tool.FACTS.read_text(encoding="utf-8")):
        assert one.keys() == FACTS[0].keys()
