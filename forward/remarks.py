"""The comments of the model, for the generated code: users read them, extraction does not."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from typing import Protocol

from rebsync.model import ReactiveClass
from rebsync.records import dataclass
from rebsync.source import Span

_WIDTH = 80  # characters of a line before it is indented


class Comment(Protocol):
    """A comment as the parser gives it."""

    @property
    def text(self) -> str: ...

    @property
    def span(self) -> Span: ...

    @property
    def behind(self) -> int | None: ...


@dataclass(frozen=True, slots=True)
class Remarks:
    """Comments in order of place."""

    comments: Sequence[Comment] = ()

    def between(self, start: int, end: int) -> Iterator[str]:
        """The lines of the comments that lie between two places, as `//` comments."""
        first = bisect_left(self.comments, start, key=lambda c: c.span.start)
        for comment in self.comments[first:]:
            if comment.span.end > end:
                break
            yield from (f"// {_harmless(line)}".rstrip() for line in comment_lines(comment.text))

    def beside(
        self, lines: Sequence[str], at: int, end: int, mark: str = "//"
    ) -> tuple[Sequence[str], int]:
        """What a statement that ends at a place becomes, with the comment at the end of its line.

        Also the place up to which comments are given then. It goes above what takes several lines.
        """
        first = bisect_left(self.comments, at, key=lambda c: c.span.start)
        comment = self.comments[first] if first < len(self.comments) else None
        if comment is None or comment.behind != at or comment.span.end > end:
            return lines, at
        words = [_harmless(line) for line in comment_lines(comment.text)]
        if len(words) != 1 or not words[0]:
            return lines, at
        remark = f"{mark} {words[0]}"
        if len(lines) == 1 and len(line := f"{lines[0]}  {remark}") <= _WIDTH:
            return [line], comment.span.end
        return [remark, *lines], comment.span.end

    def above(self, declaration: ReactiveClass | None) -> dict[int, tuple[str, ...]]:
        """By the identity of each body of a class, the comments that stand before its member."""
        found: dict[int, tuple[str, ...]] = {}
        at = declaration.queue_span.end if declaration else 0
        for member in declaration.members if declaration else ():
            body = getattr(member, "body", None)
            if body is not None:
                found[id(body)] = tuple(self.between(at, member.span.start))
            at = member.span.end
        return found


def _harmless(line: str) -> str:
    """The words of a comment as such: not a marker, and not a comment that takes the next line."""
    words = line.replace("rebsync:", "rebsync -").replace("??/", "?? /")
    return f"{words} ." if words.endswith("\\") else words


def comment_lines(text: str) -> Iterator[str]:
    """The words of a comment, line by line, without its delimiters."""
    if text.startswith("//"):
        yield text[2:].strip()
        return
    for line in text[2:-2].splitlines():
        words = line.strip().lstrip("*").strip()
        if words:
            yield words
