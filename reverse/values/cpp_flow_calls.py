"""Which functions a call may reach, and which places call a function or hand it on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_calls import call_around
from rebsync.reverse.syntax.cpp_index import CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, default_of, named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts, declaration_of, made_of, nearness
from rebsync.reverse.values.cpp_flow_types import Types, unscoped_member
from rebsync.reverse.values.cpp_values_plain import NUMBERS, Use

_HANDED = frozenset({"bind", "thread", "async", "createThread", "create_thread", "Thread"})
_TYPE_PARTS = frozenset(
    {"template_type", "qualified_identifier", "type_descriptor", "template_argument_list"}
)


@dataclass(slots=True)
class Calls:
    """Finds the functions of calls and the calls of functions."""

    texts: Texts
    types: Types
    _uses: dict[int, list[Use]] = field(default_factory=dict)
    _functions: dict[int, list[CppFunction]] = field(default_factory=dict)
    _made: dict[int, list[Use]] = field(default_factory=dict)

    # --- from a call to functions ---------------------------------------------------------------

    def functions(self, cpp: Cpp, call: Node) -> list[CppFunction]:
        """The functions with a body that a call may reach; empty where none is in the files."""
        if call.id not in self._functions:
            self._functions[call.id] = self._reached(cpp, call)
        return self._functions[call.id]

    def _reached(self, cpp: Cpp, call: Node) -> list[CppFunction]:
        function = part(call, "function")
        given = named(part(call, "arguments"))
        found = [f for f in self._named(cpp, function) if self.fits(f, len(given))]
        return [f for f in found if self.takes(f, cpp, given)] if len(found) > 1 else found

    def _named(self, cpp: Cpp, function: Node) -> list[CppFunction]:
        if function.type == "field_expression":
            name = unscoped_member(part(function, "field"))
            argument = part(function, "argument")
            owner = self.types.class_of(cpp, argument)
            if owner is None:
                return [] if self.types.type_of(cpp, argument) else self._only(name)
            return self._methods(owner, name, argument.type != "this")
        scope, last = "", function
        while last.type == "qualified_identifier":
            above = last.child_by_field_name("scope")
            scope = text_of(above).partition("<")[0] if above is not None else ""
            last = part(last, "name")
        if last.type == "template_function":
            last = part(last, "name")
        name = text_of(last)
        if scope and (owner := self.texts.class_near(scope, cpp)) is not None:
            return self._methods(owner, name, False)
        around = self.texts.class_of(self.texts.function_around(cpp, function))
        if not scope and around is not None and (found := self._methods(around, name, True)):
            return found
        free = self.texts.code.definitions.get(("", name), [])
        if len(free) < 2:
            return free
        near = [nearness(f.cpp, cpp) for f in free]
        best = max(near)
        return [f for f, of in zip(free, near, strict=True) if of == best]

    def _only(self, name: str) -> list[CppFunction]:
        """The methods of a name, if those of one class and its descendants only have it."""
        found = [
            f for (o, n), fs in self.texts.code.definitions.items() if n == name and o for f in fs
        ]
        for classes in self.texts.code.all_classes.values():
            found += [f for c in classes for f in c.functions if f.name == name and f.body]
        owners = {f.owner for f in found}
        return found if len(owners) == 1 else []

    def _methods(self, owner: CppClass, name: str, overridden: bool) -> list[CppFunction]:
        """The methods of a class, and those that override them."""
        found: list[CppFunction] = []
        for class_ in self.texts.lineage(owner):
            own = self.bodies(class_, name)
            if own or any(f.name == name for f in class_.functions):
                found += own
                break
        if overridden and found_or_pure(self.texts, owner, name):
            for below in self.texts.descendants(owner):
                found += self.bodies(below, name)
        return found

    def bodies(self, class_: CppClass, name: str) -> list[CppFunction]:
        """The functions of a class with a name that have a body, wherever it is."""
        found = [f for f in class_.functions if f.name == name and f.body is not None]
        apart = self.texts.code.definitions.get((class_.name, name), [])
        return found + [f for f in apart if self.texts.class_of(f) is class_]

    # --- from a function to its uses ------------------------------------------------------------

    def uses(self, function: CppFunction) -> list[Use]:
        """The places that call a function, or hand it to a bind or thread with arguments."""
        key = function.node.id
        if key not in self._uses:
            self._uses[key] = []  # while they are looked for
            self._uses[key] = list(self._uses_of(function))
        return self._uses[key]

    def _uses_of(self, function: CppFunction) -> Iterator[Use]:
        class_ = self.texts.class_of(function)
        if class_ is not None and function.name == class_.name:
            for use in self.made(class_):
                fits = self.fits(function, len(use.arguments))
                if fits and self.takes(function, use.cpp, use.arguments):
                    yield use
            return
        for cpp, place in self.texts.everywhere(function.name):
            call = _called_by(place)
            if call is not None:
                if any(f.node == function.node for f in self.functions(cpp, call)):
                    given = tuple(named(part(call, "arguments")))
                    home = self.texts.function_around(cpp, call)
                    yield Use(cpp, call, given, home, _in_lambda(call))
                continue
            if (handed := self._handed(cpp, place, function, class_)) is not None:
                yield handed

    def fits(self, function: CppFunction, count: int) -> bool:
        """Whether a function can be called with so many arguments."""
        if count > len(function.parameters):
            return False
        return all(
            self.default(function, index) is not None
            for index in range(count, len(function.parameters))
        )

    def takes(self, function: CppFunction, cpp: Cpp, given: Sequence[Node]) -> bool:
        """Whether the kinds of arguments are those of the parameters, as far as they are known."""
        for argument, parameter in zip(given, function.parameters, strict=False):
            wanted = _kind(self.types.plain(function.cpp, parameter.type))
            kind = _literal(argument) or _kind(self.types.type_of(cpp, argument))
            if wanted and kind and wanted != kind:
                return False
        return True

    def default(self, function: CppFunction, index: int) -> tuple[Cpp, Node] | None:
        """The default of a parameter, which the declaration in a class may give."""
        declared = [function]
        class_ = self.texts.class_of(function)
        if class_ is not None:
            same = [f for f in class_.functions if f.name == function.name]
            declared += [f for f in same if f.types == function.types]
        for candidate in declared:
            if index < len(candidate.parameters):
                value = default_of(candidate.parameters[index].node)
                if value is not None:
                    return candidate.cpp, value
        return None

    def _use(self, cpp: Cpp, node: Node, arguments: tuple[Node, ...]) -> Use:
        return Use(cpp, node, arguments, self.texts.function_around(cpp, node))

    def _handed(
        self, cpp: Cpp, place: Node, function: CppFunction, class_: CppClass | None
    ) -> Use | None:
        """`bind(&C::f, this, x)`, `thread(f, x)`: the function with its arguments."""
        around = place.parent
        argument = place
        while around is not None and around.type in (
            *("qualified_identifier", "pointer_expression", "template_function"),
            "parenthesized_expression",
        ):
            argument, around = around, around.parent
        if around is None or around.type != "argument_list" or around.parent is None:
            return None
        given = named(around)
        rest = given[given.index(argument) + 1 :] if argument in given else []
        if class_ is not None:
            rest = rest[1:]
        if around.parent.type == "call_expression":
            name = text_of(part(around.parent, "function")).partition("<")[0]
            if name.rpartition("::")[2].rpartition(".")[2] not in _HANDED:
                return None
        if not rest or len(rest) > len(function.parameters):
            return None
        home = self.texts.function_around(cpp, around)
        return Use(cpp, around.parent, tuple(rest), home, True)

    def made(self, class_: CppClass) -> list[Use]:
        """The places that make an object of a class."""
        key = class_.node.id
        if key not in self._made:
            self._made[key] = []
            found: list[Use] = []
            for name in self.texts.names(class_):
                for cpp, place in self.texts.everywhere(name):
                    if self.texts.class_near(name, cpp) is class_:
                        found += self._makes(cpp, place)
            same = {(u.node.id, *(a.id for a in u.arguments)): u for u in found}
            self._made[key] = list(same.values())
        return self._made[key]

    def _makes(self, cpp: Cpp, place: Node) -> Iterator[Use]:
        node, above = place, place.parent
        while above is not None and above.type in _TYPE_PARTS:
            if above.type == "template_argument_list":
                yield from self._by_maker(cpp, above)
                return
            node, above = above, above.parent
        if above is None:
            return
        match above.type:
            case "template_function" | "template_method":
                if (outer := call_around(above)) is not None:
                    yield self._use(cpp, outer, tuple(named(part(outer, "arguments"))))
                elif above.parent is not None and above.parent.type == "field_initializer":
                    yield self._use(cpp, above.parent, _initialised(above.parent))
            case "new_expression" | "compound_literal_expression":
                arguments = above.child_by_field_name("arguments") or above.child_by_field_name(
                    "value"
                )
                given = tuple(named(arguments)) if arguments is not None else ()
                yield self._use(cpp, above, given)
            case "call_expression" if part(above, "function") == node:
                yield self._use(cpp, above, tuple(named(part(above, "arguments"))))
            case "field_initializer":
                yield self._use(cpp, above, _initialised(above))
            case "declaration":
                for declarator in above.children_by_field_name("declarator"):
                    name = _name_in(declarator)
                    if name is not None and declaration_of(name) is not None:
                        yield self._use(cpp, above, made_of(name) or ())
            case "field_declaration":
                for declarator in above.children_by_field_name("declarator"):
                    if declarator.type == "field_identifier":
                        yield from self._as_member(declarator)
            case _:
                return

    def _by_maker(self, cpp: Cpp, arguments: Node) -> Iterator[Use]:
        """`make_shared<C>(x)`."""
        function, call = arguments.parent, call_around(arguments)
        if function is None or function.type != "template_function" or call is None:
            return
        if text_of(part(function, "name")).startswith("make_"):
            yield self._use(cpp, call, tuple(named(part(call, "arguments"))))

    def _as_member(self, declarator: Node) -> Iterator[Use]:
        """A member that is an object of the class: made by the initialisers of constructors."""
        for other, place in self.texts.everywhere(text_of(declarator)):
            above = place.parent
            if above is not None and above.type == "field_initializer":
                yield self._use(other, above, _initialised(above))


def found_or_pure(texts: Texts, owner: CppClass, name: str) -> bool:
    """Whether a class or one above declares a method."""
    return any(f.name == name for c in texts.lineage(owner) for f in c.functions)


def _kind(type_: str) -> str:
    """What may stand for a type: a number, a text, or an object of a class."""
    name = type_.rpartition("::")[2]
    if name in NUMBERS and name != "char":
        return "number"
    if name in libraries.handles():
        return "handle"
    return "text" if type_ == "std::string" else ""


def _literal(node: Node) -> str:
    match node.type:
        case "string_literal" | "concatenated_string":
            return "text"
        case "number_literal" | "true" | "false":
            return "number"
        case _:
            return ""


def _in_lambda(node: Node) -> bool:
    """Whether a node is in a lambda, which runs when something else calls it."""
    above = climb(node, lambda n: n.type in ("lambda_expression", "function_definition"))
    return above is not None and above.type == "lambda_expression"


def _called_by(place: Node) -> Node | None:
    """The call whose function a name is, if it is one."""
    node, above = place, place.parent
    while above is not None and above.type in (
        *("qualified_identifier", "template_function", "template_method", "field_expression"),
        "dependent_name",
    ):
        if above.type == "field_expression" and part(above, "field") != node:
            return None
        if above.type == "qualified_identifier" and part(above, "name") != node:
            return None
        node, above = above, above.parent
    if above is None or above.type != "call_expression" or part(above, "function") != node:
        return None
    return above


def _initialised(initializer: Node) -> tuple[Node, ...]:
    lists = [n for n in initializer.named_children if n.type.endswith("_list")]
    return tuple(named(lists[-1])) if lists else ()


def _name_in(declarator: Node) -> Node | None:
    while declarator.type not in ("identifier", "field_identifier"):
        inner = declarator.child_by_field_name("declarator")
        if inner is None or declarator.type in ("pointer_declarator", "reference_declarator"):
            return None  # a pointer makes no object
        declarator = inner
    return declarator
