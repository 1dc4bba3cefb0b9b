"""What the names of a unit's Python stand for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field as with_default
from fractions import Fraction

from tree_sitter import Node

from rebsync import model as m
from rebsync.literals import exact_literal_of
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.needs import Need
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import Fact
from rebsync.reverse.models.texts import MEMBER, is_text, text_literal
from rebsync.reverse.nodes.node_names import model_word
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.bodies.body_learnt import Learnt
from rebsync.reverse.python.bodies.body_scope import (
    Frame,
    Key,
    Meaning,
    Message,
    Nobody,
    Own,
    PyTarget,
    PyUnit,
    Var,
    field_kind,
    unknown,
)
from rebsync.reverse.python.expressions.values import OTHER, REAL, STRING, TRUTH, WHOLE, Value
from rebsync.reverse.python.values.interfaces import interface_of
from rebsync.reverse.python.values.node_effects import NodeEffects
from rebsync.reverse.python.values.py_imports import star_imported
from rebsync.reverse.python.values.py_lookup import attribute, bound
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    EnumMember,
    External,
    Function,
    Made,
    Module,
    Ways,
)
from rebsync.reverse.python.values.py_worth import Instance as Object
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, FUNCTION, MODULE, PyCode, Scope
from rebsync.reverse.syntax.py_tree import SCOPES, field, text_of
from rebsync.source import Source, Span


@dataclass(eq=False, slots=True)
class Reading:
    """What all bodies of a unit share in one round of reading.

    `taken` are the names of the code, which locals that the model gets do not have; `periods` those
    of timers, in units, by the number of their fact; `nodes` are the classes of all units,
    `entries` the functions that installed programs start, with their modules, and
    `bodies` the functions that were read, `listed` the statements, `timers` the calls, and `stored`
    the `n := value` that stand before their statement, by the ids of their nodes. `exact` are the
    places of operations that the model has.
    """

    unit: PyUnit
    values: PyValues
    learnt: Learnt
    types: MessageTypes
    instance: Instance
    servers: Mapping[int, Server]
    targets: Mapping[int, tuple[PyTarget, ...]]
    findings: Findings
    taken: set[str]
    periods: Mapping[int, int | None] = with_default(default_factory=dict)
    second: Fraction = Fraction(1)
    nodes: frozenset[Scope] = frozenset()
    entries: frozenset[tuple[str, str]] = frozenset()
    bodies: set[int] = with_default(default_factory=set)
    needs: dict[int, list[Need]] = with_default(default_factory=dict)
    state: dict[str, Key] = with_default(default_factory=dict)
    wide: set[str] = with_default(default_factory=set)
    used_names: set[str] = with_default(default_factory=set)
    keys: dict[str, Key] = with_default(default_factory=dict)
    made: set[str] = with_default(default_factory=set)
    loop_names: dict[int, str] = with_default(default_factory=dict)
    timers: set[int] = with_default(default_factory=set)
    stored: set[int] = with_default(default_factory=set)
    listed: set[int] = with_default(default_factory=set)
    exact: set[tuple[str, Span]] = with_default(default_factory=set)
    places: dict[str, tuple[Source, Span]] = with_default(default_factory=dict)
    form: PyForm | None = None
    effects: NodeEffects | None = None

    @property
    def code(self) -> PyCode:
        return self.values.code

    @property
    def extent(self) -> tuple[int, ...]:
        """How much reading has left so far of what the model or the report shows."""
        left = self.findings.all, self.learnt.pending, self.state, self.used_names
        return tuple(map(len, left))

    # --- names ----------------------------------------------------------------------------------

    def name(self, text: str, node: Node, frame: Frame) -> Meaning:
        """What a plain name stands for in a body."""
        if text in frame.bound:
            return frame.bound[text]
        scope = frame.scope
        if text == scope.self_name and self.unit.lineage and scope.parent in self.unit.lineage:
            return Own()
        around = scope.parent
        here = scope.kind != MODULE and text in scope.names and text not in scope.outer
        if here and (around is None or text not in nonlocals(scope)):
            return self._local(text, scope, frame)
        while around is not None and around.kind not in (MODULE, CLASS) and text not in scope.outer:
            owner = frame.of_scope(around.node.id)
            if owner is not None and text in around.names:
                return self.name(text, node, owner)
            if text in around.names and text not in [p.name for p in around.parameters]:
                return self._variable(("local", around.node.id, text), text)
            around = around.parent
        return self._of_module(text, scope)

    def _local(self, text: str, scope: Scope, frame: Frame) -> Meaning:
        if text in frame.kept:
            return self._variable(("local", scope.node.id, text), text)
        key = "local", scope.node.id, text
        if text not in frame.names:
            frame.names[text] = self.fresh(text, key)
        return self._typed(key, frame.names[text], False)

    def _of_module(self, text: str, scope: Scope) -> Meaning:
        module = scope.module
        bindings = module.names.get(text, [])
        if not bindings or any(b.how in ("import", "scope") for b in bindings):
            return Nobody()
        if self.values.is_stored(text, Module):
            return Nobody()
        if isinstance(star_imported(self.code, module, text), Module):  # which one comes last?
            return Nobody()
        if len(bindings) == 1 and bindings[0].how == "value":
            found = self.constant(bound(self.values, bindings[0], text, module))
            if found is not None:
                return found
        return self._variable(("module", module.node.id, text), text)

    def attribute(self, name: str, node: Node, frame: Frame) -> Meaning:
        """What an attribute of the object stands for."""
        for above in self.unit.lineage:
            bindings = above.attributes.get(name, [])
            declared = above.names.get(name, [])
            if bindings:
                return self._variable(("self", self.unit.lineage[0].node.id, name), name)
            if declared and self.values.is_stored(name):
                return Nobody()
            if declared:
                holder = Object(above)
                ways = tuple(attribute(self.values, holder, name, node, frame.scope))
                return self.constant(ways) or Nobody()
        return Nobody()

    def _variable(self, key: Key, wish: str) -> Meaning:
        """A state variable."""
        return self._typed(key, self.state_name(key, wish), True)

    def state_name(self, key: Key, wish: str) -> str:
        """The name that a state variable has in the model."""
        known = next((n for n, k in self.state.items() if k == key), None)
        if known is not None:
            return known
        plain = model_word(wish.strip("_") or wish)
        found, number = plain, 2
        while found in self.state or found in self.used_names:
            found, number = f"{plain}_{number}", number + 1
        self.state[found] = key
        return found

    def _typed(self, key: Key, name: str, is_state: bool) -> Meaning:
        shape = self.learnt.shape(key)
        if shape == OTHER:
            return Nobody()
        return Message(key, name, shape, is_state) if shape else Var(key, name, is_state)

    def constant(self, ways: Ways) -> Value | None:
        """The value of what is always the same number or text."""
        match ways:
            case (bool() as truth,):
                return Value(exact_literal_of(truth), TRUTH)
            case (int() as number,) if -(1 << 31) <= number < 1 << 31:
                return Value(exact_literal_of(number), WHOLE)
            case (float() as number,) if abs(number) < 1e300:
                return Value(exact_literal_of(number), REAL)
            case (EnumMember() as member,):
                return Value(text_literal(f"{MEMBER}{member.text}"), STRING)
            case (str() as text,) if "\0" not in text and is_text(text):
                return Value(text_literal(text), STRING)
            case _:
                return None

    def server_name(self, node: Node, wish: str) -> str:
        """The name of the server that a loop becomes: always the same."""
        known = self.loop_names.get(node.id)
        if known is None:
            known = self.loop_names[node.id] = self.fresh(wish)
        return known

    def fresh(self, wish: str, key: Key | None = None) -> str:
        """A name for a local that nothing else in the class has."""
        plain = model_word(wish.lstrip("_") or wish)
        found, number = plain, 2
        others = (self.used_names, self.state, self.taken if key is None else ())
        while any(found in of for of in others) or self.learnt.is_carried(found, self.parameter):
            found, number = f"{plain}_{number}", number + 1
        self.used_names.add(found)
        if key is not None:
            self.keys[found] = key
        return found

    # --- what is called -------------------------------------------------------------------------

    def fact(self, node: Node, frame: Frame) -> tuple[int, Fact] | None:
        """What a call asks ROS for, with its number in the unit."""
        number = self.unit.calls.get((frame.py.source.path, node.id))
        return (number, self.unit.unit.facts[number]) if number is not None else None

    def made_by(self, node: Node, frame: Frame) -> tuple[int, Fact] | None:
        """What the call asked for whose result an expression is, if that is always the same."""
        ways = self.values.ways(node, frame.scope)
        found = {
            number
            for w in ways
            if isinstance(w, Made)
            and (number := self.unit.calls.get((w.scope.py.source.path, w.call.id))) is not None
        }
        if len(found) != 1 or not all(isinstance(w, Made) for w in ways):
            return None
        (number,) = found
        return number, self.unit.unit.facts[number]

    def function(self, node: Node, frame: Frame) -> Scope | None:
        """The function or method of the files that an expression names."""
        if node.type == "attribute":
            holder = field(node, "object")
            name = text_of(field(node, "attribute"))
            if holder.type == "identifier" and isinstance(
                self.name(text_of(holder), holder, frame), Own
            ):
                return self.method(name, 0)
            if text_of(holder).startswith("super(") and self.unit.lineage:
                return self.method(name, 1)
        ways = self.values.ways(node, frame.scope)
        match ways:
            case (Function(scope, None),) if scope.kind == FUNCTION and not scope.is_method:
                return scope
            case (Function(scope, owner),) if owner is not None and owner in self.unit.lineage:
                return scope
            case _:
                return None

    def method(self, name: str, first: int) -> Scope | None:
        """A method of the class, or of those above it; None where one has several of a name."""
        for above in self.unit.lineage[first:]:
            bindings = above.names.get(name, [])
            if any(binding.how == "scope" for binding in bindings):
                found = self.code.scope_of(bindings[0].node, above.py)
                return found if found.kind == FUNCTION and len(bindings) == 1 else None
        return None

    def external(self, node: Node, frame: Frame) -> str:
        """The full name of what is not of the files; empty for anything else."""
        if node.type not in ("identifier", "attribute"):
            return ""
        match self.values.ways(node, frame.scope):
            case (External(name),):
                return name
            case _:
                return ""

    def message_type(self, node: Node, frame: Frame) -> str | None:
        """The type of message that a call makes."""
        if node.type != "call":
            return None
        name = self.external(field(node, "function"), frame)
        return interface_of(name) if name else None

    # --- messages -------------------------------------------------------------------------------

    def read_field(self, message: Message, path: str, node: Node, frame: Frame) -> Value:
        """What a field of a message holds."""
        fields = self.types.fields(message.type) or {}
        type_ = fields.get(path)
        if type_ is None or type_.dimensions:
            raise unknown(frame, node, f'"{text_of(node)}"')
        if message.server:
            self.learnt.use(self.unit.name, message.server, path)
            if self.learnt.is_open(self.unit.name, message.server, path):
                raise unknown(frame, node, f'"{text_of(node)}"')
            name = m.Name(self.parameter(path), frame.span(node))
            return Value(name, field_kind(type_), type_.name == "float")
        key = field_key(message, path)
        self.learnt.want(key)
        match self.learnt.kind(key):
            case None:
                return zero(field_kind(type_))
            case "other":
                raise unknown(frame, node, f'"{text_of(node)}"')
            case _:
                name = m.Name(self.field_name(message, path, node, frame), frame.span(node))
                return Value(name, field_kind(type_))

    def field_name(self, message: Message, path: str, node: Node, frame: Frame) -> str:
        """The variable that a field of a message in a variable is."""
        wish = f"{message.name}_{path.replace('.', '_')}"
        return self.part_name(message, field_key(message, path), wish, node, frame)

    def part_name(self, message: Message, key: Key, wish: str, node: Node, frame: Frame) -> str:
        """The variable that says something of a message in a variable."""
        if message.is_state:
            return self.state_name(key, wish)
        owner, local = frame.owner_of(message.key), key[2]
        if owner is None:
            raise Unread(frame.span(node), "a message of a function that is not under way")
        if local not in owner.names:
            owner.names[local] = self.fresh(wish, key)
            self.made.add(owner.names[local])
        return owner.names[local]

    def parameter(self, path: str) -> str:
        """The parameter of a server that a field of its message is."""
        plain = model_word(path.replace(".", "_"))
        return f"{plain}_in" if plain in self.taken else plain


def nonlocals(scope: Scope) -> set[str]:
    """The names that a function declares to be of the one around it."""
    if not has_nonlocals(scope):
        return set()
    # Functions inside say it of names of this one.
    inside = (n for c in scope.node.named_children for n in nodes_in(c, *SCOPES))
    said = (n for n in inside if n.type == "nonlocal_statement")
    return {text_of(name) for each in said for name in each.named_children}


def has_nonlocals(scope: Scope) -> bool:
    """Whether a function, or one in it, changes variables of a function around it."""
    return b"nonlocal" in (scope.node.text or b"")


def field_key(message: Message, path: str) -> Key:
    """The variable that a field of a message in a variable is."""
    where, number, name = message.key
    return where, number, f"{name}.{path}"


def zero(kind: str) -> Value:
    """What a field holds in a new message."""
    if kind == STRING:
        return Value(text_literal(""), kind)
    return Value(exact_literal_of({TRUTH: False, WHOLE: 0}.get(kind, 0.0)), kind)
