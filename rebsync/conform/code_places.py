"""Where in a generated package the body of a message server is, by the markers in its code."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from rebsync.conform.conformance import CodePlace, Deviation
from rebsync.diagnostics import RebsyncError
from rebsync.files import source_below
from rebsync.model import MessageServer, Model, walk
from rebsync.records import dataclass
from rebsync.roundtrip.package.markers import elements
from rebsync.source import Source


@dataclass(frozen=True, slots=True)
class _Body:
    """A server as its marker names it; `number` counts the overloads in a class, of `count`."""

    name: str
    number: int
    count: int


def code_place(
    deviation: Deviation, model: Model, source: Source, root: str, files: tuple[str, ...]
) -> CodePlace | None:
    """The place in the code of the server whose place in the model a deviation has.

    `files` are those that were generated, below the folder of the package. None: there is no such
    server, or the markers do not say which of several it is.
    """
    body = _body(deviation, model, source)
    if body is None:
        return None
    found = list(_marked(body.name, root, files))
    if len(found) == 1:
        return found[0]
    return found[body.number] if len(found) == body.count else None


def _body(deviation: Deviation, model: Model, source: Source) -> _Body | None:
    """The server in the line of the model that the deviation names."""
    names = {a.server for a in deviation.allowed} | {s.server for s in (deviation.served,) if s}
    for each in model.classes:
        servers = [n for n in walk(each) if isinstance(n, MessageServer)]
        for server in servers:
            line = source.position(server.name_span.start).line
            start = source.position(server.span.start).line
            if server.name in names and deviation.line in (line, start):
                same = [s for s in servers if s.name == server.name]
                number = next(i for i, s in enumerate(same) if s is server)
                return _Body(f"msgsrv {each.name}.{server.name}", number, len(same))
    return None


def _marked(name: str, root: str, files: tuple[str, ...]) -> Iterator[CodePlace]:
    """The lines behind the markers of an element, and behind the comments that follow these."""
    for file in files:
        with suppress(RebsyncError):
            code = source_below(root, file)
            lines = code.text.split("\n") if code is not None else []
            for number, line in enumerate(lines):
                element = next(elements(line), None) if "rebsync:" in line else None
                if element is None or element.name != name:
                    continue
                while number < len(lines) and lines[number].lstrip().startswith(("//", "#")):
                    number += 1
                yield CodePlace(f"{root}/{file}", number + 1)
