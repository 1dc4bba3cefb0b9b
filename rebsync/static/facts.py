"""What one analysis gathers while it goes through a model."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import field
from difflib import get_close_matches
from enum import Enum
from typing import NamedTuple

from rebsync.diagnostics import Diagnostic, Edit, Severity
from rebsync.model import (
    Annotation,
    Call,
    Constructor,
    Expression,
    Interface,
    MessageServer,
    Method,
    Name,
    ReactiveClass,
    Type,
)
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static.constants import Value, constant
from rebsync.static.symbols import (
    ClassInfo,
    ConstructorInfo,
    EnvSymbol,
    MethodSymbol,
    RebecSymbol,
    ServerSymbol,
    Symbol,
    Variable,
)

# Looking for close words is the one thing here that costs more than linear time.
_COMPARISONS = 20_000

# What has no near name may have been declared in text that could not be read.
_LOST_DECLARATIONS = frozenset(("RS201", "RS204"))


class Use(Enum):
    """How a body uses a variable."""

    READ = "read"
    WRITE = "write"


class Access(NamedTuple):
    """A variable is read or written."""

    use: Use
    symbol: Variable
    span: Span


class Invocation(NamedTuple):
    """A local method runs here and now."""

    symbol: MethodSymbol
    call: Call


class Send(NamedTuple):
    """A message is sent, to the rebec itself or through an expression of class `receiver`."""

    symbol: ServerSymbol
    call: Call
    receiver: str
    to_self: bool


class Delay(NamedTuple):
    """Time passes in the body."""

    call: Call


class Move(NamedTuple):
    """The robot moves: a `@Move` of the right form."""

    annotation: Annotation


Event = Access | Invocation | Send | Delay | Move

# After these mistakes it is open what is used.
_LOSING = frozenset(
    ("RS201", "RS203", "RS204", "RS205", "RS211", "RS212", "RS310", "RS311", "RS318", "RS319")
)


@dataclass(slots=True)
class BodyFacts:
    """What a constructor, message server or method does, in textual order."""

    owner: ClassInfo
    declaration: Constructor | MessageServer | Method
    events: list[Event] = field(default_factory=list)


@dataclass(slots=True)
class Facts:
    """The growing results of an analysis."""

    fragment: bool = False
    incomplete: bool = False
    observed: frozenset[str] = frozenset()
    diagnostics: list[Diagnostic] = field(default_factory=list)
    types: dict[int, Type] = field(default_factory=dict)
    symbols: dict[int, Symbol] = field(default_factory=dict)
    declared: dict[str, ReactiveClass | Interface] = field(default_factory=dict)
    classes: dict[str, ClassInfo] = field(default_factory=dict)
    infos: list[ClassInfo] = field(default_factory=list)
    env: dict[str, EnvSymbol] = field(default_factory=dict)
    rebecs: dict[str, RebecSymbol] = field(default_factory=dict)
    constructors: dict[int, ConstructorInfo] = field(default_factory=dict)
    priority: Annotation | None = None
    bodies: list[BodyFacts] = field(default_factory=list)
    outside: list[Access] = field(default_factory=list)
    comparisons: int = _COMPARISONS

    def error(
        self,
        code: str,
        span: Span,
        message: str,
        hint: str | None = None,
        *,
        edits: tuple[Edit, ...] = (),
        related: tuple[tuple[Span, str], ...] = (),
    ) -> None:
        """Records a mistake of the model."""
        self.diagnostics.append(Diagnostic(code, span, message, hint, edits, related))

    def warn(
        self,
        code: str,
        span: Span,
        message: str,
        hint: str | None = None,
        *,
        related: tuple[tuple[Span, str], ...] = (),
        severity: Severity = Severity.WARNING,
    ) -> None:
        """Records a weakness of a model that is accepted."""
        self.diagnostics.append(
            Diagnostic(code, span, message, hint, related=related, severity=severity)
        )

    def unknown(
        self,
        code: str,
        span: Span,
        message: str,
        word: str,
        legal: Collection[str],
        hint: str | None = None,
        *,
        certain: bool = False,
    ) -> None:
        """Reports a name that is not declared, with the legal name nearest to it.

        The only near name is a certain correction when the words differ in letter case and
        underscores only, or when the caller says so.
        """
        close = self._close(word, legal)
        if self.incomplete and not close and code in _LOST_DECLARATIONS:
            return
        sure = len(close) == 1 and (certain or _folded(word) == _folded(close[0]))
        edits = (Edit(span, close[0]),) if sure else ()
        advice = f'did you mean "{close[0]}"?' if close else hint
        self.error(code, span, message, advice, edits=edits)

    def _close(self, word: str, legal: Collection[str]) -> list[str]:
        self.comparisons -= len(legal)
        if self.comparisons < 0:
            return []
        folded = {w.casefold(): w for w in sorted(legal, reverse=True) if w != word}
        return [folded[w] for w in get_close_matches(word.casefold(), folded, n=2, cutoff=0.7)]

    def value(self, expression: Expression) -> Value | None:
        """The value of a constant expression, in which `env` constants may occur."""
        return constant(expression, self._env_value)

    def _env_value(self, name: Name) -> Value | None:
        symbol = self.symbols.get(id(name))
        return symbol.value if isinstance(symbol, EnvSymbol) else None

    @property
    def knows_uses(self) -> bool:
        """Whether all uses of names are known, so that an unused one can be told."""
        if self.incomplete or any(info.partial for info in self.infos):
            return False
        return not any(d.code in _LOSING for d in self.diagnostics)

    def note_type(self, expression: Expression, type_: Type | None) -> Type | None:
        """Remembers the static type of an expression."""
        if type_ is not None:
            self.types[id(expression)] = type_
        return type_


def _folded(word: str) -> str:
    return word.replace("_", "").casefold()
