"""Whether a piece of C++ can touch what the model has: state, messages, time, control flow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field, replace
from functools import partial

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies import cpp_roots, known_functions
from rebsync.reverse.bodies.cpp_algorithms import looked_at
from rebsync.reverse.bodies.cpp_endings import ENDLESS, ends
from rebsync.reverse.bodies.cpp_kinds import LEAVES, LOOPS, OF_TEXTS, PLAIN, REPEATED
from rebsync.reverse.bodies.cpp_macros import macro_bodies
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.cpp_misread import first_of, is_misread
from rebsync.reverse.bodies.cpp_places import is_this
from rebsync.reverse.bodies.cpp_roots import declared_in, is_modelled, is_number, root
from rebsync.reverse.bodies.scope import (
    Called,
    Ignored,
    Inline,
    Itself,
    Lambda,
    Meaning,
    Outside,
    Publishes,
    Record,
    Runtime,
    Scope,
    TimerOf,
    Variable,
    meant_by,
)
from rebsync.reverse.bodies.serving import Serves
from rebsync.reverse.bodies.touches import Touches
from rebsync.reverse.bodies.unknown_names import is_method_of_unknown, is_unknown_function
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.syntax.macros import hides


@dataclass(slots=True)
class Effects:
    """Looks through pieces of one body; that its `own` locals change is only noted, in `written`,
    with `everything` that any variable does."""

    cpp: Cpp
    scope: Scope
    own: frozenset[str] = frozenset()
    written: set[str] = field(default_factory=set)
    everything: bool = False
    returning: bool = False
    _inner: set[str] = field(default_factory=set)
    _around: tuple[str, ...] = ()  # the types of the loops and switches

    def check(self, node: Node) -> None:
        """Raises `Touches` where a piece of code may touch what the model has."""
        if (type_ := node.type) not in PLAIN:
            _CHECKS.get(type_, Effects._inside)(self, node)

    def _inside(self, node: Node) -> None:
        for child in node.named_children:
            self.check(child)

    def _pointer(self, node: Node) -> None:
        if text_of(node).startswith("&"):
            self.refers(named(node)[0])
        else:
            self._inside(node)

    def _left(self, node: Node) -> None:
        if LOOPS.isdisjoint(self._around) and not (self._around and node.type == "break_statement"):
            raise self._touches(node, "this leaves the loop")
        self._inside(node)

    def _left_function(self, node: Node) -> None:
        if not self.returning or node.type != "return_statement":
            raise self._touches(node, LEAVES[node.type])
        self._inside(node)

    def _block(self, node: Node) -> None:
        before = set(self._inner)
        self._inside(node)
        self._inner = before

    def _repeated(self, node: Node) -> None:
        if not ends(self.scope, self.cpp, node):
            raise self._touches(node, ENDLESS)
        self._around = (*self._around, node.type)
        self._block(node)
        self._around = self._around[:-1]

    def _touches(self, node: Node, why: str, hint: str = "") -> Touches:
        touches = Touches(self.cpp.span(node), why, hint)
        touches.texts = cpp_roots.texts_in(node, self._root(node)[1])
        if not self._inner:
            touches.at = node.start_byte, node.end_byte
        return touches

    def _root(self, node: Node) -> tuple[str, Meaning | None]:
        return root(self.scope, self._inner, node)

    def _is_noted(self, name: str) -> bool:
        return self.everything or (name in self.own and name in self.scope.locals)

    def _assignment(self, node: Node) -> None:
        value = node.child_by_field_name("right")  # None of `x++`
        self._write(part(node, "argument" if value is None else "left"))
        if value is not None:
            self.check(value)

    def _changes(self, node: Node, name: str, why: str, path: str = "") -> None:
        """Notes that a local of the body changes; what else the model has may not."""
        if not self._is_noted(name):
            raise self._touches(node, why)
        self.written.add(f"{name}.{path}" if path else name)

    def _write(self, node: Node) -> None:
        name, meaning = self._root(node)
        self._subscripts(node)
        if not is_modelled(node, meaning):
            self._found_out(node, name)
            return
        path = cpp_roots.path_in(node) if isinstance(meaning, Record) else ""
        self._changes(node, name, f'this changes "{text_of(node)}"', path)

    def _found_out(self, node: Node, name: str) -> None:
        """A place that is only known when the code runs: `(on ? count : limit) = 0`."""
        if not name and node.type not in ("identifier", "qualified_identifier"):
            self.check(node)
            for inner in cpp_roots.identifiers_in(node):
                name, meaning = self._root(inner)
                # A function may give a reference to a variable of the model.
                gives = not isinstance(self.scope.functions.get(name), Ignored | None)
                if gives or is_modelled(inner, meaning):
                    raise self._touches(node, f'this may change "{name}"')

    def _binary(self, node: Node) -> None:
        """An operator; of an object it may be a function: `stream >> count` changes `count`."""
        left, right = part(node, "left"), part(node, "right")
        if known_functions.reads_input(left):
            raise self._touches(node, "this waits for what somebody types")
        self.check(left)
        may_act = part(node, "operator").type in (">>", "&")
        is_object = may_act and not is_number(self.scope, self._inner, left)
        self._arguments((right,)) if is_object else self.check(right)

    def _misread(self, node: Node) -> None:
        if not is_misread(self.scope, node):
            self._inside(node)
            return
        first = first_of(self.cpp, self.scope, node)
        try:
            replace(self, cpp=first.cpp).check(first.node)
        except Touches as touches:
            raise self._touches(node, touches.why) from None
        self.check(part(part(node, "value"), "argument"))

    def _subscripts(self, node: Node) -> None:
        """What is evaluated to find the place that is written."""
        match node.type:
            case "call_expression":
                self.check(node)
            case "subscript_expression":
                for index in node.children_by_field_name("indices"):
                    self.check(index)
                self._subscripts(part(node, "argument"))
            case "field_expression" | "pointer_expression":
                self._subscripts(part(node, "argument"))

    def refers(self, node: Node) -> None:
        """Raises `Touches` where a reference to a place could change what the model has."""
        name, meaning = self._root(node)
        if is_modelled(node, meaning):
            self._changes(node, name, f'the address of "{text_of(node)}" is taken')
            return
        self.check(node)
        self._found_out(node, name)

    def _declaration(self, node: Node) -> None:
        type_ = text_of(written) if (written := node.child_by_field_name("type")) else ""
        takes = known_functions.type_takes_values(type_)
        if not type_ or (self.scope.meaning(type_) is not None and type_ not in self._inner):
            raise self._touches(node, "this looks like a declaration, but starts with a variable")
        for declarator in node.children_by_field_name("declarator"):
            value = declarator.child_by_field_name("value")
            inner = declarator.child_by_field_name("declarator")
            target = inner if declarator.type == "init_declarator" and inner else declarator
            if value is not None and is_this(value):
                raise self._touches(node, "the object itself gets another name here")
            refers = target.type == "reference_declarator"
            if refers and value is None:
                raise self._touches(node, "this looks like a declaration, but it is none")
            if target.type == "function_declarator" and not takes:
                self._made_from_names(target)
            if refers and value is not None and "const" not in cpp_roots.specifiers_of(node):
                self.refers(value)
            elif value is not None and value.type == "argument_list" and takes:
                for argument in named(value):
                    self.check(argument)
            elif value is not None:
                self.check(value)
            self._inner.update(declared_in(target))

    def _made_from_names(self, declarator: Node) -> None:
        """`Guard guard(x);`, which the grammar takes for a function: the object may change `x`."""
        for argument in named(part(declarator, "parameters")):
            name = text_of(argument)
            meaning = None if name in self._inner else self.scope.meaning(name)
            if isinstance(meaning, Variable | Record):
                self._changes(argument, name, f'this may change "{name}"')

    def _range(self, node: Node) -> None:
        if not ends(self.scope, self.cpp, node):
            raise self._touches(node, ENDLESS)
        declarator, over = part(node, "declarator"), part(node, "right")
        refers = declarator.type == "reference_declarator"
        changes = refers and "const" not in cpp_roots.specifiers_of(node)
        (self.refers if changes else self.check)(over)
        self._inner.update(declared_in(declarator))
        self._around = (*self._around, node.type)
        self.check(part(node, "body"))
        self._around = self._around[:-1]

    # --- calls ----------------------------------------------------------------------------------

    def _call(self, node: Node) -> None:
        call = self.scope.call(node)
        if call is None or call.name.startswith("["):
            raise self._touches(node, "this runs a function of its own")
        name, known = call.name.rpartition("::")[2], False
        of, meaning = self._root(call.target) if call.target is not None else ("", None)
        if call.target is None or isinstance(meaning, Itself):
            known = self._function(call, name)
            known = self._is_matrix(node, name, call) or known
        else:
            self._method(call, name, of, meaning)
        if (does := known_functions.acts(self.cpp, call, has_mailbox(self.scope))) is not None:
            raise self._touches(node, f'"{text_of(part(node, "function"))}" {does}')
        if looked_at(call):
            return
        if known or known_functions.takes_values(call):
            for argument in call.arguments:
                self.check(argument)
            return
        self._arguments(call.arguments)

    def _function(self, call: CppCall, name: str) -> bool:
        """Whether a function of the code only looks; `Touches` if it acts on more than it gets."""
        meant: tuple[CppFunction, ...] = ()
        match self.scope.functions.get(name):
            case None if hides(name):
                if self._is_calm_macro(name):
                    return True
                raise self._touches(call.node, f'"{name}" may be a macro that hides statements')
            case None | Ignored():
                if is_unknown_function(self.scope, self._inner, call):
                    raise self._touches(call.node, f'nobody here knows what "{call.name}" does')
                return False
            case Called() | Inline() as known:
                meant = meant_by(known, call.name, len(call.arguments))
        if not meant or not all(map(self._is_calm, meant)):
            raise self._touches(call.node, f'"{name}" may change what the model has')
        return not any(known_functions.may_change(p) for f in meant for p in f.parameters)

    def _is_matrix(self, node: Node, name: str, call: CppCall) -> bool:
        """Whether a matrix is called; a function that somebody has put there may do anything.

        But for one that only gets an object that is outside, as a distribution gets a generator.
        """
        meaning = None if name in self._inner else self.scope.meaning(name)
        if isinstance(meaning, Outside):
            only = call.arguments[0] if len(call.arguments) == 1 else None
            if meaning.indexed or (only and isinstance(self._root(only)[1], Outside)):
                return meaning.indexed
        if meaning is not None:
            raise self._touches(node, f'"{name}" may change what the model has')
        return False

    def _is_calm_macro(self, name: str) -> bool:
        """Whether a macro only looks at what it gets, and touches nothing else, at this place."""
        bodies = macro_bodies(self.scope, self.cpp.source.path, name)
        try:
            for each in bodies:
                inside = Effects(each.cpp, each.scope, _inner=self._inner - each.parameters)
                inside.check(each.statements)
        except Unread:
            return False
        return bool(bodies)

    def _is_calm(self, function: CppFunction) -> bool:
        """Whether a body touches nothing but what it declares, or gets."""
        if function.body is None:
            return False
        scope, looks = self.scope, partial(self._looks, function, function.body)
        return scope.calm.of(function.body.id, scope.members, scope.functions, looks)

    def _looks(self, function: CppFunction, body: Node) -> bool:
        inner, scope = {p.name for p in function.parameters}, replace(self.scope, locals={})
        inside = Effects(function.cpp, scope, returning=True, _inner=inner)
        try:
            inside.check(body)
        except (Touches, RecursionError):  # what leads too deep may do anything
            return False
        return True

    def _method(self, call: CppCall, name: str, of: str, meaning: Meaning | None) -> None:
        """A call of a function of some object."""
        target = call.target
        assert target is not None
        match meaning:
            case None if is_method_of_unknown(self.scope, self._inner, of, name):
                raise self._touches(call.node, f'nobody here knows what "{text_of(target)}" is')
            case None | Outside(reaches=False):
                if name in libraries.named(Kind.PUBLISH) and (
                    meaning is not None or not of or of in self._inner
                ):
                    raise self._touches(call.node, "what is published here is not known")
            case Outside():
                raise self._touches(call.node, f'"{text_of(target)}" may act on the node')
            case Publishes(targets):
                if name in libraries.named(Kind.PUBLISH) and not targets:
                    return
                if name not in libraries.looking():
                    raise self._touches(call.node, "this sends, or ends that the node can send")
            case Serves() | TimerOf():
                if name not in libraries.looking():
                    raise self._touches(call.node, "this changes a timer, subscription or service")
            case Variable(type=type_) if name == "load" and type_ and not type_.dimensions:
                pass  # of an atomic number
            case Record() | Variable():
                if name not in (libraries.looking() | OF_TEXTS) and is_modelled(target, meaning):
                    self._changes(call.node, of, f'this may change "{of}"')
            case Runtime() | Lambda() | Itself() if name not in libraries.looking():
                raise self._touches(call.node, f'"{of}" acts on the node')
            case _:
                if name not in libraries.looking() and is_modelled(target, meaning):
                    raise self._touches(call.node, f'this may change "{of}"')
        self.check(target)

    def _arguments(self, arguments: tuple[Node, ...] | list[Node]) -> None:
        """Arguments of a function that is not known: it may keep or change what it gets."""
        for argument in arguments:
            if argument.type == "lambda_expression":
                self._handed(argument)
                continue
            name, meaning = self._root(argument)
            is_value = argument.type == "call_expression" and not cpp_roots.is_element(argument)
            if is_value or not is_modelled(argument, meaning):
                self.check(argument)
            elif isinstance(meaning, Record) and meaning.constant:
                continue
            elif self._is_noted(name):
                self.written.add(name)
            else:
                if isinstance(meaning, Itself):
                    raise self._touches(argument, "what is done to the object itself is not known")
                why = f'this may change "{text_of(argument)}"'
                raise self._touches(argument, why, "hand over a copy: +x, or a const local")

    def _handed(self, function: Node) -> None:
        """A function that is handed on: it may run at any time."""
        outer, around = self._inner, self._around
        self._inner, self._around = {*outer, *cpp_roots.parameters_of(function)}, ()
        for child in named(part(function, "body")):
            for each in named(child) if child.type == "return_statement" else [child]:
                self.check(each)
        self._inner, self._around = outer, around


_CHECKS: dict[str, Callable[[Effects, Node], None]] = {
    **dict.fromkeys(("assignment_expression", "update_expression"), Effects._assignment),
    **{"call_expression": Effects._call, "binary_expression": Effects._binary},
    **{"cast_expression": Effects._misread, "pointer_expression": Effects._pointer},
    **{"declaration": Effects._declaration, "compound_statement": Effects._block},
    **dict.fromkeys(("break_statement", "continue_statement"), Effects._left),
    **dict.fromkeys(
        ("new_expression", "argument_list", "initializer_list"),
        lambda self, node: self._arguments(named(node)),
    ),
    **dict.fromkeys(LEAVES, Effects._left_function),
    **dict.fromkeys(REPEATED, Effects._repeated),
    "for_range_loop": Effects._range,
}


def touching(cpp: Cpp, scope: Scope, node: Node) -> Touches | None:
    """What in a piece of code may touch what the model has, the first; None where it is outside."""
    try:
        Effects(cpp, scope).check(node)
    except Touches as touches:
        return touches.with_traceback(None)  # whose frames would keep the trees, and it them
    return None
