"""What Python calls to log, and what may be called in what is logged."""

from __future__ import annotations

HARMLESS = frozenset({"str", "repr", "len", "format", "round"})
# By these names alone.
LOOKS = HARMLESS | {
    *("abs", "all", "any", "bool", "enumerate", "isinstance", "list", "sorted", "sum", "tuple"),
    "type",
}
# Functions of Python's mathematics that any number has a value of.
TOTAL = frozenset({"atan", "atan2", "cos", "degrees", "fabs", "hypot", "radians", "sin"})
# What may be asked of what tells the time.
ON_CLOCKS = frozenset({"now", "to_msg", "to_nsec", "to_sec"})
# The methods of a logger of Python's library that only log.
LEVELS = frozenset({"debug", "info", "warning", "error", "critical"})
