"""Whether a piece of C++ can touch what the model has: state, messages, time, control flow."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_misparsed import check_misparsed
from rebsync.reverse.bodies.cpp_misread import first_of, is_misread
from rebsync.reverse.bodies.effects import cpp_roots, known_functions
from rebsync.reverse.bodies.effects.cpp_call_effects import (
    RENAMED,
    check_call,
    check_deleted,
    check_macro,
    check_read,
    gives_itself,
)
from rebsync.reverse.bodies.effects.cpp_effect_reader import EffectReader
from rebsync.reverse.bodies.effects.cpp_endings import ENDLESS, ends
from rebsync.reverse.bodies.effects.cpp_kinds import LEAVES, LOOPS, PLAIN, REPEATED
from rebsync.reverse.bodies.effects.cpp_roots import declared_in, is_modelled, is_number
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import (
    Ignored,
    Itself,
    Record,
    Scope,
    Variable,
)
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of

_LISTS = ("argument_list", "initializer_list")
# Places of variables.
_PLACES = frozenset({"identifier", "field_expression", "subscript_expression"})


@dataclass(slots=True)
class Effects(EffectReader):
    """Looks through pieces of one body."""

    _around: tuple[str, ...] = ()  # the types of the loops and switches
    _is_inside: bool = False  # a piece that is being looked through

    def check(self, node: Node) -> None:
        """Raises `Touches` where a piece of code may touch what the model has."""
        if self._is_inside:
            self._check(node)
            return
        self._is_inside = True
        try:
            check_read(self, node)
            self._check(node)
        finally:
            self._is_inside = False

    def _check(self, node: Node) -> None:
        if (type_ := node.type) in _PLACES:
            self._decays(node)
        if type_ == "identifier":
            check_macro(self, node)
        elif type_ not in PLAIN:
            _CHECKS.get(type_, Effects._inside)(self, node)

    def _inside(self, node: Node) -> None:
        for child in node.named_children:
            self.check(child)

    def _decays(self, node: Node) -> None:
        """Raises `Touches` where an array is a pointer, by which its elements may change."""
        name, meaning = self.root_of(node)
        if not isinstance(meaning, Variable) or not _is_array(node, meaning):
            return
        form = self.scope.form
        if form is None or form.objects.is_pointer(self.cpp, node):
            self.changes(node, name, f'elements of "{text_of(node)}" may change by another name')

    def _pointer(self, node: Node) -> None:
        if text_of(node).startswith("&"):
            self.refers(named(node)[0])
        else:
            self._inside(node)

    def _left(self, node: Node) -> None:
        if LOOPS.isdisjoint(self._around) and not (self._around and node.type == "break_statement"):
            raise self.touches(node, "this leaves the loop")
        self._inside(node)

    def _left_function(self, node: Node) -> None:
        if not self.returning or node.type != "return_statement":
            raise self.touches(node, LEAVES[node.type])
        self._inside(node)

    def _block(self, node: Node) -> None:
        before = set(self.inner)
        self._inside(node)
        self.inner = before

    def _repeated(self, node: Node) -> None:
        if not ends(self.scope, self.cpp, node):
            raise self.touches(node, ENDLESS)
        self._around = (*self._around, node.type)
        self._block(node)
        self._around = self._around[:-1]

    def anew(
        self, cpp: Cpp, scope: Scope, inner: Collection[str], returning: bool = False
    ) -> Effects:
        """For another body, of which `inner` are the names that it declares."""
        return Effects(cpp, scope, returning=returning, inner=set(inner))

    def _assignment(self, node: Node) -> None:
        value = node.child_by_field_name("right")  # None of `x++`
        self._write(part(node, "argument" if value is None else "left"))
        if value is not None and gives_itself(value):
            raise self.touches(node, RENAMED)
        if value is not None:
            self.check(value)

    def _write(self, node: Node) -> None:
        name, meaning = self.root_of(node)
        self._subscripts(node)
        form = self.scope.form
        if name not in self.inner and form is not None and name in form.naming_macros:
            raise self.touches(node, f'"{name}" is a macro: what it names is changed')
        if not is_modelled(node, meaning):
            self._found_out(node, name)
            return
        path = cpp_roots.path_in(node) if isinstance(meaning, Record) else ""
        self.changes(node, name, f'this changes "{text_of(node)}"', path)

    def _found_out(self, node: Node, name: str) -> None:
        """A place that is only known when the code runs: `(on ? count : limit) = 0`."""
        if not name and node.type not in ("identifier", "qualified_identifier"):
            self.check(node)
            for inner in cpp_roots.identifiers_in(node):
                name, meaning = self.root_of(inner)
                # A function may give a reference to a variable of the model.
                gives = not isinstance(self.scope.functions.get(name), Ignored | None)
                if gives or is_modelled(inner, meaning):
                    raise self.touches(node, f'this may change "{name}"')

    def _binary(self, node: Node) -> None:
        """An operator; of an object it may be a function: `stream >> count` changes `count`."""
        left, right = part(node, "left"), part(node, "right")
        if known_functions.reads_input(left):
            raise self.touches(node, "this waits for what somebody types")
        self.check(left)
        may_act = part(node, "operator").type in (">>", "&")
        is_object = may_act and not is_number(self.scope, self.inner, left)
        self.arguments((right,)) if is_object else self.check(right)

    def _misread(self, node: Node) -> None:
        if not is_misread(self.scope, node):
            self._inside(node)
            return
        first = first_of(self.cpp, self.scope, node)
        try:
            replace(self, cpp=first.cpp).check(first.node)
        except Touches as touches:
            raise self.touches(node, touches.why) from None
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
        name, meaning = self.root_of(node)
        if is_modelled(node, meaning):
            self.changes(node, name, f'the address of "{text_of(node)}" is taken')
            return
        self.check(node)
        self._found_out(node, name)

    def _declaration(self, node: Node) -> None:
        written = node.child_by_field_name("type")
        type_ = text_of(written) if written is not None else ""
        takes = known_functions.type_takes_values(type_)
        if not type_ or (self.scope.meaning(type_) is not None and type_ not in self.inner):
            raise self.touches(node, "this looks like a declaration, but starts with a variable")
        if (tested := node.child_by_field_name("value")) is not None:  # `if (auto x = f())`
            self.check(tested)
        for declarator in node.children_by_field_name("declarator"):
            value = declarator.child_by_field_name("value")
            inner = declarator.child_by_field_name("declarator")
            target = inner if declarator.type == "init_declarator" and inner else declarator
            if value is not None and gives_itself(value):
                raise self.touches(node, RENAMED)
            refers = target.type == "reference_declarator"
            if refers and value is None:
                raise self.touches(node, "this looks like a declaration, but it is none")
            if target.type == "function_declarator":
                check_misparsed(self, target)
            if target.type == "function_declarator" and not takes:
                self._made_from_names(target)
            refers = refers or (value is not None and is_bound(type_, value))
            if refers and value is not None and "const" not in cpp_roots.specifiers_of(node):
                self.refers(value)
            elif value is not None:
                is_plain = target.type == "identifier"
                self.made_of(written if is_plain else None, value)
            self.inner.update(declared_in(target))

    def made_of(self, type_: Node | None, value: Node) -> None:
        """What a variable is made of, which a constructor of its class may keep or change."""
        text = text_of(type_) if type_ is not None else ""
        if value.type == "argument_list" and known_functions.type_takes_values(text):
            for argument in named(value):
                self.check(argument)
        elif value.type in _LISTS or type_ is None or self._copies(type_, text):
            self.check(value)
        else:
            self.arguments((value,))

    def _copies(self, type_: Node, text: str) -> bool:
        """Whether objects of a type only get copies of what they are made of."""
        if known_functions.type_takes_values(text) or type_.type.startswith("placeholder"):
            return True
        form = self.scope.form
        is_aggregate = form is not None and form.objects.is_aggregate(text)
        return is_aggregate or self.scope.carried(type_) is not None

    def _new(self, node: Node) -> None:
        self.arguments(named(node))

    def _made_from_names(self, declarator: Node) -> None:
        """`Guard guard(x);`, which the grammar takes for a function: the object may change `x`."""
        for argument in named(part(declarator, "parameters")):
            name = text_of(argument)
            meaning = None if name in self.inner else self.scope.meaning(name)
            if isinstance(meaning, Variable | Record):
                self.changes(argument, name, f'this may change "{name}"')

    def _range(self, node: Node) -> None:
        if not ends(self.scope, self.cpp, node):
            raise self.touches(node, ENDLESS)
        declarator, over = part(node, "declarator"), part(node, "right")
        refers = declarator.type == "reference_declarator"
        changes = refers and "const" not in cpp_roots.specifiers_of(node)
        if changes:
            self.refers(over)
        elif over.type not in _PLACES:
            self.check(over)
        self.inner.update(declared_in(declarator))
        self._around = (*self._around, node.type)
        self.check(part(node, "body"))
        self._around = self._around[:-1]

    # --- calls ----------------------------------------------------------------------------------

    def arguments(self, arguments: Sequence[Node]) -> None:
        """Arguments of a function that is not known: it may keep or change what it gets."""
        for argument in arguments:
            if argument.type == "lambda_expression":
                self._handed(argument)
                continue
            name, meaning = self.root_of(argument)
            is_value = argument.type == "call_expression" and not cpp_roots.is_element(argument)
            if is_value or not is_modelled(argument, meaning):
                self.check(argument)
            elif isinstance(meaning, Record) and meaning.constant:
                continue
            elif self.is_noted(name):
                self.written.add(name)
            else:
                if isinstance(meaning, Itself):
                    raise self.touches(argument, "what is done to the object itself is not known")
                why = f'this may change "{text_of(argument)}"'
                raise self.touches(argument, why, "hand over a copy: +x, or a const local")

    def _braces(self, node: Node) -> None:
        """What an object is made of: one of a class without constructors copies it."""
        above = node.parent
        if above is not None and above.type == "init_declarator":
            above = above.parent
        type_ = above.child_by_field_name("type") if above is not None else None
        form = self.scope.form
        if type_ is None or form is None or not form.objects.is_aggregate(text_of(type_)):
            self.arguments(named(node))
            return
        for element in named(node):
            self.check(element)

    def _handed(self, function: Node) -> None:
        """A function that is handed on: it may run at any time."""
        outer, around = self.inner, self._around
        self.inner, self._around = {*outer, *cpp_roots.parameters_of(function)}, ()
        for child in named(part(function, "body")):
            for each in named(child) if child.type == "return_statement" else [child]:
                self.check(each)
        self.inner, self._around = outer, around


_CHECKS: dict[str, Callable[[Effects, Node], None]] = {
    **dict.fromkeys(("assignment_expression", "update_expression"), Effects._assignment),
    **{"call_expression": check_call, "binary_expression": Effects._binary},
    **{"cast_expression": Effects._misread, "pointer_expression": Effects._pointer},
    **{"declaration": Effects._declaration, "compound_statement": Effects._block},
    **dict.fromkeys(("break_statement", "continue_statement"), Effects._left),
    "argument_list": lambda self, node: self.arguments(named(node)),
    "initializer_list": Effects._braces,
    **{"new_expression": Effects._new, "delete_expression": check_deleted},
    **dict.fromkeys(LEAVES, Effects._left_function),
    **dict.fromkeys(REPEATED, Effects._repeated),
    "for_range_loop": Effects._range,
}


def is_bound(type_: str, value: Node) -> bool:
    """Whether `=` may make a variable of a type another name for a place."""
    return value.type not in _LISTS and known_functions.type_refers(type_)


def _is_array(node: Node, variable: Variable) -> bool:
    """Whether a place of an array is more than one element, and none is taken where it stands."""
    indices, above, inner = 0, node.parent, node
    while above is not None and above.type == "parenthesized_expression":
        inner, above = above, above.parent
    if above is not None and (
        above.type == "sizeof_expression" or above.child_by_field_name("argument") == inner
    ):
        return False
    while node.type == "subscript_expression":
        indices, node = indices + 1, part(node, "argument")
    return variable.type is not None and indices < len(variable.type.dimensions)


def touching(cpp: Cpp, scope: Scope, node: Node) -> Touches | None:
    """What in a piece of code may touch what the model has, the first; None where it is outside."""
    try:
        Effects(cpp, scope).check(node)
    except Touches as touches:
        return touches.with_traceback(None)  # whose frames would keep the trees, and it them
    return None
