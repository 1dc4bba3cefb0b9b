"""Statements that only log: a model has none of them, and they change nothing."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.generated.log_words import (
    CALLED,
    CALLING,
    LEVELS,
    LOOKS,
    MAKING_TEXTS,
    OF_TEXTS,
    ON_CLOCKS,
)
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.ancestors import functions_around
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, PyCode, Scope, has_splat
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, named, text_of

_DESCRIBES = frozenset({"__repr__", "__str__"})
_PLAIN_VALUES = frozenset({"string", "integer", "float", "true", "false", "none"})
_STORING = frozenset({"named_expression", "await", "yield", "lambda"})


@dataclass(frozen=True, slots=True)
class Looks:
    """What names stand for in the code of a class: whether an expression is pure.

    `trusted` are names that stand for what Python and ROS have by them, "self" among them for a
    node of ROS 2; `functions` those of classes, of which one may be a property that does something;
    `makers` what makes messages. `own` are methods of the model, whose calls count as pure: who
    leaves out the rest has to keep these. `loggers`, `tables` and `clocks` are names of the module
    that stand for a logger of Python's library, a dictionary of literals, and what tells the time;
    `records` are its classes whose objects only hold what they are made of, with their fields;
    `describing` functions that only put texts together, with how many arguments they take.
    `computing` is what the module calls functions that only give a value, and `logging` methods
    that only log, with how many arguments each takes. `attributes` are what objects of the class
    have, where that is known: with a slip in the name of one, what logs raises. `texts` are methods
    that only put a text together, with how many arguments each takes.
    """

    trusted: frozenset[str] = with_default(
        default_factory=lambda: LOOKS | libraries.modules_of_logs() | {"self"}
    )
    functions: frozenset[str] = frozenset()
    makers: frozenset[str] = frozenset()
    own: frozenset[str] = frozenset()
    loggers: frozenset[str] = frozenset()
    tables: frozenset[str] = frozenset()
    clocks: frozenset[str] = frozenset()
    records: Mapping[str, Sequence[str]] = with_default(default_factory=dict)
    describing: Mapping[str, int] = with_default(default_factory=dict)
    computing: frozenset[str] = frozenset()
    logging: Mapping[str, int] = with_default(default_factory=dict)
    attributes: frozenset[str] | None = None
    texts: Mapping[str, int] = with_default(default_factory=dict)

    def is_pure(self, node: Node) -> bool:
        """Whether nothing happens where an expression is evaluated."""
        if own_method(node) in self.own:
            return self.is_pure(field(node, "arguments"))
        if own_method(node) in self.texts:
            return self._is_look(node) and self.is_pure(field(node, "arguments"))
        if node.type in _STORING or (node.type == "call" and not self._is_look(node)):
            return False
        if node.type == "attribute" and text_of(field(node, "attribute")) in self.functions:
            return text_of(field(node, "object")) not in ("self", "super()")
        if node.type == "attribute" and (self._is_absent(node) or self._is_no_field(node)):
            return False
        return all(map(self.is_pure, node.named_children))

    def _is_absent(self, node: Node) -> bool:
        """Whether no object of the class has an attribute; those of libraries are not private."""
        name = text_of(field(node, "attribute"))
        is_own = text_of(field(node, "object")) == "self" and name.startswith("_")
        is_plain = is_own and not name.endswith("__")
        return is_plain and self.attributes is not None and name not in self.attributes

    def _is_no_field(self, node: Node) -> bool:
        """Whether an attribute is asked of a local that is a record without such a field."""
        of, name = field(node, "object"), text_of(field(node, "attribute"))
        if of.type != "identifier" or not self.records:
            return False
        fields = self._fields_of(of)
        return fields is not None and name not in fields and not name.startswith("__")

    def _fields_of(self, local: Node) -> Sequence[str] | None:
        """The fields that a local has which only ever is a record; None for another one."""
        made = [text_of(value).partition("(")[0] for value in self._stores(local)]
        if len(set(made)) != 1 or made[0] not in self.records:
            return None
        return self.records[made[0]]

    def _replaces(self, call: Node) -> bool:
        """`replace(status, loaded=False)`, which makes another record of a local that is one."""
        of, *changed = named(field(call, "arguments")) or [call]
        fields = self._fields_of(of) if of.type == "identifier" else None
        names = [text_of(field(n, "name")) for n in changed if n.type == "keyword_argument"]
        return fields is not None and len(names) == len(changed) and set(names) <= set(fields)

    def _is_plain(self, value: Node) -> bool:
        """Whether a value is made of plain ones: no object that people made is in it."""
        match value.type:
            case "keyword_argument":
                return self._is_plain(field(value, "value"))
            case "dictionary" | "list" | "tuple" | "pair" | "parenthesized_expression":
                return all(map(self._is_plain, named(value)))
            case "call":
                return text_of(field(value, "function")) in LOOKS or self.is_text(value)
            case "identifier":
                stores = [*self._stores(value)]
                return text_of(value) != "self" and all(map(self._is_plain, stores))
            case _:
                return True

    def _stores(self, local: Node) -> Iterator[Node]:
        """What a function stores under the name of a local."""
        function = next(functions_around(local), None)
        for node in nodes_in(function) if function is not None else ():
            if node.type == "assignment" and is_target(node, text_of(local)):
                yield field(node, "right")

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
        if (count := self.texts.get(own_method(call))) is not None:
            given = field(call, "arguments")
            return len(named(given)) == count and _by_position(given) and not has_splat(call)
        if called in self.computing:
            if called.rpartition(".")[2] == "dumps":
                return all(map(self._is_plain, named(field(call, "arguments"))))
            return not called.endswith("replace") or self._replaces(call)
        if called in self.clocks:
            return not named(field(call, "arguments"))
        if function.type == "identifier":
            is_built_in = called in LOOKS and called in self.trusted
            given = field(call, "arguments")
            if called in self.describing and not has_splat(call):
                plain = [a for a in named(given) if a.type != "keyword_argument"]
                return len(plain) == len(named(given)) == self.describing[called]
            return is_built_in or called in self.makers or self.makes_record(call)
        if function.type != "attribute":
            return False
        holder, name = field(function, "object"), text_of(field(function, "attribute"))
        if name == "get" and text_of(holder) in self.tables:
            return len(named(field(call, "arguments"))) in (1, 2)
        if name in ON_CLOCKS:
            return holder.type == "call" and not named(field(call, "arguments"))
        is_joining = name == "join" and self._joins_texts(call)
        return self.is_text(holder) and (name in OF_TEXTS or is_joining)

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

    def makes_record(self, call: Node) -> bool:
        """Whether a call makes an object that only holds its arguments, one for each field."""
        function = call.child_by_field_name("function")
        fields = self.records.get(text_of(function)) if function is not None else None
        given = named(field(call, "arguments")) if fields is not None else []
        names = [text_of(field(a, "name")) for a in given if a.type == "keyword_argument"]
        plain = fields[: len(given) - len(names)] if fields is not None else ()
        is_whole = sorted([*plain, *names]) == sorted(fields or ()) and not has_splat(call)
        return fields is not None and len(given) == len(fields) and is_whole

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


def is_target(assignment: Node, name: str) -> bool:
    """Whether an assignment stores something under a name."""
    return text_of(field(assignment, "left")) == name and (
        assignment.child_by_field_name("right") is not None
    )


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
    return replace(looks, functions=frozenset(own), texts=dict(_texts(code)))


def _texts(code: PyCode) -> Iterator[tuple[str, int]]:
    """The methods of some code that only put a text together, where no other has the name."""
    for name, found in code.methods.items():
        function = found[0]
        members = function.owner.names if function.owner is not None else {}
        by_position = all(p.star == 0 and p.default is None for p in function.parameters)
        if len(found) == 1 and by_position and only_describes(function, members):
            yield name, len(function.parameters) - ("staticmethod" not in function.decorators)


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
    """Whether a function only puts a text together of what is there, as `__repr__` does.

    `members` are the functions of the class, of which one may be a property that does something.
    """
    body = body_of(function)
    values = named(body[0]) if len(body) == 1 and body[0].type == "return_statement" else []
    if len(values) != 1 or not set(function.decorators) <= {"staticmethod"}:
        return False
    is_text = function.name in _DESCRIBES or _PLAIN.is_text(values[0])
    return (
        is_text
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
