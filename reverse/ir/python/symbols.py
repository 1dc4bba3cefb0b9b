"""The binder: which names each scope of a file of Python binds, and what a name means in it.

Comprehensions are scopes too, as in Python 3; their variables become locals of the function around
them, with the place added to the name. A generator expression is a function of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field as with_default
from enum import Enum

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.py_tree import Py, field, named, text_of


class ScopeKind(Enum):
    MODULE = "module"
    CLASS = "class"
    FUNCTION = "function"
    LAMBDA = "lambda"
    COMPREHENSION = "comprehension"
    GENERATOR = "generator"


@dataclass(eq=False, slots=True)
class Symbols:
    """A scope: `name` is that of the function or class, unique in the program.

    `bound` counts by name what binds it, `first` is where the first of these ends, `imports` are
    the imports among these; `uses` are the names that are read or bound. `has_yield` of a function
    whose calls make generators.
    """

    kind: ScopeKind
    name: str
    node: Node
    parent: Symbols | None = None
    bound: dict[str, int] = with_default(default_factory=dict)
    first: dict[str, int] = with_default(default_factory=dict)
    imports: dict[str, list[tuple[Node, Node]]] = with_default(default_factory=dict)
    globals: set[str] = with_default(default_factory=set)
    nonlocals: set[str] = with_default(default_factory=set)
    uses: set[str] = with_default(default_factory=set)
    walrus: set[str] = with_default(default_factory=set)
    children: list[Symbols] = with_default(default_factory=list)
    has_yield: bool = False

    @property
    def function(self) -> Symbols:
        """The scope that is lowered to the function in which this stands."""
        scope = self
        while scope.kind is ScopeKind.COMPREHENSION and scope.parent is not None:
            scope = scope.parent
        return scope

    @property
    def owner(self) -> Symbols | None:
        """The innermost class around."""
        scope: Symbols | None = self
        while scope is not None and scope.kind is not ScopeKind.CLASS:
            scope = scope.parent
        return scope

    def mangled(self, name: str) -> str:
        """A private name as Python has it within a class."""
        if not name.startswith("__") or name.endswith("__") or "." in name:
            return name
        owner = self.owner
        plain = text_of(field(owner.node, "name")).lstrip("_") if owner is not None else ""
        return f"_{plain}{name}" if plain else name

    def own_name(self, name: str) -> str:
        """The name of the local variable that a name of this scope is."""
        if self.kind is ScopeKind.COMPREHENSION:
            return f"{name}@{self.node.start_byte}"
        return name


_KINDS = {
    "class_definition": ScopeKind.CLASS,
    "function_definition": ScopeKind.FUNCTION,
    "lambda": ScopeKind.LAMBDA,
    "list_comprehension": ScopeKind.COMPREHENSION,
    "set_comprehension": ScopeKind.COMPREHENSION,
    "dictionary_comprehension": ScopeKind.COMPREHENSION,
    "generator_expression": ScopeKind.GENERATOR,
}
_PATTERNS = frozenset({"pattern_list", "tuple_pattern", "list_pattern", "tuple", "list"})
_STARRED = frozenset({"list_splat_pattern", "list_splat", "splat_pattern", "as_pattern_target"})
_PYTHON_2 = frozenset({"print_statement", "exec_statement"})


class Binder:
    """The scopes of one file, by the nodes that open them."""

    def __init__(self, py: Py, module: str) -> None:
        self.py = py
        self.scopes: dict[int, Symbols] = {}
        self.is_python_2 = False
        self.has_future_division = False
        self.star_imports: list[Node] = []
        self._names: dict[str, int] = {}
        self.module = Symbols(ScopeKind.MODULE, module, py.root)
        self.scopes[py.root.id] = self.module
        self._bind_all(py.root, self.module)
        inner = (s for s in self.scopes.values() if s is not self.module)
        # What functions bind of the module's names.
        self.assigned_globals = {name for s in inner for name in s.globals if name in s.bound}

    def _bind_all(self, root: Node, scope: Symbols) -> None:
        waiting = [(child, scope) for child in reversed(root.named_children)]
        while waiting:
            node, at = waiting.pop()
            waiting += reversed(list(self._enter(node, at)))

    def _enter(self, node: Node, scope: Symbols) -> Iterator[tuple[Node, Symbols]]:
        """Notes what a node binds; gives its children with the scopes they stand in."""
        kind = _KINDS.get(node.type)
        if kind is not None:
            yield from self._open(kind, node, scope)
            return
        self._note(node, scope)
        if node.type in ("keyword_argument", "attribute"):
            part = field(node, "value" if node.type == "keyword_argument" else "object")
            yield part, scope
            return
        for child in node.named_children:
            if child.type != "comment":
                yield child, scope

    def _open(self, kind: ScopeKind, node: Node, scope: Symbols) -> Iterator[tuple[Node, Symbols]]:
        inner = Symbols(kind, self._name(kind, node, scope), node, scope)
        self.scopes[node.id] = inner
        scope.children.append(inner)
        if kind in (ScopeKind.COMPREHENSION, ScopeKind.GENERATOR):
            yield from self._open_comprehension(node, inner, scope)
            return
        if kind is not ScopeKind.LAMBDA:
            bind(scope, text_of(field(node, "name")), node)
        parameters = node.child_by_field_name("parameters")
        for parameter in named(parameters) if parameters is not None else ():
            outer = self._parameter(parameter, inner)
            if outer is not None:
                yield outer, scope
        bases = node.child_by_field_name("superclasses")
        if bases is not None:
            yield bases, scope
        yield field(node, "body"), inner

    def _open_comprehension(
        self, node: Node, inner: Symbols, scope: Symbols
    ) -> Iterator[tuple[Node, Symbols]]:
        """The first iterable stands in the scope around, all else within."""
        is_first = True
        for child in named(node):
            if child.type == "for_in_clause":
                bind_target(inner, field(child, "left"))
                yield field(child, "left"), inner
                yield field(child, "right"), scope if is_first else inner
                is_first = False
            else:
                yield child, inner

    def _parameter(self, node: Node, inner: Symbols) -> Node | None:
        """Binds a parameter; gives its default, which stands in the scope around."""
        match node.type:
            case "identifier":
                bind(inner, text_of(node), node)
            case "default_parameter" | "typed_default_parameter":
                bind_target(inner, field(node, "name"))
                return field(node, "value")
            case "typed_parameter":
                return self._parameter(node.named_children[0], inner)
            case "list_splat_pattern" | "dictionary_splat_pattern":
                bind(inner, text_of(node).lstrip("* "), node)
            case "tuple_pattern":  # of Python 2
                bind_target(inner, node)
            case _:
                pass
        return None

    def _name(self, kind: ScopeKind, node: Node, scope: Symbols) -> str:
        own = text_of(field(node, "name")) if node.child_by_field_name("name") else ""
        own = own or f"<{kind.value}@{node.start_byte}>"
        if kind is ScopeKind.COMPREHENSION:
            return scope.function.name
        around = scope.function
        name = f"{around.name}{':' if around.parent is None else '.'}{own}"
        count = self._names[name] = self._names.get(name, 0) + 1
        return name if count == 1 else f"{name}#{count}"

    def _note(self, node: Node, scope: Symbols) -> None:
        match node.type:
            case "identifier":
                use = scope.mangled(text_of(node))
                scope.uses.add(use)
            case "assignment" | "augmented_assignment":
                bind_target(scope, field(node, "left"), node)
            case "for_statement":
                bind_target(scope, field(node, "left"))
            case "named_expression":
                around = scope.function
                name = text_of(field(node, "name"))
                bind(around, name, node)
                around.walrus.add(around.mangled(name))
            case "as_pattern_target":
                for target in named(node):
                    bind_target(scope, target)
            case "except_clause":
                values = node.children_by_field_name("value")
                for target in values[1:]:  # of Python 2
                    bind_target(scope, target)
            case "delete_statement":
                for target in named(node):
                    bind_target(scope, target)
            case "global_statement":
                scope.globals |= {scope.mangled(text_of(c)) for c in named(node)}
            case "nonlocal_statement":
                scope.nonlocals |= {scope.mangled(text_of(c)) for c in named(node)}
            case "import_statement" | "import_from_statement" | "future_import_statement":
                self._note_import(node, scope)
            case "case_clause":
                for target in _captures(node):
                    bind(scope, text_of(target), target)
            case "yield":
                scope.function.has_yield = True
            case other if other in _PYTHON_2:
                self.is_python_2 = True
            case _:
                pass

    def _note_import(self, node: Node, scope: Symbols) -> None:
        names = node.children_by_field_name("name")
        if node.type == "future_import_statement":
            self.has_future_division |= any("division" in text_of(n) for n in names)
        for name in names:
            target = imported_name(name)
            bind(scope, target, node)
            scope.imports.setdefault(scope.mangled(target), []).append((node, name))
        if any(c.type == "wildcard_import" for c in node.named_children):
            self.star_imports.append(node)


def imported_name(name: Node) -> str:
    """The name that a part of an import binds."""
    alias = name.child_by_field_name("alias")
    return text_of(alias) if alias is not None else text_of(name).partition(".")[0]


def bind(scope: Symbols, name: str, node: Node) -> None:
    """A scope binds a name once more, at the end of a node."""
    name = scope.mangled(name)
    scope.bound[name] = scope.bound.get(name, 0) + 1
    scope.first.setdefault(name, node.end_byte)


def bind_target(scope: Symbols, target: Node, within: Node | None = None) -> None:
    """A scope binds the names of a target, at the end of the assignment that it is within."""
    if target.type == "identifier":
        bind(scope, text_of(target), within or target)
    elif target.type in _PATTERNS or target.type in _STARRED or _is_group(target):
        for inner in named(target):
            bind_target(scope, inner, within)


def _is_group(node: Node) -> bool:
    return node.type in ("parenthesized_expression", "expression_list", "as_pattern_target")


def _captures(clause: Node) -> Iterator[Node]:
    """The names that the patterns of a case bind."""
    waiting = [c for c in named(clause) if c.type == "case_pattern"]
    while waiting:
        node = waiting.pop()
        children = named(node)
        match node.type:
            case "dotted_name" if len(children) == 1:
                yield children[0]
            case "as_pattern":
                waiting.append(children[0])
                yield children[-1]
            case "splat_pattern":
                yield from (c for c in children if text_of(c) != "_")
            case "class_pattern":
                waiting += children[1:]
            case "keyword_pattern":
                waiting += children[1:]
            case _:
                waiting += children
