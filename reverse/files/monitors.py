"""Which files are those of a generated monitor: it only listens, and no model describes it."""

from __future__ import annotations

import re

from rebsync.reserved import MONITOR_FILES
from rebsync.source import Source

_CODE = re.compile(rf"(?:^|/)({'|'.join(MONITOR_FILES)})(?:\.(?:h|hpp|cpp|py))?\Z")
_LAUNCH = re.compile(r"(?:^|/)monitor\.launch(?:\.py)?\Z")
_STARTED = re.compile(r"<(?:node|include)\b|\b(?:Node|IncludeLaunchDescription)\(")
# What each has that people's of that name lack.
_SIGNS = {
    "monitor_machine": ("def outcomes(", "outcomes(const Model& model,"),
    "monitor_model": ("MODEL = Model(", "Model theModel() {"),
    "monitor_node": ("Watch(MODEL,", "watch_(monitoring::theModel(),"),
    "monitor_run": ("class Watch:", "class Watch {"),
}


def is_monitor(name: str, source: Source) -> bool:
    """Whether a file belongs to a generated monitor; a launch file that starts more does not."""
    if _LAUNCH.search(name) is not None:
        started = _STARTED.findall(source.text)
        return len(started) == 1 and re.search(r"monitor_node\b", source.text) is not None
    found = _CODE.search(name)
    return found is not None and any(sign in source.text for sign in _SIGNS[found[1]])
