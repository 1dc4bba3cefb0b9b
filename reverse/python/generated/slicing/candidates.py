"""Members and locals that may be for people only, by what is written: the form is asked of these.

To lower code takes time: what has to do with the node itself is known by its words.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from tree_sitter import Node

from rebsync.reserved import PYTHON_FUNCTIONS, PYTHON_MEMBERS
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.libraries.tables.runtime import names_in_model
from rebsync.reverse.python.generated.py_types import expression_in
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope, module_named, module_of
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, is_literal_text, named, text_of

_STATEMENTS = frozenset(
    {
        *("expression_statement", "if_statement", "for_statement", "while_statement"),
        *("with_statement", "try_statement"),
    }
)
SET_UP = ("__init__", "_wire")
_NUMBERS = frozenset({"integer", "float", "true", "false", "unary_operator"})
_TARGETS = frozenset({"pattern_list", "tuple_pattern", "list_pattern"})
_STORING = frozenset({"assignment", "augmented_assignment"})


def candidate_members(
    code: PyCode, module: Scope, members: Mapping[str, Node], makers: Collection[str]
) -> frozenset[str]:
    """Those of members with values that may be for people: no numbers, nothing of a node.

    `makers` are what the module calls messages for people.
    """
    values = ((n, v) for n, v in members.items() if v.type not in _NUMBERS)
    return frozenset(name for name, value in values if _is_computed(code, module, value, makers))


def candidate_locals(
    code: PyCode, functions: Iterable[Scope], members: Collection[str], makers: Collection[str]
) -> dict[int, frozenset[str]]:
    """By functions the locals of them that may be for people; what names `members` tells these."""
    return {f.node.id: _candidates_in(code, f, members, makers) for f in functions}


def _candidates_in(
    code: PyCode, function: Scope, members: Collection[str], makers: Collection[str]
) -> frozenset[str]:
    """The locals of a function that may be for people: none that models declare.

    A local that nobody is told of is the model's, though nobody
    reads it.
    """
    computed = frozenset(
        name
        for name, bindings in function.names.items()
        if all(b.how in ("value", "augmented", "loop") for b in bindings)
        and all(_is_computed(code, function.module, b.value, makers) for b in bindings)
        and not any(_is_declared(b.value) for b in bindings)
    )
    return _told_of(function, computed, members) if computed else computed


def _told_of(function: Scope, names: frozenset[str], members: Collection[str]) -> frozenset[str]:
    """Those of some locals that a statement reads which tells people something."""
    reads = [n for n in nodes_in(function.node) if n.type == "identifier" and not _is_bound(n)]
    reads = [n for n in reads if text_of(n) in names]
    found = frozenset[str]()
    while fresh := {text_of(n) for n in reads if _is_told(n, members, found)} - found:
        found |= fresh
    return found


def _is_bound(node: Node) -> bool:
    """Whether a name stands where it gets a value."""
    above = node.parent
    while above is not None and above.type in _TARGETS:
        node, above = above, above.parent
    is_left = above is not None and above.child_by_field_name("left") == node
    return is_left and above is not None and above.type in (*_STORING, "for_statement")


def _is_told(node: Node, members: Collection[str], told: Collection[str]) -> bool:
    """Whether a read of a local stands in a statement that tells people something."""
    around = (n for n in ancestors(node, _is_scope) if n.type in _STATEMENTS)
    return any(_speaks(part, members, told) for s in around for part in nodes_in(s))


def _is_scope(node: Node) -> bool:
    return node.type in ("function_definition", "class_definition")


def _speaks(part: Node, members: Collection[str], told: Collection[str]) -> bool:
    match part.type:
        case "call":
            return libraries.log_words().match(text_of(field(part, "function"))) is not None
        case "attribute":
            return text_of(field(part, "attribute")) in members
        case _:
            return part.type == "identifier" and (text_of(part) in told or text_of(part) in members)


def _is_declared(value: Node) -> bool:
    """Whether a local gets its type where it gets a value, as generated code declares each."""
    return value.parent is not None and value.parent.child_by_field_name("type") is not None


def _is_computed(code: PyCode, module: Scope, value: Node, makers: Collection[str]) -> bool:
    """Whether nothing is called for a value but what Python has, or the module itself."""
    calls = (text_of(field(n, "function")) for n in nodes_in(value) if n.type == "call")
    return all(c in makers or _calls_plainly(code, module, c) for c in calls)


def _calls_plainly(code: PyCode, module: Scope, text: str) -> bool:
    if text in libraries.clocks():
        return True
    head = text.partition(".")[0].partition("(")[0]
    if head == "self":
        return text.removeprefix("self._mailbox.") in names_in_model(Language.PYTHON)
    bindings = [b for b in module.names.get(head, []) if b.how == "import"]
    if any(libraries.of_nodes(text_of(b.value)) for b in bindings):
        return False
    return not any(_is_of_package(code, module, b.node) for b in bindings)


def _is_of_package(code: PyCode, module: Scope, statement: Node) -> bool:
    """Whether an import is of the run-time part, or of messages."""
    if statement.type != "import_from_statement":
        return False
    source = module_named(code, module_of(statement), module)
    is_message = text_of(field(statement, "module_name")).rpartition(".")[2] in ("msg", "srv")
    return is_message or (source is not None and is_runtime_file(source.py.source))


def is_of_node(name: str) -> bool:
    """Whether a node of rclpy has a member of its own by this name."""
    return name in PYTHON_FUNCTIONS or name.removeprefix("_") in PYTHON_MEMBERS


def asked_of_node() -> Collection[str]:
    """The methods of a node that only give what tells people something."""
    return {"get_logger", "get_clock", *libraries.own_name_methods()}


def may_tell(node: Node, words: Collection[str], members: Collection[str]) -> bool:
    """Whether a statement names something for people, or logs, and asks the node nothing else.

    `words` are variables for people, `members` attributes of the object. A text that is not used
    tells as little.
    """
    if node.type not in _STATEMENTS:
        return False
    inner = expression_in(node)
    names_told = inner is not None and is_literal_text(inner)
    for part in nodes_in(node):
        called = text_of(field(part, "function")) if part.type == "call" else ""
        if part.type == "identifier":
            names_told |= text_of(part) in words
        elif called:
            names_told |= libraries.log_words().match(called) is not None
        elif part.type == "attribute" and text_of(field(part, "object")) == "self":
            is_told = text_of(field(part, "attribute")) in members
            names_told |= is_told
            if not is_told and _is_acted_on(part):
                return False
    return names_told


def _is_acted_on(attribute: Node) -> bool:
    """Whether something is stored in an attribute of the object, or asked of it."""
    above = attribute.parent
    while above is not None and above.type == "subscript" and field(above, "value") == attribute:
        attribute, above = above, above.parent
    if above is None:
        return False
    if above.type in _STORING:
        return field(above, "left") == attribute
    if above.type == "call" and above.child_by_field_name("function") == attribute:
        return text_of(field(attribute, "attribute")) not in asked_of_node()
    return False


def made_once(functions: Mapping[str, Scope]) -> Iterator[tuple[str, Node]]:
    """What the constructor of a class puts into members, into each once only."""
    found: dict[str, list[Node]] = {}
    for function in (functions[name] for name in SET_UP if name in functions):
        for statement in body_of(function):
            inner = named(statement)[0] if statement.type == "expression_statement" else statement
            left, value = inner.child_by_field_name("left"), inner.child_by_field_name("right")
            if inner.type != "assignment" or left is None or value is None:
                continue
            if left.type == "attribute" and text_of(field(left, "object")) == "self":
                found.setdefault(text_of(field(left, "attribute")), []).append(value)
    yield from ((name, values[0]) for name, values in found.items() if len(values) == 1)
