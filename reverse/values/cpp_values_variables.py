"""The values that variables may hold where they are used."""

from __future__ import annotations

from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Under
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_index import CppClass
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_assignments import CppAssignments
from rebsync.reverse.values.cpp_flow_definitions import Definition
from rebsync.reverse.values.cpp_flow_reach import Reach, in_loop, reaching
from rebsync.reverse.values.cpp_flow_types import Variable, is_list
from rebsync.reverse.values.cpp_flow_writes import (
    Key,
    Writes,
    called_name,
    key_of,
    parameter_variable,
    role_of,
)
from rebsync.reverse.values.cpp_values_afterwards import Afterwards
from rebsync.reverse.values.cpp_values_kept import (
    found_by,
    is_pointer,
    listed,
    on_this,
    root_of,
    with_default,
)
from rebsync.reverse.values.cpp_values_lambdas import arguments_of
from rebsync.reverse.values.cpp_values_made import constructed, default_of
from rebsync.reverse.values.cpp_values_numbers import added, converted
from rebsync.reverse.values.cpp_values_parameters import from_parameter
from rebsync.reverse.values.cpp_values_plain import (
    MOST,
    TOO_MANY,
    Frame,
    Handle,
    Nothing,
    OpenCallers,
    Use,
    Value,
    choice,
    each,
    pairs,
)
from rebsync.reverse.values.cpp_values_ros2 import adjusted, declared
from rebsync.reverse.values.cpp_values_texts import formatted

_DEEPEST = 60
_At = tuple[Key, int, int]  # a variable, the node that uses it, and the frame
_OUTSIDE = "handed in by callers outside of the files"


@dataclass(slots=True)
class Variables(CppAssignments):
    """Finds the values of variables; `values` those of the expressions that they are given."""

    _asked: set[_At] = field(default_factory=set)
    # What was found at a place in a frame, which stays alive with it.
    _memo: dict[_At, tuple[Value, Frame]] = field(default_factory=dict)
    _later: Afterwards = field(init=False)

    def __post_init__(self) -> None:
        values = self.values
        self.writes = Writes(values.texts, values.types, values.calls)
        self._later = Afterwards(self)

    def fresh(self) -> None:
        """Begins a question of its own."""
        self._memo.clear()

    def end(self) -> None:
        """Lets go of what refers back to it."""
        del self._later

    # --- at a place -----------------------------------------------------------------------------

    def value(self, variable: Variable, path: str, node: Node, frame: Frame) -> Value:
        """What a variable, or a field of it, may hold where a node uses it."""
        found = self._at(variable, path, node, frame)
        if path:
            return found
        return converted(found, self.values.types.plain(variable.cpp, variable.type))

    def field_value(self, node: Node, frame: Frame) -> Value:
        """The value of `a.b`, `this->b` or `a->b.c`."""
        root, path = root_of(node)
        variable = None
        if root.type in ("identifier", "field_identifier"):
            variable = self.values.types.variable(frame.cpp, root)
        if variable is None:
            return self._of_class(node, frame)
        if not path:
            return self.value(variable, "", node, frame)
        if variable.kind == "member" and is_pointer(variable):
            return self._of_class(node, frame)
        found = self._at(variable, path, node, frame)
        return self._of_class(node, frame) if isinstance(found, Nothing) else found

    def _of_class(self, node: Node, frame: Frame) -> Value:
        """What a member of some object of a class may hold."""
        types = self.values.types
        name = text_of(part(node, "field")) if node.type == "field_expression" else ""
        owner = types.class_of(frame.cpp, part(node, "argument")) if name else None
        member = types.member(owner, name)
        if member is None:
            return self.values.unknown("a value that comes while it runs", node, frame)
        found = self._later.value(member, "", frame)
        return converted(found, types.plain(member.cpp, member.type))

    def _at(self, variable: Variable, path: str, node: Node | None, frame: Frame) -> Value:
        key = key_of(variable, path), node.id if node is not None else 0, id(frame)
        if key in self._memo:
            return self._memo[key][0]
        if key in self._asked or len(self._asked) > _DEEPEST:
            self.values.cuts += 1
            return Nothing()
        self._asked.add(key)
        before = self.values.cuts
        try:
            found, sure = self.ways_to(variable, path, node, frame)
            if not sure:
                found.append(self._entry(variable, path, node, frame))
        finally:
            self._asked.discard(key)
        place = node if node is not None else variable.name
        value = self.values.bounded(choice(found), place, frame)
        if self.values.cuts == before:
            self._memo[key] = value, frame
        return value

    def ways_to(
        self, variable: Variable, path: str, node: Node | None, frame: Frame
    ) -> tuple[list[Value], bool]:
        """What may be put into a variable before a place, latest first; whether surely one is."""
        if frame.function is None:
            return [], False
        found = []
        known = self.writes.within(variable, path, frame.function)

        def holds(condition: Node) -> bool | None:
            return self.values.holds(condition, frame)

        stands_in: Value = Nothing()
        for reach in reaching(known, node, holds):
            value = self._given(reach, variable, path, frame)
            if reach.unset:
                stands_in = value
                continue
            found.append(with_default(value, stands_in))
            stands_in = Nothing()
            if reach.sure:
                return found, True
            if len(found) > MOST:
                place = node if node is not None else reach.definition.place
                return [self.values.unknown(TOO_MANY, place, frame)], True
        return found if isinstance(stands_in, Nothing) else [*found, stands_in], False

    # --- one definition -------------------------------------------------------------------------

    def _given(self, reach: Reach, variable: Variable, path: str, frame: Frame) -> Value:
        definition = reach.definition
        if self._repeats(definition, variable, frame):
            why = "changes from one round of a loop to the next"
            return self.values.unknown(why, definition.node, frame)
        match definition.how:
            case "value":
                return self._as(variable, path, self.values.value(definition.node, frame))
            case "made":
                return self._made(variable, path, definition, frame)
            case "initialised":
                if not definition.arguments:
                    return self._declared(variable, path, definition.place, frame)
                return self._made(variable, path, definition, frame)
            case "declared":
                return self._declared(variable, path, definition.place, frame)
            case "added":
                before = self._at(variable, path, definition.place, frame)
                return pairs(added, before, self.values.value(definition.node, frame))
            case "adjusted":
                before = self._at(variable, path, definition.place, frame)
                return adjusted(self.values, before, definition, frame)
            case "given":
                return self._by_reference(definition, variable, path, frame)
            case "called":
                return self._by_call(definition, variable, path, frame)
            case "element":
                return self._element(definition, frame)
            case _:
                return self.values.unknown(definition.text, definition.node, frame)

    def _repeats(self, definition: Definition, variable: Variable, frame: Frame) -> bool:
        """Whether a loop makes a value of the value of the round before."""
        if definition.how not in ("value", "added", "given"):
            return False
        node = definition.node
        texts = self.values.texts
        own = texts.within(frame.cpp, variable.text, node.start_byte, node.end_byte)
        least = {"value": 1, "added": 0, "given": 2}[definition.how]
        if len(own) < least:
            return False
        return in_loop(definition, variable.scope)

    def _element(self, definition: Definition, frame: Frame) -> Value:
        """What a loop over a list that is known takes from it."""
        listed = self.values.value(definition.node, frame)
        if isinstance(listed, tuple):
            return choice(listed)
        why = f"a loop over {text_of(definition.node)}"
        return self.values.unknown(why, definition.place, frame)

    def _as(self, variable: Variable, path: str, value: Value) -> Value:
        if path:
            return value
        return converted(value, self.values.types.plain(variable.cpp, variable.type))

    def _made(self, variable: Variable, path: str, definition: Definition, frame: Frame) -> Value:
        if path:
            return Nothing()
        types = self.values.types
        type_ = types.plain(variable.cpp, variable.type)
        if len(definition.arguments) == 1 and is_pointer(variable):
            return self.values.value(definition.arguments[0], frame)
        if is_list(variable):
            return listed(self.values, type_, definition, frame)
        if not type_ or type_ == "auto":
            return self.values.value(definition.arguments[0], frame)
        use = Use(frame.cpp, definition.node, definition.arguments, frame.function)
        return constructed(self.values, type_, use, frame)

    def _declared(self, variable: Variable, path: str, place: Node, frame: Frame) -> Value:
        if variable.type is None or is_pointer(variable):
            return Nothing()
        type_ = self.values.types.plain(variable.cpp, variable.type)
        if not path:
            return default_of(self.values, type_, place, frame)
        owner = self.values.texts.class_near(type_.rpartition("::")[2], variable.cpp)
        member = self.values.types.member(owner, path) if owner is not None else None
        if member is None or member.field is None or member.field.value is None:
            return Nothing()
        return self.values.value(member.field.value, Frame(member.cpp))

    def _by_reference(
        self, definition: Definition, variable: Variable, path: str, frame: Frame
    ) -> Value:
        call = definition.node
        function = part(call, "function")
        given = tuple(named(part(call, "arguments")))
        name, scope = called_name(function)
        role = role_of(name, scope, definition.index, len(given))
        if role == "format":
            return formatted(self.values, call, frame)
        if role:
            handle: Value = Handle("")
            if function.type == "field_expression" and name not in libraries.reading():
                handle = self.values.value(part(function, "argument"), frame)
            key = self.values.value(given[0], frame)
            if role == "found":
                return found_by(self.values, handle, key, call, frame)
            if len(given) > 2:
                default = self._as(variable, path, self.values.value(given[2], frame))
            else:
                default = Nothing()
                if name in libraries.reading():
                    default = declared(self.values, given[0], frame)
                if isinstance(default, Nothing):
                    default = self._at(variable, path, call, frame)
            return each(lambda h: from_parameter(self.values, h, key, default, call, frame), handle)
        functions = self.values.calls.functions(frame.cpp, call)
        if not functions or frame.depth >= 6:
            return self.values.unknown(f"read by {name}", call, frame)
        use = Use(frame.cpp, call, given, frame.function)
        return choice(
            self._at(inner, path, None, Frame(f.cpp, f, use, frame))
            for f in functions
            if (inner := parameter_variable(f, definition.index)) is not None
        )

    def _by_call(
        self, definition: Definition, variable: Variable, path: str, frame: Frame
    ) -> Value:
        call = definition.node
        if frame.depth >= 6:
            return self.values.unknown("too many calls to follow", call, frame)
        use = Use(frame.cpp, call, tuple(named(part(call, "arguments"))), frame.function)
        return choice(
            self._at(variable, path, None, Frame(f.cpp, f, use, frame))
            for f in self.values.calls.functions(frame.cpp, call)
            if str(f.node.id) == definition.text
        )

    # --- before the function begins -------------------------------------------------------------

    def _entry(self, variable: Variable, path: str, node: Node | None, frame: Frame) -> Value:
        match variable.kind:
            case "parameter":
                return self._argument(variable, path, frame)
            case "lambda":
                if not path and (given := arguments_of(self.values.texts, variable)):
                    return choice(self.values.value(argument, frame) for argument in given)
                place = node if node is not None else variable.name
                return self.values.unknown("comes when it is called", place, frame)
            case "member" if variable.owner is not None:
                return self._member(variable, path, variable.owner, frame)
            case "global":
                return self._later.value(variable, path, frame)
            case _:
                return Nothing()

    def _argument(self, variable: Variable, path: str, frame: Frame) -> Value:
        function = frame.function
        if frame.call is None or frame.caller is None or function is None:
            if not frame.outside:
                raise OpenCallers(frame)
            return self._from_outside(variable, frame)
        given = frame.call.arguments
        if variable.index < len(given):
            argument = given[variable.index]
            if not path:
                return self.values.value(argument, frame.caller)
            return self._field_of(argument, path, frame.caller)
        default = self.values.calls.default(function, variable.index)
        if default is not None:
            return self.values.value(default[1], Frame(default[0]))
        return self.values.unknown("no argument is given", variable.name, frame)

    def _field_of(self, argument: Node, path: str, frame: Frame) -> Value:
        while argument.type in ("pointer_expression", "parenthesized_expression"):
            argument = named(argument)[-1]
        if argument.type == "this":
            class_ = self.values.texts.class_of(frame.function)
            member = self.values.types.member(class_, path)
            return self._later.value(member, "", frame) if member is not None else Nothing()
        if argument.type == "identifier":
            variable = self.values.types.variable(frame.cpp, argument)
            if variable is not None:
                return self._at(variable, path, argument, frame)
        return Nothing()

    def _from_outside(self, variable: Variable, frame: Frame) -> Value:
        type_ = self.values.types.plain(variable.cpp, variable.type)
        if type_.rpartition("::")[2] in libraries.handles():
            return Handle(Under("", self._without(variable, frame)))
        return self.values.unknown(_OUTSIDE, variable.name, frame)

    def _without(self, variable: Variable, frame: Frame) -> tuple[str, ...]:
        """The namespace that a node handle has where callers give none."""
        function = frame.function
        default = None
        if function is not None:
            default = self.values.calls.default(function, variable.index)
        if default is None:
            return ()
        handle = self.values.value(default[1], Frame(default[0]))
        known = isinstance(handle, Handle) and isinstance(handle.namespace, str)
        return (str(handle.namespace),) if known and isinstance(handle, Handle) else ()

    def _member(self, variable: Variable, path: str, owner: CppClass, frame: Frame) -> Value:
        function, texts = frame.function, self.values.texts
        if function is not None and function.name == owner.name == function.owner:
            return self.initial(variable, path)
        if function is not None and frame.call is not None and frame.caller is not None:
            before = frame.caller.function
            class_ = texts.class_of(before)
            if class_ is not None and owner in texts.lineage(class_) and on_this(frame.call.node):
                return self._at(variable, path, frame.call.node, frame.caller)
        return self._later.value(variable, path, frame)

    def initial(self, variable: Variable, path: str) -> Value:
        """What a member or global holds by its declaration."""
        member = variable.field
        if variable.owner is not None and (member is None or member.value is None):
            owners = variable.owner.name, variable.text
            member = self.values.code.statics.get(owners, member)
        frame = Frame(member.cpp if member is not None else variable.cpp)
        if member is None:
            return Nothing()
        if member.value is not None and not path:
            value = member.value
            inside = named(value) if value.type in ("argument_list", "initializer_list") else None
            if inside is None or (len(inside) > 1 and value.type == "initializer_list"):
                return self.values.value(value, frame)
            use = Use(frame.cpp, value, tuple(inside), None)
            type_ = self.values.types.plain(variable.cpp, variable.type)
            return constructed(self.values, type_, use, frame) if inside else Nothing()
        return self._declared(variable, path, member.node, frame)
