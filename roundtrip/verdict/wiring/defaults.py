"""Values that stand in for constants of the model, which count only where nothing gives them."""

from __future__ import annotations

import re

from rebsync.reverse.scaffold.fact import CONSTANT, TYPE, Fact, Facts

_FILE = "params.yaml"
_TYPES = {
    "int": re.compile(r"-?\d+"),
    "float": re.compile(r"-?\d+\.\d*"),
    "bool": re.compile(r"True|False"),
}


def is_always_given(base: Facts, today: Facts, key: tuple[str, str, str]) -> bool:
    """Whether all launch files load the constant that a default, by its key, stands in for.

    The default must be of the same type still, by which ROS 2 takes what is given.
    """
    constant = CONSTANT, "", key[2].removeprefix("env/")
    types = {_type(fact.value) for facts in (base, today) for fact in facts.get(key, ())}
    if constant not in base or constant not in today or len(types) != 1 or None in types:
        return False
    every = [fact for facts in today.values() for fact in facts]
    starting = {fact.source.path for fact in every if fact.kind == TYPE}
    of_nodes = [f for f in every if (f.kind, f.name) == ("node", "parameter file")]
    loading = {f.source.path for f in every if (f.kind, f.name) == ("parameter file", _FILE)}
    loading |= {fact.source.path for fact in of_nodes}
    return starting <= loading and all(map(_is_first, of_nodes))


def _is_first(files: Fact) -> bool:
    """Whether a node of ROS 2 has the constants from their file; those behind it are one by one."""
    return files.value.split()[0] == _FILE


def _type(default: str) -> str | None:
    """The type of a number or truth value; None of all else."""
    return next((name for name, pattern in _TYPES.items() if pattern.fullmatch(default)), None)
