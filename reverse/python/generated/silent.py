"""Members of generated Python that nothing of the model depends on: what is only told to people.

Texts, lists and parameters that are only logged, publishers of diagnostics, idle timers, and locks.
A store in such a member shows in no model, as long as nothing else looks at it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.libraries.generated_calls import PUBLISHER_METHOD
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated.asked import Answering
from rebsync.reverse.python.generated.logs import Looks, only_logs
from rebsync.reverse.python.generated.member_places import (
    function_around,
    is_of_module,
    makes_member,
    name_around,
)
from rebsync.reverse.python.generated.members import (
    NUMBERS,
    VALUES,
    is_lock,
    is_own_parameter,
    looks_of,
)
from rebsync.reverse.python.generated.module_variables import (
    counters_of,
    hidden_names,
)
from rebsync.reverse.python.generated.roles import PyRoles, is_of_node
from rebsync.reverse.python.generated.shown import (
    Shown,
    shown_by,
    tells_by,
)
from rebsync.reverse.python.generated.timers import Timers
from rebsync.reverse.python.generated.told_candidates import (
    candidate_locals,
    candidate_members,
    made_once,
    may_tell,
)
from rebsync.reverse.python.generated.told_containers import (
    SET,
    STORING,
    TABLE,
    TABLES,
    containers_in,
    is_counted,
    is_key,
    member_of,
    stores_in,
)
from rebsync.reverse.python.generated.told_effects import ToldEffects
from rebsync.reverse.python.generated.told_exceptions import ToldExceptions
from rebsync.reverse.python.generated.told_locals import told_locals
from rebsync.reverse.python.generated.told_messages import ToldMessages, told_types
from rebsync.reverse.python.generated.told_values import ToldPlaces
from rebsync.reverse.syntax.ancestors import ancestors, functions_around
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import Py, field, is_label, named, text_of

_STATEMENTS = frozenset({"function_definition", "class_definition", "module"})


@dataclass(frozen=True, eq=False, slots=True)
class Silent:
    """The silent members of a class: `texts` are told to people only, `locks` are only held.
    `ticking` are timers that only log, as `timers` tells them. `locals` are what a function makes
    or measures for people, by the function's node, and `counters` variables of the module; `form`
    tells who may wait for a lock, and `variables` the state by the names of attributes; `asked`
    are services and diagnostics; `exceptions` say what may fail of what is told. `computed` are
    those that any code makes that only computes, as `effects` tell, and `kept` such locals.
    """

    texts: frozenset[str] = frozenset()
    publishers: frozenset[str] = frozenset()
    ticking: frozenset[str] = frozenset()
    locks: frozenset[str] = frozenset()
    locals: dict[int, frozenset[str]] = with_default(default_factory=dict)
    timers: Timers = Timers()
    shown: dict[str, Shown] = with_default(default_factory=dict)
    counters: frozenset[str] = frozenset()
    form: PyForm | None = None
    variables: Mapping[str, m.Type] = with_default(default_factory=dict)
    asked: Answering = Answering()
    exceptions: ToldExceptions = ToldExceptions()
    computed: frozenset[str] = frozenset()
    kept: dict[int, frozenset[str]] = with_default(default_factory=dict)
    effects: ToldEffects | None = None
    messages: ToldMessages = ToldMessages({}, {}, Looks())

    @property
    def looks(self) -> Looks:
        """What names stand for where something is logged."""
        return self.timers.looks

    @property
    def _members(self) -> tuple[Collection[str], ...]:
        asked = self.asked.updaters
        return self.texts, self.publishers, self.ticking, self.locks, self.shown, asked

    @property
    def members(self) -> frozenset[str]:
        """All of them."""
        return frozenset(name for of in self._members for name in of)

    def is_member(self, name: str) -> bool:
        """Whether only people are told of a member, or it is a lock."""
        return any(name in of for of in self._members)

    def holds(self, node: Node) -> bool:
        """Whether a statement does nothing but to tell people something, and cannot fail."""
        return self.tells(node) and not self.exceptions.raises(node)

    def tells(self, node: Node) -> bool:
        """Whether a statement does nothing but to tell people something, or to keep it for that."""
        return self._tells_by_words(node) or self._only_computes(node)

    def _only_computes(self, node: Node) -> bool:
        """Whether the effects of a statement stay where only people look."""
        place = function_around(node)
        local = self.kept.get(place, frozenset[str]())
        told = self.locals.get(place, frozenset[str]()) | (self.texts - self.computed)
        py = self.exceptions.file_of(node)
        if self.effects is None or py is None:
            return False
        if not may_tell(node, self.texts, local | told, self.publishers):
            return False
        places = ToldPlaces(self.computed, local, told, self.publishers, self.looks.is_node)
        return self.effects.only_tells(py, py.span(node), places)

    def _tells_by_words(self, node: Node) -> bool:
        if only_logs(node, self.looks):
            return True
        if node.type == "if_statement":
            return all(map(self._branch_holds, [node, *node.children_by_field_name("alternative")]))
        if node.type == "global_statement":
            return self.counters.issuperset(map(text_of, named(node)))
        inner = named(node)[0] if node.type == "expression_statement" and named(node) else None
        if inner is None:
            return False
        if inner.type in ("assignment", "augmented_assignment"):
            value = inner.child_by_field_name("right")
            left = field(inner, "left")
            if left.type == "subscript":
                return self._stores_element(inner)
            if text_of(left).removeprefix("self.") in self.looks.containers:
                return False
            return self._is_place(field(inner, "left")) and (value is None or self._is_made(value))
        return inner.type == "call" and self._tells(inner)

    def _branch_holds(self, part: Node) -> bool:
        condition = part.child_by_field_name("condition")
        body = field(part, "body" if part.type == "else_clause" else "consequence")
        inside = [n for n in named(body) if n.type != "pass_statement"]
        is_pure = condition is None or self.looks.is_pure(condition)
        return is_pure and bool(inside) and all(map(self.tells, inside))

    def _tells(self, call: Node) -> bool:
        """`self._diagnostics_pub.publish(status)` and `self._history.append(x)`."""
        function, arguments = field(call, "function"), named(field(call, "arguments"))
        if self.asked.diagnoses(call):
            return True
        publisher = text_of(function).removeprefix("self.").removesuffix(".publish")
        if text_of(function) == f"self.{publisher}.publish" and publisher in self.shown:
            return self.shown[publisher].sends(arguments)
        if function.type != "attribute" or not all(map(self._is_made, arguments)):
            return False
        holder, method = field(function, "object"), text_of(field(function, "attribute"))
        kind = self.looks.containers.get(text_of(holder).removeprefix("self."), "")
        if kind:
            is_kept = kind != SET or all(is_key(a, self.variables) for a in arguments)
            return (
                self._is_place(holder) and is_kept and STORING[kind].get(method) == len(arguments)
            )
        is_told = text_of(holder).removeprefix("self.") in self.publishers
        if method == "sendTransform":
            return is_told and self.messages.sends_transform(arguments)
        if method == "publish":
            return is_told
        return method in ("append", "clear") and self._is_place(holder)

    def _is_place(self, node: Node) -> bool:
        """Whether something is a silent member or message, or a part of one."""
        while node.type == "attribute" and text_of(field(node, "object")) != "self":
            node = field(node, "object")
        if node.type == "attribute":
            return text_of(field(node, "attribute")) in self.texts - self.computed
        if node.type != "identifier":
            return False
        name = text_of(node)
        if name in self.locals.get(function_around(node), ()):
            return True
        return name in self.counters and is_of_module(node, name)

    def _stores_element(self, assignment: Node) -> bool:
        """`self._counts["served"] = self._counts.get("served", 0) + 1`."""
        left, value = field(assignment, "left"), assignment.child_by_field_name("right")
        kind = self.looks.containers.get(member_of(assignment), "")
        keys = left.children_by_field_name("subscript")
        if not self._is_place(field(left, "value")) or kind not in TABLES or value is None:
            return False
        if len(keys) != 1 or not is_key(keys[0], self.variables):
            return False
        return is_counted(assignment, kind) or (kind == TABLE and self.looks.is_pure(value))

    def _is_made(self, node: Node) -> bool:
        """Whether a value only takes up what is there, or is a parameter of the node's own."""
        return self.looks.is_pure(node) or is_own_parameter(node)

    # --- locks ----------------------------------------------------------------------------------

    def locked(self, py: Py, node: Node) -> Node | None:
        """What is done while a lock of the object's own is held; None if that may wait for ever."""
        head = next((c for c in named(node) if c.type == "with_clause"), node)
        items = [text_of(i) for i in named(head) if i.type == "with_item"]
        name = items[0].removeprefix("self.") if len(items) == 1 else ""
        if name not in self.locks or items[0] == name or self.form is None:
            return None
        return None if self.form.waits_for_itself(py, node) else field(node, "body")


NOTHING = Silent()


def silent_in(
    code: PyCode,
    form: PyForm,
    line: Sequence[Scope],
    roles: Sequence[PyRoles],
    own: Collection[str] = (),
) -> Silent:
    """The silent members of a class, the first of a line with those above it, and their roles.

    They are among what its constructor makes, and none that has a role, but for those of `own`.
    """
    owner, functions = line[0], roles[0].functions
    taken = {n for r in roles for n in (*r.state, *r.known, *r.env, *r.publishers)}.difference(own)
    types = told_types(owner.module)
    makers = frozenset(types)
    modules = [*{id(c.module): c.module for c in line}.values()]
    hidden = hidden_names(code, owner.module)
    looks = looks_of(code, line, makers, hidden)
    taken |= looks.functions
    made = {name: value for name, value in made_once(functions) if name not in taken}
    members = {name: value for name, value in made.items() if not is_of_node(name)}
    publishers = {} if PUBLISHER_METHOD in looks.functions else members
    variables = {name: type_ for r in roles for name, (_, type_, _) in r.state.items()}
    handed = _handed(roles)
    messages = ToldMessages(types, variables, looks)
    exceptions = ToldExceptions.of(code, form, messages)
    timers = Timers.of(code, handed, looks, exceptions)
    looks = replace(looks, logging=timers.logging)
    stores = stores_in(module.node for module in modules)
    looks = replace(looks, containers=containers_in(owner.module, members, stores))
    timers = replace(timers, looks=looks)  # what ticks runs while containers may change
    asked = Answering.of(code, owner.module, handed, members, looks, exceptions)
    told = frozenset(n for n, v in members.items() if _is_told(n, v, looks))
    found = Silent(
        told,
        frozenset(n for n, v in publishers.items() if tells_by(code, owner.module, v, types)),
        frozenset(n for n, v in members.items() if timers.is_idle(v) or asked.is_idle(v)),
        frozenset(n for n, v in members.items() if is_lock(owner.module, v)),
        {f.node.id: told_locals(f, makers, looks) for f in functions.values()},
        timers,
        {n: s for n, v in publishers.items() if (s := shown_by(code, owner.module, v, variables))},
        frozenset(counters_of(code, owner.module)) - hidden,
        form,
        variables,
        asked,
        exceptions,
        frozenset(),
        {},
        ToldEffects(form, variables, {n for r in roles for n in (*r.known, *r.env)}),
        messages,
    )
    found = _with_candidates(code, found, roles[0], members)
    beside = {n for r in roles for n in (*r.shims, *r.ticking)}
    found = _consistent(found, modules, beside)
    timers = found.timers.telling(code, handed, found.holds)
    if timers.logging == found.timers.logging:
        return found
    ticking = found.ticking.union(n for n, v in members.items() if timers.is_idle(v))
    return _consistent(replace(found, timers=timers, ticking=ticking), modules, beside)


def _with_candidates(
    code: PyCode, found: Silent, roles: PyRoles, members: Mapping[str, Node]
) -> Silent:
    """The same, with other members and locals that people alone may be told of."""
    rest = {n: v for n, v in members.items() if not found.is_member(n)}
    computed = candidate_members(code, roles.owner.module, rest)
    kept = candidate_locals(code, roles.functions.values(), found.members | computed)
    kept = {place: names - found.locals[place] for place, names in kept.items()}
    return replace(found, texts=found.texts | computed, computed=computed, kept=kept)


def _handed(roles: Sequence[PyRoles]) -> dict[str, Scope]:
    """The methods that may only tell people something, of classes of one module."""
    here = [r for r in roles if r.owner.module is roles[0].owner.module]
    functions = {n: f for r in reversed(here) for n, f in r.functions.items()}
    return {n: functions[n] for r in here for n in r.ticking if functions[n] is r.functions[n]}


def _is_told(name: str, value: Node, looks: Looks) -> bool:
    """Whether a member holds nothing but what people are told."""
    is_kept = value.type in VALUES | NUMBERS or is_own_parameter(value) or name in looks.containers
    return is_kept or looks.tells_time(value)


def _consistent(found: Silent, modules: Sequence[Scope], beside: Collection[str]) -> Silent:
    """Without what something else names than statements for people."""
    while found.members or found.counters or any((*found.locals.values(), *found.kept.values())):
        wrong = {n for module in modules for n in _odd(found, module.node, beside)}
        if not wrong:
            break
        found = _without(found, wrong)
    return found


def _without(silent: Silent, wrong: set[str]) -> Silent:
    locals_, kept = (
        {f: frozenset(names - wrong) for f, names in of.items()}
        for of in (silent.locals, silent.kept)
    )
    texts, publishers, ticking, locks = (
        names - wrong for names in (silent.texts, silent.publishers, silent.ticking, silent.locks)
    )
    shown = {n: s for n, s in silent.shown.items() if n not in wrong}
    return replace(
        silent,
        texts=texts,
        computed=silent.computed & texts,
        publishers=publishers,
        ticking=ticking,
        locks=locks,
        locals=locals_,
        kept=kept,
        shown=shown,
        counters=silent.counters - wrong,
        asked=replace(silent.asked, updaters=silent.asked.updaters - wrong),
    )


# --- where they are used ------------------------------------------------------------------------


def _odd(silent: Silent, root: Node, beside: Collection[str]) -> set[str]:
    """The members and locals that something else than a statement for people names.

    What runs beside the bodies must not name containers, which they may go through meanwhile.
    """
    members = silent.members
    found = set[str]()
    for node in nodes_in(root):
        if node.type == "attribute" and text_of(field(node, "attribute")) in members:
            name = text_of(field(node, "attribute"))
            is_own = text_of(field(node, "object")) == "self"
            is_shared = name in silent.looks.containers or name in silent.computed
            is_apart = is_shared and name_around(node) in beside
            if is_apart or not (is_own and _is_quiet(silent, node, name)):
                found.add(name)
        elif node.type == "identifier" and not is_label(node):
            name = text_of(node)
            is_local = name in silent.counters or any(
                name in silent.locals.get(f.id, ()) or name in silent.kept.get(f.id, ())
                for f in functions_around(node)
            )
            if is_local and not _is_quiet(silent, node, name):
                found.add(name)
        elif node.type == "string_content" and text_of(node) in members:
            found.add(text_of(node))  # as getattr names it
    return found


def _is_quiet(silent: Silent, node: Node, name: str) -> bool:
    """Whether a member or local stands in a statement for people, or is set up there."""
    for above in (node, *ancestors(node, lambda n: n.type in _STATEMENTS)):
        if above.type == "with_item":
            return name in silent.locks and text_of(above) == f"self.{name}"
        if above.type == "expression_statement" and makes_member(above, name):
            return name not in silent.computed or silent.holds(above)
        if above.type == "global_statement":
            return name in silent.counters
        if silent.tells(above):
            return True
        if above.id in silent.asked.bodies:
            return name not in silent.computed
    return False
