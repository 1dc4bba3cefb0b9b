"""What Python calls to log, and what may be called in what is logged."""

from __future__ import annotations

import re

LOGS = re.compile(
    r"(?:rospy\.log\w+|(?:\w+\.)*get_logger\([^()]*\)\.\w+|print"
    r"|logging\.(?:getLogger\([^()]*\)\.)?\w+|_?log(?:ger)?\.\w+)\Z"
)
HARMLESS = frozenset({"str", "repr", "len", "format", "round"})
