"""Files that are no code to read, but that come before generated code, or before a library's.

An extension module comes before a module of Python of its name (importlib, FileFinder), a header
without the suffix of one before that of the C++ library, and a `pyproject.toml` before `setup.py`.
What tells colcon or catkin to ignore a package comes before all of it.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from posixpath import dirname

from rebsync.diagnostics import RebsyncError
from rebsync.reverse.files.packages import CODE, IGNORING, Listing, suffix_of
from rebsync.reverse.files.stores import Disk, Entry, Store, join
from rebsync.source import Source
from rebsync.toml import read_toml

_MANIFEST, _OF_COLCON = "package.xml", "colcon.pkg"
_LOOKING = frozenset(
    {"autopep8", "bandit", "black", "codespell", "coverage", "flake8", "isort", "mypy"}
    | {"pydocstyle", "pylint", "pyright", "pytest", "ruff", "tox", "vulture", "yapf"}
)
_COMPILED = re.compile(r"(\w+)(?:\.[\w-]+)*\.(?:so|pyd|pyc)")
_PROSE = frozenset({".md", ".rst", ".txt"})
_HEADERS, _GCH = "include/", ".gch"
_SETUP, _PROJECT, _INIT = "setup.py", "pyproject.toml", "/__init__.py"
_IMPORTED = "Python may import this in place of other code"
_INCLUDED = "this is included in place of a header of the library"
_PRECOMPILED = "this may be included in place of the header that it is compiled from"
_NOT_BUILT = "with this, nothing of the package is built"
_BUILT = "this says anew what is built of the package"


def overriding_files(listing: Listing, generated: Collection[str]) -> dict[str, str]:
    """Such files by their paths in a package, each with what it does."""
    files = listing.store or Disk()
    found = dict.fromkeys(_compiled_python(files, listing.root, generated), _IMPORTED)
    headers = [n for n in generated if n.startswith(_HEADERS)]
    if headers:
        own = {_HEADERS + n.split("/")[1] for n in headers}
        found |= dict.fromkeys(_of_no_suffix(files, listing.root, own), _INCLUDED)
    for folder in {dirname(n) for n in headers}:
        names = (f"{folder}/{e.name}" for e in _entries(files, join(listing.root, folder)))
        precompiled = (n for n in names if n.endswith(_GCH) and n.removesuffix(_GCH) in generated)
        found |= dict.fromkeys(precompiled, _PRECOMPILED)
    for setup in (n for n in generated if n.rpartition("/")[2] == _SETUP):
        name = setup.removesuffix(_SETUP) + _PROJECT
        if _says_what_is_built(_text(files, join(listing.root, name))):
            found[name] = _BUILT
    for folder in {dirname(n) for n in generated if n.rpartition("/")[2] == _MANIFEST}:
        for entry in _entries(files, join(listing.root, folder) if folder else listing.root):
            if entry.name in IGNORING or entry.name == _OF_COLCON:
                why = _BUILT if entry.name == _OF_COLCON else _NOT_BUILT
                found[f"{folder}/{entry.name}".lstrip("/")] = why
    return found


def _of_no_suffix(files: Store, root: str, own: Collection[str]) -> Iterator[str]:
    """What may be included and has not the name of a header, but in folders of the package."""
    folders = [_HEADERS]
    while folders:
        folder = folders.pop()
        for entry in _entries(files, join(root, folder)):
            name = folder + entry.name
            if name in own or entry.name.startswith("."):
                continue
            if entry.is_dir() and not entry.is_symlink():
                folders.append(f"{name}/")
            elif entry.is_dir() or suffix_of(name) not in CODE | _PROSE:
                yield name


def _says_what_is_built(text: str) -> bool:
    """Whether a `pyproject.toml` has more than tables of tools that only look at code."""
    try:
        table = read_toml(Source(_PROJECT, text)).values
    except RebsyncError:
        return True  # pip and setuptools end there
    tools = table.get("tool", {})
    return not table.keys() <= {"tool"} or not (
        isinstance(tools, dict) and tools.keys() <= _LOOKING
    )


def _compiled_python(files: Store, root: str, generated: Collection[str]) -> Iterator[str]:
    """Compiled modules of the names of generated ones, and those where Python looks first."""
    packages = {n.removesuffix(_INIT) for n in generated if n.endswith(_INIT)}
    first = {dirname(n) for n in packages}
    first |= {dirname(n) for n in generated if dirname(n).rpartition("/")[2] == "scripts"}
    for folder in sorted(packages | first):
        for entry in _entries(files, join(root, folder) if folder else root):
            name = f"{folder}/{entry.name}".lstrip("/")
            module = _COMPILED.fullmatch(entry.name)
            if module is not None and (folder in first or f"{folder}/{module[1]}.py" in generated):
                yield name
            elif f"{name}.py" in generated and entry.is_dir():
                inside = (e.name for e in _entries(files, entry.path))
                yield from (
                    f"{name}/{i}" for i in inside if i.startswith("__init__.") and i[-3:] != ".py"
                )


def _entries(files: Store, folder: str) -> Sequence[Entry]:
    try:
        return files.entries(folder)
    except (OSError, RebsyncError):
        return ()


def _text(files: Store, path: str) -> str:
    try:
        return files.read(path).decode("utf-8", "replace")
    except (OSError, RebsyncError):
        return ""
