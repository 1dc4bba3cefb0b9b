"""The files of packages that are generated from an element of a model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from lsprotocol import types as lsp

from rebsync.lsp.border import marker_names
from rebsync.lsp.document import ModelDocument
from rebsync.lsp.occurrences import Entity
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import recorded_files


def with_generated_files(
    shown: lsp.Hover, document: ModelDocument, entity: Entity, packages: Iterable[ManagedPackage]
) -> lsp.Hover:
    """A hover text with links to the files that packages have of an element."""
    lines = [_line(Path(p.root).absolute(), document, entity) for p in packages]
    assert isinstance(shown.contents, lsp.MarkupContent)
    text = "\n\n".join((shown.contents.value, *filter(None, lines)))
    return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text), shown.range)


def _line(root: Path, document: ModelDocument, entity: Entity) -> str:
    links = (f"[{name}]({(root / name).as_uri()})" for name in _files(root, document, entity))
    shown = ", ".join(links)
    return f"in `{root.name}`: {shown}" if shown else ""


def _files(root: Path, document: ModelDocument, entity: Entity) -> Iterator[str]:
    """The files whose markers name an element, or what is in it, and its message types."""
    wanted, inside = set(marker_names(document, entity)), f"{entity.name}."
    types = set(_type_files(document, entity))
    for name, elements in recorded_files(root).items():
        is_inside = entity.kind == "reactiveclass" and any(
            each.partition(" ")[2].startswith(inside) for each in elements
        )
        if is_inside or name in types or not wanted.isdisjoint(elements):
            yield name


def _type_files(document: ModelDocument, entity: Entity) -> Iterator[str]:
    """Where the generator writes the types of a server's messages, or of what a node publishes."""
    topics = document.topics
    if topics is None:
        return
    if entity.kind in ("reactiveclass", "statevar"):
        yield f"msg/{topics.states[entity.owner or entity.name].name}.msg"
    if entity.kind != "msgsrv":
        return
    for info in document.analysis.classes.values():
        for server in info.servers:
            family = document.families[server.owner, server.name]
            if (family, server.name) == (entity.owner, entity.name):
                topic = topics.called(server)
                yield f"msg/{topic.message.name}.msg"
                yield from (f"srv/{topic.offer}.srv", f"action/{topic.offer}.action")
