"""What of Python touches nothing that the model has: it may be left out, and is worth anything."""

from __future__ import annotations

import re
from collections.abc import Collection

from tree_sitter import Node

from rebsync.reverse.graph import Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.tables.standard import WAITING_ALONE
from rebsync.reverse.python.bodies.body_reading import Reading, has_nonlocals
from rebsync.reverse.python.bodies.body_scope import Frame, Message, Own, Var
from rebsync.reverse.python.values.interfaces import interface_of
from rebsync.reverse.python.values.py_callers import UNGIVEN
from rebsync.reverse.python.values.py_worth import (
    Class,
    Function,
    Instance,
    Made,
    NoneValue,
    Value,
    Ways,
)
from rebsync.reverse.syntax.ancestors import ancestors, climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import Scope, arguments_of, last_name
from rebsync.reverse.syntax.py_tree import decorators_of, field, named, text_of

DEFINITIONS = frozenset({"function_definition", "class_definition", "decorated_definition"})
_DECORATORS = frozenset({"staticmethod", "classmethod", "property"})
# What leaves a function one that does the same when it is called.
_PLAIN_DECORATOR = re.compile(
    r"(?:(?:abc|typing|typing_extensions|functools|numba)\.)?(?:staticmethod|classmethod|property"
    r"|abstractmethod|override|(?:lru_)?cache|cached_property|n?jit|\w+\.setter)(?:\(.*\))?",
    re.DOTALL,
)
_DEEPEST = 4
HARMLESS_DECORATORS = frozenset({"staticmethod"})
_QUEUES = frozenset({"Queue", "LifoQueue", "PriorityQueue", "JoinableQueue"})
_LOOPS = frozenset({"while_statement", "for_statement"})
_WORDS = frozenset({"await", "yield", "named_expression"})


def is_log(call: Node) -> bool:
    """Whether a call only writes to a log."""
    called = text_of(field(call, "function"))
    return libraries.log_calls().match("".join(called.split())) is not None or called == "print"


def is_harmless(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether evaluating an expression changes nothing of the model, and takes no time."""
    return all(_is_one(reading, n, frame) for n in nodes_in(node))


def _is_one(reading: Reading, node: Node, frame: Frame) -> bool:
    if node.type in _WORDS:
        return node.id in reading.stored
    if node.type == "for_in_clause":
        return _has_names(field(node, "left")) and not stores_around(reading, node, frame)
    if node.type in ("binary_operator", "augmented_assignment"):
        return not _may_divide_by_zero(reading, node, frame)
    if node.type != "call":
        return _is_safe_name(reading, node, frame)
    if is_log(node):
        return True
    function = field(node, "function")
    name = last_name(function)
    if reading.fact(node, frame) is not None and name not in libraries.silent_parameters():
        return False
    own = reading.function(function, frame)
    if own is not None:
        return is_still(reading, own)
    ways = reading.values.ways(function, frame.scope)
    if not ways or not (
        all(is_quiet(reading, w) for w in ways) and _are_quiet(reading, name, function, ways)
    ):
        return False
    if waits_alone(node) or _may_be_full(reading, node, frame.scope):
        return False
    if makes_again(node, frame.scope.self_name):
        return False
    return name in libraries.harmless() or (
        bool(name) and libraries.acting().match(name) is None and _ends(name)
    )


def stores_around(reading: Reading, clause: Node, frame: Frame) -> bool:
    """Whether what makes a list stores in another variable of the function, as in Python 2."""
    above = clause.parent
    if reading.unit.version == 3 or above is None or above.type != "list_comprehension":
        return False
    names = (text_of(n) for n in nodes_in(field(clause, "left")))
    bindings = (b for name in names for b in frame.scope.names.get(name, ()))
    return any(b.node.type != "for_in_clause" for b in bindings)


def _has_names(target: Node) -> bool:
    """Whether a target stores in names only."""
    return not any(n.type in ("attribute", "subscript") for n in nodes_in(target))


def waits_alone(call: Node) -> bool:
    """Whether a call may wait for another thread: `get()` of a queue, `join()` of a thread."""
    function = field(call, "function")
    values = [a for a in named(field(call, "arguments")) if a.type != "keyword_argument"]
    is_method = function.type == "attribute" and last_name(function) in WAITING_ALONE
    return is_method and (not values or values[0].type in ("true", "false"))


def makes_again(call: Node, self_name: str | None) -> bool:
    """Whether a constructor is called by its name, on another object than that of the function."""
    function = field(call, "function")
    if last_name(function) != "__init__" or function.type != "attribute":
        return False
    plain, _ = arguments_of(call)
    own = bool(plain) and text_of(plain[0]) == self_name
    return not own and not text_of(field(function, "object")).startswith("super(")


def _may_be_full(reading: Reading, call: Node, scope: Scope) -> bool:
    """Whether a call puts something into a queue with a largest size, which then may wait."""
    function = field(call, "function")
    if function.type != "attribute" or last_name(function) != "put":
        return False
    plain, keywords = arguments_of(call)
    if len(plain) > 1 or keywords:
        return True
    for way in reading.values.ways(field(function, "object"), scope):
        if isinstance(way, Made) and way.by.rpartition(".")[2] in _QUEUES:
            plain, keywords = arguments_of(way.call)
            if plain or keywords:
                return True
    return False


def may_be_of_message(reading: Reading, target: Node, frame: Frame) -> bool:
    """Whether what is stored in may be a message in a variable: it is called like a field of one.

    An object of a class of the files is none, nor is what a call of something external makes, but
    for messages of such a type.
    """
    types, name = reading.learnt.messages(), text_of(target).rpartition(".")[2]
    held = (reading.types.fields(type_) or {} for type_ in types)
    if not any(path.rpartition(".")[2] == name for fields in held for path in fields):
        return False
    at = target
    while at.type in ("attribute", "subscript"):
        inner = at.child_by_field_name("object") or at.child_by_field_name("value")
        if inner is None or text_of(inner) == frame.scope.self_name:
            break
        at = inner
        ways = reading.values.ways(at, frame.scope)
        if ways and all(_is_other_object(way, types) for way in ways):
            return False
    return at != target


def _is_other_object(way: Value, messages: Collection[str]) -> bool:
    match way:
        case Instance():
            return True
        case Made(by):
            return interface_of(by) not in messages
        case _:
            return False


def defines_only(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether defining a function or class changes nothing: decorators, defaults, class bodies."""
    match node.type:
        case "decorated_definition":
            inner = field(node, "definition")
            is_plain = _DECORATORS.issuperset(decorators_of(inner))
            return is_plain and defines_only(reading, inner, frame)
        case "function_definition":
            parameters = named(field(node, "parameters"))
            values = (p.child_by_field_name("value") for p in parameters)
            return all(v is None or is_harmless(reading, v, frame) for v in values)
        case "class_definition":
            bases = node.child_by_field_name("superclasses")
            parts = [*named(field(node, "body")), *([bases] if bases is not None else [])]
            return all(defines_only(reading, part, frame) for part in parts)
        case _:
            return is_harmless(reading, node, frame)


def is_quiet(reading: Reading, way: Value, depth: int = 0) -> bool:
    """Whether a function of the files touches nothing that is a node's, as far as it is seen.

    A method of an object that helps a node may change that object: the model has none of it.
    """
    match way:
        case Class(scope):
            made = scope.names.get("__init__", [])
            inner = [reading.code.scope_of(b.node, scope.py) for b in made if b.how == "scope"]
            is_node = scope in reading.nodes
            return not is_node and all(is_quiet_body(reading, s, depth) for s in inner)
        case Instance() | NoneValue():
            return False  # an object is called
        case Unresolved(why):
            return why != UNGIVEN
        case Function(scope):
            return scope.owner not in reading.nodes and is_quiet_body(reading, scope, depth)
        case _:
            return True


def _are_quiet(reading: Reading, name: str, called: Node, ways: Ways, depth: int = 0) -> bool:
    """Whether all methods of a name are quiet, if that of an object is called that is not known."""
    if called.type != "attribute" or any(not isinstance(w, Unresolved) for w in ways):
        return True
    others = (s for s in reading.code.methods.get(name, ()) if s.node not in ancestors(called))
    return all(is_quiet(reading, Function(scope), depth) for scope in others)


def is_quiet_body(reading: Reading, scope: Scope, depth: int) -> bool:
    """Whether the statements of a function are all so."""
    key = scope.node.id, depth
    found = reading.unit.quiet.get(key)
    if found is None:
        found = reading.unit.quiet[key] = _is_quiet(reading, scope, depth)
    return found


def _is_quiet(reading: Reading, scope: Scope, depth: int) -> bool:
    if depth > _DEEPEST or scope.outer or has_nonlocals(scope):
        return False
    if not all(_PLAIN_DECORATOR.fullmatch(each) for each in scope.decorators):
        return False
    return all(_is_quiet_node(reading, n, scope, depth) for n in nodes_in(scope.node))


def _is_quiet_node(reading: Reading, node: Node, scope: Scope, depth: int) -> bool:
    if node.type in _WORDS:
        return False
    if node.type in ("raise_statement", "assert_statement"):
        return _is_caught(node, scope)
    if node.type in ("for_statement", "for_in_clause"):
        return _has_names(field(node, "left"))
    if node.type in ("delete_statement", "as_pattern_target"):
        return _has_names(node)
    if node.type in ("assignment", "augmented_assignment"):
        target = field(node, "left")
        if target.type == "attribute":
            return text_of(field(target, "object")).partition(".")[0] == scope.self_name
        return target.type == "identifier" or depth == 0 or "." not in text_of(target)
    if node.type != "call" or is_log(node):
        return True
    name = last_name(field(node, "function"))
    if (
        not name
        or waits_alone(node)
        or makes_again(node, scope.self_name)
        or _may_be_full(reading, node, scope)
        or (libraries.acting().match(name) is not None and name not in libraries.harmless())
        or not _ends(name)
    ):
        return False
    function = field(node, "function")
    ways = reading.values.ways(function, scope)
    return (
        bool(ways)
        and all(is_quiet(reading, w, depth + 1) for w in ways)
        and _are_quiet(reading, name, function, ways, depth + 1)
    )


def _is_caught(node: Node, scope: Scope) -> bool:
    """Whether a function may handle the exception that a statement of it raises."""
    around = ancestors(node, lambda n: n == scope.node)
    return any(n.type == "try_statement" for n in around)


def _may_divide_by_zero(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether a number of the model divides: if it is 0, Python ends the callback."""
    right, operator = field(node, "right"), text_of(field(node, "operator"))
    left = field(node, "left").type
    if operator.removesuffix("=") not in ("/", "//", "%") or left.endswith("string"):
        return False
    while right.type == "parenthesized_expression" and right.named_children:
        right = right.named_children[0]
    if _is_never_zero(reading, right, frame):
        return False
    return any(_is_modelled(reading, inner, frame) for inner in nodes_in(right))


def _is_modelled(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether a name is that of a variable of the model, or of a field of a message."""
    if node.type == "attribute" and field(node, "object").type == "identifier":
        holder = field(node, "object")
        meaning = reading.name(text_of(holder), holder, frame)
        name = text_of(field(node, "attribute"))
        own = isinstance(meaning, Own) and isinstance(reading.attribute(name, node, frame), Var)
        return own or isinstance(meaning, Message)
    if node.type == "identifier":
        return isinstance(reading.name(text_of(node), node, frame), Var)
    return False


def _is_never_zero(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether all that an expression may be worth are other numbers than 0."""
    ways = reading.values.ways(node, frame.scope)
    return bool(ways) and all(isinstance(w, int | float) and w for w in ways)


def _ends(name: str) -> bool:
    return not name.endswith(("_async", "_once"))


def _is_safe_name(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether a name hands nothing of the node out: not the object itself, nor its methods."""
    above = node.parent
    if node.type not in ("identifier", "attribute") or above is None:
        return True
    if above.type in ("attribute", "call"):  # what it is of, its own name, or what is called
        return True
    if above.type == "keyword_argument" and above.child_by_field_name("name") == node:
        return True
    if node.type == "identifier":
        meaning = reading.name(text_of(node), node, frame)
        if isinstance(meaning, Own):
            return False
        if isinstance(meaning, Message):
            return _is_looked_at(node)
    elif text_of(field(node, "attribute")) in libraries.acting_methods():
        return False
    return reading.function(node, frame) is None or getter(reading, node, frame) is not None


def _is_looked_at(node: Node) -> bool:
    """Whether something only looks at a message: a log or a text."""
    at = climb(node, lambda n: n.type == "call" or n.type.endswith("statement"))
    if at is None or at.type != "call":
        return True
    return is_log(at) or last_name(field(at, "function")) in libraries.harmless()


def is_still(reading: Reading, own: Scope) -> bool:
    """Whether a function of the node changes nothing: it only computes what it gives."""
    is_plain = HARMLESS_DECORATORS.issuperset(own.decorators)
    return is_plain and _changes_nothing(reading, own) and _comes_back(reading, own)


def _comes_back(reading: Reading, own: Scope) -> bool:
    """Whether the loops of a function end: nobody reads them where it only gives a value."""
    loops = (n for n in nodes_in(own.node) if n.type in _LOOPS)
    return all(reading.form is not None and reading.form.ends(own.py, n) for n in loops)


def getter(reading: Reading, node: Node, frame: Frame) -> Scope | None:
    """The function that `self.name` calls, where that is a property that changes nothing."""
    if node.type != "attribute" or field(node, "object").type != "identifier":
        return None
    own = reading.function(node, frame)
    return own if own is not None and is_getter(reading, own) else None


def is_getter(reading: Reading, own: Scope) -> bool:
    """Whether a method is a property that is only read, and that changes nothing."""
    if own.decorators != ["property"] or reading.values.is_stored(own.name):
        return False
    lineage = reading.unit.lineage
    bound_here = [b for c in lineage for b in c.names.get(own.name, ())]
    is_plain = all(b.how == "scope" for b in bound_here)
    is_set = any(own.name in c.attributes or len(c.names.get(own.name, ())) > 1 for c in lineage)
    return is_plain and not is_set and _changes_nothing(reading, own)


def _changes_nothing(reading: Reading, own: Scope) -> bool:
    return is_quiet_body(reading, own, 0) and not any(
        b.how in ("value", "augmented") and scope_of_binding(b, own)
        for above in reading.unit.lineage
        for of in above.attributes.values()
        for b in of
    )


def scope_of_binding(binding: Binding, own: Scope) -> bool:
    """Whether a binding stands in a function."""
    return (
        own.node.start_byte <= binding.node.start_byte
        and binding.node.end_byte <= own.node.end_byte
    )
