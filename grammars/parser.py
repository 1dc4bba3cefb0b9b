"""Text to a Timed Rebeca model, with every mistake of the text in one run."""

from __future__ import annotations

from rebsync.diagnostics import Diagnostic, Severity
from rebsync.grammars.lexer import lex, rebeca_grammar, token_span
from rebsync.grammars.recovery import RecoveringParser
from rebsync.model import Broken, Expression, Model, Statement, Switch, walk
from rebsync.records import dataclass
from rebsync.source import Source, Span


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment as written, delimiters included.

    `behind` is where the code before it on its line ends; None where there is none.
    """

    text: str
    span: Span
    behind: int | None = None


@dataclass(frozen=True, slots=True)
class Parsed:
    """What was read from a text. With errors, `model` holds the parts that could be read."""

    source: Source
    model: Model
    comments: tuple[Comment, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def ok(self) -> bool:
        return not any(d.severity is Severity.ERROR for d in self.diagnostics)


def parse_model(source: Source, start: int = 0) -> Parsed:
    """Read a model; mistakes become diagnostics, and reading goes on behind them.

    Places count from `start`, where the text is a part of a larger one.
    """
    lexed = lex(source.text, start)
    model = Model((), (), None, Span(0, len(source.text)))
    found = [*lexed.diagnostics]
    if not lexed.hopeless:
        parser = RecoveringParser(rebeca_grammar(), "model", lexed.tokens)
        read = parser.run()
        model = read if isinstance(read, Model) else model
        found += [*parser.diagnostics, *misplaced_parts(model), *_misplaced_statements(model)]
    return Parsed(
        source,
        model,
        tuple(_comment(source, str(c), token_span(c), start) for c in lexed.comments),
        tuple(sorted(found, key=lambda d: (d.span.start, d.code))),
    )


def _comment(source: Source, text: str, span: Span, start: int) -> Comment:
    at = span.start - start
    line = source.text[source.text.rfind("\n", 0, at) + 1 : at].rstrip()
    behind = source.text.rfind(line, 0, at) + len(line) + start if line else None
    return Comment(text, span, behind)


def parse_statement(text: str) -> Statement:
    """Read one statement that is known to be right (generated text); else ValueError."""
    return _parse_part(text, "statement")  # type: ignore[return-value]


def parse_expression(text: str) -> Expression:
    """Read one expression that is known to be right (generated text); else ValueError."""
    return _parse_part(text, "expression")  # type: ignore[return-value]


def _parse_part(text: str, start: str) -> object:
    lexed = lex(text)
    parser = RecoveringParser(rebeca_grammar(), start, lexed.tokens)
    part = parser.run()
    if lexed.diagnostics or parser.diagnostics:
        raise ValueError(f"not a {start}: {text!r}")
    return part


def misplaced_parts(model: Model) -> list[Diagnostic]:
    """The order that the language demands of the parts of a model: heads, classes, main."""
    found = []
    first_class = min((c.span.start for c in model.classes), default=model.span.end)
    for head in model.heads:
        if head.span.start > first_class:
            found.append(Diagnostic("RS112", head.span, "this belongs before the first class"))
    if model.main:
        for c in model.classes:
            if c.span.start > model.main.span.start:
                found.append(Diagnostic("RS112", c.name_span, "classes belong before `main`"))
    return found


def _misplaced_statements(model: Model) -> list[Diagnostic]:
    found = []
    for node in walk(model):
        if isinstance(node, Switch):
            for case in node.cases:
                if isinstance(case.value, Broken) and case.value.span == case.statements[0].span:
                    found.append(
                        Diagnostic("RS112", case.span, "a statement before the first `case`")
                    )
    return found
