"""Parameters that a constructor of generated C++ reads into members in the words of people."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from tree_sitter import Node

from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reverse.bodies.types.cpp_types import type_of
from rebsync.reverse.generated.cpp_values import initial_values
from rebsync.reverse.generated.env_values import constant
from rebsync.reverse.generated.own_parameters import OwnParameter, only_once
from rebsync.reverse.generated.parameters import DECLARES, MOST_DECLARED, READS
from rebsync.reverse.generated.ros2_words import arguments_in, constant_of_model, known_rebec
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_SPELLED = {
    **dict.fromkeys(("int", "int32_t", "int64_t", "std::int32_t", "std::int64_t"), int),
    **{"bool": bool, "double": float},
}
_GIVES = {"as_int": int, "as_bool": bool, "as_double": float, "get_value": None}
_WRITES = ("assignment_expression", "update_expression")
_SERVER = "ros::param::"


@dataclass(frozen=True, slots=True)
class _ParameterRead:
    """What a statement of a constructor, or an initialiser, reads into a member, and no more."""

    member: str
    parameter: OwnParameter
    statement: Node
    constant: Node | None = None  # of a constant of the model what stands in for its value


@dataclass(frozen=True, slots=True)
class _Asked:
    """A parameter by its name, and the value that stands in for it; `into` is what gets it.

    Of a constant of the model `constant` is where that value stands.
    """

    key: str
    default: Value | None
    for_all: bool
    into: str = ""
    constant: Node | None = None

    def read(self, member: str, statement: Node) -> Iterator[_ParameterRead]:
        """What a member gets by it, if the model can say so."""
        if self.default is not None:
            widens = not self.for_all
            own = OwnParameter(self.key, self.default, widens, self.for_all)
            if own.is_plain or self.constant is not None:
                yield _ParameterRead(member, own, statement, self.constant)


def own_parameters(code: Code, owner: CppClass) -> tuple[dict[str, OwnParameter], set[int]]:
    """By state variable the parameter of the node that it gets, and the statements that say so.

    None of a class that is above or below another one, as the model's constructors go apart there.
    """
    constructors = [f for f in code.functions_of(owner) if f.name == owner.name]
    related = {name for each in code.classes.values() for name in each.bases} & {owner.name}
    above = (f for c in code.lineage(owner.name)[1:] for f in c.fields)
    if len(constructors) != 1 or related or any(text_of(f.type) == "Mailbox" for f in above):
        return {}, set()
    types = {f.name: type_of(f.type) for f in owner.fields}
    arguments = {key.replace(".", "/") for _, key in arguments_in(constructors[0])}
    reads = [
        r
        for r in _parameters_read(code, owner, constructors[0])
        if r.parameter.fits(types.get(r.member)) and r.parameter.key not in arguments
        if r.constant is None
    ]
    own = only_once((r.member, r.parameter) for r in reads)
    return own, {r.statement.id for r in reads if r.member in own}


def deciding_parameter(
    code: Code, constructor: CppFunction, statement: Node
) -> OwnParameter | None:
    """The parameter that is all that an `if` of a constructor asks for, or for its opposite."""
    if statement.type != "if_statement":
        return None
    asked = part(statement, "condition")
    while len(named(asked)) == 1 and (asked.type.endswith("clause") or _is_negated(asked)):
        asked = named(asked)[0]
    reader = _ParameterReader(code, constructor, {}, {})
    found = [r.parameter for r in reader.assigned("", asked, statement) if r.constant is None]
    return found[0] if found else None


def is_own_parameter(value: Node) -> bool:
    """Whether a value is that of a parameter that is none of the model."""
    call = call_of(value)
    if call is None or call.name not in READS or not call.arguments:
        return False
    key = string_of(call.arguments[0])
    is_own = key is not None and constant_of_model(key) is None and known_rebec(key) is None
    return is_own and call.on != "global" and not list(calls_in(part(call.node, "arguments")))


def _is_negated(node: Node) -> bool:
    return node.type == "unary_expression" and text_of(node).startswith("!")


def constants_read(
    code: Code, owner: CppClass, constructor: CppFunction
) -> Iterator[tuple[str, str, Node, int]]:
    """The constants of the model that a constructor reads in the words of people.

    Each by its member, its name, what stands in for it, and the statement that reads it. What
    another function changes is no constant.
    """
    others = (f for f in code.functions_of(owner) if f is not constructor)
    bodies = (f.body for f in others if f.body is not None)
    writes = (node for body in bodies for node in inside(body, *_WRITES))
    changed = {_member(named(node)[0]) for node in writes if named(node)}
    types = {f.name: type_of(f.type) for f in owner.fields if f.name not in changed}
    found = [r for r in _parameters_read(code, owner, constructor) if r.constant is not None]
    once = only_once((r.member, r.parameter) for r in found)
    for read in found:
        is_stored = read.member in once and read.parameter.fits(types.get(read.member))
        if is_stored and read.constant is not None:
            yield read.member, read.parameter.key, read.constant, read.statement.id


def _parameters_read(
    code: Code, owner: CppClass, constructor: CppFunction
) -> Iterator[_ParameterRead]:
    """What a constructor reads into members, whatever their types."""
    reader = _ParameterReader(code, constructor, dict(_starts(code, owner)), {})
    for initialiser in named(constructor.initialisers) if constructor.initialisers else ():
        name, *_, values = [*named(initialiser), initialiser]
        if len(named(values)) == 1:
            yield from reader.assigned(text_of(name), named(values)[0], initialiser)
    for statement in named(constructor.body) if constructor.body is not None else ():
        inner = named(statement) if statement.type == "expression_statement" else []
        if len(inner) == 1:
            yield from reader.statement(inner[0], statement)


def _starts(code: Code, owner: CppClass) -> Iterator[tuple[str, Value | None]]:
    """What members are before a parameter is stored in them."""
    given = {member.name: value for member, _, value in initial_values(code, owner)}
    for member in owner.fields:
        type_ = type_of(member.type)
        zero: dict[str, Value] = {"int": 0, "boolean": False, "double": 0.0}
        if member.name in given:
            yield member.name, constant(given[member.name])
        elif member.value is not None and type_ is not None:
            yield member.name, zero.get(type_.name)


@dataclass(frozen=True, slots=True, eq=False)
class _ParameterReader:
    """Reads statements in turn; `declared` are the parameters that earlier ones have declared."""

    code: Code
    function: CppFunction
    starts: Mapping[str, Value | None]
    declared: dict[str, _Asked]

    def statement(self, inner: Node, statement: Node) -> Iterator[_ParameterRead]:
        if inner.type == "assignment_expression":
            member = text_of(part(inner, "left")).removeprefix("this->")
            yield from self.assigned(member, part(inner, "right"), statement)
            return
        call = call_of(inner)
        asked = self._asked(call) if call is not None else None
        if asked is not None and call is not None and not asked.into:
            if call.name == DECLARES:
                self.declared[string_of(call.arguments[0]) or ""] = asked
        elif asked is not None:
            yield from asked.read(asked.into, statement)

    def assigned(self, member: str, value: Node, statement: Node) -> Iterator[_ParameterRead]:
        """What a member gets that a value is assigned to."""
        call, kind = call_of(_plain(value)), None
        if call is not None and call.name in _GIVES and call.target is not None:
            kind = _GIVES[call.name] or _SPELLED.get(text_of(call.types[0]) if call.types else "")
            call = call_of(call.target)
            if kind is None:
                return
        asked = self._asked(call) if call is not None else None
        if asked is not None and not asked.into and kind in (None, type(asked.default)):
            yield from asked.read(member, statement)

    # --- calls ----------------------------------------------------------------------------------

    def _asked(self, call: CppCall) -> _Asked | None:
        key = string_of(call.arguments[0]) if call.arguments else None
        if key is None:
            return None
        if call.on in ("", "this") and not call.name.startswith(_SERVER):
            return self._in_ros2(call, key)
        plain = call.name.removeprefix(_SERVER)
        if plain != call.name:
            if not key.startswith("~"):
                return None
            key = key.removeprefix("~")
        elif call.on not in ("node", "global"):
            return None
        rest = call.arguments[1:]
        if call.on == "global":
            if plain != "param" or len(rest) != 2:
                return None
            return _Asked(key, self._default(call, rest[1]), False, _member(rest[0]), rest[1])
        match plain, len(rest):
            case "param", 1:
                return _Asked(key, self._default(call, rest[0]), False)
            case "param", 2:
                default = self._default(call, rest[1])
                return _Asked(key, default, False, _member(rest[0]))
            case "getParam" | "get", 1:
                member = _member(rest[0])
                return _Asked(key, self.starts.get(member), False, member)
            case _:
                return None

    def _in_ros2(self, call: CppCall, key: str) -> _Asked | None:
        path = key.replace(".", "/")
        rest = call.arguments[1:]
        if call.name == DECLARES and 0 < len(rest) < MOST_DECLARED:
            of_model = constant_of_model(key)
            default = self._default(call, rest[0])
            return _Asked(of_model or path, default, True, "", rest[0] if of_model else None)
        known = self.declared.get(key)
        if call.name != "get_parameter" or known is None:
            return None
        return replace(known, into=_member(rest[0]) if rest else "")

    def _default(self, call: CppCall, node: Node) -> Value | None:
        """The value of a constant, as a number of the kind that is asked for."""
        named_ = self.code.constant(self.function.cpp, text_of(node))
        value = constant(named_[1] if named_ is not None else node)
        if len(call.types) == 1:
            kind = _SPELLED.get(text_of(call.types[0]))
            if kind is float and type(value) is int:
                return float(value)
            return value if type(value) is kind else None
        return None if call.types else value


def _member(node: Node) -> str:
    return text_of(node).removeprefix("this->")


def _plain(value: Node) -> Node:
    """What stands in parentheses, or is made the type of the member."""
    call = call_of(value)
    if value.type in ("parenthesized_expression", "initializer_list") and len(named(value)) == 1:
        return _plain(named(value)[0])
    if call is not None and call.name == "static_cast" and len(call.arguments) == 1:
        kind = _SPELLED.get(text_of(call.types[0])) if call.types else None
        return _plain(call.arguments[0]) if kind is int else value
    return value
