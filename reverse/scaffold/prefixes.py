"""Commands before that of a node which only say how its process runs: priority, window, checks."""

from __future__ import annotations

import re
import shlex

_CHECK = r"(?:-q|-v|--leak-check=(?:no|summary|yes|full)|--track-origins=(?:yes|no))"
# What each may be given, its words joined by blanks. What may fail to start the node is left out:
# real-time classes need rights, debuggers start no scripts.
_TOOLS = {
    "nice": re.compile(r"(?:-n -?\d{1,2})?"),
    "ionice": re.compile(r"(?:-c (?:3|idle)|(?:-c (?:2|best-effort) ?)?(?:-n [0-7])?)"),
    "xterm": re.compile(r"(?:-hold )?(?:-(?:T|title) [\w.:-]+ )?-e"),
    "valgrind": re.compile(rf"(?:{_CHECK}(?: {_CHECK})*)?"),
}


def is_harmless(prefix: str) -> bool:
    """Whether a node that is started behind these words does what it does without them."""
    try:
        words = shlex.split(prefix)
    except ValueError:
        return False
    if not words:
        return True
    tool, *given = words
    is_plain = not any(re.search(r"\s", word) or not word for word in given)
    pattern = _TOOLS.get(tool)
    return is_plain and pattern is not None and pattern.fullmatch(" ".join(given)) is not None
