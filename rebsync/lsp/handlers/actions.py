"""What an editor offers to change: certain corrections, and `rebsync sync` after drift."""

from __future__ import annotations

import asyncio
import sys

from lsprotocol import types as lsp

from rebsync.lsp.drift import SYNC, belongs_to, sync_actions, sync_command
from rebsync.lsp.findings import quick_fixes
from rebsync.lsp.session import RebsyncServer, server


@server.feature(
    lsp.TEXT_DOCUMENT_CODE_ACTION,
    lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix, lsp.CodeActionKind.SourceFixAll]),
)
def code_action(ls: RebsyncServer, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    uri = params.text_document.uri
    document = ls.documents.document(uri)
    fixes = quick_fixes(document, params.range) if document is not None else ()
    drifts = (sync_actions(drift, uri, params.range) for drift in ls.drifts.values())
    return [*fixes, *(action for actions in drifts for action in actions)]


@server.command(SYNC)
async def sync(ls: RebsyncServer, root: str, favour: str) -> None:
    """Runs `rebsync sync` on a package whose open texts are saved, and says what it says."""
    if unsaved := [path for path in ls.unsaved() if belongs_to(path, root)]:
        message = f"save {', '.join(sorted(unsaved))} first"
        ls.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Warning, message))
        return
    done = await asyncio.create_subprocess_exec(
        *(sys.executable, "-m", "rebsync", *sync_command(root, favour)),
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
    )
    said, _ = await done.communicate()
    kind = lsp.MessageType.Info if done.returncode == 0 else lsp.MessageType.Warning
    lines = said.decode(errors="replace").splitlines()  # editors show one line
    message = "; ".join(filter(None, map(str.strip, lines)))
    ls.window_show_message(lsp.ShowMessageParams(kind, message))
    await ls.check(root)
