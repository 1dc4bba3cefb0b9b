"""Statements that only log: a model has none of them, and they change nothing."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.generated.slicing.log_words import (
    CALLED,
    CALLING,
    LEVELS,
    LOOKS,
    MAKING_TEXTS,
    OF_TEXTS,
    ON_CLOCKS,
)
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, PyCode, Scope, has_splat
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, named, text_of

_PLAIN_VALUES = frozenset({"string", "integer", "float", "true", "false", "none"})
_STORING = frozenset({"named_expression", "await", "yield", "lambda"})


@dataclass(frozen=True, slots=True)
class Looks:
    """What names stand for in the code of a class: whether an expression is pure.

    `trusted` are names that stand for what Python and ROS have by them, "self" among them for a
    node of ROS 2; `functions` those of classes, of which one may be a property that does something;
    `makers` what makes messages. `own` are methods of the model, whose calls count as pure: who
    leaves out the rest has to keep these. `loggers` and `clocks` are names of the module that stand
    for a logger of Python's library, and what tells the time; `logging` are methods that only log,
    with how many arguments each takes.
    """

    trusted: frozenset[str] = with_default(
        default_factory=lambda: LOOKS | libraries.modules_of_logs() | {"self"}
    )
    functions: frozenset[str] = frozenset()
    makers: frozenset[str] = frozenset()
    own: frozenset[str] = frozenset()
    loggers: frozenset[str] = frozenset()
    clocks: frozenset[str] = frozenset()
    logging: Mapping[str, int] = with_default(default_factory=dict)

    def is_pure(self, node: Node) -> bool:
        """Whether nothing happens where an expression is evaluated."""
        if own_method(node) in self.own:
            return self.is_pure(field(node, "arguments"))
        if node.type in _STORING or (node.type == "call" and not self._is_look(node)):
            return False
        if node.type == "attribute" and text_of(field(node, "object")) in ("self", "super()"):
            return text_of(field(node, "attribute")) not in self.functions
        if text_of(node) == "self":  # its class may say what text it is
            return False
        return all(map(self.is_pure, node.named_children))

    def _is_look(self, call: Node) -> bool:
        """Whether what is called only looks at its arguments, the clock, or the node's name."""
        function = field(call, "function")
        called = text_of(function)
        if called in libraries.clocks() or called in libraries.own_names():
            return called.partition(".")[0] in self.trusted
        if own_method(call) in libraries.own_name_methods():
            return self.is_node and own_method(call) not in self.functions
        if not self._calls_plain(call):
            return False
        if called in self.clocks:
            return not named(field(call, "arguments"))
        if function.type == "identifier":
            is_built_in = called in LOOKS and called in self.trusted
            return is_built_in or called in self.makers
        if function.type != "attribute":
            return False
        holder, name = field(function, "object"), text_of(field(function, "attribute"))
        if name in ON_CLOCKS:
            return holder.type == "call" and not named(field(call, "arguments"))
        return self.is_text(holder) and name == "join" and self._joins_texts(call)

    def _calls_plain(self, call: Node) -> bool:
        """Whether what a call itself calls of what it gets are functions of Python's own."""
        given = named(field(call, "arguments"))
        called = given[:1] if text_of(field(call, "function")) in CALLING else []
        by_name = [n for n in given if n.type == "keyword_argument"]
        handed = [field(n, "value") for n in by_name if text_of(field(n, "name")) in CALLED]
        called += [n for n in handed if n.type not in _PLAIN_VALUES and not _is_own(n)]
        return all(text_of(n) in LOOKS & self.trusted for n in called)

    def is_text(self, node: Node) -> bool:
        """Whether a value is a text by how it is made."""
        if node.type in ("string", "concatenated_string"):
            return True
        function = field(node, "function") if node.type == "call" else node
        if function.type == "identifier":
            return text_of(function) in MAKING_TEXTS & LOOKS
        is_method = node.type == "call" and function.type == "attribute"
        is_made = is_method and text_of(field(function, "attribute")) in OF_TEXTS
        return is_made and self.is_text(field(function, "object"))

    def _joins_texts(self, call: Node) -> bool:
        """Whether what is joined is a text for each of some elements: anything else is an error."""
        given = field(call, "arguments")
        if given.type != "generator_expression":
            (given, *rest) = named(given) or [given]
            if rest:
                return False
        if given.type == "call" and text_of(field(given, "function")) == "map":
            first = text_of(named(field(given, "arguments"))[0])
            return first in MAKING_TEXTS and self._is_look(given)
        if given.type not in ("list_comprehension", "generator_expression"):
            return False
        body = field(given, "body")
        return self.is_text(body) and self.is_pure(body)

    def logs(self, call: Node) -> bool:
        """Whether a call only logs what is there already."""
        called = text_of(field(call, "function"))
        head, _, method = called.partition(".")
        given = field(call, "arguments")
        if own_method(call) in self.logging:
            is_whole = len(named(given)) == self.logging[own_method(call)] and not has_splat(call)
            return is_whole and _by_position(given) and self.is_pure(given)
        if head in self.loggers and method in LEVELS:
            return self.is_pure(field(call, "arguments"))
        if libraries.log_words().match(called) is None:
            return False
        if head in libraries.modules_of_logs() and head not in self.trusted:
            return False
        if called.startswith("self.get_logger") and not self.is_node:
            return False
        return self.is_pure(field(call, "arguments"))

    def tells_time(self, node: Node) -> bool:
        """Whether a value is what a clock tells."""
        called = text_of(field(node, "function")) if node.type == "call" else ""
        return called in libraries.clocks() | self.clocks and self.is_pure(node)

    @property
    def is_node(self) -> bool:
        """Whether the object is a node of ROS 2 that has its logger from there."""
        return "self" in self.trusted and "get_logger" not in self.functions


def _is_own(node: Node) -> bool:
    """Whether something is an attribute of the object itself."""
    return node.type == "attribute" and text_of(field(node, "object")) == "self"


def _by_position(given: Node) -> bool:
    return all(n.type != "keyword_argument" for n in named(given))


def own_method(node: Node) -> str:
    """The method that a call of one of the object's own calls; empty for all else."""
    function = field(node, "function") if node.type == "call" else None
    if function is None or function.type != "attribute":
        return ""
    is_own = text_of(field(function, "object")) == "self"
    return text_of(field(function, "attribute")) if is_own else ""


_PLAIN = Looks()


def looks_in(code: PyCode, modules: Sequence[Scope], makers: frozenset[str]) -> Looks:
    """What names stand for in some modules with classes of the model."""
    paths = {module.py.source.path for module in modules}
    scopes = [s for (path, _), s in code.scopes.items() if path in paths and s.kind != CLASS]
    bound = {name for s in (*modules, *scopes) for name in s.names if not _is_import(s, name)}
    trusted = LOOKS.union(
        n for n in libraries.clock_modules() if all(_is_import(s, n) for s in modules)
    )
    if any(map(_has_nodes, modules)):
        trusted |= {"self"}
    looks = Looks(trusted - (bound - {"self"}), frozenset(code.methods), makers)
    own = (
        name
        for name, found in code.methods.items()
        for function in found
        if not (is_runtime_file(function.py.source) or _only_returns(function, looks))
    )
    return replace(looks, functions=frozenset(own))


def _only_returns(function: Scope, looks: Looks) -> bool:
    """Whether a function is a property that gives what is there."""
    body = body_of(function)
    values = named(body[0]) if len(body) == 1 and body[0].type == "return_statement" else []
    is_property = function.decorators == ["property"]
    return is_property and len(values) == 1 and looks.is_pure(values[0])


def _is_import(scope: Scope, name: str) -> bool:
    """Whether a name of a module is that of a module of Python or ROS, and nothing else."""
    bindings = scope.names.get(name, [])
    if name not in libraries.clock_modules() or len(bindings) != 1:
        return False
    statement = bindings[0].node
    plain = (each.type == "dotted_name" for each in named(statement))
    return statement.type == "import_statement" and all(plain)


def _has_nodes(module: Scope) -> bool:
    """Whether a module has something of a library with nodes, or the run-time part's own node."""
    bindings = (b.node for found in module.names.values() for b in found)
    imports = (n for n in bindings if n.type == "import_from_statement")
    names = (text_of(field(n, "module_name")) for n in imports)
    return any(libraries.of_nodes(n) or n.endswith(".lifecycle") for n in names)


def only_logs(node: Node, looks: Looks = _PLAIN) -> bool:
    """Whether a statement only logs what is there already, perhaps under a condition."""
    match node.type:
        case "expression_statement" if len(named(node)) == 1:
            call = named(node)[0]
            return call.type == "call" and looks.logs(call)
        case "if_statement":
            parts = [node, *node.children_by_field_name("alternative")]
            return all(_branch_only_logs(part, looks) for part in parts)
        case _:
            return False


def only_describes(function: Scope, members: Container[str]) -> bool:
    """Whether a function only puts a text together of what is there.

    `members` are the functions of the class, of which one may be a property that does something.
    """
    body = body_of(function)
    values = named(body[0]) if len(body) == 1 and body[0].type == "return_statement" else []
    if len(values) != 1 or not set(function.decorators) <= {"staticmethod"}:
        return False
    return (
        _PLAIN.is_text(values[0])
        and _PLAIN.is_pure(values[0])
        and not any(
            n.type == "attribute" and text_of(field(n, "attribute")) in members
            for n in nodes_in(values[0])
        )
    )


def _branch_only_logs(part: Node, looks: Looks) -> bool:
    condition = part.child_by_field_name("condition")
    body = field(part, "body" if part.type == "else_clause" else "consequence")
    inside = [n for n in named(body) if n.type not in ("comment", "pass_statement")]
    is_pure = condition is None or looks.is_pure(condition)
    return is_pure and bool(inside) and all(only_logs(each, looks) for each in inside)


def is_logger(stored: Node | None) -> bool:
    """Whether an attribute gets the node's own logger, which the model's constructor cannot see."""
    if stored is None or stored.type != "assignment":
        return False
    return text_of(field(stored, "right")) == "self.get_logger()"
