"""What the files of Python declare: scopes, the names bound in each, attributes, and calls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import field as with_default
from dataclasses import replace
from pathlib import PurePosixPath

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.py_bindings import BINDING, Binding, bindings_of
from rebsync.reverse.syntax.py_tree import Py, decorators_of, field, named, text_of

MODULE, CLASS, FUNCTION, LAMBDA = "module", "class", "function", "lambda"


@dataclass(eq=False, slots=True)
class Scope:
    """A module, class, function or lambda, and what is bound in it by its name.

    `attributes` of a class are those that its methods set on their object; `stores` of a function
    those that it sets on other objects, by the text of the object.
    """

    kind: str
    name: str
    node: Node
    py: Py
    parent: Scope | None = None
    names: dict[str, list[Binding]] = with_default(default_factory=dict)
    attributes: dict[str, list[Binding]] = with_default(default_factory=dict)
    stores: dict[tuple[str, str], list[Binding]] = with_default(default_factory=dict)
    outer: set[str] = with_default(default_factory=set)
    returns: list[Node] = with_default(default_factory=list)
    # What the text says does not change: it is read once.
    _decorators: list[str] | None = None
    _parameters: list[PyParameter] | None = None

    @property
    def owner(self) -> Scope | None:
        """The class whose method this is, or in whose method it stands."""
        scope: Scope | None = self
        while scope is not None and scope.kind != CLASS:
            scope = scope.parent
        return scope

    @property
    def function(self) -> Scope | None:
        """The function with a name that this is or stands in."""
        scope: Scope | None = self
        while scope is not None and scope.kind != FUNCTION:
            scope = scope.parent
        return scope

    @property
    def module(self) -> Scope:
        scope = self
        while scope.parent is not None:
            scope = scope.parent
        return scope

    @property
    def method(self) -> Scope | None:
        """The method that this is or stands in."""
        scope: Scope | None = self
        while scope is not None and not (scope.kind == FUNCTION and scope.is_method):
            scope = scope.parent
        return scope

    @property
    def is_method(self) -> bool:
        return self.parent is not None and self.parent.kind == CLASS

    @property
    def decorators(self) -> list[str]:
        if self._decorators is None:
            self._decorators = decorators_of(self.node)
        return self._decorators

    @property
    def parameters(self) -> list[PyParameter]:
        """The parameters of a function; of a method, with its object."""
        if self._parameters is None:
            self._parameters = self._read_parameters()
        return self._parameters

    @property
    def parameter_nodes(self) -> list[Node]:
        """The parameters as they are written, without what separates them."""
        node = self.node.child_by_field_name("parameters")
        return [n for n in named(node) if n.type not in _SEPARATORS] if node is not None else []

    def _read_parameters(self) -> list[PyParameter]:
        node, found, by = self.node.child_by_field_name("parameters"), list[PyParameter](), ""
        for each in named(node) if node is not None else ():
            if each.type == "positional_separator":
                found = [replace(p, by=BY_PLACE) for p in found]
            elif each.type == "keyword_separator":
                by = BY_NAME
            elif (parameter := _parameter(each)) is not None:
                found.append(replace(parameter, by=by))
                by = BY_NAME if parameter.star == 1 else by
        return found

    @property
    def self_name(self) -> str | None:
        """What a method calls its object."""
        if not self.is_method or "staticmethod" in self.decorators:
            return None
        parameters = self.parameters
        return parameters[0].name if parameters else None

    def bind(self, name: str, binding: Binding) -> None:
        scope = self.module if name in self.outer else self
        scope.names.setdefault(name, []).append(binding)


BY_NAME, BY_PLACE = "name", "place"
_SEPARATORS = frozenset({"keyword_separator", "positional_separator"})


@dataclass(frozen=True, slots=True)
class PyParameter:
    """A parameter of a function: `star` is how many stars stand before it.

    `by` says how it is given, if it is by its name alone, or by its place alone.
    """

    name: str
    default: Node | None = None
    star: int = 0
    by: str = ""


def _parameter(node: Node) -> PyParameter | None:
    match node.type:
        case "identifier":
            return PyParameter(text_of(node))
        case "default_parameter" | "typed_default_parameter":
            return PyParameter(text_of(field(node, "name")), field(node, "value"))
        case "typed_parameter":
            return _parameter(node.named_children[0])
        case "list_splat_pattern" | "dictionary_splat_pattern":
            star = 1 if node.type.startswith("list") else 2
            return PyParameter(text_of(node).lstrip("* "), None, star)
        case _:
            return None


@dataclass(eq=False, slots=True)
class PyCode:
    """Some files of Python together.

    `calls` are all calls with the scope they stand in, in the order of the text; `by_callee` the
    same by the last name of what is called; `found` are the modules that imports name, by
    the path of the file that imports them, as far as they were looked for. It is `alone` where no
    file of another language has to do with messages of std_msgs.
    """

    modules: dict[str, Scope] = with_default(default_factory=dict)
    scopes: dict[tuple[str, int], Scope] = with_default(default_factory=dict)
    calls: list[tuple[Node, Scope]] = with_default(default_factory=list)
    found: dict[tuple[str, str], Scope | None] = with_default(default_factory=dict)
    by_callee: dict[str, list[tuple[Node, Scope]]] = with_default(default_factory=dict)
    methods: dict[str, list[Scope]] = with_default(default_factory=dict)
    alone: bool = False

    @classmethod
    def of(cls, files: Iterable[Py]) -> PyCode:
        code = cls()
        for py in files:
            module = Scope(MODULE, "", py.root, py)
            code.modules[py.source.path] = module
            code._add(module)
        return code

    def scope_of(self, node: Node, py: Py) -> Scope:
        """The scope that a definition or lambda opens."""
        return self.scopes[py.source.path, node.id]

    def _add(self, module: Scope) -> None:
        """Goes through a file; declarations of global names count before what binds them."""
        waiting: list[tuple[Node, Scope]] = [(module.node, module)]
        while waiting:
            node, scope = waiting.pop()
            if node.type in _SAYING:
                scope = self._entered(node, scope)
            if node.named_child_count:
                children = [c for c in node.named_children if c.type not in _SILENT]
                waiting += [(child, scope) for child in reversed(children)]

    def _entered(self, node: Node, scope: Scope) -> Scope:
        """Notes what a node says; the scope of what is in it."""
        kind = _SCOPES.get(node.type)
        if kind is not None:
            return self._opened(kind, node, scope)
        match node.type:
            case "call":
                self.calls.append((node, scope))
                self.by_callee.setdefault(last_name(field(node, "function")), []).append(
                    (node, scope)
                )
            case "global_statement":
                scope.outer.update(text_of(c) for c in named(node))
            case "return_statement":
                scope.returns.append(node)
            case _:
                for target, binding in bindings_of(node):
                    _bind(scope, target, binding)
        return scope

    def _opened(self, kind: str, node: Node, scope: Scope) -> Scope:
        name = text_of(field(node, "name")) if kind != LAMBDA else ""
        opened = Scope(kind, name, node, scope.py, scope)
        self.scopes[scope.py.source.path, node.id] = opened
        if name:
            scope.bind(name, Binding("scope", node, node))
        if kind == FUNCTION and scope.kind == CLASS:
            self.methods.setdefault(name, []).append(opened)
        for index, parameter in enumerate(opened.parameters):
            opened.bind(parameter.name, Binding("parameter", node, node, (index,)))
        return opened


_SCOPES = {"class_definition": CLASS, "function_definition": FUNCTION, "lambda": LAMBDA}
_SAYING = BINDING.union(_SCOPES, ("call", "global_statement", "return_statement"))
# What neither says anything nor holds what does: most of all nodes.
_SILENT = frozenset(
    {
        *("identifier", "string_start", "string_content", "string_end", "integer", "float"),
        *("comment", "true", "false", "none", "pass_statement", "escape_sequence"),
    }
)


def _bind(scope: Scope, target: Node, binding: Binding) -> None:
    """Binds a name, an attribute of the method's object, or one of another object."""
    if target.type in ("identifier", "wildcard_import"):
        scope.bind(text_of(target), binding)
    elif target.type == "attribute":
        holder, name = field(target, "object"), text_of(field(target, "attribute"))
        method = scope.method
        if method is not None and method.parent and text_of(holder) == method.self_name:
            method.parent.attributes.setdefault(name, []).append(binding)
        else:
            scope.stores.setdefault((text_of(holder), name), []).append(binding)


def last_name(node: Node) -> str:
    """The last name of what is called: `create_timer` of `self.node.create_timer`."""
    match node.type:
        case "identifier":
            return text_of(node)
        case "attribute":
            return text_of(field(node, "attribute"))
        case _:
            return ""


def arguments_of(call: Node) -> tuple[list[Node], dict[str, Node]]:
    """The arguments of a call: those without a name, and those with one.

    What a star unpacks ends the first list, as what follows has no known place.
    """
    plain: list[Node] = []
    keywords: dict[str, Node] = {}
    arguments = field(call, "arguments")
    if arguments.type == "generator_expression":
        return [arguments], {}
    is_open = False
    for node in named(arguments):
        if node.type == "keyword_argument":
            keywords[text_of(field(node, "name"))] = field(node, "value")
        elif node.type == "dictionary_splat":
            continue
        elif node.type == "list_splat":
            is_open = True
        elif not is_open:
            plain.append(node)
    return plain, keywords


def has_splat(call: Node) -> bool:
    """Whether stars unpack some of the arguments of a call."""
    return any(
        c.type in ("list_splat", "dictionary_splat") for c in named(field(call, "arguments"))
    )


def classes_in(code: PyCode) -> Iterator[Scope]:
    """All classes, in the order of the text."""
    return (s for s in code.scopes.values() if s.kind == CLASS)


# --- modules ------------------------------------------------------------------------------------


def module_of(node: Node) -> str:
    """The module that names are imported from, with its dots."""
    return text_of(field(node, "module_name")).replace(" ", "")


def module_named(code: PyCode, dotted: str, of: Scope) -> Scope | None:
    """The file that a module's name stands for, seen from another file."""
    key = dotted, of.py.source.path
    if key not in code.found:
        code.found[key] = _module_named(code, dotted, of)
    return code.found[key]


def _module_named(code: PyCode, dotted: str, of: Scope) -> Scope | None:
    here = PurePosixPath(of.py.source.path).parent
    if dotted.startswith("."):
        rest = dotted.lstrip(".")
        for _ in range(len(dotted) - len(rest) - 1):
            here = here.parent
        base = here.joinpath(*rest.split(".")) if rest else here
        return next((code.modules[p] for p in _files(base) if p in code.modules), None)
    parts = dotted.split(".")
    for path in _files(here.joinpath(*parts)):
        if path in code.modules:
            return code.modules[path]
    if len(parts) == 1:
        return None
    tails = tuple(_files(PurePosixPath("/").joinpath(*parts)))
    found = [m for p, m in code.modules.items() if f"/{p}".endswith(tails)]
    return found[0] if len(found) == 1 else None


def _files(base: PurePosixPath) -> Iterator[str]:
    yield f"{base}.py"
    yield f"{base}/__init__.py"
