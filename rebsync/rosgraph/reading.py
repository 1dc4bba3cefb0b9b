"""Reads a package: which nodes its code has, and what each of them asks of ROS."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from rebsync.reverse.build.built import unbuilt
from rebsync.reverse.build.manifests import name_in
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import SETUP, is_launch, is_python
from rebsync.reverse.files.reading import Chosen
from rebsync.reverse.findings import Grade
from rebsync.rosgraph.cpp_code import nodes_in_cpp
from rebsync.rosgraph.ends import NodeCode, PackageCode
from rebsync.rosgraph.generated import with_mailboxes
from rebsync.rosgraph.python_code import nodes_in_python
from rebsync.source import Source

_MANIFEST = "package.xml"
_CODE = tuple(sorted(CODE))
_TESTS = frozenset({"test", "tests", "testing"})
_INTERFACES = (".msg", ".srv", ".action")
_SETTINGS = (".yaml", ".yml", ".xml", ".launch")


def read_package(given: Chosen) -> PackageCode:
    """The nodes of a package. Its tests, and code that no program is made of, are left out."""
    named = given.files.get(_MANIFEST)
    name = (name_in(named) if named is not None else None) or Path(given.root).resolve().name
    left = unbuilt(given.files)
    files = {
        path: source
        for path, source in given.files.items()
        if path not in left.left - left.needed and not _TESTS & set(path.split("/")[:-1])
    }
    settings = {p: s for p, s in files.items() if p.endswith(_SETTINGS) or is_launch(p)}
    odd = tuple((f.source.path, f.why) for f in given.findings if f.grade is Grade.UNREADABLE)
    types = frozenset(Path(p).stem for p in given.files if p.endswith(_INTERFACES))
    read = with_mailboxes(list(_nodes(files, name)), given.files, name)
    nodes = tuple(_without_loose(list(read), is_whole=not odd))
    return PackageCode(name, given.root, nodes, settings, types, odd)


def _without_loose(nodes: list[NodeCode], *, is_whole: bool) -> Iterator[NodeCode]:
    """The nodes and what else has ends.

    None is closed where code that any of them may run asks for more, or a file was not read.
    """
    is_closed = is_whole and all(node.is_node for node in nodes)
    for node in nodes:
        if node.is_node or node.ends:
            yield replace(node, closed=node.closed and is_closed)


def _nodes(files: Mapping[str, Source], package: str) -> Iterator[NodeCode]:
    if any(path.endswith(_CODE) for path in files):
        yield from nodes_in_cpp(files, package)
    python = {p: s for p, s in files.items() if p != SETUP and is_python(p, s)}
    code = {p: s for p, s in python.items() if not is_launch(p)}
    if code:
        yield from nodes_in_python(code, files, package)
