"""Text to a question about topics."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from importlib.resources import files

from lark import Lark, Token, Transformer, UnexpectedInput, v_args
from lark.exceptions import VisitError

from rebsync import questions as q
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.source import Source, Span

FORMS = (
    "never P [while Q]",
    "always P [while Q]",
    "P leads to Q [within 2 s]",
    "P at most 3 times",
    "at most 3 messages on TOPIC",
)
_SECONDS = {"ms": Fraction(1, 1000), "min": Fraction(60), "minute": Fraction(60)}
_ESCAPE = re.compile(r"\\(.)")
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r"}
_MOST = 9
_MOST_MESSAGES = 1000
_LONGEST = 1000


def parse_question(source: Source) -> q.Question:
    """The question that a text is. RebsyncError: it is none."""
    if len(source.text) > _LONGEST:
        raise _mistake(source, _LONGEST, f"a question has at most {_LONGEST:,} characters")
    try:
        found = _builder().transform(_grammar().parse(source.text))
    except UnexpectedInput as wrong:
        at = wrong.pos_in_stream if wrong.pos_in_stream is not None else len(source.text)
        hint = f"ask one of: {'; '.join(FORMS)}; P is such as cmd_vel.linear.x > 0"
        message = "the question is not understood from here on"
        raise _mistake(source, min(max(at, 0), len(source.text)), message, hint) from None
    except VisitError as wrong:
        raise _mistake(source, 0, str(wrong.orig_exc)) from None
    assert isinstance(found, q.Question)
    return found


def _mistake(source: Source, at: int, message: str, hint: str | None = None) -> RebsyncError:
    place = Span(at, len(source.text))
    return RebsyncError([Findings(source, (Diagnostic("RS912", place, message, hint),))])


@cache
def _grammar() -> Lark:
    text = files("rebsync.grammars").joinpath("question.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr")


@cache
def _builder() -> _Builder:
    return _Builder()


@v_args(inline=True)
class _Builder(Transformer[Token, q.Question]):
    """Makes values of the trees of the grammar."""

    def never(self, wrong: q.Condition, meanwhile: q.Condition | None) -> q.Question:
        return q.Never(wrong, meanwhile)

    def always(self, right: q.Condition, meanwhile: q.Condition | None) -> q.Question:
        return q.Always(right, meanwhile)

    def leads_to(
        self, first: q.Condition, then: q.Condition, count: Token | None, unit: Token | None
    ) -> q.Question:
        within = None
        if count is not None and unit is not None:
            plain = str(unit).removesuffix("s") if len(unit) > 2 else str(unit)
            within = Fraction(str(count)) * _SECONDS.get(plain, Fraction(1))
        return q.LeadsTo(first, then, within)

    def at_most(self, condition: q.Condition, times: Token) -> q.Question:
        return q.AtMost(condition, _count(times, _MOST))

    def messages(self, most: Token, topic: Token) -> q.Question:
        return q.Messages(_word(topic), _count(most, _MOST_MESSAGES))

    def or_(self, *operands: q.Condition) -> q.Condition:
        return q.Disjunction(operands) if len(operands) > 1 else operands[0]

    def and_(self, *operands: q.Condition) -> q.Condition:
        return q.Conjunction(operands) if len(operands) > 1 else operands[0]

    def not_(self, operand: q.Condition) -> q.Condition:
        return q.Negation(operand)

    def comparison(self, left: q.Operand, operator: Token, right: q.Operand) -> q.Condition:
        return q.Comparison(str(operator), left, right)

    def truth(self, word: Token) -> q.Condition:
        return q.Truth(_word(word))

    def word(self, word: Token) -> q.Operand:
        return _word(word)

    def number(self, number: Token) -> q.Operand:
        return float(number) if "." in number else int(number)

    def text(self, text: Token) -> q.Operand:
        start = text.start_pos or 0
        plain = _ESCAPE.sub(lambda found: _ESCAPED.get(found[1], found[1]), str(text)[1:-1])
        return q.QuotedText(plain, Span(start, start + len(text)))

    def boolean(self, truth: Token) -> q.Operand:
        return str(truth) == "true"


def _count(token: Token, most: int) -> int:
    """ValueError: it is no number of times that can be asked for."""
    if not token.isdecimal() or int(token) > most:
        raise ValueError(f"it is asked for 0 to {most} times, not for {token}")
    return int(token)


def _word(token: Token) -> q.Word:
    start = token.start_pos or 0
    return q.Word(str(token), Span(start, start + len(token)))
