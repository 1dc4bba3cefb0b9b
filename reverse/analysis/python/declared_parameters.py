"""Which parameters a node of rclpy has declared before its callbacks run.

A parameter that was not declared may not be got; one that was may not be declared again. What
constructors and modules run declares, by names that the text has.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import CallResult, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import walk, walk_all

_FIRST = (FunctionKind.CONSTRUCTOR, FunctionKind.MODULE, FunctionKind.CLASS)
_DECLARING = ("declare_parameter", "declare_parameters")
_ALLOWING = "allow_undeclared_parameters"
_ALWAYS = frozenset({"use_sim_time", "start_type_description_service"})


class DeclaredParameters:
    """The parameters of the nodes of one program, which are not told apart by their nodes."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._program = origins.graph.program

    def may_lack(self, call: s.Call, function: str) -> bool:
        """Whether a call asks for a parameter that may not be declared."""
        asked = call.arguments[0].value if call.arguments else e.Literal(None)
        if self._allows or any(self._is_before(d, call, asked) for d in self._declares(function)):
            return False
        names = self._texts(asked, function)
        return not names or not names <= self._declared

    def may_have(self, function: str) -> bool:
        """Whether what a function declares may be declared: it may run more than once."""
        return function not in self._first

    @cached_property
    def _first(self) -> frozenset[str]:
        """The functions that run before callbacks do."""
        names = self._program.functions
        modules = [n for n in names if self._program.function(n).kind is FunctionKind.MODULE]
        # `main`, by which an installed program starts, is called by no text.
        waiting = [n for n in names if self._program.function(n).kind in _FIRST]
        waiting += [n for n in names if n in {f"{module}:main" for module in modules}]
        found = set(waiting)
        while waiting:
            around = self._program.function(waiting.pop())
            calls = (n for n in walk(around.body) if isinstance(n, s.Call))
            called = {f for c in calls for f in self._origins.graph.targets(c, around).functions}
            waiting += called - found
            found |= called
        return frozenset(found)

    @cached_property
    def _allows(self) -> bool:
        """Whether a node may get parameters that it has not declared."""
        return any(
            argument.name == _ALLOWING and argument.value != e.Literal(False)
            for _, node in walk_all(self._program)
            if isinstance(node, s.Call)
            for argument in node.arguments
        )

    @cached_property
    def _declared(self) -> frozenset[str]:
        calls = ((name, call) for name in self._first for call in self._declares(name))
        texts = (self._texts(a.value, name) for name, call in calls for a in call.arguments)
        return _ALWAYS.union(*texts)

    def _declares(self, function: str) -> Iterator[s.Call]:
        for node in walk(self._program.function(function)):
            match node:
                case s.Call(_, callee) if _name_of(callee) in _DECLARING:
                    yield node
                case _:
                    pass

    def _is_before(self, declares: s.Call, call: s.Call, asked: e.Expression) -> bool:
        """Whether a call in the same function declares what another then asks for."""
        values = [a.value for a in declares.arguments]
        return asked in values and declares.place.start < call.place.start

    def _texts(self, value: e.Expression, function: str) -> frozenset[str]:
        """The texts that a value is or has in it, gets by a parameter, or has of a loop."""
        found = _literals(value)
        if found or not isinstance(value, e.Local | e.Temporary):
            return found | self._stored(value, function)
        around = self._program.function(function)
        if isinstance(value, e.Local) and value.name in {p.name for p in around.parameters}:
            return self._given(around)
        loops = [n.iterable for n in walk(around) if isinstance(n, s.ForEach)]
        return self._stored(value, function).union(
            *(_literals(each) | self._stored(each, function) for each in loops)
        )

    def _stored(self, value: e.Expression, function: str) -> frozenset[str]:
        """The texts in what is stored under the name of a value, or in what that is made of."""
        key = key_of(value, function)
        found = frozenset[str]()
        for around, stored in self._origins.graph.stores.of(key) if key is not None else ():
            match stored:
                case CallResult(s.Call(_, callee, arguments)):
                    parts = [a.value for a in arguments]
                    parts += [callee.receiver] if isinstance(callee, s.MethodCallee) else []
                    found = found.union(*(_literals(p) | self._plain(p, around) for p in parts))
                case e.Build() | e.BuildMapping() | e.Literal():
                    found |= _literals(stored)
                case _:
                    pass
        return found

    def _plain(self, value: e.Expression, function: str) -> frozenset[str]:
        """The texts in the containers that are stored under the name of a value."""
        key = key_of(value, function)
        stored = self._origins.graph.stores.of(key) if key is not None else ()
        kept = (v for _, v in stored if isinstance(v, e.Build | e.BuildMapping))
        return frozenset[str]().union(*map(_literals, kept))

    def _given(self, function: Function) -> frozenset[str]:
        """The texts that calls give to a function, by its name."""
        last = re.split("[.:]", function.name)[-1]
        found = frozenset[str]()
        for _, node in walk_all(self._program):
            match node:
                case s.Call(_, callee, arguments) if _name_of(callee) == last:
                    found = found.union(*(_literals(a.value) for a in arguments))
                case _:
                    pass
        return found


def _name_of(callee: s.Callee) -> str:
    match callee:
        case s.MethodCallee(_, name) | s.ValueCallee(e.Global(_, name)):
            return name
        case _:
            return ""


def _literals(value: e.Expression) -> frozenset[str]:
    """The texts that stand in an expression."""
    found = (n.value for n in walk(value) if isinstance(n, e.Literal))
    return frozenset(text for text in found if isinstance(text, str))
