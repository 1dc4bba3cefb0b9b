"""What an `install(...)` of a CMakeLists.txt puts where ROS looks for it, or elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from rebsync.reverse.build.cmake_text import Argument
from rebsync.source import Span

_SCRIPT = re.compile(r"scripts/(\w+)")
_PROGRAMS, _SHARED = "${CATKIN_PACKAGE_BIN_DESTINATION}", "${CATKIN_PACKAGE_SHARE_DESTINATION}"
_USED = (f"{_SHARED}/config", f"{_SHARED}/launch")  # the folders that nodes are started from
_FILES = frozenset({"DIRECTORY", "FILES", "PROGRAMS"})
# By these not all that is named is installed, or under another name, or only at times.
_LIMITS = frozenset({"CONFIGURATIONS", "EXCLUDE_FROM_ALL", "FILES_MATCHING", "REGEX", "RENAME"})
# What may be left out of a folder: no node reads it.
_IDLE = re.compile(r"\..+|\*\.py[co]|__pycache__|\*~|\*\.(?:md|orig|bak|sw[po])")
_OWN_FOLDER = re.compile(r"\$\{\w+_SOURCE_DIR\}/")
_Told = tuple[str, str, str, str, Span]


def installed(
    arguments: Sequence[Argument], names: Mapping[str, str], project: str
) -> Iterator[_Told]:
    """The programs and folders that one command installs, where ROS looks for them or elsewhere."""
    kind, words = "", [argument.text for argument in arguments]
    only = _limits(words)
    for at, argument in enumerate(arguments):
        text, span = argument.text, argument.span
        to = _destination(words, at, project)
        if text.isupper():
            kind = text
        elif kind == "TARGETS":
            place = _place(_PROGRAMS in to or not to, to)
            yield "installed program", "", names.get(text, text), place + only, span
        elif kind in _FILES and (
            _is_over_others(text, kind, to)
            or (_PROGRAMS in to and _is_over_programs(text, kind, words, names))
        ):
            shown = f"install {' '.join(words)}"
            yield "step of the build", "", shown, "given", span
        elif kind == "DIRECTORY" and not text.startswith("include"):  # no node needs headers there
            inside = f"{_SHARED}/{text.strip('/')}" if text.endswith("/") else _SHARED
            place = _place(to == [inside], to)
            yield "installed folder", "", text.strip("/"), place + only, span
        elif (script := _SCRIPT.fullmatch(text)) is not None:
            place = _place(to == [_PROGRAMS], to)
            yield "installed program", "", script[1], place + only, span


def _limits(words: Sequence[str]) -> str:
    """What of the named is not installed, as the words that say so; nothing where all is."""
    patterns = [words[at + 1 : at + 3] for at, word in enumerate(words) if word == "PATTERN"]
    is_whole = all(p[1:] != ["EXCLUDE"] or _IDLE.fullmatch(p[0]) is not None for p in patterns)
    if is_whole and _LIMITS.isdisjoint(words):
        return ""
    return f" but {' '.join(words)}"


def _is_over_others(text: str, kind: str, to: Sequence[str]) -> bool:
    """Whether files get into a folder that nodes are started from, out of another one."""
    path = _OWN_FOLDER.sub("", text)
    is_folder = kind == "DIRECTORY" and not path.endswith("/")
    folder, _, last = path.rpartition("/")
    for place in (f"{place}/{last}" if is_folder else place for place in to):
        used = any(f"{place}/".startswith(f"{used}/") for used in _USED)
        if used and place != f"{_SHARED}/{path if is_folder else folder}":
            return True
    return False


def _is_over_programs(text: str, kind: str, words: Sequence[str], names: Mapping[str, str]) -> bool:
    """Whether what is installed beside programs is named as one of them, or may be."""
    if kind == "DIRECTORY":
        return text.endswith("/")  # its files themselves
    renamed = words[words.index("RENAME") + 1 :] if "RENAME" in words else []
    name = renamed[0] if renamed else text.rpartition("/")[2]
    return name in names.values() or "$" in name


def _destination(words: Sequence[str], at: int, project: str) -> list[str]:
    """The folders that something may be installed in, as ROS calls them."""
    after = (words[i + 1] for i in range(at, len(words) - 1) if words[i] == "DESTINATION")
    named = (w.replace("${PROJECT_NAME}", project).rstrip("/") for w in after)
    known = {f"lib/{project}": _PROGRAMS, f"share/{project}": _SHARED}
    found = []
    for word in named:
        whole = next((n for n in known if word == n or word.startswith(f"{n}/")), "")
        found.append(f"{known[whole]}{word[len(whole) :]}" if whole else word)
    return found


def _place(is_there: bool, to: Sequence[str]) -> str:
    return "there" if is_there else f"there in {' '.join(to)}"
