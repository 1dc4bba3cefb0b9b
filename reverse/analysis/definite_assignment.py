"""Whether a local without an initial value has got one where it is read: definite assignment.

Of an array an element that is stored counts for all, as loops store them.
"""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, Program
from rebsync.reverse.ir.walk import Node, parts
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Language

# Functions of libraries that store what they read in an argument.
_STORING = ("getParam", "getParamCached", "get_parameter", "get_parameter_or", "param", "tie")


def may_be_unset(program: Program, function: Function, name: str) -> bool:
    """Whether a local that is declared without a value may be read before it gets one."""
    flow = _Flow(program, name, frozenset({function.name}))
    flow.body(function.body, True)
    return flow.is_read_early


class _Flow:
    """Follows a function: whether a local has a value; it has where nothing goes on.

    What a parameter refers to is followed as a local is.
    """

    def __init__(self, program: Program, name: str, active: frozenset[str]) -> None:
        self._program = program
        self._name = name
        self._active = active
        self._breaks: list[list[bool]] = []  # of the loops and switches around
        self._continues: list[list[bool]] = []
        self.is_read_early = False

    def body(self, body: s.Body, known: bool) -> bool:
        """Whether it has a value after some statements."""
        for statement in body:
            known = self._statement(statement, known)
        return known

    def _statement(self, node: s.Statement, known: bool) -> bool:
        match node:
            case s.Block(body):
                return self.body(body, known)
            case s.If(test, then, otherwise):
                known = self._read([test], known)
                return all([self.body(then, known), self.body(otherwise, known)])
            case s.Loop():
                return self._loop(node, known)
            case s.ForEach(_, iterable, body):
                known = self._read([iterable], known)
                self._round(body, known)
                self._breaks.pop()
                return known
            case s.Switch(value, cases):
                return self._switch(cases, self._read([value], known))
            case s.Try(body, handlers, otherwise, final):
                ways = [self.body((*body, *otherwise), known)]
                ways += [self.body((*h.prelude, *h.body), known) for h in handlers]
                return self.body(final, known) or all(ways)
            case s.With(context, _, body):
                return self.body(body, self._read([context], known))
            case s.Unsequenced(every):
                ways = [self.body(part, known) for part in every]
                return any(ways)
            case s.Break() if self._breaks:
                self._breaks[-1].append(known)
                return True
            case s.Continue() if self._continues:
                self._continues[-1].append(known)
                return True
            case s.Return() | s.Raise():
                self._read(parts(node), known)
                return True
            case s.Declare(e.Local(self._name)):
                return False
            case s.Call():
                return self._stored(node, self._call(node, known))
            case _:
                target = getattr(node, "target", None)
                values = [p for p in parts(node) if p is not target]
                changed = [node.target] if isinstance(node, s.CompoundAssign) else []
                return self._stored(node, self._read([*values, *changed], known))

    def _round(self, body: s.Body, known: bool) -> bool:
        """Whether it has a value after a round of a loop, whose breaks are left to be seen."""
        self._breaks.append([])
        self._continues.append([])
        return all([self.body(body, known), *self._continues.pop()])

    def _loop(self, node: s.Loop, known: bool) -> bool:
        tested = known
        if not node.body_first:
            tested = self._read([node.test], self.body(node.prelude, known))
        after = self.body(node.step, self._round(node.body, tested))
        if node.body_first:
            tested = self._read([node.test], self.body(node.prelude, after))
        is_endless = isinstance(node.test, e.Literal) and bool(node.test.value)
        return all([is_endless or tested, *self._breaks.pop()])

    def _switch(self, cases: Iterable[s.Case], known: bool) -> bool:
        self._breaks.append([])
        through, has_default = True, False
        for case in cases:
            through = self.body(case.body, known and through)
            has_default |= case.is_default
        return all([*self._breaks.pop(), through, has_default or known])

    # --- expressions ------------------------------------------------------------------------------

    def _read(self, nodes: Iterable[Node], known: bool) -> bool:
        """Whether it has a value once some expressions are evaluated."""
        for node in nodes:
            match node:
                case e.Local(self._name):
                    self.is_read_early |= not known
                case _:
                    known = self._read(parts(node), known)
        return known

    def _stored(self, node: s.Statement, known: bool) -> bool:
        """Whether it has a value once the target of a statement has got one."""
        target = getattr(node, "target", None)
        while isinstance(target, e.Index):
            known = self._read([target.index], known)
            target = target.object
        match target:
            case e.Local(self._name) | e.Dereference(e.Local(self._name)):
                return True
            case _:
                return known if target is None else self._read([target], known)

    def _call(self, call: s.Call, known: bool) -> bool:
        known, stored = self._read(parts(call.callee), known), False
        for at, argument in enumerate(call.arguments):
            match argument.value:
                case e.AddressOf(e.Local(self._name)) if self._stores(call.callee, at):
                    stored = True
                case value:
                    known = self._read([value], known)
        return known or stored

    def _stores(self, callee: s.Callee, at: int) -> bool:
        """Whether a function stores in what a parameter refers to, before it reads it."""
        match callee:
            case s.FunctionCallee(name) if name not in self._active:
                function = self._program.function(name)
                flow = _Flow(self._program, function.parameters[at].name, self._active | {name})
                return flow.body(function.body, False) and not flow.is_read_early
            case s.LibraryCallee(name) | s.MethodCallee(_, name):
                is_written = at in (of_function(Language.CPP, name).writes or ())
                return is_written or name.rpartition("::")[2] in _STORING
            case _:
                return False
