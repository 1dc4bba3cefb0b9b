"""Text to the tree of a property file, with every mistake of the text in one run."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any

from lark import Lark, Token, Tree

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Edit, Severity
from rebsync.grammars.amount import too_large
from rebsync.grammars.formulas import OPERATORS, lift
from rebsync.grammars.lexer import controls, retyped, token_span
from rebsync.grammars.recovery import RecoveringParser
from rebsync.grammars.tables import load
from rebsync.grammars.tree import TreeBuilder
from rebsync.properties import Define, Properties, Property
from rebsync.records import dataclass
from rebsync.source import Source, Span

_NUMBERS = frozenset(("byte", "short", "int", "float", "double"))
_LISTS = ("__properties_star", "__defines_star", "__section_star")
_ENTRY_ENDS = frozenset(("SEMICOLON", "LBRACE", "RBRACE"))
_FOREIGN = frozenset(("[", "<", ">"))
_WRITTEN = {
    "LTL": "operators are written G(p), F(p), X(p), U(p, q) and W(p, q)",
    "TCTL": "operators are written AG(p), AF(time <= 5, p), AU(p, q) and so on",
}
_ILLEGAL = {
    "ILLEGAL": ("RS102", "this character is not part of the language"),
    "OPEN_COMMENT": ("RS103", "this comment never ends"),
    "OPEN_STRING": ("RS103", "this string does not end on its line"),
}


@dataclass(frozen=True, slots=True)
class ParsedProperties:
    """What was read from a property file. With errors, `properties` holds the readable parts."""

    source: Source
    properties: Properties
    diagnostics: tuple[Diagnostic, ...]

    @property
    def ok(self) -> bool:
        return not any(d.severity is Severity.ERROR for d in self.diagnostics)

    @property
    def complete(self) -> bool:
        """Whether no entry was lost to a mistake of syntax."""
        return not any(d.code.startswith("RS1") for d in self.diagnostics)


def parse_properties(source: Source) -> ParsedProperties:
    """Read a property file; mistakes become diagnostics, and reading goes on behind them."""
    if (mistake := too_large(source.text)) is not None:
        return ParsedProperties(source, Properties(), (mistake,))
    tokens, diagnostics = _lex(source.text)
    parser = _PropertyParser(property_grammar(), "properties", tokens)
    raw = parser.run()
    found = [*diagnostics, *parser.diagnostics]
    properties = Properties()
    if isinstance(raw, _RawFile):
        try:
            properties = _lifted(raw, found)
        except RecursionError:
            message = "a formula nests deeper than rebsync reads"
            found.append(Diagnostic("RS111", raw.span, message, "split it with defines"))
    found.sort(key=lambda d: (d.span.start, d.code))
    return ParsedProperties(source, properties, tuple(found))


@cache
def property_grammar() -> Lark:
    """The compiled grammar of properties: its own rules and the terminals of the language."""
    folder = files("rebsync.grammars")
    texts = [
        folder.joinpath(name).read_text(encoding="utf-8")
        for name in ("property.lark", "timed_rebeca.lark")
    ]
    return load("\n".join(texts), start=["properties", "trivia"], transformer=_Builder())


# --- tokens ------------------------------------------------------------------------------------


def _lex(text: str) -> tuple[list[Token], list[Diagnostic]]:
    tokens = []
    found = []
    for token in property_grammar().lex(text):
        found += controls([token])
        if token.type in _ILLEGAL:
            code, message = _ILLEGAL[token.type]
            found.append(Diagnostic(code, token_span(token), message))
        elif token.type != "COMMENT":
            tokens.append(token)
    _mark_casts(tokens)
    return list(_with_colons(tokens, found)), found


def _mark_casts(tokens: list[Token]) -> None:
    for i in range(len(tokens) - 2):
        if tokens[i] == "(" and tokens[i + 1] in _NUMBERS and tokens[i + 2] == ")":
            tokens[i] = retyped(tokens[i], "CAST")
            tokens[i + 1] = retyped(tokens[i + 1], "TYPE_ID")


def _with_colons(tokens: list[Token], found: list[Diagnostic]) -> list[Token]:
    """The colon that the thesis left out: `Collision_Avoidance !(x && y);`."""
    mended: list[Token] = []
    section = ""
    for i, token in enumerate(tokens):
        mended.append(token)
        if token.type == "LBRACE" and i:
            section = tokens[i - 1]
        if token.type != "ID" or i + 1 == len(tokens) or section in ("define", "Define", ""):
            continue
        begins = tokens[i - 1].type in ("LBRACE", "SEMICOLON")
        if begins and tokens[i + 1].type in ("BANG", "LPAR", "ID", "TRUE", "FALSE"):
            place = Span(token_span(token).end, token_span(token).end)
            found.append(
                Diagnostic(
                    "RS105",
                    token_span(token),
                    f'`:` is missing behind the name "{token}"',
                    edits=(Edit(place, ":"),),
                )
            )
            mended.append(Token("COLON", ":", place.start))
    return mended


class _PropertyParser(RecoveringParser):
    """Goes on behind the entry that cannot be read."""

    def _report(self, i: int, diagnostic: Diagnostic) -> None:
        """Who knows other checkers writes `G p`, `[] p`, `p U q` or `AF[<=5] p`."""
        if diagnostic.code in ("RS101", "RS105") and self._is_foreign(i):
            hint = _WRITTEN[self._section(i)]
            diagnostic = replace(diagnostic, hint=hint, edits=())
        super()._report(i, diagnostic)

    def _section(self, i: int) -> str:
        """The kind of section that a token stands in."""
        braces = (k for k in range(i - 1, 0, -1) if self.tokens[k].type == "LBRACE")
        return str(self.tokens[next(braces, 1) - 1])

    def _is_foreign(self, i: int) -> bool:
        """Whether a token, or an operator before it in its formula, is in another notation."""
        operators = OPERATORS.get(self._section(i), ())
        if not operators:
            return False
        if i < len(self.tokens) and self.tokens[i] in (*_FOREIGN, *operators):
            return True
        ends = (k for k in range(i - 1, 0, -1) if self.tokens[k].type in _ENTRY_ENDS)
        formula = self.tokens[next(ends, 0) + 1 : i + 1]
        named = (k for k, t in enumerate(formula[:-1]) if t in (*operators, "A", "E"))
        return any(formula[k + 1].type not in ("LPAR", "COLON") for k in named)

    def _at_boundary(self, depth: int) -> bool:
        if depth == 1:
            return True
        top = self._parser.parser_state.value_stack[depth - 2]
        if isinstance(top, Token):
            return bool(top.type == "LBRACE")
        return isinstance(top, Tree) and str(top.data).startswith(_LISTS)


# --- trees -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _RawEntry:
    """An entry before its formula is told apart from a state expression."""

    name: str
    value: m.Expression
    span: Span
    name_span: Span


@dataclass(frozen=True, slots=True)
class _RawSection:
    kind: str
    entries: tuple[_RawEntry, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class _RawFile:
    sections: tuple[_RawSection, ...]
    span: Span


def _lifted(raw: _RawFile, found: list[Diagnostic]) -> Properties:
    defines: list[Define] = []
    properties: dict[str, list[Property]] = {"Assertion": [], "LTL": [], "TCTL": []}
    for section in raw.sections:
        for entry in section.entries:
            formula = lift(entry.value, section.kind, found)
            if section.kind == "define":
                defines.append(Define(entry.name, formula, entry.span, entry.name_span))
            else:
                each = Property(entry.name, formula, entry.span, entry.name_span)
                properties[section.kind].append(each)
    return Properties(
        tuple(defines),
        tuple(properties["Assertion"]),
        tuple(properties["LTL"]),
        tuple(properties["TCTL"]),
        raw.span,
    )


class _Builder(TreeBuilder):
    """The rules of property.lark; expressions are built as those of a model."""

    formula_chain = TreeBuilder.chain
    formulas = TreeBuilder.expressions

    def properties(self, items: list[Any]) -> _RawFile:
        sections = tuple(i for i in items if isinstance(i, _RawSection))
        return _RawFile(sections, token_span(items[0]).to(token_span(items[-1])))

    def defines(self, items: list[Any]) -> _RawSection:
        return self._raw_section("define", items, token_span(items[0]))

    def section(self, items: list[Any]) -> _RawSection:
        return self._raw_section(str(items[0]), items, token_span(items[1]))

    def section_name(self, items: list[Any]) -> str:
        return str(items[0])

    def _raw_section(self, kind: str, items: list[Any], start: Span) -> _RawSection:
        entries = tuple(i for i in items if isinstance(i, _RawEntry))
        return _RawSection(kind, entries, start.to(token_span(items[-1])))

    def define(self, items: list[Any]) -> _RawEntry:
        name = token_span(items[0])
        return _RawEntry(str(items[0]), items[2], name.to(token_span(items[3])), name)

    property = define

    def implication(self, items: list[Any]) -> m.Expression:
        left, _, right = items
        return m.Binary("->", left, right, left.span.to(right.span))

    def operator(self, items: list[Any]) -> m.Expression:
        tail = self.call_tail(items[1:])
        name = token_span(items[0])
        return m.Call(None, str(items[0]), tail.arguments, None, None, name.to(tail.span), name)
