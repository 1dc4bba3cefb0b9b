"""A question about topics as a property of the closed model."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction

from rebsync import questions as q
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, did_you_mean
from rebsync.records import dataclass
from rebsync.reverse.environment.observation import ANY, COUNT, Observation
from rebsync.reverse.models.texts import TEXT
from rebsync.source import Source, Span

_NAME = "Question"
_SHOWN = 12


@dataclass(frozen=True, slots=True)
class TopicVocabulary:
    """What can be asked of: observations with their rebecs, constants of messages by their names.

    `texts` are the numbers that texts are in the model, `unit` is the length of its unit of time in
    seconds.
    """

    source: Source
    observations: Sequence[tuple[str, Observation]]
    constants: Mapping[str, int | str]
    texts: Mapping[str, int]
    unit: Fraction

    def property_text(self, question: q.Question) -> str:
        """A property file with the question as its only property.

        A comparison neither holds nor fails before the first message of its topics. RebsyncError:
        something that is asked for is not there, or not once.
        """
        match question:
            case q.Never(wrong, meanwhile):
                return _assertion(f"!({self._both(wrong, meanwhile)})")
            case q.Always(right, meanwhile):
                return _assertion(f"!({self._both(q.Negation(right), meanwhile)})")
            case q.LeadsTo(first, then, None):
                return _formula("LTL", f"G({self._text(first)} -> F({self._text(then)}))")
            case q.LeadsTo(first, then, within):
                assert within is not None
                bound = f"time <= {self._units(within)}"
                whole = f"AG({self._text(first)} -> AF({bound}, {self._text(then)}))"
                return _formula("TCTL", whole)
            case q.AtMost(condition, times):
                return _formula("LTL", f"!({_rises(self._text(condition), times + 1)})")
            case q.Messages(topic, most):
                rebec, seen = self._only(topic, [COUNT], topic.text)
                return _assertion(f"{rebec}.{seen.variable} <= {most}")

    def _units(self, seconds: Fraction) -> int:
        if (seconds / self.unit).denominator == 1:
            return int(seconds / self.unit)
        message = f"{float(seconds):g} s is no whole number of units of {float(self.unit):g} s"
        whole = Span(0, len(self.source.text))
        raise self._mistake("RS912", whole, message, "set another time_unit in rebsync.toml")

    def _both(self, one: q.Condition, other: q.Condition | None) -> str:
        return self._text(one if other is None else q.Conjunction((one, other)))

    # --- conditions -----------------------------------------------------------------------------

    def _text(self, condition: q.Condition, *, holds: bool = True) -> str:
        """That a condition holds, or that it does not; both only once its topics had a message."""
        match condition:
            case q.Negation(operand):
                return self._text(operand, holds=not holds)
            case q.Conjunction(operands) | q.Disjunction(operands):
                parts = [self._text(each, holds=holds) for each in operands]
                sign = " && " if isinstance(condition, q.Conjunction) == holds else " || "
                return f"({sign.join(parts)})"
            case q.Truth(word):
                return self._after_first([word], self._operand(word), holds)
            case q.Comparison(operator, left, right):
                words = [w for w in (left, right) if isinstance(w, q.Word)]
                kinds = {found[1].type.name for w in words if (found := self._field(w))}
                self._check_texts(operator, left, right)
                sides = (self._operand(side, kinds) for side in (left, right))
                text = f" {operator} ".join(sides)
                return self._after_first(words, text, holds)

    def _after_first(self, words: Collection[q.Word], text: str, holds: bool) -> str:
        flags: dict[str, None] = {}
        for word in words:
            if (found := self._field(word)) is not None:
                flags[f"{found[0]}.{self._flag(*found)}"] = None
        return "(" + " && ".join([*flags, f"({text})" if holds else f"!({text})"]) + ")"

    def _flag(self, rebec: str, seen: Observation) -> str:
        return next(
            o.variable
            for r, o in self.observations
            if (r, o.topic, o.server, o.path) == (rebec, seen.topic, seen.server, ANY)
        )

    def _operand(self, operand: q.Operand, beside: Collection[str] = ()) -> str:
        """An operand, which is compared with values of the types `beside` it."""
        match operand:
            case q.Word():
                found = self._field(operand)
                if found is not None:
                    return f"{found[0]}.{found[1].variable}"
                return str(self._number(next(iter(self._constant_values(operand)))))
            case q.QuotedText(text):
                return str(self.texts[text])
            case bool():
                return str(operand).lower()
            case float():
                return f"{operand!r}{'d' if 'double' in beside else ''}"
            case number:
                return str(number)

    def _number(self, constant: int | str) -> int:
        return self.texts[constant] if isinstance(constant, str) else constant

    def _check_texts(self, operator: str, left: q.Operand, right: q.Operand) -> None:
        """RebsyncError: a text is not compared with one in quotes, for which alone one is known."""
        fields = [self._field(w) for w in (left, right) if isinstance(w, q.Word)]
        texts = [found is not None and found[1].type == TEXT for found in fields]
        quoted = [isinstance(side, q.QuotedText) for side in (left, right)]
        if True not in texts and True not in quoted:
            return
        if operator in ("==", "!=") and texts == [True] and True in quoted:
            return
        spans = [side.span for side in (left, right) if isinstance(side, q.Word | q.QuotedText)]
        message = "a field that is a text is equal, or not, to a text in quotes: no more is known"
        hint = 'such as mode.data == "stop"'
        raise self._mistake("RS912", spans[0], message, hint)

    # --- words ----------------------------------------------------------------------------------

    def _field(self, word: q.Word) -> tuple[str, Observation] | None:
        """The field that a word names; None for a constant."""
        if self._constant_values(word):
            return None
        fields = [o.path for _, o in self.observations if o.path not in (ANY, COUNT)]
        return self._only(word, fields, word.text)

    def _constant_values(self, word: q.Word) -> set[int | str]:
        """The value of a constant, if one name of a package's messages is this."""
        if "." in word.text or "/" in word.text:
            return set()
        plain = {v for n, v in self.constants.items() if n.rpartition("::")[2] == word.text}
        return plain if len(plain) == 1 else set()

    def _only(self, word: q.Word, paths: Collection[str], text: str) -> tuple[str, Observation]:
        """The one observation that a word names: of what is published, else of what is got."""
        node, _, rest = text.rpartition(":")
        found = [
            (rebec, o)
            for rebec, o in self.observations
            if o.path in paths and node in ("", rebec) and rest in _names(o)
        ]
        published = [each for each in found if not each[1].server]
        # Several publishers or callbacks that a node has for one topic are one variable.
        found = list({(rebec, o.variable): (rebec, o) for rebec, o in published or found}.values())
        if len(found) == 1:
            return found[0]
        if not found:
            raise self._mistake("RS913", word.span, f'there is no "{text}" here', self._hint(text))
        several = ", ".join(f"{rebec}:{_longest(o)}" for rebec, o in found[:_SHOWN])
        raise self._mistake("RS914", word.span, f'"{text}" is several', f"name one: {several}")

    def _hint(self, text: str) -> str:
        topic = text.rpartition(":")[2]
        fields = [_longest(o) for _, o in self.observations if o.path and topic in _topics(o)]
        if fields := [f for f in dict.fromkeys(fields) if "." in f]:
            return f"name a field: {', '.join(fields[:_SHOWN])}"
        names = sorted({n for _, o in self.observations for n in _names(o) if o.path != COUNT})
        plain = [n for n in names if not n.startswith("/")]
        if not plain:
            return "no topic of a node that is started is known: `rebsync extract` lists why"
        return did_you_mean(text, names) or f"there are: {', '.join(plain[:_SHOWN])}"

    def _mistake(self, code: str, span: Span, message: str, hint: str) -> RebsyncError:
        return RebsyncError([Findings(self.source, (Diagnostic(code, span, message, hint),))])


def _topics(seen: Observation) -> Iterator[str]:
    """What the topic of an observation can be called: its last words, or all."""
    words = seen.topic.strip("/").split("/")
    for first in range(len(words)):
        yield "/".join(words[first:])
    yield seen.topic


def _names(seen: Observation) -> Iterator[str]:
    """What an observation can be called."""
    end = f".{seen.path}" if seen.path not in (ANY, COUNT) else ""
    return (topic + end for topic in _topics(seen))


def _longest(seen: Observation) -> str:
    return max(_names(seen), key=len).removeprefix("/")


def _assertion(text: str) -> str:
    return f"property {{\n  Assertion {{\n    {_NAME}: {text};\n  }}\n}}\n"


def _formula(section: str, text: str) -> str:
    return f"property {{\n  {section} {{\n    {_NAME}: {text};\n  }}\n}}\n"


def _rises(text: str, times: int) -> str:
    """That a condition becomes true so often on a run, if it is false at first."""
    rest = f" && {_rises(text, times - 1)}" if times > 1 else ""
    return f"F(!({text}) && X(({text}){rest}))"
