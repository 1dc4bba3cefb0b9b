"""The declarations of the C++ files of a package: classes, functions, constants.

Header and source are read together: a function's body is looked for wherever it is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.cpp_calls import CppCall, calls_in
from rebsync.reverse.cpp_tree import Cpp, markers_above, markers_beside, named, parse, part, text_of
from rebsync.source import Source

_HEADERS = (".h", ".hh", ".hpp", ".hxx")
_CONTAINERS = frozenset(
    {
        *("translation_unit", "namespace_definition", "declaration_list", "ERROR"),
        *("linkage_specification", "preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif"),
        *("preproc_elifdef", "template_declaration"),
    }
)


@dataclass(frozen=True, slots=True)
class CppParameter:
    """A parameter; its name is empty where the code gives none."""

    name: str
    type: Node
    node: Node


@dataclass(frozen=True, slots=True)
class CppFunction:
    """A function, declared or defined; `owner` is the class it belongs to, or empty."""

    name: str
    owner: str
    parameters: tuple[CppParameter, ...]
    result: Node | None
    body: Node | None
    initialisers: Node | None
    markers: tuple[str, ...]
    cpp: Cpp
    node: Node
    pure: bool = False
    overrides: bool = False

    @property
    def types(self) -> tuple[str, ...]:
        """The parameters' types as text, which tells overloads apart."""
        return tuple("".join(text_of(p.type).split()) for p in self.parameters)


@dataclass(frozen=True, slots=True)
class CppField:
    """A member variable."""

    name: str
    type: Node
    value: Node | None
    markers: tuple[str, ...]
    cpp: Cpp
    node: Node


@dataclass(frozen=True, slots=True)
class CppClass:
    """A class with a body; its functions are as declared in it, in their order."""

    name: str
    bases: tuple[str, ...]
    fields: tuple[CppField, ...]
    functions: tuple[CppFunction, ...]
    markers: tuple[str, ...]
    cpp: Cpp
    node: Node


@dataclass(slots=True)
class Code:
    """All declarations of some files."""

    classes: dict[str, CppClass] = field(default_factory=dict)
    definitions: dict[tuple[str, str], list[CppFunction]] = field(default_factory=dict)
    constants: dict[tuple[str, str], tuple[Cpp, Node]] = field(default_factory=dict)
    _calls: dict[int, tuple[CppCall, ...]] = field(default_factory=dict)
    _visible: dict[str, dict[str, tuple[Cpp, Node]]] = field(default_factory=dict)

    @staticmethod
    def of(files: Iterable[Cpp]) -> Code:
        """The declarations of these files."""
        code = Code()
        for cpp in files:
            code._add(cpp, cpp.root)
        return code

    def lineage(self, name: str) -> list[CppClass]:
        """A class and those it descends from, as far as they are known, nearest first."""
        found: dict[str, CppClass] = {}
        waiting = [name]
        while waiting:
            current = self.classes.get(waiting.pop(0))
            if current is not None and current.name not in found:
                found[current.name] = current
                waiting += current.bases
        return list(found.values())

    def functions_of(self, owner: CppClass) -> Iterator[CppFunction]:
        """The functions of a class, with their bodies where these are known."""
        for declared in owner.functions:
            yield self._defined(declared) or declared

    def calls_of(self, function: CppFunction) -> tuple[CppCall, ...]:
        """The calls in a function's body."""
        if function.body is None:
            return ()
        if function.body.id not in self._calls:
            self._calls[function.body.id] = tuple(calls_in(function.body))
        return self._calls[function.body.id]

    def constant(self, cpp: Cpp, name: str) -> tuple[Cpp, Node] | None:
        """The value of a constant of a file."""
        return self.constants.get((cpp.source.path, name))

    def constants_for(self, cpp: Cpp) -> dict[str, tuple[Cpp, Node]]:
        """The constants that a file can name: its own, and those of headers that agree on them."""
        if cpp.source.path not in self._visible:
            self._visible[cpp.source.path] = self._constants_for(cpp)
        return self._visible[cpp.source.path]

    def _constants_for(self, cpp: Cpp) -> dict[str, tuple[Cpp, Node]]:
        found: dict[str, tuple[Cpp, Node]] = {}
        differing = set()
        for (path, name), value in self.constants.items():
            if path.endswith(_HEADERS):
                before = found.setdefault(name, value)
                if text_of(before[1]) != text_of(value[1]):
                    differing.add(name)
        own = {n: v for (path, n), v in self.constants.items() if path == cpp.source.path}
        return {n: v for n, v in found.items() if n not in differing} | own

    def _defined(self, declared: CppFunction) -> CppFunction | None:
        if declared.body is not None:
            return None
        found = self.definitions.get((declared.owner, declared.name), [])
        return next((f for f in found if f.types == declared.types), None)

    # --- collecting -----------------------------------------------------------------------------

    def _add(self, cpp: Cpp, node: Node) -> None:
        for child in node.named_children:
            if child.type in _CONTAINERS:
                self._add(cpp, child)
            elif child.type in ("class_specifier", "struct_specifier"):
                self._add_class(cpp, child)
            elif child.type == "function_definition" or _only_braces(child):
                if (function := function_of(cpp, child, "")) is not None:
                    place = function.owner, function.name
                    self.definitions.setdefault(place, []).append(function)
            elif child.type == "declaration":
                self._add_constants(cpp, child)
            elif child.type == "preproc_def":
                self._add_macro(cpp, child)

    def _add_class(self, cpp: Cpp, node: Node) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if name is None or body is None:
            return
        fields: list[CppField] = []
        functions: list[CppFunction] = []
        for member in named(body):
            function = function_of(cpp, member, text_of(name))
            if function is not None:
                functions.append(function)
            elif member.type == "field_declaration" and _is_constant(member):
                for declarator, value in _valued(member):
                    self.constants[cpp.source.path, text_of(declarator)] = cpp, value
            elif member.type == "field_declaration":
                fields += _fields(cpp, member)
        bases = tuple(_bases(node))
        read = CppClass(
            text_of(name), bases, tuple(fields), tuple(functions), markers_above(node), cpp, node
        )
        self.classes.setdefault(read.name, read)

    def _add_constants(self, cpp: Cpp, node: Node) -> None:
        if not _is_constant(node):
            return
        for declarator in node.children_by_field_name("declarator"):
            if declarator.type == "init_declarator":
                name, value = part(declarator, "declarator"), part(declarator, "value")
                self.constants[cpp.source.path, text_of(name)] = cpp, value

    def _add_macro(self, cpp: Cpp, node: Node) -> None:
        """`#define LIMIT 8`: the text as an expression, if it is one."""
        name, text = node.child_by_field_name("name"), node.child_by_field_name("value")
        if name is None or text is None:
            return
        inside = parse(Source(cpp.source.path, f"const auto x = {text_of(text)};"))
        declaration = inside.root.named_children[0] if inside.root.named_children else None
        if declaration is None or inside.root.has_error or declaration.type != "declaration":
            return
        declarator = part(declaration, "declarator")
        if (value := declarator.child_by_field_name("value")) is not None:
            self.constants[cpp.source.path, text_of(name)] = inside, value


def function_of(cpp: Cpp, node: Node, owner: str) -> CppFunction | None:
    """The function that a node declares or defines, if it is one; `owner` is the class around."""
    if node.type not in ("function_definition", "field_declaration", "declaration"):
        return None
    declarator = node.child_by_field_name("declarator")
    while declarator is not None and declarator.type in (
        "reference_declarator",
        "pointer_declarator",
    ):
        declarator = declarator.named_children[-1] if declarator.named_children else None
    body = node.child_by_field_name("body")
    if declarator is not None and _only_braces(node):
        body, declarator = part(declarator, "value"), part(declarator, "declarator")
    if declarator is None or declarator.type != "function_declarator":
        return None
    name = part(declarator, "declarator")
    if name.type == "qualified_identifier":
        owner, name = text_of(part(name, "scope")), part(name, "name")
    value = node.child_by_field_name("default_value")
    lists = [c for c in node.named_children if c.type == "field_initializer_list"]
    return CppFunction(
        text_of(name),
        owner,
        tuple(_parameters(part(declarator, "parameters"))),
        node.child_by_field_name("type"),
        body,
        lists[0] if lists else None,
        markers_above(node),
        cpp,
        node,
        pure=value is not None and text_of(value) == "0",
        overrides=any(c.type == "virtual_specifier" for c in declarator.named_children),
    )


def _only_braces(node: Node) -> bool:
    """Whether it is `void f() { {} }`, which the grammar takes for a variable."""
    declarator = node.child_by_field_name("declarator")
    if node.type != "declaration" or declarator is None or declarator.type != "init_declarator":
        return False
    function, value = part(declarator, "declarator"), part(declarator, "value")
    return function.type == "function_declarator" and value.type == "initializer_list"


def _parameters(node: Node) -> Iterator[CppParameter]:
    for parameter in named(node):
        if parameter.type not in ("parameter_declaration", "optional_parameter_declaration"):
            continue
        name = parameter.child_by_field_name("declarator")
        while name is not None and name.type in ("reference_declarator", "pointer_declarator"):
            name = name.named_children[-1] if name.named_children else None
        yield CppParameter(text_of(name) if name else "", part(parameter, "type"), parameter)


def _is_constant(node: Node) -> bool:
    """Whether a declaration is of constants: `const` or `constexpr`, and of no pointer."""
    qualifiers = {text_of(c) for c in node.named_children if c.type == "type_qualifier"}
    return bool(qualifiers & {"const", "constexpr"})


def _valued(node: Node) -> Iterator[tuple[Node, Node]]:
    """The member constants of a declaration with their values."""
    declarators = node.children_by_field_name("declarator")
    value = node.child_by_field_name("default_value")
    if value is not None and len(declarators) == 1:
        yield declarators[0], value


def _fields(cpp: Cpp, node: Node) -> Iterator[CppField]:
    declarators = node.children_by_field_name("declarator")
    value = node.child_by_field_name("default_value")
    for declarator in declarators:
        if declarator.type == "field_identifier":
            only = value if len(declarators) == 1 else None
            markers = (*markers_above(node), *markers_beside(node))
            yield CppField(text_of(declarator), part(node, "type"), only, markers, cpp, node)


def _bases(node: Node) -> Iterator[str]:
    for clause in node.named_children:
        if clause.type == "base_class_clause":
            for base in clause.named_children:
                if base.type in ("type_identifier", "qualified_identifier"):
                    yield text_of(base).rpartition("::")[2]
