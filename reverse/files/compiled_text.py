"""The text of a file as the compiler or interpreter of its language takes it, as long as the file.

Line ends and joined lines are what GCC and CPython make of them ("Translation phases" in the
standard of C++, "Lexical analysis" in the reference of Python); CMake takes a lone carriage return
for a blank.
"""

from __future__ import annotations

import io
import re
import tokenize

from rebsync.files import BOM
from rebsync.reverse.files.packages import CODE, suffix_of
from rebsync.source import Span

# A comment of C++ goes on where its line ends with a backslash.
LINE_COMMENT = r"//[^\r\n\\]*(?:\\(?:[ \t\v\f]*(?:\r\n?|\n))?[^\r\n\\]*)*"
_CARRIAGE_RETURN = re.compile(r"\r(?!\n)")
_CMAKE = ("CMakeLists.txt", ".cmake")
# Blanks between a backslash and the end of its line: GCC and Clang join the lines all the same.
# Before the backslash they part no token if it is behind a blank or one of these signs.
_LOOSE_SPLICE = re.compile(r"(?<=[\s;,(){}\[\]])\\([ \t\v\f]+)(?=\r?\n)")
_COOKIE = re.compile(r"coding[:=][ \t]*[-\w.]+")
_NOT_ASCII = re.compile(r"[^\x00-\x7f]+")


def compiled_text(name: str, text: str) -> str:
    """The text of a file by its name, with plain ends of lines, and of lines that are joined."""
    if "\r" in text and not name.endswith(_CMAKE):
        text = _CARRIAGE_RETURN.sub("\n", text)
    return _LOOSE_SPLICE.sub(r"\1\\", text) if "\\" in text and suffix_of(name) in CODE else text


def odd_encoding(data: bytes, text: str) -> tuple[Span, str] | None:
    """The place of a declared encoding in which Python reads other text than `text`, and it.

    Characters that are not ASCII may differ: they stand in comments and in texts that people read.
    """
    head = "\n".join(text.split("\n", 2)[:2])
    found = _COOKIE.search(head)
    if found is None:
        return None
    start = BOM if data.startswith(BOM) else b""
    try:
        name, _ = tokenize.detect_encoding(io.BytesIO(start + head.encode()).readline)
        if name in ("utf-8", "utf-8-sig"):
            return None
        if _ascii(data.decode(name)) == _ascii(text):
            return None
    except (SyntaxError, LookupError, UnicodeError):
        pass
    return Span(*found.span()), found[0]


def _ascii(text: str) -> str:
    """The characters of a text that are ASCII, with one kind of line ends."""
    return _NOT_ASCII.sub("", text.replace("\r\n", "\n").replace("\r", "\n"))
