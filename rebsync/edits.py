"""Applying certain corrections to a text."""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.diagnostics import Diagnostic, Edit


def apply_edits(text: str, edits: Iterable[Edit]) -> str:
    """The text with the edits made, from the last to the first."""
    for edit in sorted(edits, key=lambda e: e.span.start, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text


def certain_edits(diagnostics: Iterable[Diagnostic]) -> tuple[Edit, ...]:
    """The edits of those corrections that do not touch the same place as an earlier one."""
    chosen: list[Edit] = []
    for diagnostic in sorted(diagnostics, key=lambda d: d.span.start):
        wanted = [edit for edit in diagnostic.edits if edit not in chosen]
        if not any(_touch(new, old) for new in wanted for old in chosen):
            chosen.extend(wanted)
    return tuple(chosen)


def _touch(new: Edit, old: Edit) -> bool:
    return new.span.start <= old.span.end and old.span.start <= new.span.end
