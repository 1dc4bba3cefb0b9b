"""Whether a piece of C++ can touch what the model has: state, messages, time, control flow."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import field, replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies import cpp_roots, known_functions
from rebsync.reverse.bodies.cpp_kinds import LEAVES, LOOKED_AT, PLAIN, REPEATED
from rebsync.reverse.bodies.cpp_macros import is_harmless
from rebsync.reverse.bodies.cpp_misread import first_of, is_misread
from rebsync.reverse.bodies.cpp_places import is_this
from rebsync.reverse.bodies.cpp_roots import identifiers_in, is_element, is_modelled, path_in, root
from rebsync.reverse.bodies.known_functions import LOOKS, acts, takes_values, type_takes_values
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
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.syntax.macros import hides


class Touches(Unread):
    """What a piece of code does to the model.

    `at` are the bytes that do it, if they do whatever stands for the names of other locals.
    """

    at: tuple[int, int] | None = None


@dataclass(slots=True)
class Effects:
    """Looks through pieces of one body.

    `own` are the locals of the body whose change is only noted, in `written`; with `everything`
    that of any variable is.
    """

    cpp: Cpp
    scope: Scope
    own: frozenset[str] = frozenset()
    written: set[str] = field(default_factory=set)
    everything: bool = False
    returning: bool = False
    _inner: set[str] = field(default_factory=set)
    _loops: int = 0

    def check(self, node: Node) -> None:
        """Raises `Touches` where a piece of code may touch what the model has."""
        type_ = node.type
        if type_ not in LOOKED_AT:
            if type_ not in PLAIN:
                self._inside(node)
            return
        match type_:
            case "assignment_expression":
                self._write(node.children_by_field_name("left")[0])
                self.check(node.children_by_field_name("right")[0])
            case "update_expression":
                self._write(node.children_by_field_name("argument")[0])
            case "call_expression":
                self._call(node)
            case "binary_expression":
                self._binary(node)
            case "cast_expression" if is_misread(self.scope, node):
                self._misread(node)
            case "ERROR":
                raise self._touches(node, "this does not parse as C++")
            case "pointer_expression" if text_of(node).startswith("&"):
                self._address(named(node)[0])
            case "declaration":
                self._declaration(node)
            case "for_range_loop":
                self._range(node)
            case "break_statement" | "continue_statement" if not self._loops:
                raise self._touches(node, "this leaves the loop")
            case "return_statement" if self.returning:
                self._inside(node)
            case kind if kind in LEAVES:
                raise self._touches(node, LEAVES[kind])
            case "new_expression" | "argument_list" | "initializer_list":
                self._arguments(named(node))
            case kind if kind in REPEATED or kind == "compound_statement":
                looping = kind in REPEATED
                before = set(self._inner)
                self._loops += looping
                self._inside(node)
                self._loops -= looping
                self._inner = before
            case _:
                self._inside(node)

    def _inside(self, node: Node) -> None:
        for child in (c for c in node.named_children if c.type not in PLAIN):
            self.check(child)

    def _touches(self, node: Node, why: str, hint: str = "") -> Touches:
        touches = Touches(self.cpp.span(node), why, hint)
        if not self._inner:
            touches.at = node.start_byte, node.end_byte
        return touches

    # --- what names stand for -------------------------------------------------------------------

    def _root(self, node: Node) -> tuple[str, Meaning | None]:
        return root(self.scope, self._inner, node)

    def _is_noted(self, name: str) -> bool:
        return self.everything or (name in self.own and name in self.scope.locals)

    # --- writing --------------------------------------------------------------------------------

    def _write(self, node: Node) -> None:
        name, meaning = self._root(node)
        self._subscripts(node)
        if not is_modelled(node, meaning):
            self._found_out(node, name)
            return
        if self._is_noted(name):
            path = path_in(node) if isinstance(meaning, Record) else ""
            self.written.add(f"{name}.{path}" if path else name)
            return
        raise self._touches(node, f'this changes "{text_of(node)}"')

    def _found_out(self, node: Node, name: str) -> None:
        """A place that is only known when the code runs: `(on ? count : limit) = 0`."""
        if not name and node.type not in ("identifier", "qualified_identifier"):
            self.check(node)
            for inner in identifiers_in(node):
                if is_modelled(inner, self._root(inner)[1]) or text_of(inner) in self._functions:
                    raise self._touches(node, f'this may change "{text_of(inner)}"')

    @property
    def _functions(self) -> Collection[str]:
        """The names of functions that may give a reference to a variable of the model."""
        return {n for n, f in self.scope.functions.items() if not isinstance(f, Ignored)}

    def _binary(self, node: Node) -> None:
        """An operator; of an object it may be a function: `stream >> count` changes `count`."""
        left, right = (node.children_by_field_name(side)[0] for side in ("left", "right"))
        operator = text_of(node.children_by_field_name("operator")[0])
        self.check(left)
        is_object = operator in (">>", "&") and not self._is_number(left)
        self._arguments((right,)) if is_object else self.check(right)

    def _misread(self, node: Node) -> None:
        first = first_of(self.cpp, self.scope, node)
        try:
            replace(self, cpp=first.cpp).check(first.node)
        except Touches as touches:
            raise self._touches(node, touches.why) from None
        self.check(part(part(node, "value"), "argument"))

    def _is_number(self, node: Node) -> bool:
        """Whether it is a literal or a variable of the model: no object with functions."""
        if node.type in ("parenthesized_expression", "binary_expression"):
            return all(self._is_number(c) for c in named(node))
        return node.type == "number_literal" or isinstance(self._root(node)[1], Variable)

    def _subscripts(self, node: Node) -> None:
        """What is evaluated to find the place that is written."""
        indices = node.children_by_field_name("indices")
        for part_ in [node] if node.type == "call_expression" else indices:
            self.check(part_)
        if node.type in ("subscript_expression", "field_expression", "pointer_expression"):
            self._subscripts(node.children_by_field_name("argument")[0])

    def _address(self, node: Node) -> None:
        name, meaning = self._root(node)
        if is_modelled(node, meaning):
            if self._is_noted(name):
                self.written.add(name)
                return
            raise self._touches(node, f'the address of "{text_of(node)}" is taken')
        self.check(node)
        self._found_out(node, name)

    def refers(self, node: Node) -> None:
        """Raises `Touches` where a reference to a place could change what the model has."""
        self._address(node)

    def _declaration(self, node: Node) -> None:
        type_ = text_of(node.children_by_field_name("type")[0])
        if self.scope.meaning(type_) is not None and type_ not in self._inner:
            raise self._touches(node, "this looks like a declaration, but starts with a variable")
        by_value = type_takes_values(type_)
        for declarator in node.children_by_field_name("declarator"):
            value = declarator.child_by_field_name("value")
            inner = declarator.child_by_field_name("declarator")
            target = inner if declarator.type == "init_declarator" and inner else declarator
            if value is not None and is_this(value):
                raise self._touches(node, "the object itself gets another name here")
            constant = any(text_of(c) == "const" for c in node.named_children)
            if target.type == "reference_declarator" and value is None:
                raise self._touches(node, "this looks like a declaration, but it is none")
            if target.type == "reference_declarator" and value is not None and not constant:
                self._address(value)
            elif value is not None and value.type == "argument_list" and by_value:
                for argument in named(value):
                    self.check(argument)
            elif value is not None:
                self.check(value)
            self._declare(target)

    def _declare(self, declarator: Node) -> None:
        self._inner.update(cpp_roots.declared_in(declarator))

    def _range(self, node: Node) -> None:
        declarator = node.children_by_field_name("declarator")[0]
        over = node.children_by_field_name("right")[0]
        constant = any(text_of(c) == "const" for c in node.named_children)
        if declarator.type == "reference_declarator" and not constant:
            self._address(over)
        else:
            self.check(over)
        self._declare(declarator)
        self._loops += 1
        self.check(node.children_by_field_name("body")[0])
        self._loops -= 1

    # --- calls ----------------------------------------------------------------------------------

    def _call(self, node: Node) -> None:
        call = call_of(node)
        function = node.children_by_field_name("function")[0]
        if call is None or function.type == "lambda_expression":
            self._lambda(node, function)
            return
        name = call.name.rpartition("::")[2]
        known = False
        own = call.target is not None and isinstance(self._root(call.target)[1], Itself)
        if call.target is None or own:
            known = self._function(call, name)
            known = self._held(node, name, call) or known
        else:
            self._method(call, name)
        if (does := acts(call)) is not None:
            raise self._touches(node, f'"{text_of(function)}" {does}')
        if known or takes_values(call):
            for argument in call.arguments:
                self.check(argument)
            return
        self._arguments(call.arguments)

    def _function(self, call: CppCall, name: str) -> bool:
        """Whether a function of the code only looks; `Touches` if it acts on more than it gets."""
        meant: tuple[CppFunction, ...] = ()
        match self.scope.functions.get(name):
            case None if hides(name):
                if is_harmless(self, name):
                    return True
                raise self._touches(call.node, f'"{name}" may be a macro that hides statements')
            case None | Ignored():
                return False
            case Called() | Inline() as known:
                meant = meant_by(known, call.name, len(call.arguments))
        if not meant or not all(map(self._is_calm, meant)):
            raise self._touches(call.node, f'"{name}" may change what the model has')
        return not any(known_functions.may_change(p) for f in meant for p in f.parameters)

    def _held(self, node: Node, name: str, call: CppCall) -> bool:
        """Whether a matrix is called; a function that somebody has put there may do anything.

        But for one that only gets an object that is outside, as a distribution gets a generator.
        """
        meaning = None if name in self._inner else self.scope.meaning(name)
        if isinstance(meaning, Outside) and meaning.indexed:
            return True
        objects = [self._root(a)[1] for a in call.arguments]
        drawn = len(objects) == 1 and isinstance(objects[0], Outside)
        if meaning is not None and not (isinstance(meaning, Outside) and drawn):
            raise self._touches(node, f'"{name}" may change what the model has')
        return False

    def _is_calm(self, function: CppFunction) -> bool:
        """Whether a body touches nothing but what it declares, or gets."""
        if function.body is None:
            return False
        key = function.body.id
        if key not in self.scope.calm:
            self.scope.calm[key] = True  # as far as a call of itself goes
            inside = Effects(function.cpp, replace(self.scope, locals={}), returning=True)
            inside._inner = {p.name for p in function.parameters}
            try:
                inside.check(function.body)
            except (Touches, RecursionError):  # what leads too deep may do anything
                self.scope.calm[key] = False
        return self.scope.calm[key]

    def _lambda(self, node: Node, function: Node) -> None:
        if function.type != "lambda_expression":
            for child in node.named_children:
                self.check(child)
            return
        raise self._touches(node, "this runs a function of its own")

    def _method(self, call: CppCall, name: str) -> None:
        """A call of a function of some object."""
        target = call.target
        assert target is not None
        of, meaning = self._root(target)
        match meaning:
            case None | Outside(reaches=False):
                if name == "publish" and (meaning is not None or not of or of in self._inner):
                    raise self._touches(call.node, "what is published here is not known")
            case Outside():
                raise self._touches(call.node, f'"{text_of(target)}" may act on the node')
            case Publishes(targets):
                if name == "publish" and not targets:
                    return
                if name not in LOOKS:
                    raise self._touches(call.node, "this sends, or ends that the node can send")
            case TimerOf():
                if name not in LOOKS:
                    raise self._touches(call.node, "this changes a timer")
            case Record() | Variable():
                if name not in LOOKS and is_modelled(target, meaning):
                    if self._is_noted(of):
                        self.written.add(of)
                    else:
                        raise self._touches(call.node, f'this may change "{of}"')
            case Runtime() | Lambda() | Itself() if name not in LOOKS:
                raise self._touches(call.node, f'"{of}" acts on the node')
            case _:
                if name not in LOOKS and is_modelled(target, meaning):
                    raise self._touches(call.node, f'this may change "{of}"')
        self.check(target)

    def _arguments(self, arguments: tuple[Node, ...] | list[Node]) -> None:
        """Arguments of a function that is not known: it may keep or change what it gets."""
        for argument in arguments:
            if argument.type == "lambda_expression":
                self._handed(argument)
                continue
            name, meaning = self._root(argument)
            if (argument.type == "call_expression" and not is_element(argument)) or not is_modelled(
                argument, meaning
            ):
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
        outer, loops = self._inner, self._loops
        self._inner, self._loops = set(outer), 0
        declarator = function.child_by_field_name("declarator")
        if declarator is not None:
            for parameter in named(declarator.children_by_field_name("parameters")[0]):
                for inner in parameter.children_by_field_name("declarator"):
                    self._declare(inner)
        for child in named(function.children_by_field_name("body")[0]):
            if child.type == "return_statement":
                for value in named(child):
                    self.check(value)
            else:
                self.check(child)
        self._inner, self._loops = outer, loops


def is_outside(cpp: Cpp, scope: Scope, node: Node) -> bool:
    """Whether a piece of code provably touches nothing that the model has."""
    return touching(cpp, scope, node) is None


def touching(cpp: Cpp, scope: Scope, node: Node) -> Touches | None:
    """What in a piece of code may touch what the model has, the first; None for nothing."""
    try:
        Effects(cpp, scope).check(node)
    except Touches as touches:
        return touches.with_traceback(None)  # whose frames would keep the trees, and it them
    return None
