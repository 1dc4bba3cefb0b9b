"""Texts that a grammar derives, by chance and within a budget of depth."""

from __future__ import annotations

from collections import defaultdict
from functools import cache
from random import Random

from lark import Lark
from lark.grammar import NonTerminal, Symbol
from lark.lexer import PatternStr

from rebsync.grammars.lexer import rebeca_grammar
from rebsync.grammars.properties import property_grammar

NAMES = (
    "a",
    "b",
    "x",
    "self",
    "R",
    "C",
    "m",
    "r",
    "go",
    "int",
    "boolean",
    "byte",
    "Object",
    "main",
)
NUMBERS = ("0", "1", "2", "7", "255", "32768", "2147483648", "9" * 4301, "1_0", "0x1F", "07")
_TEXTS = ('"t"', '"\\n"', '"\\u001b[2J"', '"a\tb"', '"%d {} ${x} \\\\"')
_SAMPLES = {
    "ID": NAMES,
    "TYPE_ID": ("int", "boolean", "byte", "short", "float", "R", "C"),
    "INT": NUMBERS,
    "FLOAT": ("1.5", "1e400", ".5f", "0.1", "1e-400"),
    "STRING": _TEXTS,
    "CHAR": ("'a'",),
    "COMMENT": ("// c\n", "/* c */"),
    "OPEN_COMMENT": ("/* ",),
    "OPEN_STRING": ('"',),
    "ILLEGAL": ("#",),
    "BINARY": ("<", ">", "==", "!=", "&&", "||", "*", "/", "%", "<<", ">>", "&", "|", "^"),
    "CAST": ("(",),
    "CHOICE": ("?",),
}
_DEPTH = 25


@cache
def _grammar(kind: str) -> _Derivation:
    return _Derivation(rebeca_grammar() if kind == "model" else property_grammar())


def derive(kind: str, start: str, random: Random) -> str:
    """A text of a rule; `kind` says of which grammar: model or property."""
    return _grammar(kind).text(start, random)


class _Derivation:
    """The rules of a grammar, and how deep each must go at least."""

    def __init__(self, lark: Lark) -> None:
        self.rules: dict[str, list[list[Symbol]]] = defaultdict(list)
        for rule in lark.rules:
            self.rules[rule.origin.name].append(list(rule.expansion))
        self.terminals = {
            t.name: (t.pattern.value,) if isinstance(t.pattern, PatternStr) else ("x",)
            for t in lark.terminals
        } | _SAMPLES
        self.least = self._least_depths()

    def text(self, start: str, random: Random) -> str:
        words: list[str] = []
        self._derive(start, _DEPTH, random, words)
        return " ".join(words)

    def _least_depths(self) -> dict[str, int]:
        least = dict.fromkeys(self.rules, 10_000)
        changed = True
        while changed:
            changed = False
            for name, expansions in self.rules.items():
                depth = min(self._depth(e, least) for e in expansions)
                if depth < least[name]:
                    least[name], changed = depth, True
        return least

    @staticmethod
    def _depth(expansion: list[Symbol], least: dict[str, int]) -> int:
        below = (least[s.name] for s in expansion if isinstance(s, NonTerminal))
        return 1 + max(below, default=0)

    def _derive(self, name: str, depth: int, random: Random, words: list[str]) -> None:
        expansions = self.rules[name]
        fitting = [e for e in expansions if self._depth(e, self.least) <= depth]
        chosen = fitting or [min(expansions, key=lambda e: self._depth(e, self.least))]
        for symbol in random.choice(chosen):
            if isinstance(symbol, NonTerminal):
                self._derive(symbol.name, depth - 1, random, words)
            else:
                words.append(random.choice(self.terminals[symbol.name]))
