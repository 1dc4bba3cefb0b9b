"""Stand-ins of sensors: whether what somebody has made of one plays no more than its sensors still.

Of what a sensor says a node takes only what the model allows, whenever it comes. So a stand-in may
play other values at other times; what it has to do with ROS, and with all else, stays as it was.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from rebsync.reverse.files.compiled_text import LINE_COMMENT
from rebsync.reverse.syntax.py_module import module_of

STAND_IN = re.compile(r"(?:.*/)?\w+_stand_in(?:\.cpp|\.py)?")
# What gets at topics, services, parameters, other programs, and names that only running tells.
_REACHING = re.compile(
    r"(?i)\w*(?:publi|advert|subscri|servic|client|action|broadcast|param|remap|node|init(?!ializer)|signal"
    r"|shutdown|system|popen|exec|fork|kill|attr|global|local|import|eval|compile|open|stream|file"
    r"|socket|thread|async|asm|dlsym|environ|define|include|pragma|using)\w*|[\"']"
)
_REMARKS = {
    False: re.compile(rf"{LINE_COMMENT}|/\*.*?\*/", re.DOTALL),
    True: re.compile(r"#[^\n]*"),
}
_DRAWING = re.compile(
    r"#include <(?:algorithm|array|chrono|cmath|random|vector)>"
    r"|import (?:itertools|math|random|time)|from (?:itertools|math|random) import [\w, ]+"
)


def plays_on(base: str, text: str, *, is_python: bool) -> bool:
    """Whether a stand-in still does nothing but to play its sensors, however it does that."""
    if is_python and module_of(text) is None:
        return False
    before, now = (Counter(_reaching(_REMARKS[is_python].sub("", each))) for each in (base, text))
    return before == now


def _reaching(text: str) -> Iterator[str]:
    """The lines that may have to do with more than with values and times."""
    for line in text.splitlines():
        plain = " ".join(line.split())
        if _REACHING.search(plain) and not _DRAWING.fullmatch(plain):
            yield plain
