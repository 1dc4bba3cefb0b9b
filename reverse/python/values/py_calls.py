"""What the nodes in some files of Python ask of ROS: the same value that is read from C++."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.calls.beside import without_unused
from rebsync.reverse.graph import (
    Callbacks,
    ClientFact,
    Fact,
    FromParameter,
    Graph,
    NodeFact,
    OneOf,
    ParameterFact,
    Place,
    PublisherFact,
    RateFact,
    Resolved,
    ServiceFact,
    Site,
    SubscriptionFact,
    TimerFact,
    Unresolved,
)
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python.values.interfaces import interface_of
from rebsync.reverse.python.values.py_asks import PyRosCall, asked_in
from rebsync.reverse.python.values.py_callbacks import callbacks_of, filtered
from rebsync.reverse.python.values.py_quality import depth_of, latched_of, policies_of
from rebsync.reverse.python.values.py_results import declared_together
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Duration,
    External,
    Made,
    NoneValue,
    Value,
    Ways,
    distinct,
    resolved,
)
from rebsync.reverse.syntax.py_index import CLASS, FUNCTION, Scope, arguments_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

_AROUND = frozenset({"parenthesized_expression", "await"})
_CONTAINERS = frozenset({"dictionary", "pair", "list", "tuple"})


def graph_with(values: PyValues) -> Graph:
    """All that files ask of ROS, some of whose values may be known."""
    facts = _Facts(values)
    every = (f for asked in asked_in(values) for f in facts.of(asked))
    return Graph(tuple(without_unused(every, [m.py for m in values.code.modules.values()])))


def facts_of(values: PyValues, asked: PyRosCall) -> Iterator[Fact]:
    """The facts of one call."""
    return _Facts(values).of(asked)


@dataclass(frozen=True, eq=False, slots=True)
class _Facts:
    """Makes facts of calls."""

    values: PyValues

    def of(self, asked: PyRosCall) -> Iterator[Fact]:
        kind = asked.ask.kind
        match kind:
            case Kind.DECLARED:
                yield from self._declared(asked)
            case Kind.SET:
                yield from self._set(asked)
            case Kind.READ:
                yield from self._read(asked)
            case Kind.PARAMETER:
                yield self._parameter(asked)
            case Kind.PUBLISHER | Kind.SUBSCRIPTION | Kind.SINGLE:
                yield self._channel(asked)
            case _:
                yield self._other(asked)

    def _other(self, asked: PyRosCall) -> Fact:
        site = site_of(asked)
        match asked.ask.kind:
            case Kind.NODE:
                anonymous = self._value("anonymous", asked, False) is True
                return NodeFact(site, self._name(asked), anonymous)
            case Kind.TIMER:
                one_shot = self._value("one_shot", asked, False)
                autostart = self._value("autostart", asked, True)
                period = self._seconds(asked)
                return TimerFact(site, period, one_shot, self._callbacks(asked), autostart)
            case Kind.RATE:
                unknown = self._unknown(asked, "the frequency is not given")
                return RateFact(site, self._value("hz", asked, unknown))
            case Kind.SERVICE:
                callbacks = self._callbacks(asked)
                return ServiceFact(site, self._name(asked), self._type(asked), callbacks)
            case _:
                return ClientFact(site, self._name(asked), self._type(asked))

    def _channel(self, asked: PyRosCall) -> Fact:
        site, name, type_ = site_of(asked), self._name(asked), self._type(asked)
        depth = depth_of(self.values, asked)
        if asked.ask.kind is Kind.PUBLISHER:
            latched = latched_of(self.values, asked)
            policies = policies_of(self.values, asked)
            return PublisherFact(site, name, type_, depth, latched, policies=policies)
        if asked.ask.kind is Kind.SINGLE:
            return SubscriptionFact(site, name, type_, 1, (), True)
        policies = policies_of(self.values, asked)
        return SubscriptionFact(site, name, type_, depth, self._callbacks(asked), policies=policies)

    # --- parameters -----------------------------------------------------------------------------

    def _parameter(self, asked: PyRosCall) -> ParameterFact:
        ask, given = asked.ask, asked.given
        default = self._given(given.get("default"), asked.scope)
        value = self._given(given.get("value"), asked.scope) if "value" in ask.arguments else None
        access = ask.access
        assert access is not None
        return ParameterFact(site_of(asked), self._name(asked), access, default, value)

    def _given(self, node: Node | None, scope: Scope) -> Resolved | None:
        """A default; None where it is nothing, or only the kind of values."""
        if node is None:
            return None
        ways = self.values.ways(node, scope)
        known = tuple(w for w in ways if not isinstance(w, (NoneValue, External)))
        unknown = self.values.unknown("it is computed", node, scope)
        return resolved(known, unknown) if known or not ways else None

    def _declared(self, asked: PyRosCall) -> Iterator[Fact]:
        site, access = site_of(asked), asked.ask.access
        assert access is not None
        found = list(declared_together(self.values, asked.call, asked.scope))
        for name, default in found:
            known: Resolved = name if name is not None else self._unknown(asked, "a computed name")
            yield ParameterFact(site, known, access, self._given(default, asked.scope))
        if not found:
            why = "parameters whose list is not written here"
            yield ParameterFact(site, self._unknown(asked, why), access)

    def _set(self, asked: PyRosCall) -> Iterator[Fact]:
        """What `set_parameters` sets, one parameter after the other."""
        site, access = site_of(asked), asked.ask.access
        assert access is not None
        node = asked.given.get("parameters")
        items = named(node) if node is not None and node.type in ("list", "tuple") else []
        for item in items:
            for way in self.values.ways(item, asked.scope):
                if isinstance(way, Made) and way.by.endswith("Parameter"):
                    plain, keywords = arguments_of(way.call)
                    parts = dict(zip(("name", "", "value"), plain, strict=False)) | keywords
                    if "name" in parts:
                        name = self.values.value(parts["name"], way.scope)
                        value = self._given(parts.get("value"), way.scope)
                        yield ParameterFact(site, name, access, None, value)
        if not items:
            yield ParameterFact(site, self._unknown(asked, "a list that is computed"), access)

    def _read(self, asked: PyRosCall) -> Iterator[Fact]:
        """What `get_parameters` gets, or all parameters whose names begin so."""
        site, access = site_of(asked), asked.ask.access
        assert access is not None
        if (prefix := asked.given.get("prefix")) is not None:
            text = self.values.text(prefix, asked.scope)
            why = "all parameters whose names begin so"
            name = Unresolved(why, site.place, f"{text}.*" if text else None)
            yield ParameterFact(site, name, access)
            return
        node = asked.given.get("names")
        items = named(node) if node is not None and node.type in ("list", "tuple") else []
        for item in items:
            yield ParameterFact(site, self.values.value(item, asked.scope), access)
        if not items:
            yield ParameterFact(site, self._unknown(asked, "a list that is computed"), access)

    # --- arguments ------------------------------------------------------------------------------

    def _name(self, asked: PyRosCall) -> Resolved:
        node = asked.given.get("name")
        if node is None:
            return self._unknown(asked, "the name is not given")
        return private(self.values.value(node, asked.scope))

    def _value(self, role: str, asked: PyRosCall, otherwise: Resolved) -> Resolved:
        node = asked.given.get(role)
        if node is None:
            return otherwise
        ways = self.values.ways(node, asked.scope)
        if ways and all(isinstance(w, NoneValue) for w in ways):
            return otherwise
        return self.values.value(node, asked.scope)

    def _seconds(self, asked: PyRosCall) -> Resolved:
        node = asked.given.get("period")
        if node is None:
            return self._unknown(asked, "the period is not given")
        ways: Ways = self.values.ways(node, asked.scope)
        lengths = tuple(w for w in ways if isinstance(w, Duration))
        return resolved(lengths or ways, self.values.unknown("it is computed", node, asked.scope))

    def _type(self, asked: PyRosCall) -> Resolved:
        node = asked.given.get("type")
        if node is None:
            return self._unknown(asked, "the type is not given")
        found = self._types(node, asked.scope)
        return resolved(
            distinct(found), self.values.unknown("the type is not known", node, asked.scope)
        )

    def _types(self, node: Node, scope: Scope) -> list[Value]:
        """The types of ROS that an expression may be, or be made of: `numpy_msg(Odometry)`."""
        found: list[Value] = []
        for way in self.values.ways(node, scope):
            if isinstance(way, External) and (name := interface_of(way.name)) is not None:
                found.append(name)
            elif isinstance(way, Made) and way.by in libraries.names_of(Kind.OTHER, result="type"):
                for each in arguments_of(way.call)[0][:1]:
                    found += self._types(each, way.scope)
            elif isinstance(way, Unresolved):
                found.append(way)
            elif not isinstance(way, NoneValue):
                found.append(self.values.unknown("this is no type of ROS", node, scope))
        return found

    def _callbacks(self, asked: PyRosCall) -> Callbacks:
        node = asked.given.get("callback")
        if node is not None:
            return callbacks_of(self.values, node, asked.scope)
        called = text_of(field(asked.call, "function"))
        found = filtered(self.values, asked) if called.endswith("Subscriber") else ()
        return found or (self._unknown(asked, "the callback is registered elsewhere"),)

    def _unknown(self, asked: PyRosCall, why: str) -> Unresolved:
        return self.values.unknown(why, asked.name, asked.scope)


def site_of(asked: PyRosCall) -> Site:
    """Where a call stands, and where the code keeps what it gives."""
    scope = asked.scope
    start, end = asked.name.start_byte, asked.call.end_byte
    place = Place(scope.py.source, scope.py.source.within(scope.py.characters(start, end)))
    return Site(owner_of(scope), None, scope.py, asked.call, place, _kept(asked.call))


def owner_of(scope: Scope) -> str | None:
    """The class that code stands in; else the function; None outside of both."""
    at: Scope | None = scope
    function = None
    while at is not None:
        if at.kind == CLASS:
            return at.name
        if at.kind == FUNCTION and function is None:
            function = at.name
        at = at.parent
    return function


def _kept(call: Node) -> str:
    """The variable that the result of a call is put into, or its place in one."""
    above, node, place = call.parent, call, ""
    while above is not None and above.type in (*_AROUND, *_CONTAINERS):
        if above.type == "pair" and field(above, "value") == node:
            place = f"[{text_of(field(above, 'key'))}]{place}"
        elif above.type in _CONTAINERS and node.type != "pair":
            place = f"[{named(above).index(node)}]{place}"
        node, above = above, above.parent
    if (
        above is not None
        and above.type == "assignment"
        and above.child_by_field_name("right") == node
    ):
        return text_of(field(above, "left")) + place
    if above is not None and above.type == "argument_list" and above.parent is not None:
        called = field(above.parent, "function")
        if called.type == "attribute" and text_of(field(called, "attribute")) == "append":
            return text_of(field(called, "object"))
    return ""


def private(name: Resolved) -> Resolved:
    """A name as it is written: one below the name of the node is private."""
    match name:
        case str():
            return name.replace("~/", "~") if name.startswith("~/") else name
        case OneOf(values):
            return OneOf(tuple(private(v) for v in values))
        case FromParameter() | Unresolved():
            return name
        case _:
            return name
