"""Settings of nodes that may be other ones than they were generated with, and do the same."""

from __future__ import annotations

from rebsync.reverse.scaffold.fact import Facts

_REBECS, _UNIT, _WAIT, _CONSTANTS = "mailbox/rebecs", "mailbox/time_unit", "mailbox/settle", "env/"


def is_of_all_rebecs(today: Facts, key: tuple[str, str, str]) -> bool:
    """Whether a constant is given to each rebec alike: extraction reads it, and tells of it."""
    kind, _, name = key
    rebecs = {owner for _, owner, of in today if owner and of == _REBECS}
    if kind != "setting" or not name.startswith(_CONSTANTS) or not rebecs:
        return False
    given = [_values(today, (kind, each, name)) for each in rebecs]
    return all(len(values) == 1 and values == given[0] for values in given)


def waits_longer(base: Facts, today: Facts, key: tuple[str, str, str]) -> bool:
    """Whether nodes wait longer for more urgent messages of the same moment, but not too long.

    What is sent to the next unit of time has half a unit left for its way.
    """
    if key != ("parameter", "", _WAIT):
        return False
    try:
        old, new = (float(value) for facts in (base, today) for value in _values(facts, key))
        (unit,) = map(float, _values(today, ("parameter", "", _UNIT)) or ["1.0"])
    except ValueError:
        return False
    return old <= new <= unit / 2


def _values(facts: Facts, key: tuple[str, str, str]) -> list[str]:
    return [fact.value for fact in facts.get(key, ())]
