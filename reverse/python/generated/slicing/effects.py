"""Effects of statements that may only tell people something, by their intermediate form.

A statement does nothing to the model if what it stores lies in places that nothing of the model
looks at, and if nothing that it can reach is the model's. So this is an escape analysis: only free
values (`escapes`) are stored, and given to functions.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from rebsync import model as m
from rebsync.reverse.analysis.call_graph import Targets
from rebsync.reverse.analysis.python.value_types import A_TEXT
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated.slicing.escapes import Foreign, ToldPlaces
from rebsync.reverse.python.generated.slicing.log_words import TEXTS
from rebsync.reverse.python.generated.slicing.scopes import ToldScope
from rebsync.reverse.syntax.py_tree import Py
from rebsync.source import Span

_AT_ONCE = (FunctionKind.FUNCTION, FunctionKind.CONSTRUCTOR)  # others run when they are asked to


class ToldEffects(Foreign):
    """Those of one class of the model; `variables` are its state, by attributes, `constants` other
    attributes with plain values, `messages` types of messages for people.
    """

    def __init__(
        self,
        form: PyForm,
        variables: Mapping[str, m.Type],
        constants: Collection[str],
        messages: Collection[str],
    ) -> None:
        self.form = form
        self.messages = messages
        self.plain = {n for n, type_ in variables.items() if not type_.dimensions} | {*constants}
        self.arrays = {n for n, type_ in variables.items() if len(type_.dimensions) == 1}
        self.foreign: dict[str, bool] = {}
        self.giving: dict[str, bool] = {}

    def only_tells(self, py: Py, place: Span, places: ToldPlaces) -> bool:
        """Whether the statements at a place of a method do nothing but to compute and to keep."""
        function, body = self.form.statements(py, place)
        if function is None or function.receiver is None or not body:
            return False
        scope = ToldScope(self, function, places)
        if not scope.body(body):
            return False
        return self._acts_as_known(scope, function, place)

    def computes(self, py: Py, place: Span) -> bool:
        """Whether statements of a function of a module do nothing but that, and do not leave it."""
        function, body = self.form.statements(py, place)
        if function is None or function.owner is not None or not body:
            return False
        if any(isinstance(n, s.Return | s.Yield) for n in walk(body)):
            return False
        return self._is_apart(function, body, place)

    def tells_around(self, py: Py, method: Span) -> bool:
        """Whether contexts of a class only compute where they are made, entered and left.

        It is that of a `method`, extends no other, and nothing else is stored under these names.
        """
        found, _ = self.form.statements(py, method)
        owner, graph = found.owner if found is not None else None, self.origins.graph
        if found is None or owner is None or graph.bases(owner):
            return False
        ends = (s.MethodCallee(e.Literal(None), n, owner) for n in ("__enter__", "__exit__"))
        reached = [graph.construction(owner), *(graph.callee(end, found) for end in ends)]
        names = {name for targets in reached for name in targets.functions}
        if any(t != Targets(t.functions) or len(t.functions) > 1 for t in reached):
            return False
        functions = [*map(self.form.program.function, names)]
        is_run = all(f.kind in _AT_ONCE for f in functions)
        return is_run and all(self._is_apart(f, f.body, f.place) for f in functions)

    def _is_apart(self, function: Function, body: s.Body, place: Span) -> bool:
        scope = ToldScope(self, function, None)
        return scope.body(body) and self._acts_as_known(scope, function, place)

    def _acts_as_known(self, scope: ToldScope, function: Function, place: Span) -> bool:
        acting = self.form.acting(function, place)
        return all((p.function, p.place) in scope.known for p in acting)

    def acting(self, name: str) -> Iterator[tuple[str, Span]]:
        """Where a function acts, and what it calls."""
        function = self.form.program.function(name)
        return ((p.function, p.place) for p in self.form.acting(function, function.place))

    def is_foreign(self, name: str) -> bool:
        """Whether a function does nothing to the model where it gets free values only."""
        body = self.form.program.function(name).body
        return not any(isinstance(n, e.Captured) for n in walk(body)) and self.is_closed(name)

    def gives_free(self, getter: str) -> bool:
        """Whether a method of the object gives a free value for such, and does nothing else."""
        if getter not in self.giving:
            self.giving[getter] = False  # while it is looked at: none may call itself
            function = self.form.program.function(getter)
            places = ToldPlaces(locals=_locals_of(function))
            scope = ToldScope(self, function, places, gives=True)
            is_free = scope.body(function.body)
            self.giving[getter] = is_free and self._acts_as_known(scope, function, function.place)
        return self.giving[getter]

    def describes(self, owner: str) -> bool:
        """Whether to make a text of an object of a class does nothing but that."""
        found = {f for name in TEXTS for f in self.origins.methods(owner, name)}
        functions = map(self.form.program.function, found)
        return all(
            self.gives_free(f.name) and isinstance(f.body[-1], s.Return) and self._gives_texts(f)
            for f in functions
        )

    def _gives_texts(self, function: Function) -> bool:
        given = [n.value for n in walk(function.body) if isinstance(n, s.Return)]
        kinds = self.form.kinds(function)
        return all(v is not None and kinds.types(v, frozenset()) == A_TEXT for v in given)

    def is_closed(self, name: str) -> bool:
        """The same of one that gets free values only from around it as well."""
        if name not in self.foreign:
            self.foreign[name] = False  # while it is looked at: none may call itself
            function = self.form.program.function(name)
            self.foreign[name] = ToldScope(self, function, None).body(function.body)
        return self.foreign[name]


def _locals_of(function: Function) -> frozenset[str]:
    """The locals of a function, its parameters among them, but for the object."""
    stored = (getattr(n, "target", None) for n in walk(function.body))
    names = {target.name for target in stored if isinstance(target, e.Local)}
    names.update(p.name for p in function.parameters)
    return frozenset(names.difference([function.receiver]))
