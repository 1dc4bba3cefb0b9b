"""From a call that asks ROS for something to the facts of it, its arguments resolved."""

from __future__ import annotations

from dataclasses import field, replace
from functools import reduce

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.calls.parameter_lists import interface_of, several
from rebsync.reverse.calls.ros_calls_callbacks import Callbacks, Called
from rebsync.reverse.calls.ros_calls_filters import registered
from rebsync.reverse.calls.ros_calls_handles import namespace_of, usual_depth
from rebsync.reverse.calls.ros_calls_options import Given, options_of
from rebsync.reverse.calls.ros_calls_shapes import Asked, distinct, given_to, nodelets_of, truth_of
from rebsync.reverse.calls.ros_calls_types import CppMessageTypes
from rebsync.reverse.graph import (
    Callback,
    ClientFact,
    Fact,
    FromParameter,
    NodeFact,
    OneOf,
    ParameterFact,
    PublisherFact,
    RateFact,
    Resolved,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
    Unresolved,
)
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Access, Kind
from rebsync.reverse.policies import NOT_KNOWN, USUAL, Policies, either
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_names import is_plain, name_under, one_of, resolved
from rebsync.reverse.values.cpp_values_numbers import converted
from rebsync.reverse.values.cpp_values_plain import (
    Found,
    Frame,
    Length,
    Made,
    Nothing,
    Quality,
    Value,
    choice,
    ways,
)

# Ways into a function up to which all of its calls are looked at on each of them from the start.
_FEW = 3
_ANONYMOUS = "AnonymousName"  # the option that makes the name of a node one of its own


@dataclass(slots=True)
class _Answer:
    """What the arguments of a call are on one way into the function around it."""

    frame: Frame
    values: dict[str, Resolved | None] = field(default_factory=dict)
    called: list[Called] = field(default_factory=list)
    searched: bool = False
    policies: list[Policies] = field(default_factory=list)


@dataclass(slots=True)
class Facts:
    """Makes facts of calls."""

    values: Values
    callbacks: Callbacks = field(init=False)
    types: CppMessageTypes = field(init=False)
    _frames: dict[int, list[Frame]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.callbacks = Callbacks(self.values)
        self.types = CppMessageTypes(self.values)

    def of(self, asked: Asked) -> list[Fact]:
        """The facts of a call."""
        self.values.fresh()
        site, ask = asked.site, asked.ask
        if ask.kind is Kind.NODELET:
            return list(nodelets_of(asked))
        if (together := several(self.values, asked)) is not None:
            return list(together)
        answers = self._answers(asked)
        merged: dict[str, Resolved | None] = {}
        for key in {k: None for a in answers for k in a.values}:
            known = [v for a in answers if (v := a.values.get(key)) is not None]
            merged[key] = _told_apart(one_of(known), key, answers)
        if self.values.truncated:
            more = self._unknown(asked, "it is called from too many places")
            merged = {k: one_of([v, more]) if v is not None else None for k, v in merged.items()}
        called = [c for a in answers for c in a.called]
        if not called and "callback" not in ask.arguments and ask.kind is Kind.SUBSCRIPTION:
            called = registered(self.values, self.callbacks, site)
        searched = any(a.searched for a in answers)
        fact = self._fact(asked, merged, distinct(called), called, searched)
        policies = [p for a in answers for p in a.policies]
        if policies and isinstance(fact, PublisherFact | SubscriptionFact):
            both = NOT_KNOWN if self.values.truncated else reduce(either, policies)
            return [replace(fact, policies=both)]
        return [fact]

    def _answers(self, asked: Asked) -> list[_Answer]:
        """What the arguments are on each way into the function around a call."""
        site = asked.site
        home = site.function.node.id if site.function is not None else 0
        frames = self._frames.get(home, [Frame(site.cpp, site.function)])
        used: list[Frame] = []
        answers = self.values.settle_all(frames, lambda f: self._answer(asked, f), used)
        if home and len(used) <= _FEW:
            self._frames[home] = used  # what the next call in the function will ask for
        return answers

    # --- on one way -----------------------------------------------------------------------------

    def _answer(self, asked: Asked, frame: Frame) -> _Answer:
        answer = _Answer(frame)
        namespace = namespace_of(self.values, asked, frame)
        for role, given in self._roles(asked, frame).items():
            match role:
                case "name":
                    answer.values["name"] = self._name(given, namespace, answer)
                case "callback":
                    answer.called = self.callbacks.of(given.node, given.frame)
                case "variable" if asked.ask.kind is Kind.PARAMETER:
                    fallback = self._fallback(asked, given)
                    if fallback is not None:
                        answer.values["fallback"] = fallback
                case "default" | "value":
                    answer.values[role] = self._stands_in(asked, given)
                case "depth":
                    self._queue(given, asked.ask.flat, answer)
                case "period":
                    answer.values["period"] = self._seconds(given)
                case "hz":
                    answer.values["hz"] = self._hertz(given)
                case "handle" | "options" | "found" | "call" | "type" | "":
                    continue
                case _:
                    answer.values[role] = self._plain(given)
        if asked.ask.kind is Kind.SUBSCRIPTION and "depth" not in answer.values:
            answer.values["depth"] = usual_depth(self.values, asked, frame)
        return answer

    def _roles(self, asked: Asked, frame: Frame) -> dict[str, Given]:
        """The arguments of a call by their roles."""
        arguments, ask = asked.arguments, asked.ask
        if ask.options is not None and len(arguments) == 1:
            found = options_of(self.values, arguments[0], frame, libraries.options()[ask.options])
            if found:
                return found
        roles = ask.arguments
        if ask.flat:
            pairs = zip(roles, arguments, strict=False)
            return {role: Given(node, frame) for role, node in pairs if role}
        if ask.kind is Kind.NODE and (len(arguments) == 2 or _text(arguments[1:2])):
            roles = roles[1:]
        if ask.kind is Kind.PARAMETER and len(arguments) == 2 and "default" in roles:
            roles = ("name", "default")
        found = {}
        rest = list(arguments)
        for role in roles:
            if not rest:
                break
            argument = rest.pop(0)
            if role == "latched" and "latched" not in found and not self._is_truth(argument, frame):
                continue
            if role:
                found[role] = Given(argument, frame)
            if role == "callback" and rest and not self._is_truth(rest[0], frame):
                rest.pop(0)  # the object whose method it is
        return found

    def _is_truth(self, node: Node, frame: Frame) -> bool:
        if node.type in ("true", "false"):
            return True
        if node.type in ("this", "pointer_expression", "lambda_expression", "null"):
            return False
        if self.values.types.type_of(frame.cpp, node) == "bool":
            return True
        return isinstance(self.values.value(node, frame), (bool, int))

    # --- names ----------------------------------------------------------------------------------

    def _name(self, given: Given, namespace: Resolved, answer: _Answer) -> Resolved | None:
        value = self.values.value(given.node, given.frame)
        if any(isinstance(v, Found) for v in ways(value)):
            answer.searched = True
            value = choice(v.name if isinstance(v, Found) else v for v in ways(value))
            return self._found(self._resolved(value, given), given)
        found = self._resolved(value, given)
        return name_under(namespace, found) if found is not None else None

    def _found(self, name: Resolved, given: Given) -> Resolved:
        """The key that a search upwards finds: a private name says from where it goes up."""
        if not isinstance(name, str) or name.startswith(("~", "/")):
            return name
        place = self.values.unknown("", given.node, given.frame).place
        return Unresolved(f"the key that an upward search for {name} finds", place, f"*/{name}")

    def _queue(self, given: Given, flat: bool, answer: _Answer) -> None:
        """The depth of a queue, and what else a quality of service says."""
        value = self.values.value(given.node, given.frame)
        answer.values["depth"] = self._resolved(value, given)
        qualities = [v for v in ways(value) if isinstance(v, Quality)]
        answer.policies += [_policies_of(v) for v in ways(value)] if flat else []
        if qualities:
            answer.values["latched"] = one_of(q.latched for q in qualities)
        elif flat and isinstance(value, Unresolved):
            answer.values["latched"] = value

    # --- numbers --------------------------------------------------------------------------------

    def _resolved(self, value: Value, given: Given) -> Resolved:
        if is_plain(value):
            return value
        unknown = self.values.unknown("no value that is known", given.node, given.frame)
        found = resolved(value, unknown)
        return found if found is not None else unknown

    def _plain(self, given: Given) -> Resolved:
        return self._resolved(self.values.value(given.node, given.frame), given)

    def _seconds(self, given: Given) -> Resolved:
        value = self.values.value(given.node, given.frame)
        found = [v for v in ways(value) if isinstance(v, (Length, Unresolved))]
        return self._resolved(choice(found) if found else value, given)

    def _hertz(self, given: Given) -> Resolved:
        value = self.values.value(given.node, given.frame)
        if isinstance(value, Length) and isinstance(value.seconds, float) and value.seconds:
            return 1 / value.seconds
        return self._resolved(value, given)

    def _stands_in(self, asked: Asked, given: Given) -> Resolved | None:
        value = self.values.value(given.node, given.frame)
        if asked.types:
            value = converted(value, self.values.types.plain(given.frame.cpp, asked.types[0]))
        elif len(asked.arguments) > 2:
            value = converted(value, self.values.types.type_of(given.frame.cpp, asked.arguments[1]))
        if isinstance(value, Made) and not value.use.arguments:
            return None  # an empty structure
        if isinstance(value, Nothing):
            return None
        return self._resolved(value, given)

    def _fallback(self, asked: Asked, given: Given) -> Resolved | None:
        """What a variable holds before a parameter is read into it; nothing for a list or map."""
        types = self.values.types
        if len(asked.arguments) > 2 or types.holds_several(given.frame.cpp, given.node):
            return None
        value = self.values.value(given.node, given.frame)
        return value if isinstance(value, (bool, int, float, str)) else None

    # --- facts ----------------------------------------------------------------------------------

    def _fact(
        self,
        asked: Asked,
        found: dict[str, Resolved | None],
        callbacks: tuple[Callback | Unresolved, ...],
        called: list[Called],
        searched: bool,
    ) -> Fact:
        site, ask = asked.site, asked.ask
        name = self._or_unknown(found.get("name"), asked, "the name is not known")
        match ask.kind:
            case Kind.NODE:
                anonymous = any(_ANONYMOUS in text_of(a) for a in asked.arguments)
                return NodeFact(site, name, anonymous)
            case Kind.PUBLISHER:
                depth = self._or_unknown(found.get("depth"), asked, "the depth is not known")
                latched = found.get("latched")
                type_ = self._type(asked, called, found)
                kept = latched if latched is not None else False
                return PublisherFact(site, name, type_, depth, truth_of(kept), ask.transport)
            case Kind.SUBSCRIPTION | Kind.SINGLE:
                single = ask.kind is Kind.SINGLE
                given = 1 if single else found.get("depth")
                depth = self._or_unknown(given, asked, "the depth is not known")
                type_ = self._type(asked, called, found)
                if not callbacks and not single:
                    callbacks = (self._unknown(asked, "the callback is registered elsewhere"),)
                return SubscriptionFact(site, name, type_, depth, callbacks, single, ask.transport)
            case Kind.TIMER:
                return self._timer(asked, found, callbacks)
            case Kind.RATE:
                hz = self._or_unknown(found.get("hz"), asked, "the frequency is not known")
                return RateFact(site, hz, ask.wall)
            case Kind.SERVICE:
                return ServiceFact(site, name, self._type(asked, called, found), callbacks)
            case Kind.CLIENT:
                return ClientFact(site, name, self._type(asked, called, found))
            case _:
                return self._parameter(asked, found, name, searched)

    def _timer(
        self,
        asked: Asked,
        found: dict[str, Resolved | None],
        callbacks: tuple[Callback | Unresolved, ...],
    ) -> TimerFact:
        period = self._or_unknown(found.get("period"), asked, "the period is not known")
        one_shot, autostart = found.get("one_shot"), found.get("autostart")
        return TimerFact(
            asked.site,
            period,
            truth_of(one_shot) if one_shot is not None else False,
            callbacks,
            truth_of(autostart) if autostart is not None else True,
            asked.ask.wall,
        )

    def _parameter(
        self, asked: Asked, found: dict[str, Resolved | None], name: Resolved, searched: bool
    ) -> ParameterFact:
        access = asked.ask.access or Access.GET
        default = found.get("default")
        if (
            default is None
            and not searched
            and "variable" in asked.ask.arguments
            and len(asked.arguments) == 2
        ):
            default = found.get("fallback")
        return ParameterFact(asked.site, name, access, default, found.get("value"), searched)

    def _type(
        self, asked: Asked, called: list[Called], given: dict[str, Resolved | None]
    ) -> Resolved:
        if asked.ask.type is not None:
            return asked.ask.type
        cpp = asked.site.cpp
        if asked.types:
            return self.types.of(cpp, asked.types[0])
        if (written := given.get("interface")) is not None:
            return interface_of(written)
        named_: list[tuple[Cpp, Node]] = [(c.cpp, c.type) for c in called if c.type is not None]
        if asked.ask.options is not None and len(asked.arguments) == 1:
            frame = Frame(cpp, asked.site.function)
            held = options_of(
                self.values, asked.arguments[0], frame, libraries.options()[asked.ask.options]
            )
            named_ = [(g.frame.cpp, g.node) for r, g in held.items() if r == "type"] + named_
        if "call" in asked.ask.arguments and len(asked.arguments) > 1:
            variable = self.values.types.variable(cpp, asked.arguments[1])
            if variable is not None and variable.type is not None:
                named_ = [(variable.cpp, variable.type)]
        found = one_of(self.types.of(c, n) for c, n in named_)
        return self._or_unknown(found, asked, "the type is not known")

    def _or_unknown(self, value: Resolved | None, asked: Asked, why: str) -> Resolved:
        return value if value is not None else self._unknown(asked, why)

    def _unknown(self, asked: Asked, why: str) -> Unresolved:
        return Unresolved(why, asked.site.place)


def _told_apart(value: Resolved | None, key: str, answers: list[_Answer]) -> Resolved | None:
    """One of several values with the calls that lead to each."""
    if not isinstance(value, OneOf):
        return value
    known = [(a.frame, v) for a in answers if (v := a.values.get(key)) is not None]
    return OneOf(value.values, tuple((given_to(frame), v) for frame, v in known))


def _policies_of(value: Value) -> Policies:
    """What a quality of service asks of the other end; a number alone is a depth."""
    match value:
        case Quality(policies=policies):
            return policies
        case int() | FromParameter():
            return USUAL
        case _:
            return NOT_KNOWN


def _text(nodes: tuple[Node, ...]) -> bool:
    return bool(nodes) and nodes[0].type in ("string_literal", "concatenated_string")
