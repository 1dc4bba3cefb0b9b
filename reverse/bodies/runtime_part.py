"""The run-time part of generated classes among the files of a package."""

from __future__ import annotations

from pathlib import PurePosixPath

from rebsync.reserved import RUNTIME_HEADERS
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp


def runtime_part(code: Code, generated: bool) -> list[Cpp]:
    """Its headers, if there are `generated` classes: what they do is known by their text."""
    mailboxes = code.all_classes.get("Mailbox", ()) if generated else ()
    folders = {PurePosixPath(c.cpp.source.path).parent for c in mailboxes}
    return [c for c in code.files if _is_of(PurePosixPath(c.source.path), folders)]


def _is_of(header: PurePosixPath, folders: set[PurePosixPath]) -> bool:
    return header.parent in folders and header.stem in RUNTIME_HEADERS
