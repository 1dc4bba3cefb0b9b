"""Brings the names of a property file after those of a model of which elements were renamed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Edit, Severity
from rebsync.edits import apply_edits
from rebsync.grammars.properties import parse_properties
from rebsync.properties import Define, Formula, Property, Tctl, operands, state_expressions
from rebsync.property_check import check_properties
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Depth
from rebsync.roundtrip.diff.matching import matched
from rebsync.roundtrip.diff.operands import SourcedModel, two_sides
from rebsync.source import Source
from rebsync.static import Analysis, analyse

_Key = tuple[str, str, str]  # kind, class, name
_KINDS = frozenset({"rebec", "env", "statevar"})


def renamed_properties(
    properties: Source, base: SourcedModel | None, today: SourcedModel, merged: SourcedModel
) -> str:
    """The text of a property file for a merged model, whose names were those of the others."""
    if base is not None and _is_behind(properties, base, today):
        properties = replace(properties, text=with_renames(properties, base, today))
    return with_renames(properties, today, merged)


def _is_behind(properties: Source, base: SourcedModel, today: SourcedModel) -> bool:
    """Whether somebody has renamed something in the model, and not yet here."""
    parsed = parse_properties(properties).properties
    last, now = (check_properties(parsed, analyse(g.model)) for g in (base, today))
    return _mistakes(last) < _mistakes(now)


def with_renames(properties: Source, old: SourcedModel, new: SourcedModel) -> str:
    """The text with the elements of a model under their new names; nothing else of it changes.

    The same text where it does not parse, or where it would say something else then.
    """
    renames = dict(_renames(old, new))
    parsed = parse_properties(properties)
    if not renames or not parsed.ok:
        return properties.text
    names = _FormulaNames(analyse(old.model), renames, {d.name for d in parsed.properties.defines})
    entries: tuple[Define | Property, ...]
    entries = (*parsed.properties.defines, *parsed.properties.all)
    text = apply_edits(properties.text, {e for each in entries for e in names.edits(each)})
    again = parse_properties(Source(properties.path, text))
    before = check_properties(parsed.properties, names.analysis)
    after = check_properties(again.properties, analyse(new.model))
    return text if again.ok and _mistakes(after) <= _mistakes(before) else properties.text


def _mistakes(found: tuple[Diagnostic, ...]) -> int:
    return sum(d.severity is Severity.ERROR for d in found)


def _renames(old: SourcedModel, new: SourcedModel) -> Iterator[tuple[_Key, str]]:
    """The elements that properties speak of, with their new names."""
    for x, r in matched(*two_sides(old, new, Depth.EQUAL)).pairs:
        if x.kind in _KINDS and x.name != r.name:
            yield (x.kind, x.owner, x.name), r.name


@dataclass(frozen=True, slots=True, eq=False)
class _FormulaNames:
    """What names in formulas stand for in a model; `defined` are those of the file itself."""

    analysis: Analysis
    renames: Mapping[_Key, str]
    defined: set[str]

    def edits(self, entry: Define | Property) -> Iterator[Edit]:
        """The names of an entry that change."""
        formula = entry.value if isinstance(entry, Define) else entry.formula
        for expression in _expressions(formula):
            for node in m.walk(expression):
                yield from self._edit(node)

    def _edit(self, node: object) -> Iterator[Edit]:
        match node:
            case m.Member(target=m.Name(name=rebec) as target, name=name):
                yield from self._given(target, "rebec", rebec)
                yield from self._variable(node, rebec, name)
            case m.Name(name=name) if name not in self.defined:
                kind = "env" if name in self.analysis.env else "rebec"
                yield from self._given(node, kind, name)

    def _given(self, node: m.Name, kind: str, name: str) -> Iterator[Edit]:
        if (new := self.renames.get((kind, "", name))) is not None:
            yield Edit(node.span, new)

    def _variable(self, node: m.Member, rebec: str, name: str) -> Iterator[Edit]:
        """The state variable of a rebec, of its class or one above."""
        main = self.analysis.model.main
        type_ = next((r.type.name for r in main.rebecs if r.name == rebec), "") if main else ""
        info = self.analysis.classes.get(type_)
        for symbol in info.state if info is not None else ():
            new = self.renames.get(("statevar", symbol.owner, name))
            if symbol.name == name and new is not None:
                yield Edit(node.name_span, new)


def _expressions(formula: Formula) -> Iterator[m.Expression]:
    """The state expressions of a formula, and its bounds of time."""
    yield from state_expressions(formula)
    waiting = [formula]
    while waiting:
        each = waiting.pop()
        if isinstance(each, Tctl) and each.bound is not None:
            yield each.bound.limit
        waiting += operands(each)
