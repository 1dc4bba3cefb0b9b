"""The loop of the language server: requests of an editor are answered by pure functions."""

from __future__ import annotations

import gc

from rebsync.lsp.handlers import actions, names, texts, views
from rebsync.lsp.session import server

ANSWERED = (texts, views, names, actions)  # each registers its answers with the server
_NEVER = 1_000_000  # collections of younger objects before one of all


def serve() -> None:
    """Answers until the editor says that it ends.

    To look through all memory takes as long as to answer: it is done while nobody types.
    """
    gc.enable()
    gc.freeze()
    young, middle, _ = gc.get_threshold()
    gc.set_threshold(young, middle, _NEVER)
    server.start_io()
