"""Functions that the bodies of a unit call: methods of its class, or put in the place of calls."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import field, replace

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Called, Inline, Meaning, Variable
from rebsync.reverse.findings import Findings
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.syntax.cpp_declarations import with_defaults
from rebsync.reverse.syntax.cpp_index import CppFunction

_ROUNDS = 4


@dataclass(slots=True)
class Functions:
    """Decides what becomes of the functions of a unit, and reads the methods."""

    bodies: Bodies
    methods: dict[str, CppFunction] = field(default_factory=dict)
    # As they were read when they were tried, if nothing that they call has changed since.
    _tried: dict[str, tuple[m.Method, Findings]] = field(default_factory=dict)
    # The functions outside of classes that they can call.
    _free: tuple[CppFunction, ...] = ()
    # Where in files, by their paths, calls and loops begin that set the node up.
    _places: dict[str, list[int]] | None = None

    def choose(self) -> None:
        """Functions become methods where a method can say what they do; others are inlined."""
        by_name: dict[str, list[CppFunction]] = {}
        self._free = tuple(self._outside())
        for function in (*map(self._with_defaults, self.bodies.unit.functions), *self._free):
            by_name.setdefault(function.name, []).append(function)
        for above in self.bodies.unit.lineage:
            for declared in above.functions:
                by_name.setdefault(declared.name, [])
        served = {s.body.id for s in self.bodies.servers}
        methods: dict[str, CppFunction] = {}
        for name, found in by_name.items():
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
        """A function of the unit with what its parameters are by default."""
        lineage = self.bodies.unit.lineage if function.owner and function.parameters else ()
        declared = [f for c in lineage for f in c.functions if f.name == function.name]
        return with_defaults(function, declared)

    def _outside(self) -> Iterable[CppFunction]:
        """The functions outside of classes that member functions can call, `main` left out."""
        if self.bodies.unit.owner is None:
            return ()
        near = self.bodies.unit.files | {f.cpp.source.path for f in self.bodies.setup.first}
        return self.bodies.common.signatures.free(self.bodies.code, near)

    def _signature(self, function: CppFunction) -> Called | None:
        """A function as a method, if its parameters and result are of the model's types."""
        if self._sets_up(function):
            return None
        signature = self.bodies.common.signatures.of(function)
        if signature is None:
            return None
        name = self.bodies.setup.names.give(function.name)
        return Called(name, takes=signature.takes, returns=signature.returns, function=function)

    def _sets_up(self, function: CppFunction) -> bool:
        """Whether a function has calls or loops that set the node up."""
        body, setup = function.body, self.bodies.setup
        if body is None:
            return False
        if self._places is None:
            self._places = {}
            calls = [(f.site.cpp, f.site.call) for f in setup.facts]
            for cpp, node in (*calls, *((x.function.cpp, x.node) for x, _ in setup.loops)):
                self._places.setdefault(cpp.source.path, []).append(node.start_byte)
        places = self._places.get(function.cpp.source.path)
        return places is not None and any(body.start_byte <= p < body.end_byte for p in places)

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
            waiting = self._affected(methods.keys() - failed, set(failed))
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
                findings.take(told)
            found.append(method)
        return found

    def _affected(self, methods: Collection[str], changed: set[str]) -> set[str]:
        """Those of some methods that lead to what has changed, by the names that bodies call."""
        if not changed or not methods:
            return set()
        known = self.bodies.functions
        functions = {f.name: f for f in (*self.bodies.unit.functions, *self._free)}

        def leads(method: str) -> bool:
            seen, waiting = set[str](), [method]
            while waiting:
                called = self.bodies.code.names_called(functions[waiting.pop()])
                if not called.isdisjoint(changed):
                    return True
                fresh = {n for n in called if n in functions and n in known} - seen
                seen |= fresh
                waiting += fresh
            return False

        return set(filter(leads, methods))

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
