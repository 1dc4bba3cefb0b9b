"""Lines, encodings, names and classes of people's nodes are what compilers make of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.reverse.files.reading import chosen
from rebsync.reverse.findings import Grade
from rebsync.reverse.recovery import Extracted, extract

IN_PYTHON = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32

BASES = (object,)


class N:
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.x = 5
        self.pub.publish(self.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
"""
IN_CPP = """#include <ros/ros.h>
#include <std_msgs/Int32.h>

class N {
 public:
  N() {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 1);
    sub_ = nh_.subscribe("inp", 1, &N::cb, this);
  }

  void cb(const std_msgs::Int32::ConstPtr& m) {
    x_ = 5;
    x_ = x_ + 1;
    std_msgs::Int32 msg;
    msg.data = x_;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  ros::spin();
}
"""
PACKAGE = "<package format='2'><name>n</name></package>"
# An edit, and the edit that says the same to every reader.
ALIKE: dict[str, list[tuple[str, str, str | None]]] = {
    "n.py": [
        ("        self.x = 5\n", "        # x\r        self.x = 7\n", "        self.x = 7\n"),
        ("        self.x = 5\n", "        self.x = 5\r\n", "        self.x = 5\n"),
        ("        self.x = 5\n", "        self.x = 5  # x\f\x0b\x85\u2028 self.x = 7\n", None),
        ("#!/usr/bin/env python3\n", "#!/usr/bin/env python3\n# coding: cp1252\n", None),
        ("class N:", "class N(object):", None),
    ],
    "n.cpp": [
        ("    x_ = x_ + 1;\n", "    // x \\ \n    x_ = x_ + 1;\n", ""),
        ("    x_ = x_ + 1;\n", "    // x \\ \t\r\n    x_ = x_ + 1;\n", ""),
        ("    x_ = x_ + 1;\n", "    // x\r    x_ = x_ + 2;\n", "    x_ = x_ + 2;\n"),
        (
            "    x_ = 5;\n",
            "    // x \\\n#if 0\n    x_ = 7;\n    // x \\\n#endif\n",
            "    x_ = 7;\n",
        ),
    ],
}
LISTED = {
    "n.py": [
        ("#!/usr/bin/env python3\n", "# coding: utf-7\n# +AAo-import os\n", "another encoding"),
        ("#!/usr/bin/env python3\n", "# coding: rot13\n", "another encoding"),
        ("self.x = 5", "self.\uff58 = 5", 'for "x"'),
        ("class N:", "class N(*BASES):", "what class this is"),
        ("class N:", "class N(BASES[0]):", "what class this is"),
        ("class N:", "class N(fast=True):", "a metaclass"),
        ("class N:\n", "class N:\n    __slots__ = ('pub',)\n", 'no `__slots__` has "x"'),
    ],
    "n.cpp": [
        ("    x_ = 5;\n", "    // C:\\x\\ \n    x_ = 5;\n", "compilers join this line"),
        ("    x_ = 5;\n", "    // x??/\n    x_ = 5;\n", "trigraphs"),
        ("x_ + 1", "x_ + 1\\\n2", "one token"),
        ("    x_ = 5;\n", "    int \\u00e9 = 5;\n    x_ = 5;\n", "by its number"),
    ],
}
TEXTS = {"n.py": IN_PYTHON, "n.cpp": IN_CPP}


def _extracted(folder: Path, name: str, text: str) -> Extracted:
    folder.mkdir()
    (folder / "package.xml").write_text(PACKAGE, encoding="utf-8")
    (folder / name).write_bytes(text.encode())
    read = chosen(str(folder))
    found = extract(read.files)
    return Extracted(found.model, (*read.findings, *found.findings), found.statements)


@pytest.mark.parametrize(
    ("name", "old", "new", "plain"), [(n, *case) for n, cases in ALIKE.items() for case in cases]
)
def test_a_text_is_what_the_compiler_reads(
    name: str, old: str, new: str, plain: str | None, tmp_path: Path
) -> None:
    text = TEXTS[name]
    assert old in text
    one = _extracted(tmp_path / "one", name, text.replace(old, new))
    other = _extracted(tmp_path / "other", name, text.replace(old, old if plain is None else plain))
    assert one.model == other.model
    assert {f.why for f in one.findings} == {f.why for f in other.findings}


@pytest.mark.parametrize(
    ("name", "old", "new", "why"), [(n, *case) for n, cases in LISTED.items() for case in cases]
)
def test_what_reads_otherwise_is_listed(
    name: str, old: str, new: str, why: str, tmp_path: Path
) -> None:
    text = TEXTS[name]
    assert old in text
    plain = _extracted(tmp_path / "plain", name, text)
    assert all(f.grade is not Grade.UNREADABLE for f in plain.findings)
    found = _extracted(tmp_path / "odd", name, text.replace(old, new)).findings
    assert any(why in f.why for f in found if f.grade is Grade.UNREADABLE)
