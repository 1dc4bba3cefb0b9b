"""What is too large to be kept in every state of a search."""

from __future__ import annotations

from rebsync.checker.lowering.emitter import size_of
from rebsync.diagnostics import Diagnostic
from rebsync.model import Type, walk
from rebsync.static import Analysis

LARGEST = 100_000  # elements of an array, and of all state variables of a rebec


def check_sizes(analysis: Analysis) -> tuple[Diagnostic, ...]:
    """Types and classes of which a state would hold more than LARGEST values."""
    hint = f"at most {LARGEST:,} are checked: model what the properties are about"
    found = [
        Diagnostic("RS927", node.span, f"{size_of(node):,} elements are too many to check", hint)
        for node in walk(analysis.model)
        if isinstance(node, Type) and size_of(node) > LARGEST
    ]
    for info in analysis.classes.values():
        size = sum(size_of(s.type) for s in info.state if s.type is not None)
        if size > LARGEST and not found:
            message = f"{size:,} values in the state of a rebec are too many to check"
            found.append(Diagnostic("RS927", info.declaration.name_span, message, hint))
    return tuple(found)
