"""Which classes of Python have objects in which attributes cannot be stored.

Those of `__slots__`, of frozen data classes and of named tuples; see the data model of Python.
"""

from __future__ import annotations

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.python.class_decorators import ClassDecorators
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk

_TUPLES = frozenset({"typing.NamedTuple"})


class FixedAttributes:
    """The classes of one program."""

    def __init__(self, graph: CallGraph, decorators: ClassDecorators) -> None:
        self._graph = graph
        self._decorators = decorators
        self._program = graph.program

    def refuses(self, name: str, attribute: str) -> bool:
        """Whether an object of a class takes no value for an attribute."""
        line = [name, *self._graph.bases(name)]
        if any(map(self._decorators.is_frozen, line)) or not _TUPLES.isdisjoint(line):
            return True
        if any(c not in self._program.classes and c != "builtins.object" for c in line):
            return False
        own = [c for c in line if c in self._program.classes]
        slots = [self._slots(c) for c in own]
        if any(each is None for each in slots):
            return False
        methods = {p.name for c in own for p in self._program.classes[c].properties}
        return attribute not in methods.union(*(each or () for each in slots))

    def stored_in(self, name: str) -> frozenset[str]:
        """The attributes that objects of a class may have: all that functions may store there."""
        family, found = self._graph.family(name), set[str]()
        for each in self._program.functions:
            around = self._program.function(each)
            for node in walk(around):
                match getattr(node, "target", None):
                    case e.Attribute(e.Local(of), attribute) if of == around.receiver:
                        found |= {attribute} if around.owner in family else set()
                    case e.Attribute(_, attribute):
                        found.add(attribute)
                    case _:
                        pass
        return frozenset(found)

    def _slots(self, name: str) -> frozenset[str] | None:
        """The attributes that a class has place for; None where it has place for any."""
        body = self._program.classes[name].body
        for node in walk(self._program.function(body)) if body is not None else ():
            match node:
                case s.Assign(e.Attribute(_, "__slots__") | e.Local("__slots__"), value):
                    texts = (n.value for n in walk(value) if isinstance(n, e.Literal))
                    found = frozenset(text for text in texts if isinstance(text, str))
                    return None if "__dict__" in found else found
                case _:
                    pass
        return None
