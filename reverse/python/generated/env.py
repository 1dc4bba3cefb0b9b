"""What the constants of the model are that generated Python reads from parameters."""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.intervals import INTEGERS, Interval, exactly
from rebsync.package import Value
from rebsync.reverse.generated.env_values import value_in_all
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.python.generated.parameters import constant
from rebsync.reverse.python.generated.roles import EnvUse


def integer_constants(uses: Iterable[EnvUse], launch: Launch | None) -> dict[str, Interval]:
    """The integers among the constants that some classes read, which all nodes give one value."""
    found: dict[str, set[Value | None]] = {}
    for use in uses:
        is_integer = use.type.name in INTEGERS and not use.type.dimensions
        value = None
        if launch is not None and is_integer:
            value = value_in_all(use.key, constant(use.default), launch)
        found.setdefault(use.name, set()).add(value)
    whole = {name: values.pop() for name, values in found.items() if len(values) == 1}
    return {name: exactly(value) for name, value in whole.items() if type(value) is int}
