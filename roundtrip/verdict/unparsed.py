"""What is told of code that does not parse: the mistake, and not what seems to differ for it.

A `;` that is missing may make one statement of two, a brace may make another class of the rest of
a file. The verdict stays as it is, and what else is to be told is told when the code parses.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Findings
from rebsync.records import dataclass
from rebsync.roundtrip.package.models import read_code
from rebsync.roundtrip.verdict.drift import Mover
from rebsync.roundtrip.verdict.missing_sources import is_mistake
from rebsync.roundtrip.verdict.result import CheckResult
from rebsync.source import Source, SourceSpan, Span

if TYPE_CHECKING:
    from rebsync.roundtrip.diff.difference import Difference, Place

_PLAIN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
_FOLLOWING = frozenset({"RS941", "RS942", "RS947", "RS956"})
_WHOLE = frozenset({"reactiveclass", "interface", "rebec"})


def as_far_as_parsed(checked: CheckResult) -> CheckResult:
    """The same without what is only told because some of the code does not parse."""
    mistakes = tuple(_mistakes(checked))
    if not mistakes or checked.drift is None:
        return checked
    code = read_code(checked.package, checked.state).given.model
    hidden = _Hidden(tuple(_bodies(code)), mistakes, tuple(_lost(code, mistakes)))
    told = tuple(
        (d, mover)
        for d, mover in checked.drift.differences
        if mover is Mover.MODEL or not hidden.difference(d)
    )
    findings = tuple(found for f in checked.findings if (found := hidden.left(f)).diagnostics)
    return replace(checked, drift=replace(checked.drift, differences=told), findings=findings)


@dataclass(frozen=True, slots=True)
class _Mistake:
    """A place where code does not parse."""

    source: Source
    span: Span

    def is_at(self, source: Source, span: Span) -> bool:
        """Whether a place is in the line of the mistake, or in one beside it."""
        if source.path != self.source.path:
            return False
        first, last = (
            source.position(at).line for at in (span.start, max(span.start, span.end - 1))
        )
        line = self.source.position(self.span.start).line
        return first - 1 <= line <= last + 1


def _mistakes(checked: CheckResult) -> Iterator[_Mistake]:
    for found in checked.findings:
        for diagnostic in found.diagnostics:
            if is_mistake(diagnostic):
                yield _Mistake(found.source, diagnostic.span)


def _bodies(code: m.Model) -> Iterator[SourceSpan]:
    """The places of functions of the model in the code."""
    for each in code.classes:
        for member in each.servers if isinstance(each, m.Interface) else each.members:
            if isinstance(member.span, SourceSpan):
                yield member.span


@dataclass(frozen=True, slots=True)
class _Lost:
    """A class in a file in which braces do not match; empty for what nobody knows the class of."""

    name: str
    paths: frozenset[str]


def _lost(code: m.Model, mistakes: tuple[_Mistake, ...]) -> Iterator[_Lost]:
    """The classes that have a part in files of which nobody knows what belongs to what."""
    broken = {k.source.path for k in mistakes if not _is_balanced(k.source.text)}
    if broken:
        yield _Lost("", frozenset(broken))
    for each in code.classes:
        spans = (getattr(node, "span", None) for node in m.walk(each))
        paths = frozenset(span.source.path for span in spans if isinstance(span, SourceSpan))
        if paths & broken:
            yield _Lost(each.name, paths)


def _is_balanced(text: str) -> bool:
    """Whether there are as many braces and parentheses closed as opened."""
    plain = _PLAIN.sub("", text)
    return all(plain.count(x) == plain.count(y) for x, y in ("{}", "()"))


@dataclass(frozen=True, slots=True)
class _Hidden:
    """Tells what is not to be told."""

    bodies: tuple[SourceSpan, ...]
    mistakes: tuple[_Mistake, ...]
    lost: tuple[_Lost, ...]

    @property
    def paths(self) -> frozenset[str]:
        """The files of the classes that are lost."""
        return frozenset().union(*(each.paths for each in self.lost))

    def difference(self, difference: Difference) -> bool:
        """Whether a difference may be one only for a mistake."""
        element = difference.element
        if self.lost and element.kind in _WHOLE:
            return True
        if element.group and any(element.group == each.name for each in self.lost):
            return True
        place = difference.right
        return place is not None and (place.source.path in self.paths or self._at(place))

    def left(self, found: Findings) -> Findings:
        """The findings of a file that are told: the mistakes, and what has no other cause."""
        left = tuple(
            d
            for d in found.diagnostics
            if is_mistake(d)
            or d.code not in _FOLLOWING
            or not (found.source.path in self.paths or self._is_near(found.source, d))
        )
        return Findings(found.source, left)

    def _is_near(self, source: Source, diagnostic: Diagnostic) -> bool:
        told = diagnostic.code == "RS956"
        return told and any(each.is_at(source, diagnostic.span) for each in self.mistakes)

    def _at(self, place: Place) -> bool:
        """Whether a place is in a body with a mistake, or beside one."""
        for mistake in self.mistakes:
            if mistake.is_at(place.source, place.span):
                return True
            for body in self.bodies:
                both = body.source.path == mistake.source.path == place.source.path
                if both and _holds(body, mistake.span) and _holds(body, place.span):
                    return True
        return False


def _holds(outer: Span, inner: Span) -> bool:
    return outer.start <= inner.start <= outer.end
