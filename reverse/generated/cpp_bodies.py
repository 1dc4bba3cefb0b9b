"""The bodies of the functions of a class of generated code, and what runs around them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.evaluation_order import note_body
from rebsync.reverse.bodies.cpp_expressions import CppExpressions
from rebsync.reverse.bodies.cpp_references import is_made
from rebsync.reverse.bodies.cpp_statements import CppStatements
from rebsync.reverse.bodies.scope import Called, Outside, Record, Scope, Variable
from rebsync.reverse.bodies.subscripts import out_of_range, untested
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.cpp_free import passed_by_reference
from rebsync.reverse.generated.cpp_names import declared_type
from rebsync.reverse.generated.cpp_roles import Taken, parameters_of
from rebsync.reverse.generated.cpp_timers import Timer, sent_later, with_rearming
from rebsync.reverse.generated.ill_formed import ill_formed
from rebsync.reverse.generated.sensor_functions import acting_for_sensors, acting_in_blocks
from rebsync.reverse.generated.sensors import list_unseen
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppField, CppFunction, CppParameter
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of

_BY_VALUE = "pass it by value"
_WORD = re.compile(r"\w+")
_USERS = "rebsync: user"  # what stands in such a block is nobody else's


@dataclass(frozen=True, slots=True)
class GeneratedBodies:
    """Reads functions and lambdas of one class; `scope` is what they can name.

    `by_hand` makes of that what people's own code can name. `sensors` are the bodies that ask one.
    """

    code: Code
    scope: Scope
    findings: Findings
    by_hand: Callable[[Scope], Scope]
    sensors: frozenset[str] = frozenset()

    def parameters(self, function: CppFunction) -> tuple[m.Parameter, ...]:
        """The parameters; what the model cannot pass is listed."""
        found = []
        references = set(passed_by_reference(function))
        for index, parameter in enumerate(function.parameters):
            span = function.cpp.span(parameter.node)
            type_ = declared_type(self.code, parameter.type)
            if type_ is None:
                why = f'the model has no type "{text_of(parameter.type)}"'
                self._unread(function, parameter.node, why, function.name)
            elif index in references:
                why = "what this function does to its parameter the caller's variable keeps"
                self._unread(function, parameter.node, why, function.name)
            elif self._may_change(function, index):
                why = "this refers to a member that the function may change"
                self._unread(function, parameter.node, why, function.name, _BY_VALUE)
            name = self._given_name(function, parameter) or self._declared_name(function, index)
            found.append(m.Parameter(type_ or m.Type("int"), name, span))
        return tuple(found)

    def _declared_name(self, function: CppFunction, index: int) -> str:
        """What the class calls a parameter that a function does not use, and so leaves unnamed."""
        owner = self.code.classes.get(function.owner)
        same = (
            declared.parameters[index].name
            for declared in (owner.functions if owner is not None else ())
            if (declared.name, declared.types) == (function.name, function.types)
        )
        return next(filter(None, same), f"unused{index + 1}")

    def _may_change(self, function: CppFunction, index: int) -> bool:
        """Whether a reference to a constant may refer to a member that the function changes."""
        parameter = function.parameters[index].node.child_by_field_name("declarator")
        if parameter is None or parameter.type != "reference_declarator" or not function.body:
            return False
        family = [c for c in self.code.classes.values() if self._is_related(c, function.owner)]
        members = {f.name for c in family for f in c.fields}
        if not any(_is_called(self.scope, c) for c in self.code.calls_of(function)):
            members &= set(_WORD.findall(text_of(function.body)))
        given = (
            call.arguments[index]
            for caller in (f for c in family for f in self.code.functions_of(c))
            for call in self.code.calls_of(caller)
            if call.name == function.name and index < len(call.arguments)
        )
        places = (text_of(each) for each in given if not is_made(self.scope, each))
        return any(members & set(_WORD.findall(place)) for place in places)

    def _is_related(self, one: CppClass, name: str) -> bool:
        """Whether a class is the one of a name, or above or below it."""
        lineage = {c.name for c in self.code.lineage(one.name)}
        return name in lineage or one.name in {c.name for c in self.code.lineage(name)}

    def _given_name(self, function: CppFunction, parameter: CppParameter) -> str:
        """The model's name of a parameter: another one where it would hide a member in use."""
        name = free = self.scope.local(parameter.name)
        text, number = text_of(function.body) if function.body is not None else "", 1
        own = {n: v for n, v in self.scope.members.items() if n != parameter.name}
        names = {v.name for v in own.values() if isinstance(v, Variable)}
        used = (n for n, v in own.items() if isinstance(v, Variable) and v.name == name)
        if any(re.search(rf"(?<![\w.>]){n}\b", text) for n in used):
            while free in names:
                number += 1
                free = f"{name}_{number}"
        return free

    def block(self, function: CppFunction, within: str) -> m.Block | None:
        """The body of a function, if the files have it; one that should be there is listed."""
        if function.body is None:
            if not function.pure:
                self._unread(function, function.node, "its body is not in these files", within)
            return None
        inside = self._inside(function.cpp).with_locals(
            {
                p.name: Variable(self._given_name(function, p), declared_type(self.code, p.type))
                for p in function.parameters
            }
        )
        read = self._read(function.cpp, inside, function.body, within)
        for unread in ill_formed(self.code, function):
            self.findings.unreadable(function.cpp.source, unread, within)
        if within in self.sensors:
            list_unseen(read, within, function.cpp.source, self.findings)
        return read

    def _read(self, cpp: Cpp, inside: Scope, body: Node, within: str) -> m.Block:
        """A body, and what it asks of sensors besides what they saw."""
        read = self._said(cpp, inside, body, within)
        for source, unread in acting_for_sensors(self.code, cpp, body, self.scope.messages):
            self.findings.unreadable(source, unread, within)
        listed = [f.span for f in self.findings.all if f.source == cpp.source]
        for source, unread in acting_in_blocks(self.code, cpp, body, listed):
            self.findings.unreadable(source, unread, within)
        return read

    def _said(self, cpp: Cpp, inside: Scope, body: Node, within: str) -> m.Block:
        """A body as generated code says it, or else, if it is exact, as people's code says it."""
        marked = self.findings.mark()
        read = _checked(CppStatements(cpp, inside, self.findings, within), body)
        if len(self.findings.all) == marked[0] or _USERS in text_of(body):
            return read
        by_hand = Findings()
        again = _checked(CppStatements(cpp, self.by_hand(inside), by_hand, within), body)
        if by_hand.all:
            return read
        self.findings.back_to(marked)
        self.findings.take(by_hand)
        return again

    def _inside(self, cpp: Cpp) -> Scope:
        return replace(self.scope, constants=self.code.constants_for(cpp))

    def _unread(
        self, function: CppFunction, node: Node, why: str, within: str, hint: str = ""
    ) -> None:
        unread = Unread(function.cpp.span(node), why, hint)
        self.findings.unreadable(function.cpp.source, unread, within)

    # --- handlers that are lambdas --------------------------------------------------------------

    def taken(
        self, taken: Taken, fields: Mapping[str, m.Type | None] | None, within: str
    ) -> tuple[tuple[m.Parameter, ...], m.Block]:
        """Parameters and body of a server whose handler is a lambda in the shim."""
        function = taken.function
        span = function.cpp.span(taken.message.node)
        if fields is None or None in fields.values():
            why = f'the model does not know the fields of "{taken.type}"'
            self._unread(function, taken.message.node, why, within)
        known = {f: t for f, t in (fields or {}).items() if t is not None}
        names = {f: self.scope.local(f) for f in known}
        variables = {f: Variable(names[f], t) for f, t in known.items()}
        parameters = tuple(m.Parameter(t, names[f], span) for f, t in known.items())
        inside = self._inside(function.cpp).with_locals({taken.message.name: Record(variables)})
        body = part(taken.call.arguments[4], "body")
        return parameters, self._read(function.cpp, inside, body, within)

    # --- timers ---------------------------------------------------------------------------------

    def ticking(self, timer: Timer, function: CppFunction, name: str, within: str) -> m.Block:
        """The body of a timer's callback, with the next tick if there is one."""
        lambda_ = timer.lambda_
        given = function.parameters if lambda_ is None else parameters_of(lambda_)
        body = function.body if lambda_ is None else part(lambda_, "body")
        if body is None:
            self._unread(function, function.node, "its body is not in these files", within)
            return m.Block(())
        hidden = self._inside(function.cpp).with_locals({p.name: Outside() for p in given})
        read = self._read(function.cpp, hidden, body, within)
        again = None if timer.one_shot else self._later(timer, name, within)
        return read if again is None else with_rearming(read, again)

    def _later(self, timer: Timer, server: str, within: str) -> m.Statement | None:
        try:
            return sent_later(timer, server, self._inside(timer.function.cpp))
        except Unread as unread:
            self.findings.unreadable(timer.function.cpp.source, unread, within)
            return None

    # --- constructors ---------------------------------------------------------------------------

    def started(self, timers: Iterator[tuple[Timer, str]], within: str) -> list[m.Statement]:
        """What the class's own constructor starts: the first ticks, to these servers."""
        later = (self._later(t, s, within) for t, s in timers if t.one_shot or self._is_whole(t))
        return [s for s in later if s is not None]

    def _is_whole(self, timer: Timer) -> bool:
        """Whether a periodic timer's time is one of the model; its callback lists it if not."""
        try:
            sent_later(timer, "", self._inside(timer.function.cpp))
        except Unread:
            return False
        return True

    def given(self, values: Iterator[tuple[CppField, Cpp, Node]], within: str) -> list[m.Statement]:
        """What members have before the model's constructor runs."""
        found: list[m.Statement] = []
        for member, cpp, value in values:
            variable = self.scope.members.get(member.name)
            if not isinstance(variable, Variable):
                continue
            try:
                found += self._given(variable.name, cpp, value)
            except Unread as unread:
                self.findings.unreadable(cpp.source, unread, within)
        return found

    def _given(self, name: str, cpp: Cpp, value: Node) -> Iterator[m.Statement]:
        span = cpp.span(value)
        reader = CppExpressions(cpp, self._inside(cpp))
        if value.type != "initializer_list":
            yield m.ExpressionStatement(m.Assign("=", m.Name(name), reader.read(value)), (), span)
        else:
            for index, element in enumerate(named(value)):
                cell = m.Index(m.Name(name), m.IntLiteral(index))
                yield m.ExpressionStatement(m.Assign("=", cell, reader.read(element)), (), span)
        untested(reader.subscripts)


def _is_called(scope: Scope, call: CppCall) -> bool:
    return isinstance(scope.functions.get(call.name), Called)


def _checked(reader: CppStatements, body: Node) -> m.Block:
    """A body; the elements that may not be there are listed."""
    scope = reader.scope
    read = reader.block(body)
    note_body(reader.findings, reader.cpp.source, reader.within, read.statements)
    for unread in out_of_range(read, reader.shared, scope):
        reader.findings.unreadable(reader.cpp.source, unread, reader.within)
    return read
