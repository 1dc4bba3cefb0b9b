"""What is asked of values of Python that have no such attribute: an AttributeError."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.foreign_values import ForeignValues
from rebsync.reverse.analysis.origins import ANYTHING, ClassOrigin, LibraryOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.operand_kinds import ATTRIBUTES, OperandKinds
from rebsync.reverse.analysis.python.value_types import (
    InstanceType,
    LibraryType,
    MessageType,
    ValueType,
    own_type,
)
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    CapturedVariable,
    ClassValue,
    ElementOf,
    GlobalVariable,
    Member,
    ObjectValue,
    PartOf,
    Source,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.attributes import (
    attributes_of,
    may_be_of_messages,
    takes_nothing,
)
from rebsync.reverse.libraries.module_names import has_name

_REFUSED = "gets other arguments than it takes"
_LACKS = "has no such attribute"
_UNDEFINED = "names what nothing defines"
_OF_MODULES = frozenset({"__name__", "__file__", "__doc__", "__package__", "__spec__"})
_HANDING = frozenset({"contextlib.closing", "contextlib.nullcontext"})
_DEEPEST = 5  # names that follow each other
_HOOKS = ("__getattr__", "__getattribute__")
_OF_CLASSES = frozenset(dir(type)) | {"__members__"}
_OF_OBJECTS = frozenset(dir(object)) | {"__dict__", "__module__", "__name__", "__slots__"}


class AttributeErrors:
    """The values of one function, in Python."""

    def __init__(self, notes: ProblemNotes, kinds: OperandKinds) -> None:
        self._notes = notes
        self._kinds = kinds
        self._foreign = ForeignValues(notes.origins)
        self._rules = notes.counts.rules
        self._program = notes.origins.graph.program

    def asks(
        self, node: s.Statement | e.Expression, of: e.Expression, name: str, facts: Facts
    ) -> None:
        """Notes that an attribute is asked of a value that may have none of the name."""
        types = self._kinds.types(of, facts)
        lacks = any(self._has_not(type_, name) for type_ in types)
        if lacks or self._is_of_none(of, name, facts) or (None in types and self._is_open(of)):
            self._notes.fails(node, _LACKS)

    def asks_base(self, node: s.Call, after: str, name: str) -> None:
        """Notes that no class behind another has a method; a mixin is none of its own."""
        graph = self._notes.origins.graph
        below = sorted(graph.subclasses.get(after, set()) - {after}) or [after]
        lines = [[each, *graph.bases(each)] for each in below]
        if any(self._lacks_behind(x[x.index(after) + 1 :], name) for x in lines if after in x):
            self._notes.fails(node, _LACKS)

    def _lacks_behind(self, line: list[str], name: str) -> bool:
        """Whether none of some classes has a method, as far as these are known."""
        known = [self._program.classes[c] for c in line if c in self._program.classes]
        is_own = any(name == n for c in known for n, _ in c.methods) or name in _OF_OBJECTS
        is_open = any(None in c.bases for c in known)
        others = [attributes_of(c) or (name,) for c in line if c not in self._program.classes]
        return not is_own and not is_open and all(name not in each for each in others)

    def _is_open(self, of: e.Expression) -> bool:
        """Whether nothing is known of a value: not which library, or class, it is of."""
        name = self._notes.function.name
        return not (self._notes.table.trusts_attributes or self._is_made(of, name, 0))

    def _is_made(self, value: e.Expression, function: str, depth: int) -> bool:
        """Whether a value is a message, what the program or a library made, or a part of these."""
        held = self._notes.origins.of(value, function)
        is_own = self._rules.types.attributes.receiver(value, function) is not None
        if is_own or ANYTHING.isdisjoint(held) or self._rules.messages.has(value, function):
            return True
        if depth == _DEEPEST or self._foreign.has(value, function):
            return depth != _DEEPEST
        if isinstance(value, e.Temporary) and self._is_entered(value, function):
            return True
        key = key_of(value, function)
        sources = self._rules.types.sources(key) if key is not None else []
        if isinstance(key, CapturedVariable):
            given = self._rules.arguments.arguments(key.function, key.name)
            if given and key.function not in self._rules.arguments.escaping:
                sources = [*given, *(s for s in sources if not isinstance(s[1], AnyValue))]
        if sources:
            return all(self._is_made_there(each, depth + 1) for each in sources)
        return isinstance(value, e.Attribute) and self._is_made(value.object, function, depth + 1)

    def _is_entered(self, value: e.Temporary, function: str) -> bool:
        """Whether a context of a library gives a value, which is no object of another."""
        nodes = walk(self._program.function(function))
        contexts = [n.context for n in nodes if isinstance(n, s.With) and n.target == value]
        held = frozenset().union(*(self._notes.origins.of(c, function) for c in contexts))
        return bool(held) and all(
            isinstance(origin, LibraryOrigin) and origin.name not in _HANDING for origin in held
        )

    def _is_made_there(self, source: Source, depth: int) -> bool:
        function, value = source
        match value:
            case CallResult(s.Call(_, s.MethodCallee(receiver, name, None, None))):
                is_own = bool(self._notes.origins.methods_of_any(name))
                return not is_own and self._is_made(receiver, function, depth)
            case CallResult() | ClassValue() | ObjectValue():
                return ANYTHING.isdisjoint(self._notes.origins.of_stored((function, value)))
            case ElementOf() | PartOf() | AnyValue():
                return False
            case _:
                return self._is_made(value, function, depth)

    def _has_not(self, type_: ValueType | None, name: str) -> bool:
        """Whether values of a type have no attribute of a name."""
        match type_:
            case None:
                return False
            case MessageType(of):
                fields = self._notes.table.fields(of)
                return fields is not None and name not in fields and not may_be_of_messages(name)
            case LibraryType(of):
                known = attributes_of(of)
                return known is not None and name not in known | _OF_OBJECTS
            case InstanceType(of):
                return self._lacks(of, name)
            case _:
                known = ATTRIBUTES.get(own_type(type_))
                return known is not None and name not in known

    def _is_of_none(self, of: e.Expression, name: str, facts: Facts) -> bool:
        """Whether no object of the classes that a value is of may have an attribute."""
        if self._kinds.of(of, facts) != {None}:
            return False
        origins = self._notes.origins
        own = origins.graph.class_of(of, self._notes.function)
        held = origins.of(of, self._notes.function.name)
        if held and all(isinstance(o, ClassOrigin) and not o.of_object for o in held):
            names = {o.name for o in held if isinstance(o, ClassOrigin)}
            is_stored = bool(origins.graph.stores.of(Member(name))) or name in _OF_CLASSES
            return not is_stored and any(
                self._rules.objects.lacks_attribute(n, name) for n in names
            )
        classes = {o.name for o in held if isinstance(o, ClassOrigin) and o.of_object}
        if own is not None:
            classes = {own}
        elif len(classes) != len(held):
            return False
        return bool(classes) and any(self._lacks(each, name) for each in classes)

    def _lacks(self, of: str, name: str) -> bool:
        """Whether a class, and all that it extends, say nothing of an attribute."""
        origins = self._notes.origins
        if name in _OF_OBJECTS or origins.graph.stores.of(Member(name)):
            return False
        family = origins.graph.family(of)
        classes = [self._program.classes[c] for c in family if c in self._program.classes]
        others = [attributes_of(c) for c in family - self._program.classes.keys()]
        is_open = any(None in c.bases or not self._rules.decorators.is_plain(c) for c in classes)
        if is_open or None in others or origins.names.sets_by_text:
            return False
        known = {n for c in classes for n, _ in c.methods}
        known |= {p.name for c in classes for p in c.properties}
        known |= {f.name for c in classes for f in c.fields}
        is_known = any(name in (other or ()) for other in others)
        return not is_known and known.isdisjoint({name, *_HOOKS})

    def named(self, value: e.Expression, module: str, name: str) -> None:
        """Notes a name that no scope of a module binds, and no import brings in unseen."""
        graph = self._notes.origins.graph
        if name in _OF_MODULES or graph.stores.of(GlobalVariable(module, name)):
            return
        body = graph.program.modules.get(module)
        if body is None or self._notes.origins.names.sets_by_text:
            return
        nodes = walk(graph.program.function(body))
        if not any(isinstance(n, s.Unsupported) or _is_star(n) for n in nodes):
            self._notes.fails(value, _UNDEFINED)

    def takes_nothing(self, node: s.Call, receiver: e.Expression, name: str, facts: Facts) -> None:
        """Notes that a method of a library's object gets arguments, which takes none."""
        if not node.arguments:
            return
        for type_ in self._kinds.types(receiver, facts):
            names = [type_.name] if isinstance(type_, LibraryType) else []
            if isinstance(type_, InstanceType) and not self._notes.origins.methods(
                type_.name, name
            ):
                names = self._notes.origins.graph.bases(type_.name)
            if any(takes_nothing(f"{each}.{name}") for each in names):
                self._notes.fails(node, _REFUSED)

    def of_library(self, node: s.Statement | e.Expression, name: str) -> None:
        """Notes a full name in a library of which a table has all names, and not this one."""
        if "." in name and not has_name(name):
            self._notes.fails(node, _LACKS)
        if isinstance(node, s.Call) and node.arguments and takes_nothing(name):
            self._notes.fails(node, _REFUSED)


def _is_star(node: Node) -> bool:
    """Whether a node imports all that a module has."""
    return isinstance(node, s.Import) and node.name == "*"
