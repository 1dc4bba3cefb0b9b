"""The functions and state variables of generated sources, found by their markers and shape."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

BODIES = ("constructor", "msgsrv", "method")

_CPP_MARKED = re.compile(
    r"^// rebsync: (constructor|msgsrv|method|send) (\S+)\n(?://[^\n]*\n)*[^\n;]*\{\n", re.MULTILINE
)
_CPP_SETUP = re.compile(r"^(\w+)::\1\([^{;]*\{", re.MULTILINE)
_CPP_RECEIVE = re.compile(r"^void (\w+)::(receive\w+)\([^{;]*\{\n", re.MULTILINE)
_CPP_MEMBER = re.compile(
    r"^  ([\w:<>, ]+?) (\w+)(?:\{\})?;\s*// rebsync: statevar (\S+)$", re.MULTILINE
)
_CPP_SEND = re.compile(r"^void (\w+)::(send\w+)\(([^)]*)\) \{$", re.MULTILINE)
_CPP_CLASS = re.compile(r"^// rebsync: reactiveclass (\S+)$", re.MULTILINE)

_PY_HEAD = r"    def (\w+)\(self[^:]*(?:: (?:[^:()]|\([^()]*\))*)*\)[^\n]*:\n"
_PY_MARKED = re.compile(
    rf"^    # rebsync: (constructor|msgsrv|method|send) (\S+)\n(?:    #[^\n]*\n)*{_PY_HEAD}",
    re.MULTILINE,
)
_PY_SETUP = re.compile(r"^    def __init__\(self[^\n]*\) -> None:\n", re.MULTILINE)
_PY_RECEIVE = re.compile(r"^    def (_receive_\w+)\(self[^\n]*:\n", re.MULTILINE)
_PY_MEMBER = re.compile(
    r"^        self\.(\w+): ([^=\n]+) = [^\n]*  # rebsync: statevar (\S+)$", re.M
)
_PY_SEND = re.compile(r"^    def (send_\w+)\(self(?:, ([^\n]*))?, when: When = AT_ONCE\)", re.M)
_PY_CLASS = re.compile(r"^# rebsync: reactiveclass (\S+)$", re.MULTILINE)


@dataclass(frozen=True)
class Part:
    """A function of a file: its kind, the element that it is or belongs to, and its extent."""

    kind: str
    element: str
    path: str
    start: int
    end: int

    @property
    def owner(self) -> str:
        """The class."""
        return self.element.partition(".")[0]


@dataclass(frozen=True)
class Member:
    """A state variable."""

    type: str
    name: str
    element: str


def parts_in(path: str, text: str) -> Iterator[Part]:
    """The functions of a source of a class."""
    yield from _py_parts(path, text) if path.endswith(".py") else _cpp_parts(path, text)


def members_in(path: str, text: str) -> list[Member]:
    """The state variables that a file declares."""
    if path.endswith(".py"):
        return [Member(m[2], f"self.{m[1]}", m[3]) for m in _PY_MEMBER.finditer(text)]
    return [Member(m[1], m[2], m[3]) for m in _CPP_MEMBER.finditer(text)]


def class_in(path: str, text: str) -> str | None:
    """The reactive class that a file declares."""
    found = (_PY_CLASS if path.endswith(".py") else _CPP_CLASS).search(text)
    return found[1] if found is not None else None


def sends_in(path: str, text: str) -> Iterator[tuple[tuple[str, str], tuple[str, ...]]]:
    """The types of the parameters of each sending function, by its class and name."""
    if path.endswith(".py"):
        owner = class_in(path, text) or ""
        for m in _PY_SEND.finditer(text):
            yield (owner, m[1]), tuple(p.partition(": ")[2] for p in split(m[2] or ""))
        return
    for m in _CPP_SEND.finditer(text):
        yield (m[1], m[2]), tuple(p.strip().rpartition(" ")[0] for p in m[3].split(",")[:-1])


def split(arguments: str) -> list[str]:
    """Arguments, told apart at the commas that no bracket encloses."""
    parts, depth, last = [], 0, 0
    for at, char in enumerate(arguments):
        depth += (char in "([{") - (char in ")]}")
        if char == "," and depth == 0:
            parts.append(arguments[last:at].strip())
            last = at + 1
    return parts + ([arguments[last:].strip()] if arguments.strip() else [])


def _cpp_parts(path: str, text: str) -> Iterator[Part]:
    for m in _CPP_MARKED.finditer(text):
        yield Part(m[1], m[2], path, m.end(), _cpp_end(text, m.end()))
    for m in _CPP_SETUP.finditer(text):
        yield Part("setup", m[1], path, m.start(), _cpp_end(text, m.end()))
    for m in _CPP_RECEIVE.finditer(text):
        yield Part("receive", f"{m[1]}.{m[2]}", path, m.end(), _cpp_end(text, m.end()))


def _cpp_end(text: str, start: int) -> int:
    """The end of a function's last statement."""
    return text.index("\n}\n", start) + 1


def _py_parts(path: str, text: str) -> Iterator[Part]:
    owner = class_in(path, text)
    if owner is None:
        return
    for m in _PY_MARKED.finditer(text):
        yield Part(m[1], m[2], path, m.end(), _py_end(text, m.end()))
    for m in _PY_SETUP.finditer(text):
        yield Part("setup", owner, path, m.end(), _py_end(text, m.end()))
    for m in _PY_RECEIVE.finditer(text):
        yield Part("receive", f"{owner}.{m[1]}", path, m.end(), _py_end(text, m.end()))


def _py_end(text: str, start: int) -> int:
    """The end of the lines that are indented as a method's body is."""
    body = re.compile(r"(?:        [^\n]*\n|\n+(?=        ))*").match(text, start)
    return body.end() if body is not None else start
