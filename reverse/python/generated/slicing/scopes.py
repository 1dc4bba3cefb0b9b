"""Which statements only compute and keep: each kind of statement of the intermediate form."""

from __future__ import annotations

from rebsync.records import dataclass
from rebsync.reverse.analysis.origins import ClassOrigin, FunctionOrigin, LibraryOrigin, Origin
from rebsync.reverse.analysis.stores import ClassValue, Value, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.libraries.tables.runtime import names_in_model
from rebsync.reverse.python.generated.slicing.candidates import asked_of_node
from rebsync.reverse.python.generated.slicing.escapes import LOGGER, ToldValues
from rebsync.reverse.python.generated.slicing.library_calls import method_takes, takes
from rebsync.reverse.python.generated.slicing.log_words import ON_CLOCKS

_LOG_LEVELS = frozenset({"debug", "info", "warn", "warning", "error", "fatal", "critical"})
_SENDING, _ADDING = frozenset({"publish", "sendTransform"}), frozenset({"append", "extend"})
_REPLACE = "dataclasses.replace"
_DEEPEST = 4
_SUPPRESS = "contextlib.suppress"
_CONTEXTS = frozenset({LibraryOrigin(_SUPPRESS, True)})
_ASKING = frozenset({"get", "items", "keys", "values", "index", "count"})  # of a constant table
# What only gives a number, or a text, of what it gets; the rest goes through its elements.
_WHOLE = frozenset({"str", "repr", "len", "int", "float", "bool", "abs", "round"})
_SHOWN = frozenset({"str", "repr"})
_CONTAINERS = frozenset(
    {
        *("str", "list", "dict", "set", "tuple", "deque", "defaultdict"),
        *("collections.deque", "collections.Counter", "collections.OrderedDict"),
    }
)


@dataclass(eq=False, slots=True)
class ToldScope(ToldValues):
    """The statements of a function, or some of a method."""

    # --- statements -----------------------------------------------------------------------------

    def body(self, body: s.Body) -> bool:
        """Whether some statements only compute, and keep what they made."""
        return all(map(self._statement, body))

    def _statement(self, node: s.Statement) -> bool:
        match node:
            case s.Evaluate(value):
                return self.is_free(value)
            case s.Declare(target, _, None):
                return self._is_place(target)
            case s.Assign(target, value):
                return self._keeps(target, value)
            case s.Declare(target, _, value) if value is not None:
                return self._keeps(target, value)
            case s.CompoundAssign(target, _, value):
                is_kept = self._is_place(target) and self.is_free(value)
                return is_kept and self.is_typed(target, value)
            case s.Unpack(targets, value):
                self.made.update(targets)
                return self.is_seen(value) and self.is_typed(value)
            case s.Insert(container, value, key):
                return container in self.made and self.is_free(value) and self.is_free_or_none(key)
            case s.Delete(target):
                return self._is_place(target)
            case s.Call() | s.Construct():
                return self._called(node)
            case s.Return(value):
                return (self.is_all_own or self.gives) and self.is_free_or_none(value)
            case s.Yield(target, value):
                return self.is_all_own and target is None and self.is_free(value)
            case s.Break() | s.Continue():
                return self.loops > 0
            case _:
                return self._structured(node)

    def _structured(self, node: s.Statement) -> bool:
        match node:
            case s.Block(body):
                return self.body(body)
            case s.If(test, then, otherwise):
                return self.is_seen(test) and self.body(then) and self.body(otherwise)
            case s.With(context, target, body, waits=False):
                held = self.effects.origins.of(context, self.function.name)
                if target is not None:
                    self.made.add(target)
                return held <= _CONTEXTS and self.body(body)
            case s.Try(body, handlers, otherwise, final):
                caught = all(self.body((*h.prelude, *h.body)) for h in handlers)
                kept = all(h.target is None or self._is_place(h.target) for h in handlers)
                return caught and kept and all(map(self.body, (body, otherwise, final)))
            case s.ForEach(target, iterable, body, otherwise, waits=False):
                is_read = self.is_seen(iterable) and self.is_typed(iterable)
                is_read = is_read and self._is_place(target)
                return is_read and self._repeated(body) and self.body(otherwise)
            case s.Loop(test, body, prelude, step, otherwise):
                is_read = self._repeated((*prelude, *body, *step)) and self.is_seen(test)
                return is_read and self.body(otherwise)
            case _:
                return False

    def _repeated(self, body: s.Body) -> bool:
        self.loops += 1
        found = self.body(body)
        self.loops -= 1
        return found

    def _keeps(self, target: e.Lvalue, value: e.Expression) -> bool:
        """Whether a value may be kept in a place; a temporary may stand for an array too."""
        if isinstance(target, e.Temporary) and value in self.loggers:
            self.loggers.add(target)
            return True
        if isinstance(target, e.Temporary) and self.is_publisher(value):
            self.publishing.add(target)
            return True
        if isinstance(target, e.Temporary) and self.is_table(value):
            self.tables.add(target)
            return True
        if isinstance(target, e.Temporary) and self.is_message(value):
            self.fields.add(target)
        return self.is_free(value) and self._is_place(target)

    def _is_place(self, target: e.Lvalue) -> bool:
        """Whether nothing of the model looks at a place."""
        match target:
            case e.Temporary():
                self.made.add(target)
                return target not in self.tables
            case e.Local(name):
                is_inner = "@" in name or self.is_all_own
                if is_inner:
                    self.made.add(target)
                return is_inner or (self.places is not None and name in self.places.locals)
            case e.Attribute(of, name) if self.is_object(of):
                return self.places is not None and name in self.places.attributes
            case e.Attribute(of):
                return (self.is_own(of) or self.is_message(of)) and self.is_free(of)
            case e.Global():
                return self.is_variable(target)
            case e.Index(of, index):
                return self.is_seen(index) and self.is_kept(of)
            case _:
                return False

    # --- calls ----------------------------------------------------------------------------------

    def _called(self, node: s.Call | s.Construct) -> bool:
        """Whether a call does nothing to the model; what it gives is free."""
        if isinstance(node, s.Construct):
            is_made = self.enters(ClassOrigin(node.class_name, False)) and self._given(node)
        else:
            is_made = self._calls(node)
            if node.target is not None and _gives_whole(node):
                self.whole.add(node.target)
        if not is_made:
            return False
        return node.target is None or self._is_place(node.target)

    def _given(self, node: s.Call | s.Construct, *, seen: bool = False) -> bool:
        """Whether all arguments are free, or are `seen` only: behind the first in a text of it."""
        return all(
            self.is_free(a.value)
            if not seen or a.stars
            else (self.is_shown(a.value) if number else self.is_seen(a.value))
            for number, a in enumerate(node.arguments)
        )

    def _calls(self, node: s.Call) -> bool:
        match node.callee:
            case s.FunctionCallee(name):
                is_free = self._given(node)
                return self.effects.is_foreign(name) if is_free else self._runs(node, name)
            case s.LibraryCallee(name, None):
                return self._calls_library(node, name)
            case s.ValueCallee(e.Closure(name)):
                return self._runs(node, name)
            case s.ValueCallee(value):
                held = self.effects.origins.of(value, self.function.name)
                is_given = self._given(node)
                does_nothing = (
                    self.enters(o)
                    if is_given
                    else isinstance(o, FunctionOrigin) and self._runs(node, o.name)
                    for o in held
                )
                return (bool(held) and all(does_nothing)) and (
                    self._is_defined(value, self.function.name) or self.has_keys(node)
                )
            case s.MethodCallee(receiver, name, after=None):
                return self._calls_method(node, receiver, name)
            case _:
                return False

    def _is_defined(self, value: Value, function: str, deepest: int = 4) -> bool:
        """Whether what a value stands for is as it was defined: nothing decorates it."""
        match value:
            case e.Closure() | e.FunctionReference() | e.ClassReference() | ClassValue():
                return True
            case e.Global() | e.Temporary() | e.Local():
                key = key_of(value, function) if deepest else None
                stored = self.effects.origins.graph.stores.of(key) if key is not None else []
                return bool(stored) and all(self._is_defined(v, f, deepest - 1) for f, v in stored)
            case _:
                return False

    def _runs(self, node: s.Call, name: str) -> bool:
        """A function, or a generator that is written in place, looks at an array that it gets."""
        function = self.effects.form.program.function(name)
        if self.depth > _DEEPEST or any(a.stars or a.name for a in node.arguments):
            return False
        inner = ToldScope(self.effects, function, self.places, outside=self)
        for parameter, argument in zip(function.parameters, node.arguments, strict=False):
            if self.is_table(argument.value):
                inner.tables.add(e.Local(parameter.name))
            elif not self.is_free(argument.value):
                return False
        return inner.body(function.body)

    def _calls_library(self, node: s.Call, name: str) -> bool:
        effect = of_function(Language.PYTHON, name).effect
        if effect is Effect.LOGS:
            return self._given(node, seen=True)
        if any(a.stars for a in node.arguments):
            return False
        if name == _SUPPRESS:
            return all(isinstance(a.value, e.LibraryReference) for a in node.arguments)
        if name in self.effects.messages:
            return self._given(node)
        if name in libraries.own_names():
            return not node.arguments
        if name == _REPLACE:
            return self._replaces(node)
        plain = name.removeprefix("builtins.")
        is_shown = plain in _SHOWN and all(self.is_shown(a.value) for a in node.arguments)
        is_shown |= plain == "type" and all(self.is_object(a.value) for a in node.arguments)
        seen = is_shown or all(self.is_seen(a.value, whole=plain in _WHOLE) for a in node.arguments)
        return seen and takes(name, self.arguments(node), whole=self.has_whole(node))

    def _replaces(self, node: s.Call) -> bool:
        """`replace(status, loaded=False)`: another object of a class that has these fields."""
        first, *changed = node.arguments or (None,)
        if first is None or first.name is not None or not self.is_own(first.value):
            return False
        held = self.held(first.value)
        classes = [
            self.effects.form.program.classes[o.name] for o in held if isinstance(o, ClassOrigin)
        ]
        fields = frozenset.intersection(*(frozenset(f.name for f in c.fields) for c in classes))
        is_made = all(self.enters(ClassOrigin(c.name, False)) for c in classes)
        return is_made and self._given(node) and {a.name for a in changed} <= fields

    def _calls_method(self, node: s.Call, receiver: e.Expression, name: str) -> bool:
        if self.is_object(receiver):
            return self._calls_own(node, name)
        if receiver in self.loggers:
            self._know(node)
            return name in _LOG_LEVELS and self._given(node, seen=True)
        if receiver in self.clocks:
            self._know(node)
            return name in ON_CLOCKS and not node.arguments and self._tells_time(node)
        if isinstance(receiver, e.Attribute) and receiver.name == "_mailbox":
            self._know(node)
            is_asked = name in names_in_model(Language.PYTHON) and not node.arguments
            return is_asked and self.is_object(receiver.object)
        if receiver in self.publishing or self.is_publisher(receiver):
            self._know(node)
            return name in _SENDING and self._given(node)
        if self.is_message(receiver):
            return name in _ADDING and self._given(node)
        if self.is_table(receiver):
            is_asked = name in _ASKING and self._given(node)
            return is_asked and method_takes(name, self.arguments(node), whole=self.has_whole(node))
        held = self.held(receiver)
        is_logging = held == {LOGGER} and name in _LOG_LEVELS
        if is_logging or not self._given(node):
            return is_logging and self._given(node, seen=True)
        answers = (self._answers(node, o, name) for o in held)
        return self.is_kept(receiver) and bool(held) and all(answers)

    def _know(self, node: s.Call) -> None:
        self.known.add((self.function.name, node.place))

    def _tells_time(self, node: s.Call) -> bool:
        if node.target is not None:
            self.clocks.add(node.target)
        return True

    def _calls_own(self, node: s.Call, name: str) -> bool:
        """A method of the object that only tells people something, or is asked of its node."""
        places, owner = self.places, self.function.owner
        if places is None or owner is None:
            return False
        if name in places.logging:
            for each in self.effects.origins.methods(owner, name):
                self.known.update(self.effects.acting(each))
            is_whole = len(node.arguments) == places.logging[name]
            by_position = all(not a.stars and a.name is None for a in node.arguments)
            return is_whole and by_position and self._given(node, seen=True)
        found = self.effects.origins.methods(owner, name)
        if found and all(map(self.effects.gives_free, found)):
            for each in found:
                self.known.update(self.effects.acting(each))
            return self._given(node)
        if not places.logs or name not in asked_of_node() or node.arguments:
            return False
        self._know(node)
        if name == "get_logger":
            if node.target is not None:
                self.loggers.add(node.target)
            return isinstance(node.target, e.Temporary)
        return name != "get_clock" or self._tells_time(node)

    def _answers(self, node: s.Call, origin: Origin, name: str) -> bool:
        """Whether a method of an object that the receiver may be does nothing to the model."""
        match origin:
            case LibraryOrigin(of, True):
                return of in _CONTAINERS and method_takes(
                    name, self.arguments(node), whole=self.has_whole(node)
                )
            case ClassOrigin(of, True):
                found = self.effects.origins.methods(of, name)
                return bool(found) and all(map(self.effects.is_foreign, found))
            case _:
                return False

    def enters(self, origin: Origin) -> bool:
        """Whether calling a value does nothing to the model."""
        match origin:
            case FunctionOrigin(name):
                return self.effects.is_foreign(name)
            case ClassOrigin(name, False):
                graph = self.effects.origins.graph
                return all(map(self.effects.is_foreign, graph.construction(name).functions))
            case _:
                return False


def _gives_whole(node: s.Call) -> bool:
    """Whether what a call gives is a whole number, if it gives one."""
    match node.callee:
        case s.LibraryCallee("builtins.len" | "builtins.int"):
            return True
        case s.LibraryCallee("builtins.round"):
            return len(node.arguments) == 1
        case _:
            return False
