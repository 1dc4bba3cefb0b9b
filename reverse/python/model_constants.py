"""Numbers and truth values that generated Python gives names to, and what else says nothing."""

from __future__ import annotations

import builtins
import re
from collections.abc import Iterator, Mapping
from dataclasses import field as with_default
from operator import add, floordiv, mul, sub

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.building import whole_number
from rebsync.reverse.python.py_bindings import Binding
from rebsync.reverse.python.py_imports import module_named, module_of
from rebsync.reverse.python.py_index import CLASS, PyCode, Scope
from rebsync.reverse.python.py_tree import Py, field, named, text_of

_LITERALS = frozenset({"integer", "float", "true", "false"})
_OPERATORS = {"+": add, "-": sub, "*": mul, "//": floordiv}
_FROZEN = frozenset({"dataclass(frozen=True)", "dataclasses.dataclass(frozen=True)"})
_TUPLES = frozenset({"NamedTuple", "typing.NamedTuple"})
_ENUMERATIONS = frozenset({"IntEnum", "enum.IntEnum"})
_PLAIN_BASES = frozenset({"object", "ABC", "abc.ABC"}) | _ENUMERATIONS
_FUNCTIONS = frozenset({"function_definition", "decorated_definition"})
_LARGEST = 2**31 - 1
_DEEPEST = 4  # modules that import a constant from each other

Constants = Mapping[str, m.Expression]


def constants_in(code: PyCode, module: Scope) -> dict[str, m.Expression]:
    """What constants of a module are, by all that they are called in it: `LAST`, `limits.LAST`.

    Those of its classes, of what is made of these, and of imported modules are among them.
    """
    return _Constants(code).of(module, 0)


@dataclass(frozen=True, slots=True, eq=False)
class _Constants:
    """Those of modules that import each other, each found once at each depth."""

    code: PyCode
    known: dict[tuple[int, int], dict[str, m.Expression]] = with_default(default_factory=dict)

    def of(self, module: Scope, depth: int) -> dict[str, m.Expression]:
        """Those of a module that is reached through so many others."""
        key = id(module), depth
        if key not in self.known:
            self.known[key] = _constants_in(self, module, depth)
        return self.known[key]


def _constants_in(all_: _Constants, module: Scope, depth: int) -> dict[str, m.Expression]:
    code, found = all_.code, constants_of(module)
    for name, bindings in module.names.items():
        if len(bindings) != 1 or hasattr(builtins, name):
            continue
        binding = bindings[0]
        if binding.how == "scope" and binding.node.type == "class_definition":
            owner = code.scope_of(binding.node, module.py)
            if not _is_plain(code, module, binding.node):
                continue
            own = {k: v for k, v in constants_of(owner).items() if k not in owner.attributes}
            found |= {f"{name}.{key}": value for key, value in own.items()}
        elif binding.how == "import" and depth < _DEEPEST:
            found |= _imported(all_, module, name, binding.node, binding.value, depth)
        elif binding.how == "value" and binding.value is not None:
            found |= _made(code, module, name, binding.value)
            if binding.value.type == "list" and _is_named_elsewhere(code, module, name):
                found = {k: v for k, v in found.items() if not k.startswith(f"{name}[")}
    stored = {name for scope in code.scopes.values() for _, name in scope.stores}
    return {k: v for k, v in found.items() if "." not in k or k.rpartition(".")[2] not in stored}


def _is_named_elsewhere(code: PyCode, module: Scope, name: str) -> bool:
    """Whether other modules may have to do with a name of a module."""
    use = re.compile(rf"\.{re.escape(name)}\b|\bimport\b[^\n]*\b{re.escape(name)}\b")
    others = (each for each in code.modules.values() if each is not module)
    return any(use.search(each.py.source.text) for each in others)


def constants_of(scope: Scope) -> dict[str, m.Expression]:
    """The names of a module or a class that are bound once, to what is always the same."""
    found: dict[str, m.Expression] = {}
    for name, bindings in scope.names.items():
        if len(bindings) == 1 and bindings[0].how == "value" and not hasattr(builtins, name):
            value = _part(bindings[0])
            read = _value(scope.py, value, found) if value is not None else None
            if read is not None:
                found[name] = read
            elif value is not None and _is_fixed(scope, name, value):
                each = [_value(scope.py, v, found) for v in named(value)]
                if None not in each:
                    found |= {f"{name}[{i}]": v for i, v in enumerate(each) if v is not None}
    return found


def _part(binding: Binding) -> Node | None:
    """What a name is bound to, one of several at once perhaps; None if that is not written out."""
    value = binding.value
    for index in binding.path:
        parts = named(value) if value.type in ("tuple", "expression_list") else []
        if index >= len(parts) or any(p.type == "list_splat" for p in parts):
            return None
        value = parts[index]
    return value


def enumerations_of(module: Scope) -> dict[str, m.Expression]:
    """The members of the module's enumerations of integers, `Command.STOP`, as what they are."""
    found: dict[str, m.Expression] = {}
    for node in named(module.node):
        bases = {text_of(b) for b in _bases(node)}
        if node.type != "class_definition" or not bases or not bases <= _ENUMERATIONS:
            continue
        name, body = text_of(field(node, "name")), named(field(node, "body"))
        if any(s.type in _FUNCTIONS for s in body):
            continue  # which may compare otherwise
        for statement in body:
            inner = named(statement)[0] if statement.type == "expression_statement" else None
            if inner is None or inner.type != "assignment" or not _is_new(module, name):
                continue
            value = inner.child_by_field_name("right")
            read = _value(module.py, value, {}) if value is not None else None
            if value is not None and value.type == "integer" and read is not None:
                found[f"{name}.{text_of(field(inner, 'left'))}"] = read
    return found


def _is_plain(code: PyCode, module: Scope, node: Node) -> bool:
    """Whether the constants of a class are what they are bound to, as they are not in an `Enum`.

    Those of an enumeration of integers with functions may compare otherwise.
    """
    line = list(_line(code, module, node))
    known = [each for each in line if each is not None]
    is_enumeration = any(text_of(b) in _ENUMERATIONS for n in known for b in _bases(n))
    has_functions = any(s.type in _FUNCTIONS for n in known for s in named(field(n, "body")))
    return len(known) == len(line) and not (is_enumeration and has_functions)


def _line(code: PyCode, module: Scope, node: Node, depth: int = 0) -> Iterator[Node | None]:
    """A class and those above it; None for one that is not known."""
    yield node
    for base in _bases(node):
        name = text_of(base)
        if name in _PLAIN_BASES:
            continue
        bindings = module.names.get(name, [])
        source = module
        if len(bindings) == 1 and bindings[0].node.type == "import_from_statement":
            found = module_named(code, module_of(bindings[0].node), module)
            bindings, source = (found.names.get(name, []), found) if found else ([], module)
        if len(bindings) == 1 and bindings[0].node.type == "class_definition" and depth <= _DEEPEST:
            yield from _line(code, source, bindings[0].node, depth + 1)
        else:
            yield None


def _bases(node: Node) -> list[Node]:
    bases = node.child_by_field_name("superclasses")
    return named(bases) if bases is not None else []


def is_quiet(scope: Scope, statement: Node) -> bool:
    """Whether a statement of a module or a class only names a constant or defines a function.

    Where these are used, the reader of bodies looks at what they are.
    """
    if statement.type == "function_definition":
        return _is_new(scope, text_of(field(statement, "name")))
    inner = named(statement)[0] if statement.type == "expression_statement" else None
    if inner is None or inner.type != "assignment":
        return False
    left, value = field(inner, "left"), inner.child_by_field_name("right")
    if left.type in ("pattern_list", "tuple_pattern"):
        known = constants_of(scope)
        names = map(text_of, named(left))
        return all(name in known and _is_new(scope, name) for name in names)
    if left.type != "identifier" or value is None:
        return False
    if text_of(left) == "__all__":
        return value.type in ("list", "tuple")
    is_known = _value(scope.py, value, constants_of(scope)) is not None or (
        _is_fixed(scope, text_of(left), value) and all(map(_is_literal, named(value)))
    )
    return (is_known or _is_record(scope, value)) and _is_new(scope, text_of(left))


def _is_fixed(scope: Scope, name: str, value: Node) -> bool:
    """Whether a value is a tuple, or a list of the module's own that only gives choices."""
    if value.type == "list" and name.startswith("_"):
        text = scope.py.source.text
        choices = re.findall(rf"\bself\._mailbox\.choose\((?:self\.)?{re.escape(name)}[,)]", text)
        return len(re.findall(rf"\b{re.escape(name)}\b", text)) == 1 + len(choices)
    return value.type == "tuple"


def _is_new(scope: Scope, name: str) -> bool:
    """Whether a name stands for nothing else."""
    return len(scope.names.get(name, ())) == 1 and not hasattr(builtins, name)


def _is_literal(node: Node) -> bool:
    if node.type == "unary_operator":
        return text_of(field(node, "operator")) == "-" and _is_literal(field(node, "argument"))
    return node.type in _LITERALS


# --- values -------------------------------------------------------------------------------------


def _value(py: Py, node: Node, known: Constants) -> m.Expression | None:
    """A literal, or the whole number that some of them make; None for anything else."""
    span = py.span(node)
    match node.type:
        case "true" | "false":
            return m.BoolLiteral(node.type == "true", span)
        case "float":
            return m.FloatLiteral(text_of(node), span)
        case "unary_operator" if text_of(field(node, "argument")) and _is_literal(node):
            inner = _value(py, field(node, "argument"), known)
            return m.Unary("-", inner, span) if inner is not None else None
        case _:
            number = _whole(node, known)
    if number is None or abs(number) > _LARGEST:
        return None
    literal = m.IntLiteral(abs(number), span)
    return literal if number >= 0 else m.Unary("-", literal, span)


def _whole(node: Node, known: Constants) -> int | None:
    match node.type:
        case "integer" if text_of(node).replace("_", "").isdigit():
            return int(text_of(node))
        case "integer":
            return int(text_of(node), 0) if text_of(node)[-1] not in "lLjJ" else None
        case "identifier":
            return whole_number(known.get(text_of(node)))
        case "parenthesized_expression" if len(named(node)) == 1:
            return _whole(named(node)[0], known)
        case "unary_operator" if text_of(field(node, "operator")) == "-":
            inner = _whole(field(node, "argument"), known)
            return -inner if inner is not None else None
        case "binary_operator":
            left, right = (_whole(field(node, side), known) for side in ("left", "right"))
            operator = text_of(field(node, "operator"))
            if left is None or right is None or operator not in _OPERATORS:
                return None
            return None if operator == "//" and not right else _OPERATORS[operator](left, right)
        case _:
            return None


# --- elsewhere ----------------------------------------------------------------------------------


def _imported(
    all_: _Constants, module: Scope, name: str, node: Node, item: Node | None, depth: int
) -> dict[str, m.Expression]:
    """The constants that an import brings under a name."""
    if item is None:
        return {}
    code = all_.code
    wanted = text_of(field(item, "name") if item.type == "aliased_import" else item)
    if node.type == "import_statement":
        source = module_named(code, wanted, module)
        called = name if item.type == "aliased_import" else wanted
        return _below(all_, source, module, called, depth)
    source = module_named(code, module_of(node), module)
    if source is None or source is module or wanted not in source.names:
        inner = module_named(code, f"{module_of(node).rstrip('.')}.{wanted}", module)
        return _below(all_, inner, module, name, depth)
    given = all_.of(source, depth + 1) | enumerations_of(source)
    return {
        f"{name}{key.removeprefix(wanted)}": value
        for key, value in given.items()
        if key == wanted or key.startswith((f"{wanted}.", f"{wanted}["))
    }


def _below(
    all_: _Constants, source: Scope | None, module: Scope, name: str, depth: int
) -> dict[str, m.Expression]:
    if source is None or source is module:
        return {}
    return {f"{name}.{k}": v for k, v in all_.of(source, depth + 1).items()}


def _made(code: PyCode, module: Scope, name: str, value: Node) -> dict[str, m.Expression]:
    """The fields of `LIMITS = Limits(last=10)`, of a class whose objects do not change."""
    owner = _record(code, module, value)
    if owner is None:
        return {}
    known = constants_of(module)
    fields = list(_fields(owner))
    given: dict[str, Node | None] = dict(fields)
    for (key, _), argument in zip(fields, named(field(value, "arguments")), strict=False):
        if argument.type != "keyword_argument":
            given[key] = argument
    for argument in named(field(value, "arguments")):
        if argument.type == "keyword_argument":
            given[text_of(field(argument, "name"))] = field(argument, "value")
    read = {k: _value(module.py, v, known) for k, v in given.items() if v is not None}
    return {f"{name}.{k}": v for k, v in read.items() if v is not None}


def _is_record(scope: Scope, value: Node) -> bool:
    """Whether a value is made of a class of the module whose objects do not change."""
    return scope.kind != CLASS and _record(None, scope, value) is not None


def _record(code: PyCode | None, module: Scope, value: Node) -> Scope | None:
    called = text_of(field(value, "function")) if value.type == "call" else ""
    bindings = module.names.get(called, [])
    if len(bindings) != 1 or bindings[0].how != "scope":
        return None
    node = bindings[0].node
    if node.type != "class_definition":
        return None
    owner = code.scope_of(node, module.py) if code is not None else module
    bases = node.child_by_field_name("superclasses")
    above = {text_of(b) for b in named(bases)} if bases is not None else set()
    around = node.parent.children if node.parent is not None else []
    decorators = {text_of(c).lstrip("@ ") for c in around if c.type == "decorator"}
    is_record = (above <= _TUPLES and bool(above)) or (not above and bool(decorators & _FROZEN))
    functions = [s for s in named(field(node, "body")) if s.type not in _SAID]
    return owner if is_record and not functions else None


_SAID = frozenset({"expression_statement", "pass_statement"})


def _fields(owner: Scope) -> Iterator[tuple[str, Node | None]]:
    """The fields that the body of a class declares, with what they are by default."""
    for statement in named(field(owner.node, "body")):
        inner = named(statement)[0] if statement.type == "expression_statement" else None
        is_field = inner is not None and inner.child_by_field_name("type") is not None
        if inner is not None and is_field:
            yield text_of(field(inner, "left")), inner.child_by_field_name("right")
