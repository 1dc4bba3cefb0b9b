"""Names that a module of Python uses and that nothing there binds: it cannot run."""

from __future__ import annotations

import builtins
import re
import symtable
from collections.abc import Iterator

from rebsync.source import Source, Span

_OF_MODULES = frozenset({"__builtins__", "__file__", "__name__", "__path__", "__spec__"})
_BINDS = (symtable.Symbol.is_assigned, symtable.Symbol.is_imported, symtable.Symbol.is_namespace)


def unbound_names(source: Source) -> Iterator[tuple[Span, str]]:
    """The names that a module of Python uses and that neither it nor Python defines.

    SyntaxError, ValueError, RecursionError: Python does not take the module.
    """
    whole = symtable.symtable(source.text, source.path, "exec")
    tables = list(_below(whole))
    if re.search(r"^\s*from\s+\S+\s+import\s*\(?\s*\*", source.text, re.MULTILINE):
        return  # which names that binds is not known here
    bound = {s.get_name() for s in whole.get_symbols() if any(is_(s) for is_ in _BINDS)}
    bound |= {
        s.get_name()
        for table in tables
        for s in table.get_symbols()
        if s.is_declared_global() and s.is_assigned()
    }
    known = bound | {*dir(builtins), *_OF_MODULES}
    used = {s.get_name() for t in (whole, *tables) for s in t.get_symbols() if _is_global(s, t)}
    for name in sorted(used - known):
        found = re.search(rf"\b{re.escape(name)}\b", source.text)
        start = found.start() if found is not None else 0
        yield Span(start, start + len(name)), name


def _below(table: symtable.SymbolTable) -> Iterator[symtable.SymbolTable]:
    for child in table.get_children():
        if child.get_type() in ("class", "function"):
            yield child
            yield from _below(child)


def _is_global(symbol: symtable.Symbol, table: symtable.SymbolTable) -> bool:
    return symbol.is_referenced() and (symbol.is_global() or table.get_type() == "module")
