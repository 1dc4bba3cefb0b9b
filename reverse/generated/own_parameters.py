"""Parameters of a node's own that set-up reads into state variables, in C++ and in Python.

They are arguments of the model's constructor: a launch file or a parameter file gives each rebec
its own, and the code a value where none does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.literals import literal_of
from rebsync.names import uncarry
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reserved import RESERVED, RESERVED_GLOBALS
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.env_values import as_type, plain_value
from rebsync.reverse.launch.launched import LaunchedNode
from rebsync.reverse.launch.parameters import Parameter
from rebsync.source import Span

_KINDS: dict[type, str] = {bool: "boolean", int: "int", float: "double"}


@dataclass(frozen=True, slots=True)
class OwnParameter:
    """A parameter of the node by its graph name, and its value where nothing sets it.

    `widens`: a whole number is taken where a decimal one is asked for. `for_all`: a parameter file
    may set it for all nodes at once, as in ROS 2.
    """

    key: str
    default: Value
    widens: bool = False
    for_all: bool = False

    @property
    def is_plain(self) -> bool:
        """Whether it is none of the parameters that generated code reads for itself."""
        first = self.key.partition("/")[0]
        return first not in RESERVED_GLOBALS | {"knownrebecs", "env", "use_sim_time"}

    def fits(self, type_: m.Type | None) -> bool:
        """Whether a variable of a type has all values that the code may read."""
        kind = _KINDS.get(type(self.default))
        return type_ is not None and type_ in (m.Type(kind or ""), _WIDER.get(kind or ""))

    def takes(self, value: Value | None) -> bool:
        """Whether the code reads this value as it is."""
        widened = self.widens and type(value) is int and isinstance(self.default, float)
        return type(value) is type(self.default) or widened


_WIDER = {"int": m.Type("double")}


def only_once(reads: Iterable[tuple[str, OwnParameter]]) -> dict[str, OwnParameter]:
    """The parameters by their variables: those that are read once, into one variable."""
    found = list(reads)
    names, keys = [name for name, _ in found], [p.key for _, p in found]
    return {n: p for n, p in found if names.count(n) == keys.count(p.key) == 1}


@dataclass(frozen=True, slots=True)
class Stored:
    """A state variable with the parameter that it gets."""

    name: str
    type: m.Type
    parameter: OwnParameter
    span: Span


def with_own(
    made: Sequence[m.Constructor], own: Sequence[Stored], name: str
) -> Iterator[m.Constructor]:
    """Constructors of a class that take such parameters too, behind their own, and store them."""
    for each in made or ((m.Constructor(name, (), m.Block(())),) if own else ()):
        parameters, stores = list(each.parameters), list[m.Statement]()
        for stored in own:
            given = _free(stored, each, parameters)
            parameters.append(m.Parameter(stored.type, given, stored.span))
            target: m.Expression = m.Name(stored.name)
            if given == stored.name:
                target = m.Member(m.Self(), stored.name)
            stores.append(
                m.ExpressionStatement(m.Assign("=", target, m.Name(given)), span=stored.span)
            )
        body = each.body
        if body is not None:
            body = replace(body, statements=(*stores, *body.statements))
        yield replace(each, parameters=tuple(parameters), body=body)


def _free(stored: Stored, made: m.Constructor, parameters: Sequence[m.Parameter]) -> str:
    """A name for the argument that hides nothing which the constructor names."""
    named = {n.name for n in m.walk(made) if isinstance(n, m.Name | m.Declarator)}
    taken = named | {p.name for p in parameters}
    key = stored.parameter.key
    name = uncarry(key, RESERVED) if key.isidentifier() else stored.name
    free, number = name, 1
    while free in taken:
        number += 1
        free = f"{name}_{number}"
    return free


def list_refused(
    node: LaunchedNode,
    told: Sequence[OwnParameter],
    common: Sequence[Parameter],
    findings: Findings,
    within: str,
) -> None:
    """Lists values for which a node of ROS 2 does not start, of parameters that no model has."""
    everywhere = {p.name: p for p in common}
    for parameter in told:
        given = node.parameter(parameter.key) or everywhere.get(f"/{parameter.key}")
        if given is None or not parameter.for_all:
            continue
        value = plain_value(given)
        if value is not None and not parameter.takes(value):
            why = f"the code reads another kind of value for `{parameter.key}`"
            findings.unreadable(given.source, Unread(given.span, why), within)


def given_to(
    node: LaunchedNode,
    own: Sequence[Stored],
    common: Sequence[Parameter],
    findings: Findings,
    within: str,
) -> Iterator[m.Expression]:
    """The arguments that they are for a node that is started; what has no known value is listed."""
    everywhere = {p.name: p for p in common}
    for stored in own:
        try:
            value, given = _value_of(stored.parameter, node, everywhere)
        except Unread as unread:
            given = node.parameter(stored.parameter.key) or everywhere.get(
                f"/{stored.parameter.key}"
            )
            source = given.source if given is not None else node.source
            findings.unreadable(source, unread, within)
            continue
        made = literal_of(as_type(value, stored.type))
        yield made if given is None else replace(made, span=given.source.within(given.span))


def _value_of(
    own: OwnParameter, node: LaunchedNode, common: Mapping[str, Parameter]
) -> tuple[Value, Parameter | None]:
    """The value of a parameter for a node, and what sets it. Unread: it is not known."""
    everywhere = common.get(f"/{own.key}") if own.for_all else None
    given = node.parameter(own.key) or everywhere
    if given is None:
        return own.default, None
    value = plain_value(given)
    if value is None or not own.takes(value):
        raise Unread(given.span, f"the code reads another kind of value for `{own.key}`")
    if everywhere is not None and given.value != everywhere.value:
        raise Unread(given.span, f"`{own.key}` is set for all nodes as well, to another value")
    return value, given
