"""Members of generated C++ outside of the backward slice of the model's behaviour, by effects.

Numbers, arrays of them, and objects that only hold some, of which no marker says that they are
state variables. Their values are followed through the members and locals that get them: nothing
there may touch what the model has, nor fail. So they only go into logs, and to publishers that
no node listens to.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import field, replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.effects.cpp_call_effects import is_calm
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.effects.cpp_roots import declared_in
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import Called, Member, Outside, Scope, Variable
from rebsync.reverse.generated.cpp_hand import acts
from rebsync.reverse.generated.cpp_names import declared_type, has_mailbox, runtime_of
from rebsync.reverse.generated.cpp_parameters import is_own_parameter
from rebsync.reverse.generated.cpp_roles import Roles
from rebsync.reverse.generated.slicing.publishers import telling_publishers
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.ancestors import ancestors, climb
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, squeezed, text_of

_NUMBER = (
    r"(?:(?:std::)?u?int(?:8|16|32|64)_t|(?:std::)?size_t|int|unsigned(?:int)?|(?:unsigned)?long"
    r"|float|double|bool)"
)
_VALUE = re.compile(rf"{_NUMBER}|(?:std::)?atomic<{_NUMBER}>|(?:std::)?atomic_(?:bool|int|uint)")
_ARRAY = re.compile(rf"(?:std::)?array<{_NUMBER},\d+>")
_OF_ALL = frozenset({"fill", "size", "at", "front", "back"})
_WHOLE = ("for_range_loop", "assignment_expression", "binary_expression", "init_declarator")
_STATEMENTS = ("declaration", "for_range_loop")
_DECLARING = (
    *("declaration", "parameter_declaration", "optional_parameter_declaration", "for_range_loop"),
)
_STORES = ("assignment_expression", "update_expression", "call_expression")
_TARGET = re.compile(r"(?:\+\+|--)?(?:this->)?(\w+)")


def add_silent(
    code: Code, form: CppForm, owner: CppClass, roles: Roles, shown: Collection[tuple[str, str]]
) -> None:
    """Tells the roles of a class which members are dead for the model, parameters among them.

    One that is told to nobody is the model's, unused as yet, unless it is such a parameter. `shown`
    are types of messages with topics that nobody in the code hears.
    """
    fields = owner.fields if has_mailbox(code, owner) else ()
    free = [f for f in fields if not f.markers and f.name not in roles.globals]
    left = {f.name for f in free if f.name in roles.own or _is_candidate(code, form, f.type)}
    if left:
        members = _members(code, form, owner, shown)
        known = {f.node.id for f in fields} | roles.reading | _reading(code, owner)
        found = _sliced(_Slice(code, form, owner, members, known, frozenset(left)))
        roles.silent = {n for n in found.dead if n in roles.own or n in found.told}
    roles.told = [p for n, p in roles.own.items() if n in roles.silent] + roles.told
    roles.own = {n: p for n, p in roles.own.items() if n not in roles.silent}


def _reading(code: Code, owner: CppClass) -> set[int]:
    """The statements of constructors that give a member what a parameter of people says."""
    constructors = [f for f in code.functions_of(owner) if f.name == owner.name]
    return {
        statement.id
        for function in constructors
        for statement in inside(function.body, "expression_statement")
        for stored in named(statement)[:1]
        if stored.type == "assignment_expression" and is_own_parameter(part(stored, "right"))
    }


def _is_candidate(code: Code, form: CppForm, type_: Node) -> bool:
    text = squeezed(type_)
    is_number = _VALUE.fullmatch(text) is not None or _ARRAY.fullmatch(text) is not None
    return is_number or _only_holds(code, form, text)


def _only_holds(code: Code, form: CppForm, name: str) -> bool:
    """Whether objects of a class of the files only hold values, and change nothing else."""
    found = code.all_classes.get(name, [])
    if len(found) != 1 or found[0].bases or found[0].roots or found[0].others:
        return False
    (owner,) = found
    if not all(_VALUE.fullmatch(squeezed(f.type)) for f in owner.fields):
        return False
    functions = code.functions_of(owner)
    scope = _scope(code, form, functions, {f.name: Outside() for f in owner.fields})
    return all(
        not f.pure and f.name != f"~{name}" and is_calm(Effects(f.cpp, scope), f) for f in functions
    ) and not any(map(form.throws, functions))


def _scope(
    code: Code, form: CppForm, own: Collection[CppFunction], members: Mapping[str, Member]
) -> Scope:
    """What functions of a class name, of which no statement of the model is made."""
    functions = {
        f.name: Called(f.name, overloads=tuple(g for g in own if g.name == f.name)) for f in own
    }
    types = frozenset(code.classes)
    return Scope(members, functions, {}, types, open=True, macros=code.macros, form=form)


def _members(
    code: Code, form: CppForm, owner: CppClass, shown: Collection[tuple[str, str]]
) -> dict[str, Member]:
    """What the members of a class and its heirs are as long as none is dead."""
    members: dict[str, Member] = {}
    for above in reversed(_family(code, owner)):
        for member in above.fields:
            plain: Member = Variable(member.name)
            if declared_type(code, member.type) is None:
                plain = Outside(reaches=acts(text_of(member.type)))
            members[member.name] = runtime_of(member) or plain
        members |= telling_publishers(code, form, above, shown)
    return members


def _sliced(slice_: _Slice) -> _Slice:
    """The greatest slice without members that a statement of the model names."""
    code = slice_.code
    places = [
        (text_of(node), cpp, node)
        for cpp in code.files
        for node in code.named(cpp, cpp.root, sorted(slice_.dead))
        if not _is_of_another(code, slice_.owner, node)
    ]
    while wrong := {n for n, cpp, at in places if n in slice_.dead and not slice_.is_dead(cpp, at)}:
        slice_ = replace(slice_, dead=slice_.dead - wrong, told=set())
    return slice_


def _is_of_another(code: Code, owner: CppClass, name: Node) -> bool:
    """Whether a name stands in a class beside the one whose member has it, as one of its own."""
    above = name.parent
    is_part = above is not None and above.child_by_field_name("field") == name
    if is_part and above and text_of(part(above, "argument")) != "this":
        return False
    family = {c.name for c in _family(code, owner)}
    around = {n.id for n in ancestors(name)}
    return any(
        not around.isdisjoint((of.node.id, *(f.node.id for f in code.functions_of(of))))
        for of in code.classes.values()
        if of.name not in family
    )


def _family(code: Code, owner: CppClass) -> list[CppClass]:
    """A class, those that it descends from, nearest first, and those that descend from it."""
    line = code.lineage(owner.name)
    names = {c.name for c in line}
    heirs = (c for c in code.classes.values() if owner in code.lineage(c.name)[1:])
    return line + [c for c in heirs if c.name not in names]


@dataclass(frozen=True, slots=True)
class _Slice:
    """Follows the values of `dead` members, which statements by the ids in `known` only fill.

    `told` are those of them that something else is made of, as far as was looked.
    """

    code: Code
    form: CppForm
    owner: CppClass
    members: Mapping[str, Member]
    known: Collection[int]
    dead: frozenset[str]
    told: set[str] = field(default_factory=set)

    def is_dead(self, cpp: Cpp, place: Node) -> bool:
        """Whether the model has nothing of what is done with a value at a place."""
        waiting, seen = [place], set(self.known)
        while waiting:
            node = waiting.pop()
            statement = climb(node, lambda n: n.id in self.known or _is_statement(n))
            if statement is None:
                return False
            if statement.id in seen:
                continue
            seen.add(statement.id)
            changed = self._changed(cpp, statement)
            if changed is None:
                return False
            if (name := text_of(node)) in self.dead and _stored_in(statement) != name:
                self.told.add(name)
            waiting += self._uses(cpp, statement, changed)
        return True

    def _uses(self, cpp: Cpp, statement: Node, names: Collection[str]) -> list[Node]:
        """Where the function around a statement names some of its locals."""
        function = climb(statement, _is_function)
        if not names or function is None:
            return []
        return [n for n in self.code.named(cpp, function, sorted(names)) if n.type == "identifier"]

    def _changed(self, cpp: Cpp, statement: Node) -> set[str] | None:
        """The locals that a statement changes; None if it does more than that, or may fail."""
        function = climb(statement, _is_function)
        is_told = is_logging(statement)  # that it may fail is told of the log itself
        if function is None or not (is_told or self._is_sure(cpp, statement)):
            return None
        family = _family(self.code, self.owner)
        own = [f for each in family for f in self.code.functions_of(each)]
        members = {**self.members, **dict.fromkeys(self.dead, Outside())}
        locals_ = _locals(function) - members.keys()
        scope = _scope(self.code, self.form, own, members)
        scope = scope.with_locals({n: Variable(n) for n in locals_})
        effects = Effects(cpp, scope, own=frozenset(locals_))
        try:
            effects.check(statement)
        except (Touches, RecursionError):
            return None
        sent = (c for c in calls_in(statement) if c.name in libraries.named(Kind.PUBLISH))
        if any(c.target is not None and effects.root_of(c.target)[0] in locals_ for c in sent):
            return None
        written = {name.partition(".")[0] for name in effects.written}
        return set() if is_told else written | effects.inner

    def _is_sure(self, cpp: Cpp, statement: Node) -> bool:
        """Whether a statement cannot fail, nor change what lies beside a member in memory."""
        if inside(statement, "pointer_expression"):
            return False
        arrays = (f.name for f in self.owner.fields if _ARRAY.fullmatch(squeezed(f.type)))
        places = self.code.named(cpp, statement, sorted(self.dead.intersection(arrays)))
        if not all(map(_is_element, places)) or self.form.raises(cpp, statement) is not None:
            return False
        return not self.form.looked_up(cpp, statement)


def _is_element(name: Node) -> bool:
    """Whether an array is named for an element by a literal, or for all elements at once."""
    above = name.parent
    if above is not None and above.type == "field_expression" and part(above, "field") == name:
        name, above = above, above.parent
    match above.type if above is not None else "":
        case "subscript_expression" if above:
            return text_of(part(above, "indices")).strip("[]").isdecimal()
        case "field_expression" if above:
            return text_of(part(above, "field")) in _OF_ALL
        case type_:
            return type_ in _WHOLE


def _locals(function: Node) -> set[str]:
    """The names that a function declares, its parameters among them."""
    declaring = inside(function, *_DECLARING)
    declarators = (d for n in declaring for d in n.children_by_field_name("declarator"))
    return {name for d in declarators for name in declared_in(d)}


def _is_function(node: Node) -> bool:
    return node.type == "function_definition"


def _is_statement(node: Node) -> bool:
    if node.type == "compound_statement":
        return False
    return node.type in _STATEMENTS or node.type.endswith("_statement")


def _stored_in(statement: Node) -> str:
    """The member that a statement does nothing but to store in; empty for others."""
    inner = named(statement)[0] if statement.type == "expression_statement" else None
    found = _TARGET.match(squeezed(inner)) if inner is not None and inner.type in _STORES else None
    return found[1] if found is not None else ""
