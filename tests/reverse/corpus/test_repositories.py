"""The tool as a whole, on a checkout that is made up."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.reverse.corpus import __main__ as tool
from tests.reverse.corpus import repositories
from tests.reverse.corpus.printing import as_data, as_text
from tests.reverse.corpus.values import Json

CODE = """\
#include <ros/ros.h>
#include <std_msgs/Int32.h>

void heard(const std_msgs::Int32& msg) {}

int main(int argc, char** argv) {
  ros::init(argc, argv, "relay");
  ros::NodeHandle node;
  ros::Publisher pub = node.advertise<std_msgs::Int32>(argv[1], 1);
  ros::Subscriber sub = node.subscribe("in", 5, heard);
  ros::spin();
}
"""
FILE = "relay/src/relay.cpp"


def fact(line: int, kind: str, name: str, **keys: Json) -> Json:
    place = {"file": FILE, "line": line, "node_class": "main"}
    return {**place, "kind": kind, "name": name, "type": None, **keys}


FACTS = [
    fact(7, "node", "relay"),
    fact(9, "publisher", "out", depth=1, latched=False) | {"type": "std_msgs/Int32"},
    fact(10, "subscription", "in", depth=6, callback="heard") | {"type": "std_msgs/Int32"},
    fact(11, "client", "add") | {"type": "a/Add"},
]


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with one repository of one package."""
    source = tmp_path / "relays" / FILE
    source.parent.mkdir(parents=True)
    source.write_text(CODE)
    manifest = "<package><name>relay</name></package>\n"
    (tmp_path / "relays" / "relay" / "package.xml").write_text(manifest)
    monkeypatch.setattr(repositories, "PACKAGES", {"relays": ("relay",)})
    monkeypatch.setattr(repositories, "PYTHON", {})
    monkeypatch.setattr(repositories, "ROS2", {})
    monkeypatch.setattr(repositories, "facts_of", lambda _: FACTS)
    return tmp_path


def test_figures_and_differences(checkout: Path) -> None:
    found = list(repositories.results(checkout))
    lines = as_text(found).splitlines()
    assert lines[1].split()[:12] == [
        *("relays", "4", "2", "50.0", "%", "3", "2", "0", "100.0", "%", "1", "33.3")
    ]
    places = [line.strip().split(": ")[:2] for line in lines if FILE in line]
    assert places == [
        [f"{FILE}:9", "open publisher name"],
        [f"{FILE}:10", "wrong detail subscription depth"],
        [f"{FILE}:11", "missed client name"],
    ]


def test_the_same_as_data(checkout: Path) -> None:
    data = as_data(list(repositories.results(checkout, bodies=True)))
    figures = data["repositories"]["relays"]
    assert (figures["facts"], figures["found"], figures["open"]) == (4, 2, 1)
    assert figures["details"]["depth"] == {"right": 1, "open": 0, "wrong": 1}
    assert figures["bodies"]["statements"] > 0
    assert data["all"]["differences"] == figures["differences"]


def test_the_command(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert tool.main([str(checkout), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["all"]["facts"] == 4
    assert tool.main([str(checkout), "--bodies", "--short"]) == 0
    text = capsys.readouterr().out
    assert "unreadable because" in text
    assert FILE not in text
    assert tool.main([str(checkout / "relays")]) == 1
    assert "no checkout of" in capsys.readouterr().err
