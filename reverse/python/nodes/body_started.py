"""Which rebecs the nodes of hand-written Python are: as a launch file starts them, or one each."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from rebsync.records import dataclass
from rebsync.reverse.files.python_files import SETUP
from rebsync.reverse.graph import FromParameter, ParameterFact
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.parameter_sections import ANY
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_units import Start
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.python.bodies.body_scope import PyUnit
from rebsync.source import Source

# `talker = package.talker:main` in the scripts that a package of Python installs
_SCRIPT = re.compile(r"([\w.-]+)\s*=\s*([\w.]+)\s*:\s*(\w+)")
_LISTED = re.compile(r"console_scripts['\"]?\s*[:=]\s*\[?([^\]\[]*)")


@dataclass(frozen=True, slots=True)
class Started:
    """What starts the nodes: a launch file of a `package`, if any.

    `scripts` are the modules, with dots, of the programs that the package installs by their names;
    `others` the names of its programs in other languages. `entries` are the functions that its
    programs start, with their modules.
    """

    launch: Launch | None
    package: str
    scripts: Mapping[str, str]
    others: frozenset[str]
    others_start: bool = False
    entries: frozenset[tuple[str, str]] = frozenset()

    def starts(self, units: Iterable[PyUnit]) -> bool:
        """Whether the launch file starts any of some units."""
        launched = self.launch.nodes if self.launch is not None else ()
        return any(self._runs(node, unit) for unit in units for node in launched)

    def set_to(self, name: str) -> list[int | str | None]:
        """The values of the parameters with the same last name, of any node; None for others."""
        if self.launch is None:
            return []
        every = (self.launch.parameters, *(node.parameters for node in self.launch.nodes))
        last = name.rpartition("/")[2].lstrip("~")
        found = (p for of in every for p in of if p.name.rpartition("/")[2] in (last, ANY))
        return [p.value if isinstance(p.value, int | str) else None for p in found]

    def instances(self, unit: PyUnit, units: Sequence[PyUnit], names: Names) -> Iterator[Instance]:
        """The rebecs of a unit: one also where nothing starts it, which is idle if others start."""
        launched = self.launch.nodes if self.launch is not None else ()
        nodes: list[LaunchedNode | None] = [n for n in launched if self._runs(n, unit)]
        alone = sum(u.module is unit.module for u in units) == 1 or not unit.lineage
        start = Start(unit.unit, None, None)
        for node in nodes or [None]:
            own = unit.node
            if node is not None:
                node = node.named(own)
                own = node.name if isinstance(node.name, str) else own
            wish = own if alone else unit.lineage[0].name
            if not alone and len(nodes) > 1:
                wish = f"{own}_{wish}"
            space = node.namespace if node is not None else ""
            below = space.strip("/") if isinstance(space, str) else ""
            wish = wish[:1].lower() + wish[1:]
            name = names.give(wish, f"{below}_{wish}" if below else wish)
            idle = node is None and self.others_start
            yield Instance(start, name, own, node, self.launch, idle)

    def _runs(self, node: LaunchedNode, unit: PyUnit) -> bool:
        """Whether a tag of a launch file starts the program that a unit is of."""
        if not isinstance(node.type, str):
            return False
        if (
            self.package
            and node.package not in (self.package, "")
            and isinstance(node.package, str)
        ):
            return False
        path = unit.module.py.source.path
        if node.type in self.scripts:
            return is_module(path, self.scripts[node.type])
        plain = path.rpartition("/")[2]
        stem = plain.removesuffix(".py")
        return node.type == plain or (node.type == stem and stem not in self.others)


NOTHING = Started(None, "", {}, frozenset())


def settings(instance: Instance, asked: Collection[ParameterFact]) -> tuple[object, ...]:
    """What the parameters of a node are: bodies are read with their values."""
    values = []
    for fact in asked:
        value = instance.value(FromParameter(fact.name, fact.default))
        values.append(value if isinstance(value, bool | int | float) else "")
    return tuple((type(v).__name__, v) for v in values)


def scripts_of(files: Mapping[str, Source]) -> dict[str, str]:
    """The programs that the set-up of a package of Python installs, with their modules."""
    return {name: module for name, module, _ in _installed(files)}


def entries_of(files: Mapping[str, Source]) -> frozenset[tuple[str, str]]:
    """The functions that these programs start, with their modules."""
    return frozenset((module, function) for _, module, function in _installed(files))


def _installed(files: Mapping[str, Source]) -> list[tuple[str, str, str]]:
    listed = _LISTED.findall(files[SETUP].text) if SETUP in files else []
    return [found for part in listed for found in _SCRIPT.findall(part)]


def is_module(path: str, module: str) -> bool:
    """Whether a file is a module; a folder's own is its `__init__`."""
    below = module.replace(".", "/")
    whole = f"/{path}"
    return whole.endswith((f"/{below}.py", f"/{below}/__init__.py"))
