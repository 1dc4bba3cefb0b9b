"""The static semantics of Timed Rebeca: names, types, structure, warnings."""

from __future__ import annotations

from rebsync.static.analysis import Analysis, analyse
from rebsync.static.symbols import ClassInfo, Symbol

__all__ = ["Analysis", "ClassInfo", "Symbol", "analyse"]
