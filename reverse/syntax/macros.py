"""Macros that calls may be: some are known to do nothing to a node, others may hide anything."""

from __future__ import annotations

import re

from rebsync.reverse.libraries.cpp import macros

_MACRO = re.compile(r"[A-Z][A-Z0-9_]+\Z")
_HARMLESS = re.compile(
    r"CONSOLE_BRIDGE_(?:DEBUG|INFO|WARN|ERROR|FATAL|LOG)"
    r"|(?:BOOST|EIGEN|Q|RCUTILS)_(?:ASSERT|BREAK|STATIC_ASSERT|UNUSED|CHECK_ARGUMENT)"
    r"|(?:ASSERT|EXPECT)_[A-Z_]+\Z|STATIC_ASSERT|SUCCEED\Z|ADD_FAILURE\Z|UNUSED|LOG\Z|VLOG|DLOG"
    r"|PLUGINLIB_|CLASS_LOADER_|SIGNAL\Z|SLOT\Z|TRACE|UINT\d+_C\Z|INT\d+_C\Z"
)


def hides(name: str) -> bool:
    """Whether a call of this name may be a macro that hides statements: names of capitals are.

    Not those that only log or check, as far as they are known.
    """
    if _MACRO.match(name) is None or name.startswith(macros()):
        return False
    return _HARMLESS.match(name) is None
