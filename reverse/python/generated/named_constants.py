"""Numbers and truth values that generated Python gives names to, as the model writes them."""

from __future__ import annotations

import builtins
import re
from collections.abc import Mapping, Sequence
from dataclasses import field as with_default
from itertools import count, takewhile
from math import isfinite

from tree_sitter import Node

from rebsync import model as m
from rebsync.literals import literal_of
from rebsync.records import dataclass
from rebsync.reverse.graph import Unresolved
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.bodies.body_tables import bound_once
from rebsync.reverse.python.generated.kinds import float_literal
from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_lookup import attribute
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import (
    Class,
    EnumMember,
    External,
    Instance,
    Items,
    Made,
    Module,
    Value,
    Ways,
)
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import CLASS, Scope, arguments_of, module_named
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of

_INTEGERS = "enum.IntEnum"
# Classes of which the attributes are what a class below them binds.
_PLAIN = frozenset({"builtins.object", "abc.ABC", "typing.NamedTuple", _INTEGERS, "enum.Enum"})
_FROZEN = frozenset({"dataclass(frozen=True)", "dataclasses.dataclass(frozen=True)"})
_FUNCTIONS = frozenset({"function_definition", "decorated_definition"})
_DATA = frozenset(
    {"string", "string_start", "string_content", "string_end", "integer", "float"}
) | {
    *("true", "false", "none", "dictionary", "pair", "list", "tuple", "set", "unary_operator"),
    *("concatenated_string", "comment", "parenthesized_expression"),
}
_NAMING = frozenset({"import", "scope", "value"})
_LISTS = frozenset({"list", "tuple"})
_LARGEST = 2**31 - 1
_OWN_CLASS = re.compile(r"\A(?:type\(self\)|self\.__class__)\.")
_NAMED = re.compile(r"([^\W\d]\w*)((?:\.\w+)*)(?:\[(\d+)\])?")


@dataclass(eq=False, slots=True)
class CodeConstants(PyValues):
    """What names and expressions of some files always stand for; all else is unknown.

    A constant is bound once, by its text, and by nothing else. `values` are those that expressions
    have at some time; `messages` the numbers that the package's message types name.
    """

    values: PyValues = with_default(kw_only=True)
    messages: Mapping[str, Mapping[str, int]] = with_default(default_factory=dict)

    def of(self, scope: Scope, name: str) -> Value | None:
        """What a name of a module or a class always stands for; None if that is not known."""
        bindings = scope.names.get(name, [])
        return _only(self.bound(bindings[0], name, scope)) if bindings else None

    def part(self, holder: Value | None, name: str, scope: Scope) -> Value | None:
        """The same of an attribute of what is constant."""
        if not isinstance(holder, Module | Class | Instance | EnumMember | External):
            return None
        return _only(tuple(attribute(self, holder, name, scope.node, scope)))

    def numbers(self, holder: Value | None) -> bool:
        """Whether what is constant is an enumeration of integers, whose members have a value."""
        return isinstance(holder, Class) and _INTEGERS in self._above(holder.scope)

    def literal(self, value: Value | None) -> m.Expression | None:
        """A number or truth value as the model writes it; None for one that it does not hold."""
        match value:
            case External(name):
                type_, _, constant = name.rpartition(".")
                of = self.messages.get(type_.rpartition(".")[2], {})
                return self.literal(of.get(constant)) if ".msg." in type_ else None
            case float() if isfinite(value):
                number = float_literal(repr(abs(value)))
                return number if repr(value)[0] != "-" else m.Unary("-", number)
            case int() if abs(value) <= _LARGEST:
                return literal_of(value)
            case _:
                return None

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
        shown = _within_set(value, scope.module)
        is_data = scope.kind != CLASS and left.type == "identifier" and _is_data(shown)
        return all(
            _is_new(scope, n) and (is_data or self._is_known(self.of(scope, n))) for n in names
        )

    def _is_known(self, value: Value | None) -> bool:
        if isinstance(value, Items):
            return all(self._is_known(_only(ways)) for ways in value.each)
        is_object = isinstance(value, Instance | Made) or is_moment(value)
        return is_object or self.literal(value) is not None

    def moment(self, module: Scope, name: str) -> Node | None:
        """`SOON = When(after=1)`: the time of sends that a variable of a module is."""
        match self.of(module, name):
            case Instance(_, (call, scope)) | Made(_, call, scope) if scope is module:
                is_moment_ = is_moment(_only(self.ways(field(call, "function"), scope)))
                return call if is_moment_ else None
            case _:
                return None

    # --- what is bound --------------------------------------------------------------------------

    def bound(self, binding: Binding, name: str, scope: Scope) -> Ways:
        """What a binding gives that is the only one of its name, and gives the same at any time."""
        is_only = binding.how in _NAMING and name != "*" and _is_new(scope, name)
        is_steady = binding.how != "value" or (is_only and self._is_steady(binding, name, scope))
        fits = not binding.path or self._fits(binding, scope)
        if is_only and is_steady and fits and not self._is_stored(scope, name):
            return PyValues.bound(self, binding, name, scope)
        return (self.unknown("this may change", binding.node, scope),)

    def _fits(self, binding: Binding, scope: Scope) -> bool:
        """Whether names are given as many values as they are: `A, B = 1, 2`."""
        left = binding.node.child_by_field_name("left")
        names = named(left) if left is not None else []
        value = _only(self.values.ways(binding.value, scope))
        is_flat = all(each.type == "identifier" for each in names)
        return is_flat and isinstance(value, Items) and len(value.each) == len(names)

    def _is_stored(self, scope: Scope, name: str) -> bool:
        """Whether an object has another value than its class, or others store one there."""
        others = (s for s in self.code.scopes.values() if scope.kind == CLASS)
        return self.values.is_stored(name) or any(name in other.attributes for other in others)

    def _is_steady(self, binding: Binding, name: str, scope: Scope) -> bool:
        """Whether an expression gives the same at any time: it calls nothing, nor asks what may."""
        value = binding.value
        if scope.kind == CLASS and not self._is_plain(scope):
            return False
        if value.type == "list":
            return self._is_kept(scope, name)
        calls = (n for n in nodes_in(value) if n.type == "call")
        return all(self._makes_constant(call, scope) for call in calls)

    def _makes_constant(self, call: Node, scope: Scope) -> bool:
        """Whether a call gives the next number of an enumeration, or an object with fields."""
        function = field(call, "function")
        if text_of(function) == "range" and "range" not in scope.module.names:
            return True
        match self.values.ways(function, scope):
            case (External(name="enum.auto"),):
                return True
            case (made,) if is_moment(made):
                plain, keywords = arguments_of(call)
                given = [*plain, *keywords.values()]
                is_whole = len(given) == len(named(field(call, "arguments")))
                return is_whole and all(n.type == "integer" for n in given)
            case (Class(owner),):
                line = (each for each in lineage(self.values, owner) if isinstance(each, Scope))
                bodies = (s for each in line for s in named(field(each.node, "body")))
                body = [named(s)[0] for s in bodies if named(s)]
                is_record = _FROZEN.issuperset(owner.decorators) and self._is_plain(owner)
                return is_record and all(
                    s.type == "assignment" or is_constant_text(s) for s in body
                )
            case _:
                return False

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

    def _is_plain(self, owner: Scope) -> bool:
        """Whether the attributes of a class are what it binds: all above it is known.

        Those of an enumeration with functions may compare otherwise.
        """
        line = lineage(self.values, owner)
        classes = [each for each in line if isinstance(each, Scope)]
        above = self._above(owner)
        is_known = len(line) == 1 + sum(len(_bases(each)) for each in classes)
        bodies = (s for each in classes for s in named(field(each.node, "body")))
        is_enumeration = any(name.startswith("enum.") for name in above)
        is_plain = not (is_enumeration and any(s.type in _FUNCTIONS for s in bodies))
        return is_known and is_plain and above <= _PLAIN | libraries.node_classes()

    def _above(self, owner: Scope) -> set[str]:
        line = lineage(self.values, owner)
        return {each.name for each in line if isinstance(each, External)}


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

    def of_run_time(self, name: str) -> str:
        """What the run-time part calls something, whatever the module does: `v.int32`."""
        whole = imported_as(self.module, name)
        for at in sorted((match.start() for match in re.finditer(r"\.\b", whole)), reverse=True):
            module = module_named(self.code.code, whole[:at], self.module) if at else None
            if module is not None and is_runtime_file(module.py.source):
                return whole[at + 1 :]
        return name

    def get(self, text: str) -> m.Expression | None:
        """The literal that a text stands for; None if it is no such name."""
        if text not in self._found:
            match = _NAMED.fullmatch(text if self.binds("type") else _OWN_CLASS.sub("self.", text))
            self._found[text] = self._read(match) if match is not None else None
        return self._found[text]

    def made(self, text: str) -> Node | None:
        """What a name of the module, or one behind `self.`, is bound to, if that is done once."""
        head, _, name = text.rpartition(".")
        scopes = (self.module,) if not head else self.line if head == "self" else ()
        owner = next((s for s in scopes if name in s.names), None)
        bindings = owner.names[name] if owner is not None else []
        is_once = len(bindings) == 1 and bindings[0].how == "value" and not bindings[0].path
        return bindings[0].value if is_once else None

    def container(self, text: str) -> Node | None:
        """The display that such a name always stands for: code only looks into it."""
        made = self.made(text)
        if made is None or bound_once(self.code.values, text.rpartition(".")[2]) != made:
            return None
        return _within_set(made, self.module)

    def tuple_of(self, text: str) -> tuple[m.Expression, ...]:
        """The elements of a constant tuple; none for anything else."""
        made, found = self.made(text), self.elements(text)
        is_tuple = made is not None and made.type == "tuple" and len(named(made)) == len(found)
        return found if is_tuple else ()

    def elements(self, text: str) -> tuple[m.Expression, ...]:
        """Those of a constant tuple or list."""
        each = (self.get(f"{text}[{number}]") for number in count())
        return tuple(x for x in takewhile(bool, each) if x is not None)

    def _read(self, match: re.Match[str]) -> m.Expression | None:
        head, *rest = f"{match[1]}{match[2]}".split(".")
        found: Value | None
        if head == "self":
            owner = next((c for c in self.line if rest and rest[0] in c.names), None)
            found = self.code.of(owner, rest.pop(0)) if owner is not None else None
        elif (inner := self._whole_module((head, *rest))) is not None:
            found, rest = inner
        else:
            found = self.code.of(self.module, head)
        holder: Value | None = None
        for name in rest:
            if not (name == "value" and self.code.numbers(holder)):
                holder, found = found, self.code.part(found, name, self.module)
        if match[3] is None:
            return self.code.literal(found)
        at, each = int(match[3]), found.each if isinstance(found, Items) else ()
        return self.code.literal(_only(each[at])) if at < len(each) else None

    def _whole_module(self, names: Sequence[str]) -> tuple[Value, list[str]] | None:
        """The module that `import package.limits` brings, and the names behind it."""
        match self.module.names.get(names[0]):
            case [Binding("import", item, Node(type="import_statement"))]:
                dotted = text_of(item).split(".")
                inner = module_named(self.code.code, text_of(item), self.module)
                if inner is not None and [*names[: len(dotted)]] == dotted and len(dotted) > 1:
                    return Module(inner), [*names[len(dotted) :]]
        return None


def is_moment(value: Value | None) -> bool:
    """Whether a value is the class of times of sends."""
    match value:
        case Class(Scope(name="When") as owner):
            return is_runtime_file(owner.py.source)
        case External(name):
            return name.endswith("values.When")
        case _:
            return False


def _only(ways: Ways) -> Value | None:
    return ways[0] if len(ways) == 1 and not isinstance(ways[0], Unresolved) else None


def _within_set(value: Node, module: Scope) -> Node:
    """The display in `frozenset({1, 2})`; any other expression as it is."""
    is_call = value.type == "call" and text_of(field(value, "function")) == "frozenset"
    given = named(field(value, "arguments")) if is_call and "frozenset" not in module.names else []
    is_shown = len(given) == 1 and given[0].type in ("set", "list", "tuple")
    return given[0] if is_shown else value


def _is_data(value: Node) -> bool:
    """Whether an expression is put together of literals alone."""
    return all(node.type in _DATA for node in nodes_in(value) if node.is_named)


def _is_new(scope: Scope, name: str) -> bool:
    """Whether a name stands for nothing else."""
    return len(scope.names.get(name, ())) == 1 and not hasattr(builtins, name)


def _bases(owner: Scope) -> list[Node]:
    bases = owner.node.child_by_field_name("superclasses")
    return named(bases) if bases is not None else []
