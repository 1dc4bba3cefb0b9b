"""A user's mistakes as values: code, severity, place, message, hint, certain corrections."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from enum import Enum

from rebsync.records import dataclass
from rebsync.source import NOWHERE, Source, Span


class Severity(Enum):
    """How much a finding weighs: an error stops the command, a warning does not."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Edit:
    """Replace the text of `span` by `text`."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding in one text.

    `edits` is the correction when there is exactly one that is certain; `rebsync lint --fix`
    applies it. `related` are further places, each with a remark.
    """

    code: str
    span: Span
    message: str
    hint: str | None = None
    edits: tuple[Edit, ...] = ()
    related: tuple[tuple[Span, str], ...] = ()
    severity: Severity = Severity.ERROR


@dataclass(frozen=True, slots=True)
class Findings:
    """The diagnostics of one source text."""

    source: Source
    diagnostics: tuple[Diagnostic, ...]

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        return tuple(d for d in self.diagnostics if d.severity is Severity.ERROR)


class RebsyncError(Exception):
    """What a command cannot go on from; carries the findings to print."""

    def __init__(self, findings: Iterable[Findings]) -> None:
        super().__init__("a command ends with these findings")
        self.findings = tuple(findings)

    @classmethod
    def of(cls, path: str, code: str, message: str, hint: str | None = None) -> RebsyncError:
        """An error about a whole file, directory or option."""
        return cls([Findings(Source(path, ""), (Diagnostic(code, NOWHERE, message, hint),))])


def did_you_mean(word: str, known: Iterable[str]) -> str | None:
    """The hint `did you mean "x"?` for a close misspelling of a known word."""
    close = closest(word, known)
    return f'did you mean "{close}"?' if close else None


def closest(word: str, known: Iterable[str]) -> str | None:
    """The known word nearest to `word`, if one is near; letter case counts least."""
    words = sorted(set(known) - {word})
    folded = {w.casefold(): w for w in reversed(words)}
    match = get_close_matches(word.casefold(), folded, n=1, cutoff=0.7)
    return folded[match[0]] if match else None
