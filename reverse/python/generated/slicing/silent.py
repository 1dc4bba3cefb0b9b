"""Members of generated Python that nothing of the model depends on: what is only told to people.

Texts, lists and parameters that are only logged, publishers of diagnostics, idle timers, and locks.
A store in such a member shows in no model, as long as nothing else looks at it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries.generated_calls import PUBLISHER_METHOD
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated.member_places import (
    function_around,
    makes_member,
    name_around,
)
from rebsync.reverse.python.generated.module_variables import (
    counters_of,
    hidden_names,
    imported_as,
    looks_of,
)
from rebsync.reverse.python.generated.parameters import LITERALS, is_of_people
from rebsync.reverse.python.generated.py_types import call_parts, expression_in
from rebsync.reverse.python.generated.roles import PyRoles
from rebsync.reverse.python.generated.slicing.candidates import (
    candidate_locals,
    candidate_members,
    is_of_node,
    made_once,
    may_tell,
)
from rebsync.reverse.python.generated.slicing.effects import ToldEffects
from rebsync.reverse.python.generated.slicing.escapes import ToldPlaces
from rebsync.reverse.python.generated.slicing.exceptions import ToldExceptions, raising_again
from rebsync.reverse.python.generated.slicing.logs import Looks
from rebsync.reverse.python.generated.slicing.messages import ToldMessages, told_types
from rebsync.reverse.python.generated.slicing.publishers import (
    shown_by,
    tells_by,
)
from rebsync.reverse.python.generated.slicing.services import Answering
from rebsync.reverse.python.generated.slicing.timers import Timers
from rebsync.reverse.syntax.ancestors import ancestors, functions_around
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import Py, field, is_label, named, text_of

_LOCKS = frozenset({"threading.Lock", "threading.RLock"})
_STATEMENTS = frozenset({"function_definition", "class_definition", "module"})


@dataclass(frozen=True, eq=False, slots=True)
class Silent:
    """The silent members of a class: `texts` are told to people only, `locks` are only held.
    `ticking` are timers that only log, as `timers` tells them, `shown` publishers of messages that
    nobody hears. `locals` are what a function makes or measures for people, by the function's node,
    and `counters` variables of the module; `form` tells who may wait for a lock; `asked` are
    services and diagnostics; `exceptions` say what may fail of what is told, `effects` what else it
    does. `plain` are texts that nothing goes through while they change, `describing` methods that
    give what no variable of the model holds.
    """

    texts: frozenset[str] = frozenset()
    publishers: frozenset[str] = frozenset()
    ticking: frozenset[str] = frozenset()
    locks: frozenset[str] = frozenset()
    locals: dict[int, frozenset[str]] = with_default(default_factory=dict)
    timers: Timers = Timers()
    shown: frozenset[str] = frozenset()
    counters: frozenset[str] = frozenset()
    form: PyForm | None = None
    asked: Answering = Answering()
    exceptions: ToldExceptions = ToldExceptions()
    effects: ToldEffects | None = None
    plain: frozenset[str] = frozenset()
    describing: frozenset[str] = frozenset()

    @property
    def looks(self) -> Looks:
        """What names stand for where something is logged."""
        return self.timers.looks

    @property
    def rest(self) -> frozenset[str]:
        """The members that are more than something to keep."""
        return frozenset(name for of in self._members[1:] for name in of)

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
        if self._asks_parameter(node):
            return True
        inner = expression_in(node)
        if inner is not None and inner.type == "call" and self.asked.diagnoses(inner):
            return True
        if node.type == "global_statement":
            return self.counters.issuperset(map(text_of, named(node)))
        return self._only_computes(node)

    def without_handlers(self, statements: Iterable[Node]) -> Iterator[Node]:
        """Statements, with the body of a `try` in its place whose handlers tell and raise again."""
        for statement in statements:
            again = raising_again(statement)
            if again is not None and all(map(self.holds, again[1])):
                yield from self.without_handlers(again[0])
            else:
                yield statement

    def _asks_parameter(self, node: Node) -> bool:
        """Whether a member gets a parameter of people's own: it may be of any type."""
        inner = expression_in(node)
        if inner is None or inner.type != "assignment":
            return False
        name = text_of(field(inner, "left")).removeprefix("self.")
        value = inner.child_by_field_name("right")
        return name in self.texts and value is not None and is_of_people(value)

    @property
    def _publishers(self) -> frozenset[str]:
        return self.publishers | self.shown

    def _only_computes(self, node: Node) -> bool:
        """Whether the effects of a statement stay where only people look."""
        local = self.locals.get(function_around(node), frozenset[str]())
        py = self.exceptions.file_of(node)
        if self.effects is None or py is None:
            return False
        words = local | self.counters | self.looks.loggers
        members = self.texts | self._publishers | self.timers.logging.keys() | self.describing
        if not may_tell(node, words, members):
            return False
        places = ToldPlaces(
            *(self.texts, local, self.counters, self._publishers),
            *(self.timers.logging, self.looks.is_node),
        )
        return self.effects.only_tells(py, py.span(node), places)

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
    makers, modules = frozenset(types), [*{id(c.module): c.module for c in line}.values()]
    hidden = hidden_names(code, owner.module)
    looks = looks_of(code, (c.module for c in line), makers, hidden)
    taken |= looks.functions
    made = ((name, value) for name, value in made_once(functions) if name not in taken)
    members = {name: value for name, value in made if not is_of_node(name)}
    publishers = {} if PUBLISHER_METHOD in looks.functions else members
    variables = {name: type_ for r in roles for name, (_, type_, _) in r.state.items()}
    shown = {
        n: s for n, v in publishers.items() if (s := shown_by(code, owner.module, v, variables))
    }
    handed = _handed(roles)
    messages = ToldMessages(types, variables, looks, shown)
    exceptions = ToldExceptions.of(code, form, messages)
    timers = Timers.of(code, handed, looks, exceptions)
    timers = replace(timers, looks=(looks := replace(looks, logging=timers.logging)))
    asked = Answering.of(code, owner.module, handed, members, looks, exceptions)
    plain = frozenset(n for n, v in members.items() if _is_plain(v, looks))
    sent = {t.replace("/", ".msg.") for t in types.values()} | {s.full_type for s in shown.values()}
    found = Silent(
        plain | candidate_members(code, owner.module, members, makers),
        frozenset(n for n, v in publishers.items() if tells_by(code, owner.module, v, types)),
        frozenset(n for n, v in members.items() if timers.is_idle(v) or asked.is_idle(v)),
        frozenset(n for n, v in members.items() if _is_lock(owner.module, v)),
        {},
        timers,
        frozenset(shown),
        frozenset(counters_of(code, owner.module)) - hidden,
        form,
        asked,
        exceptions,
        ToldEffects(form, variables, {n for r in roles for n in (*r.known, *r.env)}, sent),
        plain,
        frozenset(name for r in roles for name in r.beside),
    )
    found = replace(found, texts=found.texts - found.rest)
    giving = makers | {f"self.{name}" for name in found.describing}
    speaking = found.members | looks.loggers | looks.logging.keys() | found.counters
    found = replace(found, locals=candidate_locals(code, functions.values(), speaking, giving))
    beside = {n for r in roles for n in (*r.shims, *r.ticking)}
    found = _consistent(found, modules, beside)
    timers = found.timers.telling(code, handed, found.holds)
    if timers.logging != found.timers.logging:
        ticking = found.ticking.union(n for n, v in members.items() if timers.is_idle(v))
        found = _consistent(replace(found, timers=timers, ticking=ticking), modules, beside)
    return found


def _handed(roles: Sequence[PyRoles]) -> dict[str, Scope]:
    """The methods that may only tell people something, of classes of one module."""
    here = [r for r in roles if r.owner.module is roles[0].owner.module]
    functions = {n: f for r in reversed(here) for n, f in r.functions.items()}
    return {n: functions[n] for r in here for n in r.ticking if functions[n] is r.functions[n]}


def _is_lock(module: Scope, node: Node) -> bool:
    """Whether a value is a lock of Python's library."""
    called, arguments = call_parts(node) or ("", [])
    return imported_as(module, called) in _LOCKS and not arguments


def _is_plain(value: Node, looks: Looks) -> bool:
    """Whether a member is made of a literal, a time, or a parameter of people's own."""
    is_kept = value.type in LITERALS or is_of_people(value)
    return is_kept or looks.tells_time(value)


def _consistent(found: Silent, modules: Sequence[Scope], beside: Collection[str]) -> Silent:
    """Without what something else names than statements for people."""
    while found.members or found.counters or any(found.locals.values()):
        wrong = {n for module in modules for n in _odd(found, module.node, beside)}
        if not wrong:
            break
        found = _without(found, wrong)
    return found


def _without(silent: Silent, wrong: set[str]) -> Silent:
    texts, publishers, ticking, locks, shown = (
        names - wrong
        for names in (silent.texts, silent.publishers, silent.ticking, silent.locks, silent.shown)
    )
    return replace(
        silent,
        texts=texts,
        publishers=publishers,
        ticking=ticking,
        locks=locks,
        locals={f: frozenset(names - wrong) for f, names in silent.locals.items()},
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
            is_shared = name in silent.texts and name not in silent.plain
            is_apart = is_shared and name_around(node) in beside
            if is_apart or not (is_own and _is_quiet(silent, node, name)):
                found.add(name)
        elif node.type == "identifier" and not is_label(node):
            name = text_of(node)
            is_local = name in silent.counters or any(
                name in silent.locals.get(f.id, ()) for f in functions_around(node)
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
            return name in silent.plain or name not in silent.texts or silent.holds(above)
        if above.type == "global_statement":
            return name in silent.counters
        if silent.tells(above):
            return True
        if above.id in silent.asked.bodies:
            return name in silent.plain or name not in silent.texts
    return False
