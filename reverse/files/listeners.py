"""Programs of Python beside generated nodes that people run by hand, and that only listen.

No launch file starts them, nothing imports them, and they have no word for what acts on a node:
what they hear is told to people. They are no part of the system that a model says.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping

from rebsync.reverse.libraries.generated_calls import SUBSCRIBES
from rebsync.reverse.libraries.python import clients
from rebsync.source import Source

_PROGRAM = re.compile(r"(?:.*\.py|(?:.*/)?scripts/\w+)\Z")
_MODELLED = re.compile(r"^\s*(?:#|//) rebsync: (?:reactiveclass|interface) ", re.M)
_LAUNCH = re.compile(r"(?:\.launch(?:\.py|\.xml|\.yaml)?|(?:^|/)launch/.*)\Z")
_LISTENS = re.compile(SUBSCRIBES)
# What may be heard by others, or may be anything.
_ACTS = re.compile(
    r"publish|advertis|Service|Client|Action|create_client|create_service|call|param\b|set_param"
    r"|signal_|subprocess|\bos\b|\bsys\.modules|importlib|__|exec|eval|getattr|setattr|globals"
    r"|socket|Broadcaster|roslaunch|rosservice|rostopic|Mailbox",
    re.I,
)
_HARMLESS = re.compile(r"__name__|__main__|__init__|__future__|\w*callback\w*|call_count")
_IMPORTED = re.compile(r"^\s*(?:from\s+([\w.]+)\s+import\s+([^\n]+)|import\s+([\w., ]+))", re.M)
_ENTRY = r"['\"]\s*(\w+)\s*=\s*[\w.]*\b{}:\w+\s*['\"]"


def listeners(files: Mapping[str, Source]) -> frozenset[str]:
    """The files of such programs."""
    programs = {n: s for n, s in files.items() if _PROGRAM.match(n) and not _LAUNCH.search(n)}
    modelled = {_stem(n) for n, s in files.items() if _MODELLED.search(s.text)}
    found = {n for n, s in programs.items() if modelled and _only_listens(s.text, modelled)}
    if not found:
        return frozenset()
    started = " ".join(s.text for n, s in files.items() if _LAUNCH.search(n))
    setups = " ".join(s.text for n, s in files.items() if n.endswith("setup.py"))
    imported = {name for s in programs.values() for name in _imports(s.text)}
    return frozenset(
        path
        for path in found
        if _stem(path) not in imported
        and not any(
            re.search(rf"\b{name}\b", started)
            for name in (_stem(path), *re.findall(_ENTRY.format(_stem(path)), setups))
        )
    )


def _only_listens(text: str, modelled: set[str]) -> bool:
    if _MODELLED.search(text) or _LISTENS.search(text) is None:
        return False
    if not all(map(_is_known, _modules(text))):
        return False
    return _ACTS.search(_HARMLESS.sub("", text)) is None and modelled.isdisjoint(_imports(text))


def _modules(text: str) -> Iterator[str]:
    """The whole names of the modules that are imported."""
    for module, _, plain in _IMPORTED.findall(text):
        names = [module] if module else plain.split(",")
        yield from (name.split()[0] for name in names if name.strip())


def _is_known(module: str) -> bool:
    """Whether a module is of ROS, of Python, or has messages alone: others may do anything."""
    head = module.partition(".")[0]
    is_of_messages = module.endswith(".msg") and not module.startswith(".")
    return (
        is_of_messages or head in {lib.name for lib in clients()} or head in sys.stdlib_module_names
    )


def _imports(text: str) -> Iterator[str]:
    """The last names of what is imported, and of the modules that it is imported from."""
    for module, names, plain in _IMPORTED.findall(text):
        if module and not module.endswith(".msg"):
            yield module.rpartition(".")[2]
            yield from re.findall(r"\w+", names)
        yield from (name.strip().rpartition(".")[2] for name in plain.split(",") if plain)


def _stem(path: str) -> str:
    return path.rpartition("/")[2].removesuffix(".py")
