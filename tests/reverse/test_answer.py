"""What is told of a package as one object: what its nodes ask of ROS, with places."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema  # type: ignore[import-untyped]

from rebsync.reverse.answer import answer
from rebsync.reverse.files.reading import packages
from tests.consoles import ROOT

SCHEMA = json.loads((ROOT / "docs" / "extract.schema.json").read_text(encoding="utf-8"))
CALLER = """\
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "caller");
  ros::NodeHandle node("~");
  std::string name;
  node.getParam(argv[1], name);
  ros::service::waitForService("add");
}
"""
NODES = """\
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Talker {
 public:
  Talker() {
    pub_ = nh_.advertise<std_msgs::Int32>("count", 5, true);
    sub_ = nh_.subscribe("reset", 1, &Talker::reset, this);
    nh_.param("period", period_, 0.5);
    timer_ = nh_.createTimer(ros::Duration(period_), &Talker::tick, this);
  }

 private:
  void reset(const std_msgs::Int32& msg) { count_ = msg.data; }
  void tick(const ros::TimerEvent&) {
    std_msgs::Int32 out;
    out.data = ++count_;
    pub_.publish(out);
  }

  ros::NodeHandle nh_{"~"};
  ros::Publisher pub_;
  ros::Subscriber sub_;
  ros::Timer timer_;
  double period_ = 1.0;
  int count_ = 0;
};
"""


def told(path: Path) -> dict[str, Any]:
    """The object for a package or file; the schema allows it."""
    (given,) = packages([str(path)])
    found: dict[str, Any] = json.loads(answer(given, None, whole=True).whole)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
    return found


def test_what_nodes_ask_of_ros(tmp_path: Path) -> None:
    source = tmp_path / "talker" / "src" / "talker.h"
    source.parent.mkdir(parents=True)
    source.write_text(NODES)
    other = source.with_name("main.cpp")
    other.write_text('#include "talker.h"\nint main(int c, char** v) { ros::init(c, v, "t"); }\n')
    manifest = "<package><name>talker</name></package>\n"
    (tmp_path / "talker" / "package.xml").write_text(manifest)
    found = told(tmp_path / "talker")
    place = {"file": str(source), "within": "Talker"}
    (publisher,) = found["publishers"]
    assert publisher == {
        **place,
        "line": 7,
        "kept": "pub_",
        "topic": "~count",
        "type": "std_msgs/Int32",
        "depth": 5,
        "latched": True,
    }
    (subscription,) = found["subscriptions"]
    assert (subscription["topic"], subscription["line"]) == ("~reset", 8)
    assert subscription["callback"]["function"] == "Talker::reset"
    (parameter,) = found["parameters"]
    assert (parameter["name"], parameter["access"], parameter["default"]) == ("~period", "get", 0.5)
    (timer,) = found["timers"]
    assert timer["period"] == {"parameter": "~period", "default": 0.5}
    assert (timer["one_shot"], timer["callback"]["function"]) == (False, "Talker::tick")
    assert [n["name"] for n in found["nodes"]] == ["t"]
    assert found["unknowns"] == []


def test_one_file_tells_what_it_asks_itself(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "talker.h").write_text(NODES)
    (tmp_path / "caller.cpp").write_text(CALLER)
    found = told(tmp_path / "caller.cpp")
    assert (found["publishers"], len(found["nodes"])) == ([], 1)


def test_what_is_not_known(tmp_path: Path) -> None:
    (tmp_path / "caller.cpp").write_text(CALLER)
    found = told(tmp_path / "caller.cpp")
    assert (found["package"], found["file"], found["model"]) == (None, "caller.cpp", None)
    (parameter,) = found["parameters"]
    (unknown,) = found["unknowns"]
    assert (unknown["of"], unknown["key"]) == ("parameters", "name")
    assert unknown["call"] == {"file": parameter["file"], "line": 7}
    assert parameter["name"]["unknown"] == unknown["unknown"] != ""
