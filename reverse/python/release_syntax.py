"""Syntax of Python that the release has not which runs a package: of rospy, Noetic's 3.8.

A module with such syntax is not imported at all, whatever else it says. `python_requires` of the
package's `setup.py` says that another release runs it.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterator, Mapping

from rebsync.reverse.files.python_files import SETUP
from rebsync.reverse.findings import Finding, Grade
from rebsync.source import Source, Span

_NOETIC = 8  # Python 3.8, the release of REP 3
_ROSPY = re.compile(r"^[ \t]*(?:import|from)[ \t]+rospy\b", re.MULTILINE)
_REQUIRED = re.compile(r"python_requires\s*=\s*[\"'][^\"']*>=\s*3\.(\d+)")
# What a newer release may have brought; most files have none of it.
_NEWER = re.compile(
    r"^[ \t]*(?:match\b.*:|with[ \t]*\(|type[ \t]+\w|@.*[\[(]|(?:def|class)[ \t]+\w+\[)"
    r"|\basync[ \t]+def[ \t]+\w+\[|\bexcept[ \t]*\*|\[[^\]\n]*\*",
    re.MULTILINE,
)


def newer_syntax(sources: Mapping[str, Source], files: Mapping[str, Source]) -> Iterator[Finding]:
    """The first place of each module that the package's release of Python does not take.

    `sources` are the modules, `files` all that the package has.
    """
    if not any(_ROSPY.search(source.text) for source in sources.values()):
        return
    setup = files.get(SETUP)
    required = _REQUIRED.search(setup.text) if setup is not None else None
    minor = max(_NOETIC, int(required[1])) if required is not None else _NOETIC
    for source in sources.values():
        if _NEWER.search(source.text) and (found := _refused(source, minor)) is not None:
            yield found


def _refused(source: Source, minor: int) -> Finding | None:
    """Where one release refuses a module that a newer one takes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ast.parse(source.text)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return None  # it is listed as no Python at all, or is of Python 2
        try:
            ast.parse(source.text, feature_version=(3, minor))
        except SyntaxError as error:
            line = error.lineno or 1
            start = source.start_of(line)
            span = Span(start, start + len(source.line(line)))
            why = f"Python 3.{minor}, which runs this package, has no such syntax"
            hint = "say python_requires in setup.py where another release runs it"
            return Finding(Grade.UNREADABLE, source, span, why, hint)
    return None
