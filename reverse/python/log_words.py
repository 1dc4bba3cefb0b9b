"""What Python calls to log, and what may be called in what is logged."""

from __future__ import annotations

import re

LOGS = re.compile(
    r"(?:rospy\.log\w+|(?:\w+\.)*get_logger\([^()]*\)\.\w+|print"
    r"|logging\.(?:getLogger\([^()]*\)\.)?\w+|(?:self\.)?_?log(?:ger)?\.\w+)\Z"
)
HARMLESS = frozenset({"str", "repr", "len", "format", "round"})
LOOKS = HARMLESS | {"abs", "bool", "list", "sorted", "sum", "tuple"}  # by these names alone
# What tells the time, and what may be asked of that.
CLOCKS = frozenset(
    {
        *("rospy.Time.now", "rospy.get_rostime", "rospy.get_time", "self.get_clock"),
        *("time.monotonic", "time.time"),
    }
)
ON_CLOCKS = frozenset({"now", "to_msg", "to_nsec", "to_sec"})
