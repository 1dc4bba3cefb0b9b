"""What a package asks of ROS in the files that it takes of other packages of the workspace.

These declare more than the package uses. A class there is told by its name: where that is written
only to declare and define the class, no object of it is made, and it asks for nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from rebsync.reverse.graph import Fact
from rebsync.reverse.syntax.cpp_tree import Cpp


def without_unused(facts: Iterable[Fact], files: Sequence[Cpp]) -> Iterator[Fact]:
    """The facts but for those of classes and functions of other packages that nothing uses."""
    used: dict[str, bool] = {}
    for fact in facts:
        owner = fact.site.owner or ""
        if fact.site.cpp.is_beside and owner not in used:
            is_class = fact.site.function is None or fact.site.function.owner
            used[owner] = (is_made if is_class else is_named)(owner, files)
        if not fact.site.cpp.is_beside or used[owner]:
            yield fact


def is_named(name: str, files: Iterable[Cpp]) -> bool:
    """Whether the own files of a package name a function of another one, or several files do."""
    found = [each for each in files if name.encode() in each.words]
    return len(found) > 2 or any(not each.is_beside for each in found)


def is_made(name: str, files: Iterable[Cpp]) -> bool:
    """Whether objects of a class of another package may be made: its name stands for one."""
    return any(_is_used_in(name, each) for each in files)


def _is_used_in(name: str, file: Cpp) -> bool:
    word = name.encode()
    if word not in file.words:
        return False
    if not file.is_beside:
        return True
    in_python = file.source.path.endswith(".py")
    return (_in_python if in_python else _in_cpp)(word).search(file.data) is not None


def _in_python(word: bytes) -> re.Pattern[bytes]:
    """The name but for where its class begins."""
    return re.compile(rb"(?<!class )\b" + word + rb"\b")


def _in_cpp(word: bytes) -> re.Pattern[bytes]:
    """The name but for where its class begins, and those of its constructors and members."""
    plain = rb"(?<!class )(?<!struct )(?<![~\w])" + word + rb"\b(?!\s*(?:::|\(|\{))"
    made = rb"(?:\bnew\b|\breturn\b|[=,(<?]|[)]\s*:)\s*(?:\w+::)*" + word + rb"\s*[({]"
    return re.compile(made + rb"|" + plain)
