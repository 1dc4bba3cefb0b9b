"""Methods of generated Python that ROS asks something, and that only tell what is there.

Services and diagnostics run beside the bodies of the model: what they look at may be on its way to
another value, and whom they answer changes nothing of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries.generated_calls import SERVICE_OF_NODE, SERVICE_OF_ROS_1
from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.python.generated.py_types import call_parts, expression_in, string_value
from rebsync.reverse.python.generated.slicing.exceptions import ToldExceptions
from rebsync.reverse.python.generated.slicing.logs import Looks, only_logs
from rebsync.reverse.python.generated.slicing.timers import is_heir, tells_with
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

# What offers a service, and how many arguments its callback gets.
_OFFERS = {SERVICE_OF_ROS_1: 1, SERVICE_OF_NODE: 2}
_UPDATER = "diagnostic_updater.Updater"
_STATED = frozenset({"add", "addf", "summary", "summaryf"})
_OF_ROS = re.compile(r"parameter|logger")
_SERVICES = re.compile(r"(\w+)\.srv\.(\w+)")


def asked_back(function: Scope) -> Iterator[str]:
    """The methods that the statements of a function hand to services and to diagnostics."""
    for statement in body_of(function):
        inner = expression_in(statement)
        value = (
            inner.child_by_field_name("right") if inner and inner.type == "assignment" else inner
        )
        called, arguments = call_parts(value) or ("", [])
        count = 3 if called in _OFFERS else 2 if called.endswith(".add") else 0
        if count == len(arguments) > 0:
            holder, _, name = text_of(arguments[-1]).partition(".")
            if holder == "self" and name.isidentifier():
                yield name


@dataclass(frozen=True, eq=False, slots=True)
class Answering:
    """What tells the services and diagnostics of a class that only tell what there is.

    `telling` are the functions that do no more, each with how many arguments it takes, `bodies`
    the trees of these; `services` are the names of the module for their types, `updaters` members
    that publish diagnostics.
    """

    looks: Looks = Looks()
    telling: Mapping[str, int] = with_default(default_factory=dict)
    services: frozenset[str] = frozenset()
    updaters: frozenset[str] = frozenset()
    bodies: frozenset[int] = frozenset()

    @staticmethod
    def of(
        code: PyCode,
        module: Scope,
        functions: Mapping[str, Scope],
        members: Mapping[str, Node],
        looks: Looks,
        exceptions: ToldExceptions,
    ) -> Answering:
        """Those of a class by what it hands over; what an heir has instead may be anything."""
        names = {n: _SERVICES.fullmatch(imported_as(module, n)) for n in module.names}
        services = frozenset(n for n, found in names.items() if found is not None)
        answers = frozenset(n for n in services if n.endswith("Response"))
        looks = replace(looks, makers=looks.makers | answers)
        telling = {}
        for name, function in functions.items():
            others = (f for f in code.methods.get(name, ()) if f is not function)
            is_telling = _only_tells(function, looks) and not any(map(is_heir, others))
            body = field(function.node, "body")
            if is_telling and not (exceptions.raises(body) or exceptions.races(body)):
                telling[name] = len(function.parameters) - 1
        made = (n for n, value in members.items() if _is_updater(module, value))
        bodies = frozenset(field(functions[n].node, "body").id for n in telling)
        return Answering(looks, telling, services, frozenset(made), bodies)

    def is_idle(self, node: Node) -> bool:
        """Whether something offers a service that only tells what there is."""
        called, arguments = call_parts(node) or ("", [])
        if called not in _OFFERS or called.rpartition(".")[2] in self.looks.functions:
            return False
        if not called.startswith("self.") and called.partition(".")[0] not in self.looks.trusted:
            return False
        topics = [s for a in arguments[:2] if (s := string_value(a)) is not None]
        types = [text_of(a) for a in arguments[:2] if text_of(a) in self.services]
        is_known = len(arguments) == 3 and len(topics) == len(types) == 1
        is_free = is_known and _OF_ROS.search(topics[0]) is None
        return is_free and self._tells(arguments[2], _OFFERS[called])

    def diagnoses(self, call: Node) -> bool:
        """Whether a call is one of an updater of diagnostics: `self._updater.update()`."""
        called, arguments = call_parts(call) or ("", [])
        holder, _, method = called.removeprefix("self.").partition(".")
        if not called.startswith("self.") or holder not in self.updaters:
            return False
        match method, arguments:
            case "setHardwareID", [name]:
                return self.looks.is_pure(name)
            case "add", [name, callback]:
                return self.looks.is_pure(name) and self._tells(callback, 1)
            case (("update" | "force_update"), []):
                return True
            case _:
                return False

    def _tells(self, callback: Node, count: int) -> bool:
        holder, _, name = text_of(callback).partition(".")
        return holder == "self" and self.telling.get(name) == count


def _is_updater(module: Scope, value: Node) -> bool:
    called, arguments = call_parts(value) or ("", [])
    return imported_as(module, called) == _UPDATER and [text_of(a) for a in arguments] in (
        [],
        ["self"],
    )


def _only_tells(function: Scope, looks: Looks) -> bool:
    """Whether a method only fills its last argument or what it gives back, and logs."""
    parameters = function.parameters
    is_plain = not function.decorators and function.node.children[0].type == "def"
    by_position = all(p.star == 0 and p.default is None for p in parameters)
    if not (is_plain and by_position and len(parameters) in (2, 3)):
        return False
    names = {n for n in function.names if n not in {p.name for p in parameters}}
    if parameters[0].name != "self" or names & looks.trusted:
        return False
    return all(_tells(s, parameters[-1].name, names, looks) for s in body_of(function))


def _tells(node: Node, given: str, names: set[str], looks: Looks) -> bool:
    """Whether a statement only looks at what is there, and puts it into what is given or local."""

    def tells(node: Node) -> bool:
        if node.type == "return_statement":
            return all(map(looks.is_pure, named(node)))
        inner = expression_in(node)
        if inner is None or inner.type != "call":
            return False
        holder, _, method = text_of(field(inner, "function")).partition(".")
        is_stating = holder == given and method in _STATED
        return only_logs(node, looks) or (is_stating and looks.is_pure(field(inner, "arguments")))

    return tells_with(node, {given, *names}, looks, tells)
