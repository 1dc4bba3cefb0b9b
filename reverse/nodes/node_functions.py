"""Functions that the bodies of a unit call: methods of its class, or put in the place of calls."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_types import carried
from rebsync.reverse.bodies.scope import Called, Inline, Meaning, Variable
from rebsync.reverse.findings import Findings
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_views import is_header
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of

_ROUNDS = 4


@dataclass(slots=True)
class Functions:
    """Decides what becomes of the functions of a unit, and reads the methods."""

    bodies: Bodies
    methods: dict[str, CppFunction] = field(default_factory=dict)
    # As they were read when they were tried, if nothing that they call has changed since.
    _tried: dict[str, tuple[m.Method, Findings]] = field(default_factory=dict)

    def choose(self) -> None:
        """Functions become methods where a method can say what they do; others are inlined."""
        by_name: dict[str, list[CppFunction]] = {}
        for function in (*self.bodies.unit.functions, *self._free()):
            by_name.setdefault(function.name, []).append(function)
        for above in self.bodies.unit.lineage:
            for declared in above.functions:
                by_name.setdefault(declared.name, [])
        served = {s.body.id for s in self.bodies.servers}
        methods: dict[str, CppFunction] = {}
        for name, all_of in by_name.items():
            found = [self._with_defaults(f) for f in all_of]
            if name in self.bodies.unit.names or name.startswith("~") or name == "main":
                continue
            if len(found) != 1 or found[0].body is None:  # which is meant, or what it does, is open
                known = () if any(f.body is None for f in found) else tuple(found)
                self.bodies.functions[name] = Called(name, server=True, overloads=known)
            elif found[0].body.id in served or (method := self._signature(found[0])) is None:
                self.bodies.functions[name] = Inline(found[0])
            else:
                self.bodies.functions[name] = method
                methods[name] = found[0]
        self._held(methods)
        self._try(methods)

    def _held(self, methods: dict[str, CppFunction]) -> None:
        """Members that hold functions are these, and what puts them there is nothing more."""
        for each in self.bodies.held():
            known = self.bodies.functions.get(each.function)
            if each.lambda_ is None and known is None:
                continue
            self.bodies.setup.instead[each.statement.id] = ()
            if known is not None:
                if each.function in methods:
                    known = Inline(methods.pop(each.function))
                self.bodies.functions[each.name] = known
                self.bodies.functions[each.function] = known

    def _with_defaults(self, function: CppFunction) -> CppFunction:
        """A function with what its parameters are by default: its declaration says so."""
        lineage = self.bodies.unit.lineage if function.owner else ()
        if not function.parameters:
            return function
        of_name = [f for c in lineage for f in c.functions if f.name == function.name]
        given = (p.node.type for f in (*of_name, function) for p in f.parameters)
        if "optional_parameter_declaration" not in given:
            return function
        same = [f for f in of_name if f.types == function.types]
        parameters = list(function.parameters)
        for known in (*same, function):
            for number, parameter in enumerate(known.parameters):
                default = parameter.node.child_by_field_name("default_value")
                if default is not None:
                    parameters[number] = replace(parameters[number], default=(known.cpp, default))
        changed = any(a is not b for a, b in zip(parameters, function.parameters, strict=True))
        return replace(function, parameters=tuple(parameters)) if changed else function

    def _free(self) -> Iterator[CppFunction]:
        """The functions outside of classes that member functions can call."""
        if self.bodies.unit.owner is None:
            return
        near = self.bodies.unit.files | {f.cpp.source.path for f in self.bodies.setup.first}
        for (owner, _), all_of in self.bodies.code.definitions.items():
            if owner:
                continue
            others = any(f.cpp.source.path in near for f in all_of)
            for function in all_of:
                here = function.cpp.source.path in near or is_header(function.cpp)
                if function.body is not None and (here or not others):
                    yield function

    def _signature(self, function: CppFunction) -> Called | None:
        """A function as a method, if its parameters and result are of the model's types."""
        if self._sets_up(function):
            return None
        takes = []
        for parameter in function.parameters:
            type_ = carried(parameter.type, self.bodies.common.enums)
            declarator = parameter.node.child_by_field_name("declarator")
            plain = declarator is not None and declarator.type == "identifier"
            if type_ is None or type_.bits or type_.why or not plain:
                return None
            takes.append(type_.type)
        result = carried(function.result, self.bodies.common.enums) if function.result else None
        void = function.result is not None and text_of(function.result) == "void"
        if not void and (result is None or result.bits or result.why):
            return None
        name = self.bodies.setup.names.give(function.name)
        returned = result.type if result else None
        return Called(name, takes=tuple(takes), returns=returned, function=function)

    def _sets_up(self, function: CppFunction) -> bool:
        """Whether a function has calls or loops that set the node up."""
        body, setup = function.body, self.bodies.setup
        if body is None:
            return False
        path = function.cpp.source.path
        calls = [f.site.call for f in setup.facts if f.site.cpp.source.path == path]
        calls += [x.node for x, _ in setup.loops if x.function.cpp.source.path == path]
        return any(body.start_byte <= c.start_byte < body.end_byte for c in calls)

    def _try(self, methods: dict[str, CppFunction]) -> None:
        """Leaves those methods that can be read as such; a choice is none of a method."""
        findings = self.bodies.findings
        waiting = set(methods)
        for _ in range(_ROUNDS):
            failed = []
            for name, function in methods.items():
                if name not in waiting:
                    continue
                self.bodies.findings = Findings()
                self._tried[name] = self.method(name, function), self.bodies.findings
                if self.bodies.findings.all:
                    failed.append(name)
            self.bodies.findings = findings
            waiting = self._affected(methods, set(failed))
            for name in failed:
                self.bodies.functions[name] = Inline(methods.pop(name))
            if not failed:
                break
        for name in methods:
            self.methods[name] = methods[name]
        self._tried = {n: t for n, t in self._tried.items() if n in methods and n not in waiting}

    def read(self) -> list[m.Method]:
        """The methods, and what has been counted in them."""
        found = []
        findings = self.bodies.findings
        for name, function in self.methods.items():
            method, told = self._tried.get(name, (None, None))
            if method is None or told is None:
                method = self.method(name, function)
            else:
                findings.statements.update(told.statements)
                findings.open_members |= told.open_members
            found.append(method)
        return found

    def _affected(self, methods: dict[str, CppFunction], changed: set[str]) -> set[str]:
        """The methods that lead to some functions, by the names that bodies call."""
        if not changed:
            return set()
        functions = (*self.bodies.unit.functions, *self._free())
        calls = {
            f.name: self.bodies.code.names_called(f)
            for f in functions
            if f.name in self.bodies.functions
        }
        found, fresh = set[str](), changed
        while fresh:
            fresh = {n for n, names in calls.items() if names & fresh} - found
            found |= fresh
        return found & set(methods)

    def method(self, name: str, function: CppFunction) -> m.Method:
        """A function as a local method."""
        called = self.bodies.functions[name]
        assert isinstance(called, Called)
        scope = self.bodies.scope(function.cpp, function)
        local: dict[str, Meaning] = {}
        parameters = []
        for parameter, type_ in zip(function.parameters, called.takes or (), strict=True):
            assert isinstance(type_, m.Type)
            given = scope.local(parameter.name)
            local[parameter.name] = Variable(given, type_)
            parameters.append(m.Parameter(type_, given, function.cpp.span(parameter.node)))
        inside = replace(scope.with_locals(local), returns=called.returns)
        body = self.bodies.block(
            function.cpp, inside, function.body, self.bodies.within(function.name)
        )
        result = called.returns or m.Type("void")
        span = function.cpp.span(function.node)
        return m.Method(result, called.name, tuple(parameters), body, span=span)
