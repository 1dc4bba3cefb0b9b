"""Findings of `rebsync lint` as diagnostics and quick fixes of the protocol."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from rebsync.diagnostics import Diagnostic, Severity
from rebsync.edits import certain_edits
from rebsync.lsp.document import Document, ModelDocument, Text

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}


def diagnostics(document: Document, *, exact: bool = False) -> list[lsp.Diagnostic]:
    """What is wrong with a document; `exact` is as `rebsync lint` says it, whatever it takes."""
    found = document.findings
    if exact and isinstance(document, ModelDocument):
        found = document.exact_findings
    return [as_diagnostic(document, each) for each in found]


def as_diagnostic(text: Text, found: Diagnostic) -> lsp.Diagnostic:
    """A finding whose places are those of the text."""
    related = [
        lsp.DiagnosticRelatedInformation(lsp.Location(text.uri, text.text_range(span)), remark)
        for span, remark in found.related
    ]
    return lsp.Diagnostic(
        text.text_range(found.span),
        f"{found.message}\n{found.hint}" if found.hint else found.message,
        severity=_SEVERITIES[found.severity],
        code=found.code,
        source="rebsync",
        related_information=related or None,
    )


def quick_fixes(document: Document, at: lsp.Range) -> Iterator[lsp.CodeAction]:
    """The certain corrections at a range, and all of the document where there are several."""
    for found in document.findings:
        place = document.text_range(found.span)
        if found.edits and place.start <= at.end and at.start <= place.end:
            title = found.hint or f"Correct: {found.message}"
            yield _fix(document, title, (found,), lsp.CodeActionKind.QuickFix)
    every = tuple(found for found in document.findings if found.edits)
    if len(every) > 1:
        yield _fix(document, "Make all certain corrections", every, lsp.CodeActionKind.SourceFixAll)


def _fix(
    document: Document, title: str, found: tuple[Diagnostic, ...], kind: lsp.CodeActionKind
) -> lsp.CodeAction:
    edits = [
        lsp.TextEdit(document.text_range(edit.span), edit.text) for edit in certain_edits(found)
    ]
    return lsp.CodeAction(
        title,
        kind=kind,
        diagnostics=[as_diagnostic(document, each) for each in found],
        edit=lsp.WorkspaceEdit(changes={document.uri: edits}),
    )
