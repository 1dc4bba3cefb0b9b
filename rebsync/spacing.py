"""The blanks between neighbouring tokens of one line of Rebeca."""

from __future__ import annotations

from dataclasses import field

from rebsync.records import dataclass

_ARITHMETIC = frozenset(("*", "/", "%", "+", "-", "<<", ">>", "&", "^", "|"))
_LOGICAL = frozenset(("<=", ">=", "<", ">", "==", "!=", "&&", "||", "->"))
_ASSIGNING = frozenset({"=", *(operator + "=" for operator in _ARITHMETIC)})
_BINARY = _ARITHMETIC | _LOGICAL | _ASSIGNING
_PREFIX = frozenset(("+", "-", "!", "~", "++", "--"))
_STEPS = frozenset(("++", "--"))
# Words that a parenthesis does not follow directly, and that an operand may follow.
_STATEMENTS = frozenset(("if", "else", "while", "for", "switch", "case", "default", "return"))
_KEYWORDS = _STATEMENTS | {"new", "instanceof", "main", "env", "msgsrv", "abstract"}

_NUMBERS = frozenset(("byte", "short", "int", "float", "double"))


def is_comment(text: str) -> bool:
    """Whether a token is `// ...` or `/* ... */`."""
    return text.startswith(("//", "/*"))


@dataclass(slots=True)
class Spacing:
    """What the blank before the next token depends on."""

    before: str = ""
    ended: bool = False
    prefixing: bool = False
    tight: bool = False
    conditionals: list[int] = field(default_factory=lambda: [0])

    @property
    def depth(self) -> int:
        """How many brackets are open."""
        return len(self.conditionals) - 1

    def begin_operand(self) -> None:
        """What follows starts an expression, although the token before looks like its end."""
        self.ended = False

    def blank(self, text: str, choice: bool = False) -> str:
        """The blank before `text`, which is then the token before."""
        blank = " " if self.before and self._apart(text, choice) else ""
        self._step(text, choice)
        return blank

    def _apart(self, text: str, choice: bool) -> bool:
        before = self.before
        if text in (")", "]", ",", ";", ".", "}") or before in ("(", "[", ".", "@", "{"):
            return False
        if is_comment(text) or is_comment(before):
            return True
        match text:
            case "[":
                return False
            case ":":
                return self.conditionals[-1] > 0
            case "?" if not choice:
                return True
            case "++" | "--" if self.ended:
                return False
            case _ if text in _BINARY and (self.ended or text not in _PREFIX):
                return True
        if before == ";" and self.depth and text in (")", ";"):
            return False
        if self.prefixing:
            return before[-1] == text[0]
        return not (text == "(" and self._opens_list())

    def _opens_list(self) -> bool:
        return self.tight or (_is_word(self.before) and self.before not in _KEYWORDS)

    def _step(self, text: str, choice: bool) -> None:
        if is_comment(text):
            self.before = text
            return
        self.prefixing = text in _PREFIX and not self.ended
        self.tight = choice or (text == ":" and not self.conditionals[-1])
        match text:
            case "(" | "[" | "{":
                self.conditionals.append(0)
            case ")" | "]" | "}" if self.depth:
                self.conditionals.pop()
            case "?" if not choice:
                self.conditionals[-1] += 1
            case ":" if self.conditionals[-1]:
                self.conditionals[-1] -= 1
        if not (text in _STEPS and self.ended):
            cast = text == ")" and self.before in _NUMBERS
            name = _is_word(text) and text not in _KEYWORDS
            self.ended = not cast and (text in (")", "]") or name)
        self.before = text


def _is_word(text: str) -> bool:
    first = text[0]
    return first.isalnum() or first in "_$\"'" or (first == "." and len(text) > 1)
