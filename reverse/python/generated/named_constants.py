"""Numbers and truth values that generated Python gives names to, as the model writes them."""

from __future__ import annotations

import builtins
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field as with_default
from itertools import count, takewhile
from math import isfinite
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.literals import literal_of
from rebsync.records import dataclass
from rebsync.reverse.python.generated.kinds import float_literal
from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import Class, External, Items, Module, Value
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import (
    CLASS,
    PyCode,
    Scope,
    arguments_of,
    has_splat,
    module_named,
    module_of,
)
from rebsync.reverse.syntax.py_tree import field, named, text_of

_INTEGERS, _ENUM = "enum.IntEnum", "enum.Enum"
_PLAIN_BASES = frozenset({"builtins.object", "abc.ABC", _INTEGERS})
_FROZEN = frozenset({"dataclass(frozen=True)", "dataclasses.dataclass(frozen=True)"})
_TUPLES = frozenset({"NamedTuple", "typing.NamedTuple"})
_FUNCTIONS = frozenset({"function_definition", "decorated_definition"})
_DATA = frozenset(
    {"string", "string_start", "string_content", "string_end", "integer", "float"}
) | {
    *("true", "false", "none", "dictionary", "pair", "list", "tuple", "set", "unary_operator"),
    *("concatenated_string", "comment", "parenthesized_expression"),
}
_LISTS = frozenset({"list", "tuple"})
_LARGEST = 2**31 - 1
_NAMED = re.compile(r"([^\W\d]\w*)((?:\.\w+)*)(?:\[(\d+)\])?")


@dataclass(frozen=True, slots=True)
class Record:
    """An object that does not change, by those of its fields that are constants."""

    fields: dict[str, Constant]


Constant: TypeAlias = "Value | Record"


@dataclass(eq=False, slots=True)
class CodeConstants:
    """The constants of some files: what is bound once, by its text, and by nothing else.

    `messages` are the numbers that the package's message types name.
    """

    values: PyValues
    messages: Mapping[str, Mapping[str, int]] = with_default(default_factory=dict)

    @property
    def code(self) -> PyCode:
        return self.values.code

    def of(self, scope: Scope, name: str) -> Constant | None:
        """What a name of a module or a class always stands for; None if that is not known."""
        bindings = scope.names.get(name, [])
        if len(bindings) != 1 or hasattr(builtins, name) or self._is_stored(scope, name):
            return None
        binding = bindings[0]
        match binding.how:
            case "import":
                return self._imported(scope, name, binding)
            case "scope":
                return self._only(binding, name, scope)
            case "value" if _is_auto(scope, binding.value):
                return self._numbered(scope, name)
            case "value" if binding.value.type == "call":
                return self._made(scope, binding.value)
            case "value" if binding.value.type != "list" or self._is_kept(scope, name):
                return self._only(binding, name, scope) if self._is_steady(binding.value) else None
            case _:
                return None

    def part(self, holder: Constant | None, name: str) -> Constant | None:
        """The same of an attribute of what is constant."""
        match holder:
            case Module(scope):
                return self.of(scope, name)
            case Class(scope) if self._is_plain(scope):
                return self.of(scope, name)
            case Class(scope) if self._is_plain(scope, _ENUM):
                value = self.of(scope, name)
                return Record({"value": value}) if value is not None else None
            case Record(fields):
                return fields.get(name)
            case _:
                return None

    def numbers(self, holder: Constant | None) -> bool:
        """Whether what is constant is an enumeration of integers, whose members have a value."""
        if not isinstance(holder, Class):
            return False
        return any(
            isinstance(c, External) and c.name == _INTEGERS
            for c in lineage(self.values, holder.scope)
        )

    def is_quiet(self, scope: Scope, statement: Node) -> bool:
        """Whether a statement of a module or class only names constants, or defines a function.

        Where these are used, the reader of bodies looks at what they are.
        """
        if statement.type == "function_definition":
            return _is_new(scope, text_of(field(statement, "name")))
        inner = named(statement)[0] if statement.type == "expression_statement" else None
        value = inner.child_by_field_name("right") if inner is not None else None
        if inner is None or value is None or inner.type != "assignment":
            return False
        left = field(inner, "left")
        if text_of(left) == "__all__":
            return value.type in _LISTS
        is_many = left.type in ("pattern_list", "tuple_pattern")
        names = [text_of(n) for n in (named(left) if is_many else [left])]
        is_data = scope.kind != CLASS and left.type == "identifier" and _is_data(value)
        return all(_is_new(scope, n) and (is_data or _is_known(self.of(scope, n))) for n in names)

    # --- what is bound --------------------------------------------------------------------------

    def _is_stored(self, scope: Scope, name: str) -> bool:
        """Whether an object has another value than its class, or others store one there."""
        others = (s for s in self.code.scopes.values() if scope.kind == CLASS)
        return self.values.is_stored(name) or any(name in other.attributes for other in others)

    def _is_steady(self, value: Node) -> bool:
        """Whether an expression gives the same at any time: it calls nothing, nor asks what may."""
        parts = list(nodes_in(value))
        names = {text_of(field(n, "attribute")) for n in parts if n.type == "attribute"}
        is_stored = any(map(self.values.is_stored, names))
        return not is_stored and all(n.type != "call" for n in parts)

    def _is_kept(self, scope: Scope, name: str) -> bool:
        """Whether a list only gives choices, in its own module."""
        if not name.startswith("_"):
            return False
        word, text = re.escape(name), scope.py.source.text
        use = re.compile(rf"\.{word}\b|\bimport\b[^\n]*\b{word}\b")
        modules = (module for module in self.code.modules.values() if module is not scope.module)
        if any(use.search(module.py.source.text) for module in modules):
            return False
        choices = re.findall(rf"\bself\._mailbox\.choose\((?:self\.)?{word}[,)]", text)
        return len(re.findall(rf"\b{word}\b", text)) == 1 + len(choices)

    def _only(self, binding: Binding, name: str, scope: Scope) -> Constant | None:
        """What the evaluator follows a binding to, if that is one value."""
        ways = self.values.bound(binding, name, scope)
        return ways[0] if len(ways) == 1 else None

    def _imported(self, scope: Scope, name: str, binding: Binding) -> Constant | None:
        found = self._only(binding, name, scope)
        if isinstance(found, Module) or binding.node.type == "import_statement":
            return found
        if module_of(binding.node).endswith(".msg") and name in self.messages:
            return Record({**self.messages[name]})
        source, item = module_named(self.code, module_of(binding.node), scope), binding.value
        wanted = field(item, "name") if item.type == "aliased_import" else item
        is_other = source is not None and source is not scope.module
        return self.of(source, text_of(wanted)) if source is not None and is_other else None

    # --- classes --------------------------------------------------------------------------------

    def _numbered(self, owner: Scope, name: str) -> Constant | None:
        """What `auto()` gives in an enumeration: one more than the greatest before it."""
        names = list(_names_before(owner, name))
        before = [self.of(owner, each) for each in names]
        numbers = [n for n in before if isinstance(n, int) and not isinstance(n, bool)]
        is_known = len(numbers) == len(names) and (
            self._is_plain(owner) or self._is_plain(owner, _ENUM)
        )
        is_last = not numbers or numbers[-1] == max(numbers)
        return (numbers or [0])[-1] + 1 if is_known and is_last else None

    def _is_plain(self, owner: Scope, base: str = _INTEGERS) -> bool:
        """Whether what a class binds is what its attributes are, as it is not in an `Enum`.

        Those of an enumeration of integers with functions may compare otherwise.
        """
        line = lineage(self.values, owner)
        classes = [each for each in line if isinstance(each, Scope)]
        above = {each.name for each in line if isinstance(each, External)}
        is_known = len(line) == 1 + sum(len(_bases(each)) for each in classes)
        bodies = (s for each in classes for s in named(field(each.node, "body")))
        has_functions = any(s.type in _FUNCTIONS for s in bodies)
        if base == _ENUM and _ENUM not in above:
            return False
        return is_known and above <= _PLAIN_BASES | {base} and not (base in above and has_functions)

    def _made(self, scope: Scope, call: Node) -> Record | None:
        """`LIMITS = Limits(last=10)`, of a class whose objects do not change."""
        made = self.values.ways(field(call, "function"), scope)
        if len(made) != 1 or not isinstance(made[0], Class) or has_splat(call):
            return None
        owner = made[0].scope
        bases = {text_of(b) for b in _bases(owner)}
        is_frozen = bool(_FROZEN & set(owner.decorators)) and not bases
        body = [named(s)[0] for s in named(field(owner.node, "body")) if named(s)]
        if not (is_frozen or (bases and bases <= _TUPLES)) or any(
            s.type not in ("assignment", "string") for s in body
        ):
            return None
        fields = [s for s in body if s.child_by_field_name("type") is not None]
        given = {text_of(field(s, "left")): s.child_by_field_name("right") for s in fields}
        plain, keywords = arguments_of(call)
        given |= {**dict(zip(given, plain, strict=False)), **keywords}
        steady = {n: v for n, v in given.items() if v is not None and self._is_steady(v)}
        ways = {n: self.values.ways(v, scope) for n, v in steady.items()}
        return Record({n: found[0] for n, found in ways.items() if len(found) == 1})


@dataclass(eq=False, slots=True)
class NamedConstants:
    """The constants that functions of a module name, and behind `self.` those of some classes.

    They are asked for by the text that names them: `LAST`, `limits.LAST`, `self.LAST`, `LIMITS[0]`.
    """

    code: CodeConstants
    module: Scope
    line: Sequence[Scope] = ()
    _found: dict[str, m.Expression | None] = with_default(default_factory=dict)

    def __contains__(self, text: str) -> bool:
        return self.get(text) is not None

    def binds(self, name: str) -> bool:
        """Whether a name is the module's own, whatever Python has by that name."""
        return name in self.module.names

    def get(self, text: str) -> m.Expression | None:
        """The literal that a text stands for; None if it is no such name."""
        if text not in self._found:
            match = _NAMED.fullmatch(text)
            self._found[text] = self._read(match) if match is not None else None
        return self._found[text]

    def elements(self, text: str) -> tuple[m.Expression, ...]:
        """Those of a constant tuple or list."""
        each = (self.get(f"{text}[{number}]") for number in count())
        return tuple(x for x in takewhile(bool, each) if x is not None)

    def _read(self, match: re.Match[str]) -> m.Expression | None:
        head, *rest = f"{match[1]}{match[2]}".split(".")
        found: Constant | None
        if head == "self":
            owner = next((c for c in self.line if rest and rest[0] in c.names), None)
            found = self.code.of(owner, rest.pop(0)) if owner is not None else None
        elif (inner := self._whole_module((head, *rest))) is not None:
            found, rest = inner
        else:
            found = self.code.of(self.module, head)
        holder: Constant | None = None
        for name in rest:
            if not (name == "value" and self.code.numbers(holder)):
                holder, found = found, self.code.part(found, name)
        if match[3] is None:
            return _literal(found)
        at, each = int(match[3]), found.each if isinstance(found, Items) else ()
        return _literal(each[at][0]) if at < len(each) and len(each[at]) == 1 else None

    def _whole_module(self, names: Sequence[str]) -> tuple[Constant, list[str]] | None:
        """The module that `import package.limits` brings, and the names behind it."""
        match self.module.names.get(names[0]):
            case [Binding("import", item, Node(type="import_statement"))]:
                dotted = text_of(item).split(".")
                inner = module_named(self.code.code, text_of(item), self.module)
                if inner is not None and [*names[: len(dotted)]] == dotted and len(dotted) > 1:
                    return Module(inner), [*names[len(dotted) :]]
        return None


def _literal(constant: Constant | None) -> m.Expression | None:
    """A number or truth value as the model writes it; None for one that it does not hold."""
    match constant:
        case float() if isfinite(constant):
            number = float_literal(repr(abs(constant)))
            return number if repr(constant)[0] != "-" else m.Unary("-", number)
        case int() if abs(constant) <= _LARGEST:
            return literal_of(constant)
        case _:
            return None


def _is_known(constant: Constant | None) -> bool:
    if isinstance(constant, Items):
        return all(len(ways) == 1 and _is_known(ways[0]) for ways in constant.each)
    return isinstance(constant, Record) or _literal(constant) is not None


def _is_data(value: Node) -> bool:
    """Whether an expression is put together of literals alone."""
    return all(node.type in _DATA for node in nodes_in(value) if node.is_named)


def _is_new(scope: Scope, name: str) -> bool:
    """Whether a name stands for nothing else."""
    return len(scope.names.get(name, ())) == 1 and not hasattr(builtins, name)


def _bases(owner: Scope) -> list[Node]:
    bases = owner.node.child_by_field_name("superclasses")
    return named(bases) if bases is not None else []


def _is_auto(scope: Scope, value: Node) -> bool:
    """Whether a class gives a member the next number: `MOVE = auto()`."""
    if scope.kind != CLASS or value.type != "call" or named(field(value, "arguments")):
        return False
    return imported_as(scope.module, text_of(field(value, "function"))) == "enum.auto"


def _names_before(owner: Scope, name: str) -> Iterator[str]:
    """The members of an enumeration that stand before one."""
    for statement in named(field(owner.node, "body")):
        inner = named(statement)[0] if statement.type == "expression_statement" else statement
        if inner.type != "assignment" or inner.child_by_field_name("right") is None:
            continue
        if text_of(field(inner, "left")) == name:
            return
        yield text_of(field(inner, "left"))
