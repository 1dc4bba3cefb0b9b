"""Types, names and markers of generated Python, as the model has them."""

from __future__ import annotations

import builtins
import re
from collections.abc import Iterator
from functools import lru_cache

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import uncarry
from rebsync.reserved import NO_PYTHON_CLASSES
from rebsync.reverse.bodies.written import annotation
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import Py, field, is_constant_text, named, parse, text_of
from rebsync.source import Source

_PLAIN = {
    "Byte": "byte",
    "Short": "short",
    "int": "int",
    "Float": "float",
    "float": "double",
    "bool": "boolean",
    "None": "void",
}
_CHARACTERS = re.compile(r"\\.|[^\\]", re.DOTALL)
_MARKER = re.compile(r"#\s*rebsync:\s*(.*?)\s*$")
_OF_TYPING = re.compile(r"from\s+typing\s|import\s+typing\Z")
_QUOTES = "\"'"
_UNSET = re.compile(r"(?:int|Byte|Short|Float|float|bool|Rebec)\(\)\Z|array\(")


def class_name(text: str) -> str:
    """The reactive class of a Python class."""
    return uncarry(text, NO_PYTHON_CLASSES)


def type_of(node: Node | None) -> m.Type | None:
    """The type that an annotation says; None for what the model has no type for."""
    if node is None:
        return None
    if node.type == "type":
        return type_of(named(node)[0]) if named(node) else None
    if node.type == "string":
        return _quoted(text_of(node))
    if node.type in ("identifier", "none"):
        plain = _PLAIN.get(text_of(node)) or _PLAIN.get(_alias_in(_root_of(node), text_of(node)))
        return m.Type(plain) if plain is not None else None
    if node.type == "generic_type":
        head, parameters = named(node)[0], named(named(node)[1])
    elif node.type == "subscript":
        head, *parameters = named(node)
    else:
        return None
    return _generic(text_of(head), parameters)


def _root_of(node: Node) -> Node:
    """The module that something stands in."""
    while node.parent is not None:
        node = node.parent
    return node


def _alias_in(module: Node, name: str) -> str:
    """The type that a name of a module is another word for: `Cell = int`; empty for no such one."""
    values = [v for s in named(module) if (v := alias_of(s)) is not None and v[0] == name]
    return values[0][1] if len(values) == 1 else ""


def alias_of(statement: Node) -> tuple[str, str] | None:
    """What a statement at the top of a module names a plain type, and that type; else None."""
    inner = named(statement)[0] if statement.type == "expression_statement" else statement
    if inner.type != "assignment":
        return None
    said, value = inner.child_by_field_name("type"), inner.child_by_field_name("right")
    is_said = said is None or text_of(said).rpartition(".")[2] == "TypeAlias"
    if value is not None and (made := _new_type(value)) is not None:
        is_whole = made[0] == text_of(field(inner, "left")) and said is None
        return made if is_whole and made[1] in _PLAIN else None
    is_name = is_said and value is not None and value.type == "identifier"
    if not is_name or value is None or field(inner, "left").type != "identifier":
        return None
    return (text_of(field(inner, "left")), text_of(value)) if text_of(value) in _PLAIN else None


def _new_type(value: Node) -> tuple[str, str] | None:
    """The name and the type of `NewType("Cell", int)`."""
    called, arguments = call_parts(value) or ("", [])
    if called.rpartition(".")[2] != "NewType" or len(arguments) != 2:
        return None
    return string_value(arguments[0]) or "", text_of(arguments[1])


def is_new_type(module: Scope, name: str) -> bool:
    """Whether a name is a type of its own for who checks types: a call gives what it gets."""
    bindings = module.names.get(name, [])
    if len(bindings) != 1 or bindings[0].how != "value":
        return False
    called, _ = call_parts(bindings[0].value) or ("", [])
    made = module.names.get(called.partition(".")[0], [])
    is_library = len(made) == 1 and _OF_TYPING.match(text_of(made[0].node)) is not None
    return is_library and _new_type(bindings[0].value) is not None


def is_alias(module: Scope, statement: Node) -> bool:
    """Whether a statement gives a plain type another name, which means nothing else."""
    name = (alias_of(statement) or ("", ""))[0]
    value = expression_in(statement)
    made = value.child_by_field_name("right") if value is not None else None
    if made is not None and made.type == "call" and not is_new_type(module, name):
        return False
    return len(module.names.get(name, ())) == 1 and not hasattr(builtins, name)


@lru_cache(maxsize=256)
def _quoted(text: str) -> m.Type | None:
    """The type that an annotation in quotes says."""
    annotation = parse(Source("", f"x: {text.strip(_QUOTES)}")).root
    types = [n for n in nodes_in(annotation) if n.type == "type"]
    return type_of(types[0]) if types and not annotation.has_error else None


def _generic(head: str, parameters: list[Node]) -> m.Type | None:
    if head == "Rebec" and len(parameters) == 1:
        return m.Type(class_name(text_of(parameters[0]).rpartition(".")[2]))
    if head != "Array" or len(parameters) != 2:
        return None
    inner = type_of(parameters[0])
    length = re.search(r"\d+", text_of(parameters[1]))
    if inner is None or length is None:
        return None
    return m.Type(inner.name, (int(length[0]), *inner.dimensions))


def type_made(value: Node) -> m.Type | None:
    """The type that `int()` or `array(bool, 4)` makes; None for what is made otherwise."""
    called, arguments = call_parts(value) or ("", [])
    if called != "array":
        plain = _PLAIN.get(called)
        return m.Type(plain) if plain is not None and not arguments else None
    name, *lengths = [text_of(a) for a in arguments] or [""]
    if not all(map(str.isdecimal, lengths)):
        return None
    return m.Type(_PLAIN.get(name, class_name(name)), tuple(map(int, lengths)))


def is_unset(node: Node) -> bool:
    """Whether a value is that of a variable that nothing has been stored in."""
    return node.type == "call" and _UNSET.match(text_of(node)) is not None


def markers_above(py: Py, node: Node) -> list[str]:
    """The markers in the comments on the lines directly above something.

    They are those of what begins the line: of `if x: y()` the whole, and not `y()`.
    """
    above = node.parent
    if above is not None and above.type == "decorated_definition":
        node = above
    found: list[str] = []
    position = py.source.position(py.span(node).start)
    if py.source.line(position.line)[: position.column - 1].strip():
        return found
    number = position.line - 1
    while number > 0 and (line := py.source.line(number).strip()).startswith("#"):
        match = _MARKER.match(line)
        if match is not None:
            found.append(match[1])
        number -= 1
    return found[::-1]


def annotations_above(py: Py, node: Node) -> tuple[m.Annotation, ...]:
    """The annotations that the markers above something hold."""
    span = py.span(node)
    return tuple(a for x in markers_above(py, node) if (a := annotation(x, span)) is not None)


def markers_at(py: Py, node: Node) -> list[str]:
    """The markers above something, and that at the end of the line on which it ends."""
    span = py.span(node)
    position = py.source.position(span.end)
    rest = py.source.line(position.line)[position.column - 1 :]
    match = _MARKER.search(rest)
    beside = [match[1]] if match is not None else []
    return [*markers_above(py, node), *beside]


def literal_type(node: Node) -> m.Type | None:
    """The type of a variable that starts as a number or a truth value."""
    if node.type == "unary_operator" and text_of(field(node, "operator")) == "-":
        inner = literal_type(field(node, "argument"))
        return inner if inner != m.Type("boolean") else None
    kinds = {"integer": "int", "float": "double", "true": "boolean", "false": "boolean"}
    return m.Type(kinds[node.type]) if node.type in kinds else None


def passed_on(node: Node) -> tuple[str, list[Node]] | None:
    """What a callback calls, and with what: `lambda: f(x)`, `partial(f, x)`, or `f` itself."""
    if node.type == "lambda":
        return call_parts(called_late(node))
    called, arguments = call_parts(node) or ("", [])
    if called in ("partial", "functools.partial") and arguments:
        return text_of(arguments[0]), arguments[1:]
    return None if called else (text_of(node), [])


def field_read(node: Node, message: str) -> str:
    """The field of a message that a value is: as it is, as a rebec's name, or as an array."""
    inside = call_parts(node)
    plain = inside[1][0] if inside is not None and inside[1] else node
    return text_of(plain).removeprefix(f"{message}.")


def handed_over(node: Node) -> str:
    """The function that takes a message: `f`, or `lambda msg: f(msg)`."""
    if node.type == "lambda":
        called, arguments = call_parts(field(node, "body")) or ("", [])
        parameters = node.child_by_field_name("parameters")
        names = [text_of(p) for p in named(parameters)] if parameters is not None else []
        if called and len(names) == 1 and [text_of(a) for a in arguments] == names:
            return called
    return text_of(node)


def string_value(node: Node | None) -> str | None:
    """The text of a plain string."""
    if node is None or node.type != "string":
        return None
    return "".join(text_of(c) for c in node.children[1:-1])


def without_parentheses(node: Node) -> Node:
    """What stands in the parentheses that a formatter may have put around it."""
    while node.type == "parenthesized_expression" and len(named(node)) == 1:
        node = named(node)[0]
    return node


def call_parts(node: Node | None) -> tuple[str, list[Node]] | None:
    """The text of what is called, and the arguments, for a call without names for these."""
    if node is None or (node := without_parentheses(node)).type != "call":
        return None
    given = field(node, "arguments")
    arguments = [given] if given.type == "generator_expression" else named(given)
    return text_of(field(node, "function")), arguments


def expression_in(statement: Node) -> Node | None:
    """The expression or assignment that a statement is; none where it is a tuple of several."""
    inner = named(statement) if statement.type == "expression_statement" else []
    return inner[0] if len(inner) == 1 else None


def stored_into(inner: Node | None) -> str:
    """What an assignment stores into; nothing for what is none."""
    return text_of(field(inner, "left")) if inner is not None and inner.type == "assignment" else ""


def called_late(node: Node) -> Node | None:
    """What a function without a name does when it is called; None for what is none."""
    return without_parentheses(field(node, "body")) if node.type == "lambda" else None


def in_double_quotes(text: str) -> str:
    """A string as the model writes it: `'say "no"'` as `"say \\"no\\""`."""
    if not text.startswith("'") or text.startswith("'''"):
        return text
    written = {"\\'": "'", '"': '\\"'}
    return '"' + "".join(written.get(p, p) for p in _CHARACTERS.findall(text[1:-1])) + '"'


def only_breaks_lines(node: Node) -> bool:
    """Whether these are the parentheses that a formatter puts around what is too long a line.

    Those around an operand are the author's.
    """
    inner = named(node)[0]
    if node.parent is not None and node.parent.type.endswith("_operator"):
        return False
    is_apart = inner.start_point.row > node.start_point.row
    return is_apart and inner.type != "named_expression"


def messages_of(owners: list[Scope]) -> Iterator[str]:
    """The message types that the modules of some classes import."""
    for module in {id(o.module): o.module for o in owners}.values():
        for name, bindings in module.names.items():
            nodes = (b.node for b in bindings if b.how == "import")
            modules = (text_of(n.child_by_field_name("module_name") or n) for n in nodes)
            if any(module.endswith(".msg") for module in modules):
                yield name


def is_text(statement: Node) -> bool:
    """Whether a statement is a text that stands alone."""
    inner = expression_in(statement)
    return inner is not None and is_constant_text(inner)
