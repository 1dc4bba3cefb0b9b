"""The rules of `case` and `default`."""

from __future__ import annotations

from rebsync.model import Expression, Name, Switch, Type, walk
from rebsync.static.constants import constant
from rebsync.static.scope import Body
from rebsync.static.symbols import EnvSymbol
from rebsync.static.types import is_integer


def check_order(switch: Switch, body: Body) -> None:
    """At least one case, and one default at most, at the end."""
    defaults = [case for case in switch.cases if case.value is None]
    if len(defaults) == len(switch.cases):
        body.facts.error("RS419", switch.span, "a switch needs at least one case")
    for extra in defaults[1:]:
        place = ((defaults[0].span, "the first one"),)
        body.facts.error("RS419", extra.span, "a switch has one default", related=place)
    if len(defaults) == 1 and switch.cases[-1].value is not None:
        body.facts.error("RS419", defaults[0].span, "default must come last")


def check_label(
    label: Expression, type_: Type | None, seen: dict[int, Expression], body: Body
) -> None:
    """A label must be an integer constant that no other label of the switch has."""
    if type_ is None:
        return
    value = constant(label)
    if not is_integer(type_):
        message = f'a case must be an integer, not "{type_}"'
        body.facts.error("RS306", label.span, message)
    elif not isinstance(value, int):
        names = [n for n in walk(label) if isinstance(n, Name)]
        env = any(isinstance(body.facts.symbols.get(id(n)), EnvSymbol) for n in names)
        hint = "an env variable may change at the start: use if and else" if env else None
        body.facts.error("RS417", label.span, "a case must be constant", hint)
    elif value in seen:
        place = ((seen[value].span, "the first one"),)
        body.facts.error("RS418", label.span, f"case {value} stands here twice", related=place)
    else:
        seen[value] = label
