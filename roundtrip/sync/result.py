"""What a sync is going to write."""

from __future__ import annotations

from dataclasses import field

from rebsync.diagnostics import Findings
from rebsync.records import dataclass
from rebsync.roundtrip.merge.code import Stages
from rebsync.roundtrip.package.model_file import properties_beside
from rebsync.roundtrip.verdict.result import CheckResult


@dataclass(frozen=True, slots=True)
class Sync:
    """What is to be written so that a package and its model are in step.

    `model_text`, that of the `properties` beside it and `texts` are those that change (None: the
    file goes), `records` all of `.rebsync/`. `conflicts` are left to decide, by path from the
    package or `""` for the model; then both sides are in the texts, between markers. With `refused`
    nothing is to be written.
    `findings` are places of the code that are not known exactly, or where it `is_joined_otherwise`,
    which is known to differ and which no model tells.
    """

    checked: CheckResult
    model_text: str | None = None
    texts: dict[str, str | None] = field(default_factory=dict)
    records: dict[str, str | None] = field(default_factory=dict)
    conflicts: dict[str, Stages] = field(default_factory=dict)
    findings: tuple[Findings, ...] = ()
    refused: tuple[Findings, ...] = ()
    is_undetermined: bool = False
    properties: str | None = None
    is_joined_otherwise: bool = False

    @property
    def changes(self) -> bool:
        """Whether a model or code is to change."""
        return bool(self.beside) or bool(self.texts)

    @property
    def beside(self) -> dict[str, str]:
        """The texts that change outside of the package, by their paths."""
        told = {self.checked.model: self.model_text}
        if (path := properties_beside(self.checked.model)) is not None:
            told[path] = self.properties
        return {path: text for path, text in told.items() if text is not None}
