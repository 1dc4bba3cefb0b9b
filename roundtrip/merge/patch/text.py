"""Changes of a text in place: what no change is about keeps its bytes."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import field
from functools import cached_property

from rebsync.diagnostics import Edit
from rebsync.records import dataclass
from rebsync.source import Span

_STEP = "  "  # of what rebsync prints, and of a text in which nothing is indented


_INDENTED = re.compile(r"^(?:  )+", re.MULTILINE)
_TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|/\*.*?\*/|//[^\n]*|[{;]', re.DOTALL)


@dataclass(eq=False)
class TextPatch:
    """Changes that are collected for a text, in characters of the text as it was."""

    text: str
    edits: list[Edit] = field(default_factory=list)

    @property
    def newline(self) -> str:
        """How the lines of the text end."""
        return "\r\n" if "\r\n" in self.text else "\n"

    @cached_property
    def step(self) -> str:
        """By what the text indents: mostly a line against the one before it."""
        steps: Counter[str] = Counter()
        above = ""
        for line in self.text.splitlines():
            blanks = line[: len(line) - len(line.lstrip())]
            if line.strip() and not line.lstrip().startswith(("//", "*", "/*")):
                steps[blanks.removeprefix(above)] += blanks.startswith(above) and blanks != above
                above = blanks
        return next((step for step, count in steps.most_common(1) if count), _STEP)

    def printed(self, text: str) -> str:
        """What rebsync has printed, indented as the text is."""
        return _INDENTED.sub(lambda m: self.step * (len(m[0]) // len(_STEP)), text)

    # --- collecting -----------------------------------------------------------------------------

    def replace(self, span: Span, text: str) -> None:
        """Puts a text in place of another; its further lines are indented as the first one is.

        Comments in the old one that the new one lacks stand before it.
        """
        indent = self.indent_at(span.start)
        text = with_remarks(self.text[span.start : span.end], text) if text else text
        self._edit(span.start, span.end, indented(text, indent).removeprefix(indent))

    def insert(self, at: int, text: str) -> None:
        """Puts a text between two characters, as it is."""
        self._edit(at, at, text)

    def remove(self, span: Span, above: bool = False) -> None:
        """Takes a text out, with its lines if nothing else is on them.

        `above`: with the comments on the lines right above it, and the empty line before these.
        """
        start, end = self._line_start(span.start), self._line_end(span.end)
        if self.text[start : span.start].strip() or not self._is_remark(span.end, end):
            before = self.text[start : span.start].rstrip()
            self._edit(start + len(before) if before else span.start, span.end, "")
            return
        if above:
            start = self._above(start)
        self._edit(start, self._past_line(end), "")

    def after(self, at: int, text: str, indent: str) -> None:
        """Puts lines behind what ends at `at` and the remark on its line."""
        end = self._line_end(at)
        if self._is_remark(at, end):
            self.insert(end, f"\n{indented(text, indent)}")
        elif "\n" in text:
            self.insert(at, f"\n{indented(text, indent)}\n{indent}")
        else:
            self.insert(at, f" {text}")

    def within(self, span: Span, text: str) -> None:
        """Puts lines first behind the opening brace of a block."""
        opening = self.find("{", span.start)
        inner = self.text[opening + 1 : span.end - 1]
        indent = self.indent_at(span.start)
        if not inner.strip() and "\n" not in inner:
            own = f"\n{indented(text, indent + self.step)}\n{indent}"
            self._edit(opening + 1, span.end - 1, own)
        else:
            self.after(opening + 1, text, indent + self.step)

    def remark_of(self, span: Span) -> str:
        """The comment at the end of the line that a text has to itself, as a line of its own."""
        start, end = self._line_start(span.start), self._line_end(span.end)
        is_alone = not self.text[start : span.start].strip() and self._is_remark(span.end, end)
        remark = self.text[span.end : end].strip() if is_alone else ""
        return f"{remark}\n" if remark else ""

    def take_back(self, mark: int) -> None:
        """Forgets the changes that came after the first `mark` ones."""
        del self.edits[mark:]

    def _edit(self, start: int, end: int, text: str) -> None:
        plain = text.replace("\r\n", "\n").replace("\n", self.newline)
        self.edits.append(Edit(Span(start, end), plain))

    # --- the result -----------------------------------------------------------------------------

    def result(self) -> str:
        """The text with all changes made; what is taken out twice is taken out once."""
        parts: list[str] = []
        at = 0
        for edit in sorted(self.edits, key=lambda e: (e.span.start, e.span.end)):
            parts += (self.text[at : edit.span.start], edit.text)
            at = max(at, edit.span.end)
        return "".join([*parts, self.text[at:]])

    # --- places ---------------------------------------------------------------------------------

    def find(self, mark: str, at: int) -> int:
        """Where a brace or a semicolon comes next behind a place, comments not counting."""
        return next(f.start() for f in _TOKEN.finditer(self.text, at) if f[0] == mark)

    # --- lines ----------------------------------------------------------------------------------

    def indent_at(self, at: int) -> str:
        """The blanks that the line of a place begins with."""
        line = self.text[self._line_start(at) : at]
        return line[: len(line) - len(line.lstrip())]

    def _line_start(self, at: int) -> int:
        return self.text.rfind("\n", 0, at) + 1

    def _line_end(self, at: int) -> int:
        """The end of the line of a place, before its line end."""
        end = self.text.find("\n", at)
        end = end if end >= 0 else len(self.text)
        return end - (end > at and self.text[end - 1] == "\r")

    def _past_line(self, end: int) -> int:
        newline = self.text.find("\n", end)
        return newline + 1 if newline >= 0 else len(self.text)

    def _is_remark(self, start: int, end: int) -> bool:
        """Whether nothing but a comment is between two places of a line."""
        rest = self.text[start:end].strip()
        return not rest or rest.startswith("//") or _is_one_comment(rest)

    def _above(self, start: int) -> int:
        """The start of the comments right above a line, and of the empty line before them.

        Those that the text begins with are of all of it.
        """
        at = start
        while at:
            line = self._line_start(at - 1)
            shown = self.text[line:at].strip()
            if shown.startswith("//") or _is_one_comment(shown):
                at = line
                continue
            return line if not shown else at
        return start


def _is_one_comment(text: str) -> bool:
    return text.startswith("/*") and text.find("*/", 2) == len(text) - 2 and len(text) > 3


def with_remarks(old: str, new: str) -> str:
    """A text with the comments of the one that it replaces, as far as it has not got them."""
    left = Counter(_comments(old)) - Counter(_comments(new))
    kept = [shown.replace("\r", "").rstrip() for shown in left.elements()]
    end = "\n" if any(shown.startswith("//") for shown in kept) else " "
    return "".join(f"{shown}{end}" for shown in kept) + new


def _comments(text: str) -> list[str]:
    return [f for f in _TOKEN.findall(text) if f.startswith(("//", "/*"))]


def indented(text: str, indent: str) -> str:
    """Lines of a text, those that are not empty behind some blanks."""
    lines = text.removesuffix("\n").split("\n")
    return "\n".join(f"{indent}{line}" if line else line for line in lines)


def dedented(text: str, indent: str) -> str:
    """Lines of a text without the blanks that all but the first begin with."""
    lines = text.replace("\r\n", "\n").split("\n")
    return "\n".join([lines[0], *(line.removeprefix(indent) for line in lines[1:])])
