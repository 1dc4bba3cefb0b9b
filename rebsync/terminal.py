"""The one way to a terminal, a log or a pipe: texts of others never give orders to who reads them.

Names of files, texts of models and code, and arguments may hold escape sequences, line ends,
characters that turn the direction of writing or have no width, and workflow commands of CI systems.
Whatever rebsync says goes through here, and shows them as escapes. What is the product's own output
(a model, a patch) is left as it is on a pipe, and cleaned where a terminal reads it.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterable
from typing import TextIO

# Controls and formats (categories Cc, Cf, Cs, Zl, Zp, noncharacters) and other characters that
# nobody sees, the same in every Python.
_UNSAFE = (
    r"\x00-\x08\x0b-\x1f\x7f-\x9f\xad\u034f\u0600-\u0605\u061c\u06dd\u070f\u0890\u0891\u08e2"
    r"\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u2028-\u202e\u2060-\u206f\u3164"
    r"\ud800-\udfff\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb\ufffe\uffff\U000110bd\U000110cd"
    r"\U00013430-\U0001343f\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e0fff"
)
_CONTROL = re.compile(f"[{_UNSAFE}]")
_CONTROL_OR_END = re.compile(rf"[{_UNSAFE}\n]")
_COMMAND = re.compile(r"^(\s*):(?=:[A-Za-z][^\n]*::)", re.MULTILINE)
_OLD_COMMAND = re.compile(r"##(?=(?:vso|teamcity)?\[)")
_CONTROL_IN_TEXT = re.compile(
    r"[\x00-\x08\x0b\x0e-\x1f\x7f-\x9f\u180e\u200b\u2028-\u202e\u2060-\u206f\ud800-\udfff"
    r"\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e007f]"
)
_ENDS = {"\n": r"\n", "\r": r"\r"}


def printable(text: str) -> str:
    """A text of several lines in which nothing but line ends and tabs is a control."""
    return _CONTROL.sub(_escape, text)


def one_line(text: str) -> str:
    """The same for what is part of a line: line ends are escapes as well."""
    return _CONTROL_OR_END.sub(_escape, text)


def named(path: str) -> str:
    """The path of a file or directory for people: of one above this, its name instead of `..`."""
    if path.strip("./") or ".." not in path:
        return path
    return os.path.basename(os.path.realpath(path)) or path  # noqa: PTH119


def _escape(match: re.Match[str]) -> str:
    code = ord(match[0])
    if match[0] in _ENDS:
        return _ENDS[match[0]]
    if 0xDC80 <= code <= 0xDCFF:  # a byte of a file name that is not UTF-8
        return f"\\x{code - 0xDC00:02x}"
    return (
        f"\\x{code:02x}"
        if code < 0x100
        else f"\\u{code:04x}"
        if code < 0x10000
        else f"\\U{code:08x}"
    )


def has_colours(stream: TextIO) -> bool:
    """Whether a stream is a terminal that shows colours, and nobody has asked for none."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def controls_in_text(text: str) -> re.Match[str] | None:
    """The first control in a text or comment of a model; marks of scripts may be in them."""
    return None if text.isprintable() else _CONTROL_IN_TEXT.search(text)


def with_escapes(text: str) -> str:
    """A quoted text in which these are the escapes that Rebeca, C++ and Python have for them."""
    if text.isprintable():
        return text
    return _CONTROL_IN_TEXT.sub(lambda m: "".join(map(_unicode_escape, m[0])), text)


def _unicode_escape(character: str) -> str:
    code = ord(character)
    units = [code] if code < 0x10000 else [0xD800 + (code - 0x10000 >> 10), 0xDC00 + (code & 0x3FF)]
    return "".join(f"\\u{unit:04x}" for unit in units)


def without_commands(text: str, escape: str = r"\x23") -> str:
    """Whole lines, in which no CI system reads a command: `::error::`, `##[error]`."""
    if "::" in text:
        text = _COMMAND.sub(r"\1\\x3a", text)
    return without_old_commands(text, escape)


def without_old_commands(text: str, escape: str = r"\x23") -> str:
    """The same for those that are read anywhere in a line."""
    return _OLD_COMMAND.sub(lambda _: f"#{escape}", text) if "##" in text else text


def lines_text(lines: Iterable[str]) -> str:
    """Lines without their ends, as they are printed."""
    return "".join(without_commands(f"{one_line(line)}\n") for line in lines)


def say(line: str, *, err: bool = False, end: str = "\n") -> None:
    """Prints one line."""
    stream = sys.stderr if err else sys.stdout
    stream.write(without_commands(one_line(line)) + end)
    stream.flush()


def say_lines(lines: Iterable[str], stream: TextIO | None = None) -> None:
    """Prints lines on standard output, or another stream."""
    (stream or sys.stdout).write(lines_text(lines))


def write_data(text: str) -> None:
    """Prints the output of a command: in UTF-8 as it is, but cleaned on a terminal."""
    sys.stdout.flush()
    if sys.stdout.isatty():
        sys.stdout.write(printable(text))
        sys.stdout.flush()
        return
    sys.stdout.buffer.write(encoded(text))
    sys.stdout.buffer.flush()


def encoded(text: str) -> bytes:
    """A text in UTF-8; halves of characters, as JSON may have them, become escapes."""
    return text.encode("utf-8", "backslashreplace")


def json_text(value: object, indent: int | None = None) -> str:
    """A value as JSON that is safe to look at: controls are escapes, other characters are not."""
    text = json.dumps(value, indent=indent, ensure_ascii=False, allow_nan=False)
    return without_old_commands(_CONTROL.sub(lambda m: json.dumps(m[0])[1:-1], text), r"\u0023")
