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
    """The facts but for those of classes of other packages of which no object is made."""
    used: dict[str, bool] = {}
    for fact in facts:
        owner = _class_beside(fact)
        if owner and owner not in used:
            used[owner] = is_made(owner, files)
        if not owner or used[owner]:
            yield fact


def is_made(name: str, files: Iterable[Cpp]) -> bool:
    """Whether objects of a class of another package may be made: its name stands for one."""
    return any(_is_used_in(name, each) for each in files)


def _class_beside(fact: Fact) -> str:
    """The class of another package that a fact belongs to; or empty."""
    site = fact.site
    is_of_class = site.function is None or site.function.owner
    return site.owner or "" if site.cpp.is_beside and is_of_class else ""


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
