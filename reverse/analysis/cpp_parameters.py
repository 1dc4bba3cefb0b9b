"""Parameters of nodes in C++: with which types they are declared, and which calls declare again."""

from __future__ import annotations

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import CallResult, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import FunctionKind
from rebsync.reverse.ir.walk import walk

_ASKED = {"as_bool": bool, "as_int": int, "as_double": float, "as_string": str}


class CppParameters:
    """The parameters of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._facts = origins.of_cpp
        self._program = origins.graph.program

    def is_of_other_type(self, call: s.Call, function: str) -> bool:
        """Whether a parameter is asked for a type that none has of those of its name.

        What is declared without a value in the source is trusted to be of the type.
        """
        match call.callee:
            case s.MethodCallee(receiver, asked) | s.LibraryCallee(asked, receiver):
                names = self._names(receiver, function) if receiver is not None else []
            case _:
                return False
        declared = [self._facts.parameter_types.get(name, frozenset()) for name in names]
        wanted = _ASKED.get(asked.rpartition("::")[2])
        return any(types and None not in types and wanted not in types for types in declared)

    def is_declared_again(self, function: str) -> bool:
        """Whether a function that declares a parameter may run more than once.

        One that asks whether it is there is trusted to look at the answer.
        """
        body = self._program.function(function)
        is_once = function in self._facts.constructing or body.kind is FunctionKind.MODULE
        if is_once or function.rpartition("::")[2] == "main":
            return False
        calls = (n.callee for n in walk(body) if isinstance(n, s.Call))
        return not any("has_parameter" in getattr(c, "name", "") for c in calls)

    def _names(self, parameter: e.Expression, function: str) -> list[str]:
        """The names that a node was asked for to get a parameter."""
        while isinstance(parameter, e.Dereference | e.AddressOf | e.Convert | e.Copy):
            match parameter:
                case e.Dereference(of) | e.AddressOf(of) | e.Convert(_, of) | e.Copy(of):
                    parameter = of
        key = key_of(parameter, function)
        stored = [] if key is None else self._origins.graph.stores.of(key)
        calls = [v.call for _, v in stored if isinstance(v, CallResult)]
        asking = [c for c in calls if "get_parameter" in getattr(c.callee, "name", "")]
        values = [a.value for c in asking for a in c.arguments[:1]]
        return [v.value for v in values if isinstance(v, e.Literal) and isinstance(v.value, str)]
