"""What of a model its generated nodes show: names, fields of state messages, texts of arguments."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, TypeAlias, TypeGuard

from rebsync.checker.program import NULL, Cell, Kind, Program, Slot
from rebsync.checker.values import cell_of, real
from rebsync.package import Package, StateType
from rebsync.records import dataclass

NOBODY = -2  # the cell of a name that is no rebec's: no state of the model has it
_CLOSE = {"float": 2**-22, "double": 2**-48}

Cells: TypeAlias = tuple[Cell, ...]


@dataclass(frozen=True, slots=True)
class Observable:
    """The rebecs of a program as nodes: their names, and how values and arguments are written."""

    program: Program
    nodes: tuple[str, ...]
    states: tuple[StateType, ...]
    package: Package

    @classmethod
    def of(cls, program: Program, package: Package) -> Observable:
        """The rebecs of a program as the nodes of the package that carries it out."""
        names = {i.rebec: i.name for i in package.instances}
        states = tuple(package.node_class(r.class_name).state for r in program.rebecs)
        return cls(program, tuple(names[r.name] for r in program.rebecs), states, package)

    def decoder(self, rebec: int) -> tuple[tuple[str, ...], Callable[[Sequence[Any]], Cells]]:
        """The fields of a rebec's state message, and what makes cells of their values."""
        info = self.program.rebecs[rebec]
        fields = {f.source: f.name for f in self.states[rebec].fields}
        names = tuple(fields[slot.name] for slot in info.state)
        readers = [self.reader(slot.kind) for slot in info.state]
        slots = list(zip(names, (slot.size for slot in info.state), readers, strict=True))
        is_plain = all(not slot.type.dimensions for slot in info.state)

        def decode(values: Sequence[Any]) -> Cells:
            if is_plain and not any(map(is_list, values)):
                return tuple([read(value) for read, value in zip(readers, values, strict=True)])
            cells: list[Cell] = []
            for (name, size, read), value in zip(slots, values, strict=True):
                elements = [value] if size == 1 and not is_list(value) else list(value)
                if len(elements) != size:
                    raise ValueError(f"{name} has {len(elements)} elements, not {size}")
                cells += map(read, elements)
            return tuple(cells)

        return names, decode

    def reader(self, kind: Kind) -> Callable[[Any], Cell]:
        """What makes a cell of a field's value. TypeError, ValueError: it is of another kind."""
        match kind:
            case "float" | "double":
                return lambda value: cell_of(float(value))
            case "rebec":
                return self._rebec
            case _:
                return int

    def _rebec(self, name: object) -> Cell:
        if name == "":
            return NULL
        named = str(name).strip("/").rsplit("/", 1)[-1]
        return self.nodes.index(named) if named in self.nodes else NOBODY

    def arguments(self, server: int, cells: Sequence[Cell]) -> str:
        """The text that a state message has for the arguments of a message."""
        body = self.program.bodies[self.program.servers[server].body]
        return ", ".join(self._shown(slot, cells) for slot in body.parameters)

    def _shown(self, slot: Slot, cells: Sequence[Cell]) -> str:
        texts = [self.value(c, slot.kind) for c in cells[slot.offset : slot.offset + slot.size]]
        return nested(texts, slot.type.dimensions)

    def value(self, cell: Cell, kind: Kind) -> str:
        """A value as nodes write it."""
        match kind:
            case "boolean":
                return "true" if cell else "false"
            case "float" | "double":
                return f"{real(cell):g}"
            case "rebec":
                return self.nodes[cell] if cell >= 0 else ""
            case _:
                return str(cell)

    def differing(self, rebec: int, recorded: Cells, expected: Cells) -> tuple[str, ...]:
        """The variables of which two states of a rebec have different values."""
        return tuple(
            name
            for name, kind, cell in self.variables(rebec)
            if not is_close(recorded[cell], expected[cell], kind)
        )

    def variables(self, rebec: int) -> tuple[tuple[str, Kind, int], ...]:
        """The variables of a rebec, arrays element by element: name, kind, number of the cell."""
        return tuple(
            (name, slot.kind, cell)
            for slot in self.program.rebecs[rebec].state
            for name, cell in _elements(slot)
        )

    def shown(self, rebec: int, cells: Cells) -> dict[str, str]:
        """The values of the variables of a rebec as nodes write them, by name."""
        return {name: self.value(cells[at], kind) for name, kind, at in self.variables(rebec)}

    def is_same(self, rebec: int, recorded: Cells, expected: Cells) -> bool:
        """Whether two states of a rebec are equal, up to the last bits of floating numbers."""
        return recorded == expected or not self.differing(rebec, recorded, expected)


def kinds(program: Program, server: int) -> list[Kind]:
    """The kinds of the cells of a message."""
    parameters = program.bodies[program.servers[server].body].parameters
    return [slot.kind for slot in parameters for _ in range(slot.size)]


def is_close(one: Cell, other: Cell, kind: Kind) -> bool:
    """Equal; of floating numbers up to what libraries of mathematics leave open."""
    if one == other or kind not in _CLOSE:
        return one == other
    return math.isclose(real(one), real(other), rel_tol=_CLOSE[kind])


def is_list(value: object) -> TypeGuard[Sequence[Any]]:
    """Whether a value is an array of a message."""
    return hasattr(value, "__len__") and not isinstance(value, (str, bytes))


def _elements(slot: Slot) -> list[tuple[str, int]]:
    if not slot.type.dimensions:
        return [(slot.name, slot.offset)]
    indices = product(*(range(n) for n in slot.type.dimensions))
    return [
        (slot.name + "".join(f"[{n}]" for n in index), slot.offset + i)
        for i, index in enumerate(indices)
    ]


def nested(texts: Sequence[str], dimensions: Sequence[int]) -> str:
    """The texts of the elements of an array as nodes write the whole."""
    if not dimensions:
        return texts[0]
    step = len(texts) // dimensions[0]
    parts = (texts[i * step : (i + 1) * step] for i in range(dimensions[0]))
    return "[" + ", ".join(nested(part, dimensions[1:]) for part in parts) + "]"
