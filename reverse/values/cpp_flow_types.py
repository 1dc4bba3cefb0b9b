"""The classes of expressions, as far as declarations in the files tell them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_declarations import unscoped
from rebsync.reverse.syntax.cpp_index import CppClass, CppField, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of, unqualified
from rebsync.reverse.values.cpp_flow import Texts, declaration_of, made_of, nearness, scope_of

HOLDERS = frozenset(
    {
        *("shared_ptr", "unique_ptr", "scoped_ptr", "weak_ptr", "intrusive_ptr", "optional"),
        *("vector", "array", "deque", "list", "set", "atomic", "reference_wrapper"),
    }
)
_LISTS = frozenset({"vector", "array", "initializer_list"})
_MAPS = frozenset({"map", "unordered_map"})
# Methods that give what a holder has, and those that give the type they are called with.
_HELD = frozenset({"get", "front", "back", "at", "lock", "value"})
_TYPED = frozenset({"as", "get", "cast", "param", "value"})
POINTERS = frozenset(
    {
        *("Ptr", "ConstPtr", "SharedPtr", "ConstSharedPtr", "UniquePtr", "ConstUniquePtr"),
        *("WeakPtr", "ConstWeakPtr"),
    }
)
_OWN_MAKERS = frozenset({"make_shared", "make_unique"})
_MAKERS = frozenset({"make_shared", "make_unique", "static_pointer_cast", "allocate_shared"})


@dataclass(frozen=True, eq=False)
class Variable:
    """What a name in an expression stands for.

    `name` is the place that declares it; `scope` the code in which a local can be named; `index`
    that of a function's parameter; `owner` the class that a member belongs to.
    """

    kind: str  # local, parameter, lambda, member, global
    text: str
    cpp: Cpp
    name: Node
    type: Node | None
    scope: Node | None = None
    owner: CppClass | None = None
    field: CppField | None = None
    index: int = 0


@dataclass(slots=True)
class Types:
    """Finds out what names stand for and which classes expressions are of."""

    texts: Texts
    _variables: dict[int, Variable | None] = field(default_factory=dict)
    _locals: dict[tuple[int, str], list[tuple[int, int, Variable]]] = field(default_factory=dict)
    _plain: dict[int, str] = field(default_factory=dict)
    _types: dict[int, str] = field(default_factory=dict)

    # --- variables ------------------------------------------------------------------------------

    def variable(self, cpp: Cpp, node: Node) -> Variable | None:
        """What a name stands for where it is; None for what no file declares."""
        if node.id not in self._variables:
            name = text_of(node).rpartition("::")[2]
            self._variables[node.id] = (
                self._local(cpp, node, name)
                or self._member(cpp, node, name)
                or self._global(cpp, name)
            )
        return self._variables[node.id]

    def _local(self, cpp: Cpp, node: Node, name: str) -> Variable | None:
        function = self.texts.function_around(cpp, node)
        if function is None or node.type == "qualified_identifier":
            return None
        key = function.node.id, name
        if key not in self._locals:
            self._locals[key] = list(self._declared(function, name))
        at = node.start_byte
        seen = [v for v in self._locals[key] if v[0] <= at < v[1] and v[2].name.start_byte <= at]
        return max(seen, key=lambda v: v[0])[2] if seen else None

    def _declared(self, function: CppFunction, name: str) -> Iterator[tuple[int, int, Variable]]:
        """The local variables of a name, with the bytes between which they can be named."""
        home, cpp = function.node, function.cpp
        places = self.texts.within(cpp, name, home.start_byte, home.end_byte)
        for place in reversed(places):
            declaration = declaration_of(place)
            scope = scope_of(declaration) if declaration is not None else None
            if declaration is None or scope is None:
                continue
            kind, index = "local", 0
            if declaration.type.endswith("parameter_declaration"):
                kind, index = _parameter(function, declaration, scope)
            type_ = declaration.child_by_field_name("type")
            variable = Variable(kind, name, cpp, place, type_, scope, index=index)
            yield scope.start_byte, scope.end_byte, variable

    def _member(self, cpp: Cpp, node: Node, name: str) -> Variable | None:
        class_ = self.texts.class_of(self.texts.function_around(cpp, node))
        if class_ is None:
            around = self.texts.class_node_around(node)
            label = around.child_by_field_name("name") if around is not None else None
            class_ = self.texts.class_near(unscoped(label), cpp) if label is not None else None
        return self.member(class_, name)

    def member(self, class_: CppClass | None, name: str) -> Variable | None:
        """The member variable of a class, or of those it descends from."""
        for owner in self.texts.lineage(class_):
            for member in (*owner.fields, *owner.others):
                if member.name == name:
                    place = member.cpp, member.node, member.type
                    return Variable("member", name, *place, owner=owner, field=member)
        return None

    def _global(self, cpp: Cpp, name: str) -> Variable | None:
        found = self.texts.code.variables.get(name)
        if not found:
            return None
        best = max(found, key=lambda f: (nearness(f.cpp, cpp), f.value is not None))
        return Variable("global", name, best.cpp, best.node, best.type, field=best)

    def holds_several(self, cpp: Cpp, node: Node) -> bool:
        """Whether an expression is the name of a variable that holds a list or a map."""
        variable = self.variable(cpp, node) if node.type == "identifier" else None
        return variable is not None and (is_list(variable) or _template_of(variable) in _MAPS)

    # --- types ----------------------------------------------------------------------------------

    def plain(self, cpp: Cpp, type_: Node | None, depth: int = 0) -> str:
        """A type without what holds or points to it, other names for types replaced.

        Scopes are kept and arguments of templates dropped: `ros::NodeHandle`.
        """
        if type_ is None or depth > 8:
            return ""
        if type_.id not in self._plain:
            self._plain[type_.id] = self._plainly(cpp, type_, depth)
        return self._plain[type_.id]

    def _plainly(self, cpp: Cpp, type_: Node, depth: int) -> str:
        if type_.type in ("type_descriptor", "dependent_type"):
            inner = type_.child_by_field_name("type") or type_.named_children[-1]
            return self.plain(cpp, inner, depth + 1)
        last = unqualified(type_)
        if last.type == "template_type":
            own = text_of(part(last, "name"))
            given = named(part(last, "arguments"))
            if own in HOLDERS and given:
                return self.plain(cpp, given[0], depth + 1)
            if own in _MAPS and len(given) > 1:
                return self.plain(cpp, given[1], depth + 1)
            return text_of(type_).partition("<")[0].replace(" ", "")
        return self._named_type(cpp, type_, last, depth)

    def _named_type(self, cpp: Cpp, type_: Node, last: Node, depth: int) -> str:
        name = text_of(last)
        if name in POINTERS and type_.type == "qualified_identifier":
            return "".join(text_of(type_).split()).rpartition("::")[0]
        if (alias := self.texts.renamed(cpp, type_)) is not None:
            return self.plain(alias.cpp, alias.type, depth + 1)
        return self.texts.pointed_to(name) or "".join(text_of(type_).split())

    def type_of(self, cpp: Cpp, node: Node, depth: int = 0) -> str:
        """The type of an expression, as `plain` gives it; empty if it is not known."""
        if node.id not in self._types:
            self._types[node.id] = ""  # while it is looked for
            self._types[node.id] = self._type_of(cpp, node, depth) if depth < 12 else ""
        return self._types[node.id]

    def _type_of(self, cpp: Cpp, node: Node, depth: int) -> str:
        match node.type:
            case "this":
                function = self.texts.function_around(cpp, node)
                return function.owner if function is not None else ""
            case "identifier" | "qualified_identifier" | "type_identifier" | "field_identifier":
                return self._type_of_variable(cpp, node, depth)
            case "field_expression":
                owner = self.class_of(cpp, part(node, "argument"), depth + 1)
                member = self.member(owner, text_of(part(node, "field")))
                return self.plain(member.cpp, member.type) if member is not None else ""
            case "pointer_expression" | "subscript_expression":
                return self.type_of(cpp, part(node, "argument"), depth + 1)
            case "parenthesized_expression":
                inner = named(node)
                return self.type_of(cpp, inner[0], depth + 1) if inner else ""
            case "call_expression":
                return self._type_of_call(cpp, node, depth)
            case "new_expression" | "compound_literal_expression" | "cast_expression":
                return self.plain(cpp, part(node, "type"))
            case "assignment_expression":
                return self.type_of(cpp, part(node, "right"), depth + 1)
            case _:
                return ""

    def _type_of_variable(self, cpp: Cpp, node: Node, depth: int) -> str:
        variable = self.variable(cpp, node)
        if variable is None:
            return ""
        if variable.type is not None and variable.type.type == "placeholder_type_specifier":
            given = made_of(variable.name)
            return self.type_of(variable.cpp, given[0], depth + 1) if given else ""
        return self.plain(variable.cpp, variable.type)

    def _type_of_call(self, cpp: Cpp, node: Node, depth: int) -> str:
        function = part(node, "function")
        if text_of(function).rpartition(">")[2] in libraries.own_handles():
            return next(iter(libraries.handles()))
        if function.type == "field_expression":
            name = unscoped_member(part(function, "field"))
            owner = self.class_of(cpp, part(function, "argument"), depth + 1)
            if owner is not None:
                return self._result(owner, name)
            method = part(function, "field")
            if method.type == "template_method":
                given = named(part(method, "arguments"))
                return self.plain(cpp, given[0]) if given and name in _TYPED else ""
            if name in _HELD:
                return self.type_of(cpp, part(function, "argument"), depth + 1)
            return ""
        last = unqualified(function)
        if last is not function and text_of(last) in _OWN_MAKERS:
            return "".join(text_of(function).split()).rpartition("::")[0]
        if last.type in ("template_function", "template_type"):
            given = named(part(last, "arguments"))
            if text_of(part(last, "name")) in _MAKERS and given:
                return self.plain(cpp, given[0])
            last = part(last, "name")
        name = text_of(last)
        around = self.texts.class_of(self.texts.function_around(cpp, node))
        if found := self._result(around, name):
            return found
        for definition in self.texts.code.definitions.get(("", name), []):
            return self.plain(definition.cpp, definition.result)
        return "".join(text_of(function).split()).partition("<")[0]

    def _result(self, owner: CppClass | None, name: str) -> str:
        function = self.texts.giving(owner, name)
        return self.plain(function.cpp, function.result) if function is not None else ""

    def class_of(self, cpp: Cpp, node: Node, depth: int = 0) -> CppClass | None:
        """The class that an expression is of, if it is in the files."""
        type_ = self.type_of(cpp, node, depth)
        return self.texts.class_near(type_.rpartition("::")[2], cpp) if type_ else None


def unscoped_member(name: Node) -> str:
    """The name of a method, without the arguments of a template."""
    while name.type in ("template_method", "template_function", "dependent_name"):
        name = name.child_by_field_name("name") or name.named_children[-1]
    return text_of(name)


def is_list(variable: Variable) -> bool:
    """Whether a variable is an array, or a vector of the standard library."""
    above = variable.name.parent
    if above is not None and above.type == "array_declarator":
        return True
    return _template_of(variable) in _LISTS


def _template_of(variable: Variable) -> str:
    """The name of the template that a variable is an object of; empty for what is of none."""
    type_ = unqualified(variable.type) if variable.type is not None else None
    if type_ is None or type_.type != "template_type":
        return ""
    return text_of(part(type_, "name"))


def _parameter(function: CppFunction, declaration: Node, scope: Node) -> tuple[str, int]:
    """Whether a parameter is one of the function itself, and which."""
    if scope != function.node:
        return "lambda", 0
    for index, parameter in enumerate(function.parameters):
        if parameter.node == declaration:
            return "parameter", index
    return "lambda", 0
