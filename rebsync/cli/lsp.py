"""`rebsync lsp`: the language server."""

from __future__ import annotations

from importlib.util import find_spec

import click

from rebsync.cli.status import Status
from rebsync.diagnostics import RebsyncError


@click.command("lsp")
def command() -> Status:
    """Serve an editor over standard input and output, in the Language Server Protocol.

    Editors start it. Models and property files are checked as they are typed; code of a package
    when it is saved.
    """
    if find_spec("pygls") is None:
        hint = "pip install 'rebsync[lsp]'"
        raise RebsyncError.of("pygls", "RS816", "the language server needs this library", hint)
    from rebsync.lsp.server import serve

    serve()
    return Status.CLEAN
