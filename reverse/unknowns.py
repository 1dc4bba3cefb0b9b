"""What the files of a package leave open: why, and in which place."""

from __future__ import annotations

from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.source import Source, Span


@dataclass(frozen=True, slots=True)
class Open:
    """Stands where a value would: the reason why it cannot be known."""

    why: str


Text: TypeAlias = "str | Open"


@dataclass(frozen=True, slots=True)
class Unknown:
    """What cannot be known or read, the reason, and the place that makes it so."""

    what: str
    why: str
    source: Source
    span: Span

    def __str__(self) -> str:
        position = self.source.position(self.span.start)
        return f"{self.source.path}:{position.line}:{position.column}: {self.what}: {self.why}"
