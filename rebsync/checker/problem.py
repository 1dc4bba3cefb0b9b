"""What is to be verified, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from typing import Literal, TypeAlias

from rebsync.checker.exploration import Faults, Limits
from rebsync.checker.steps import Semantics
from rebsync.diagnostics import RebsyncError, did_you_mean
from rebsync.properties import Measure, Properties, TimeBetween
from rebsync.records import dataclass
from rebsync.source import Source
from rebsync.static import Analysis

EngineChoice: TypeAlias = Literal["auto", "interpreted", "compiled"]
Fairness: TypeAlias = Literal["none", "weak", "progress"]


@dataclass(frozen=True, slots=True)
class CodePlace:
    """A place of the code that a model does not say exactly, in words.

    A run passes it in no other `lines` of the model than these; None: in any.
    """

    text: str
    lines: frozenset[int] | None


@dataclass(frozen=True, slots=True)
class TextNumbers:
    """Texts by the numbers that they are in an extracted model.

    `places` are the variables that hold one: a rebec, a server or nothing, and a name.
    """

    texts: tuple[str, ...] = ()
    places: frozenset[tuple[str, str, str]] = frozenset()

    def shown(self, rebec: str, server: str, name: str, value: str) -> str:
        """A value of a variable, a text as such."""
        if (rebec, server, name) not in self.places:
            return value
        number = int(value)
        if number >= 0:
            text = self.texts[number]
            return f'"{text}"' if text[:1] != "\1" else text.rpartition(":")[2]
        return "any other text" if number == -1 else "None"


@dataclass(frozen=True, slots=True)
class Problem:
    """A model without errors, and the properties that it is to have, with their texts.

    Of a model that was extracted `code` has the places by its lines, `unread` what it lacks; what
    is said of it is true of the code under the `assumptions`, and because of `gaps` nothing is
    proved. At the places of `loose` it does more than the code, so that a run need not be one of
    the code. `texts` are those of the code that the model has as numbers.
    """

    source: Source
    analysis: Analysis
    properties: Properties = field(default_factory=Properties)
    property_source: Source | None = None
    assumptions: tuple[str, ...] = ()
    gaps: tuple[str, ...] = ()
    unread: tuple[CodePlace, ...] = ()
    loose: tuple[CodePlace, ...] = ()
    code: Mapping[int, str] = field(default_factory=dict)
    texts: TextNumbers = field(default_factory=TextNumbers)
    measures: tuple[Measure, ...] = ()
    between: tuple[TimeBetween, ...] = ()

    def named(self, names: Sequence[str]) -> Problem:
        """The problem with the properties of these names only; with all where there is no name.

        RebsyncError (RS929): no property is called so.
        """
        if not names:
            return self
        known = [entry.name for entry in self.properties.all]
        for name in names:
            if name not in known:
                hint = did_you_mean(name, known) or f"there is {', '.join(known) or 'none'}"
                path = (self.property_source or self.source).path
                raise RebsyncError.of(path, "RS929", f'no property is called "{name}"', hint)
        return replace(self, properties=self.properties.named(names))

    @property
    def is_measured(self) -> bool:
        """Whether more is asked than what holds."""
        return bool(self.measures or self.between)


LOCAL = "local"


@dataclass(frozen=True, slots=True)
class Cluster:
    """An address that Ray understands, or LOCAL; `workers`, None for one for each processor."""

    address: str
    workers: int | None = None


@dataclass(frozen=True, slots=True)
class Options:
    """How to verify. `semantics` None leaves the view to the model and its properties.

    With `first` the search ends at the first violation; what is not decided then is undetermined.
    With `reduce` or `symmetry` states are reduced so, with `auto_reduce` where that pays.
    """

    semantics: Semantics | None = None
    engine: EngineChoice = "auto"
    limits: Limits = field(default_factory=Limits)
    fairness: Fairness = "none"
    allowed: frozenset[str] = frozenset()
    hash_compaction: bool = False
    threads: int = 1
    reduce: bool = False
    symmetry: bool = False
    auto_reduce: bool = False
    cluster: Cluster | None = None

    def bounded(self, started: float, faults: Faults) -> Options:
        """With bounds that count what was done before the search, too."""
        limits = replace(self.limits, began=started, faults=faults, first=self.first)
        return replace(self, limits=limits)

    first: bool = False
