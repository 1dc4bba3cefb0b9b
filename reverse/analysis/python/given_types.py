"""Of which types what calls of Python give is: of its own functions and methods, and others."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.origins import ClassOrigin, FunctionOrigin, LibraryOrigin, Origins
from rebsync.reverse.analysis.python.argument_types import ArgumentTypes, parameter_of
from rebsync.reverse.analysis.python.attribute_types import AttributeTypes
from rebsync.reverse.analysis.python.type_queries import TypeQueries
from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    A_TEXT,
    ANY_TYPE,
    NO_TYPES,
    ContainerType,
    InstanceType,
    LibraryType,
    OwnType,
    ValueType,
    ValueTypes,
    copied,
    elements_of,
    pair,
    sequence,
    union,
    values_of,
)
from rebsync.reverse.analysis.stores import CallResult, Member, Value, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.libraries.attributes import NODE, OF_NUMBERS_ALONE, OTHERWISE, result_of
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.libraries.tables.runtime import CLOCK, MAILBOX, WHOLE

_COMPUTING = OF_NUMBERS_ALONE | {"builtins.divmod"}
_LIST, _QUEUE, _SET = OwnType.LIST, OwnType.QUEUE, OwnType.SET
# Functions that give a container of the elements of their first argument, or go through it.
_COPYING = {
    **{"builtins.list": _LIST, "builtins.sorted": _LIST, "builtins.tuple": OwnType.TUPLE},
    **{"builtins.set": _SET, "builtins.frozenset": OwnType.FROZEN, "collections.deque": _QUEUE},
    **{"builtins.reversed": None, "builtins.iter": None},
}
_PARSER = frozenset((LibraryOrigin("argparse.ArgumentParser", True),))
_NUMBERED = frozenset({"index", "count", "find", "rfind", "__len__"})
_OF_TEXTS = {
    **dict.fromkeys(
        (
            *("strip", "lstrip", "rstrip", "lower", "upper", "title", "capitalize", "swapcase"),
            *("replace", "join", "format", "ljust", "rjust", "center", "zfill", "casefold"),
            *("removeprefix", "removesuffix", "expandtabs", "format_map", "translate"),
        ),
        A_TEXT,
    ),
    **dict.fromkeys(("split", "rsplit", "splitlines"), sequence(_LIST, A_TEXT)),
    "encode": frozenset((OwnType.BYTES,)),
    **dict.fromkeys(("partition", "rpartition"), pair(A_TEXT, A_TEXT, A_TEXT)),
    **dict.fromkeys(
        (
            *("find", "rfind", "index", "rindex", "count", "startswith", "endswith", "isdigit"),
            *("isalpha", "isalnum", "isnumeric", "isdecimal", "isspace", "isupper", "islower"),
        ),
        A_NUMBER,
    ),
}


class GivenTypes:
    """The calls of one program; `types` are those of the values in it."""

    def __init__(
        self,
        origins: Origins,
        types: TypeQueries,
        attributes: AttributeTypes,
        arguments: ArgumentTypes,
    ) -> None:
        self._origins = origins
        self._graph = origins.graph
        self._types = types
        self._arguments = arguments
        self._attributes = attributes

    def of(self, call: s.Call, function: str) -> ValueTypes:
        """The types of what a call in a function gives."""
        if (held := self._of_parameter(call, function)) is not None:
            return held
        match call.callee:
            case s.LibraryCallee(name, None):
                return self._of_library(call, name, function)
            case s.MethodCallee(receiver, name, None, None):
                if name in CLOCK and self._is_mailbox(receiver, function):
                    return A_NUMBER
                types = self._types.of(receiver, function)
                if name == "parse_args" and self._origins.of(receiver, function) == _PARSER:
                    return frozenset((LibraryType("argparse.Namespace"),))
                if types == NO_TYPES:  # None, or not yet known of what is stored there
                    return NO_TYPES
                if all(map(_has_methods, types)):
                    return union(self._of_method(t, name, call, function) for t in types)
            case s.ValueCallee(value) if self._of_run_time(value, function) in WHOLE:
                return A_NUMBER
        return self._of_program(call, function)

    def _of_run_time(self, value: e.Expression, function: str) -> str:
        """The name of a value of the run-time part, which is the same in all programs; or none."""
        key = key_of(value, function) if isinstance(value, e.Global) else None
        is_plain = key is not None and not self._graph.stores.of(key)
        if not (isinstance(value, e.Global) and is_plain):
            return ""
        return value.name if value.module not in self._graph.program.modules else ""

    def _is_mailbox(self, value: Value, function: str, depth: int = 2) -> bool:
        """Whether a value is the mailbox of a node."""
        match value:
            case CallResult(s.Call(_, s.ValueCallee(made))):
                return self._of_run_time(made, function) == MAILBOX
            case e.Attribute() | e.Temporary() if depth:
                held = held_by(self._origins, value, function)
                return bool(held) and all(self._is_mailbox(v, of, depth - 1) for of, v in held)
            case _:
                return False

    def _of_program(self, call: s.Call, function: str) -> ValueTypes:
        """The types of what functions of the program give, and of new objects of its classes."""
        found = NO_TYPES
        for origin in self._origins.result(call, function):
            match origin:
                case ClassOrigin(name, True):
                    found |= {InstanceType(name)}
                case LibraryOrigin(name, True):
                    found |= self._attributes.of_class(name)
                case _:
                    found |= ANY_TYPE
        if found and None not in found:
            return found
        around = self._graph.program.function(function)
        targets = self._graph.callee(call.callee, around)
        functions = targets.functions
        if targets.unknown or targets.libraries or not functions:
            functions = self._of_known(call, function)
        return union(map(self._types.result, functions)) if functions else ANY_TYPE

    def _of_known(self, call: s.Call, function: str) -> frozenset[str]:
        """The functions that a call runs, if it is known of which objects; none otherwise."""
        match call.callee:
            case s.MethodCallee(_, _, _, str()):
                pass
            case s.MethodCallee(receiver):
                types = self._types.of(receiver, function)
                if not types or not all(isinstance(t, InstanceType) for t in types):
                    return frozenset()
            case s.ValueCallee(value):
                held = self._origins.of(value, function)
                if not all(isinstance(o, ClassOrigin | FunctionOrigin) for o in held):
                    return frozenset()
            case _:
                return frozenset()
        return self._arguments.called(call, self._graph.program.function(function))

    # --- functions of libraries ------------------------------------------------------------------

    def _of_library(self, call: s.Call, name: str, function: str) -> ValueTypes:
        plain = [a.value for a in call.arguments if a.name is None and not a.stars]
        named = {a.name for a in call.arguments}
        given = [self._types.of(value, function) for value in plain]
        found = _of_elements(name, given)
        if found is not None:
            return found
        match name:
            case "builtins.map" if len(given) > 1:
                return sequence(None, self.mapped(plain[0], function))
            case "builtins.dict" if not call.arguments:
                return frozenset((ContainerType(OwnType.MAPPING, NO_TYPES, NO_TYPES),))
            case _ if name in OTHERWISE and OTHERWISE[name][0] not in named:
                return frozenset((LibraryType(OTHERWISE[name][1]),))
            case "builtins.dict.fromkeys" if given:
                values = given[1] if len(given) > 1 else frozenset((OwnType.NONE,))
                return frozenset((ContainerType(OwnType.MAPPING, elements_of(given[0]), values),))
            case "collections.Counter" if not call.arguments:
                return frozenset((ContainerType(OwnType.MAPPING, NO_TYPES, A_NUMBER),))
            case "numpy.zeros" | "numpy.ones" if len(call.arguments) == 1 and given == [A_NUMBER]:
                return self._attributes.of_class("numbers")
            case "numpy.append" if len(call.arguments) == len(given) == 2:
                numbers = self._attributes.of_class("numbers")
                known = union(given) <= numbers | A_NUMBER
                return NO_TYPES if NO_TYPES in given else numbers if known else ANY_TYPE
            case "builtins.sum" if len(given) > 1:
                return ANY_TYPE
            case "functools.reduce" if given:
                return union([self.mapped(plain[0], function), *given[2:]])
            case "builtins.max" | "builtins.min" if given:
                defaults = [a.value for a in call.arguments if a.name == "default"]
                found = union(given) if len(given) > 1 else elements_of(given[0])
                return found | union(self._types.of(each, function) for each in defaults)
        gives = self._origins.table.function(name).gives or result_of(name) or name
        return self._attributes.of_class(gives)

    def mapped(self, value: e.Expression, function: str) -> ValueTypes:
        """The types of what a function gives that another calls for each element."""
        match value:
            case e.LibraryReference(name):
                return self._attributes.of_class(self._origins.table.function(name).gives)
            case _:
                targets = self._graph.value(value, self._graph.program.function(function))
                if targets.unknown or targets.libraries or not targets.functions:
                    return ANY_TYPE
                return union(map(self._types.result, targets.functions))

    # --- methods ---------------------------------------------------------------------------------

    def _of_method(
        self, type_: ValueType | None, name: str, call: s.Call, function: str
    ) -> ValueTypes:
        match type_:
            case OwnType.TEXT:
                return _OF_TEXTS.get(name, ANY_TYPE)
            case OwnType.BYTES if name == "decode":
                return A_TEXT
            case ContainerType(OwnType.MAPPING):
                return self._of_mapping(type_, name, call, function)
            case ContainerType() if name in ("pop", "popleft"):
                return elements_of(frozenset((type_,)))
            case ContainerType() if name == "copy":
                return copied(frozenset((type_,)))
            case ContainerType() if name in _NUMBERED:
                return A_NUMBER
            case LibraryType(of, answers) if answers and name == "call_async":
                return frozenset((LibraryType(result_of(f"{of}.{name}"), answers),))
            case LibraryType(_, holds) if holds and name in ("call", "result"):
                return holds
            case LibraryType(of):
                return self._attributes.of_class(result_of(f"{of}.{name}"))
            case InstanceType(of):
                return self._of_instance(of, name, call, function)
            case _:
                return ANY_TYPE

    def _of_mapping(
        self, type_: ContainerType, name: str, call: s.Call, function: str
    ) -> ValueTypes:
        keys, values = type_.elements, type_.values
        match name:
            case "keys":
                return sequence(None, keys)
            case "values":
                return sequence(None, values)
            case "items":
                return sequence(None, pair(keys, values))
            case "most_common":
                return sequence(_LIST, pair(keys, values))
            case "copy":
                return copied(frozenset((type_,)))
            case "get" | "pop" | "setdefault":
                others = [a.value for a in call.arguments[1:] if not a.stars]
                defaults = union(self._types.of(value, function) for value in others)
                return values_of(frozenset((type_,))) | defaults
            case _:
                return ANY_TYPE

    def _of_instance(self, of: str, name: str, call: s.Call, function: str) -> ValueTypes:
        """A method of an object of the program's: its own, or one of a base in a library."""
        if self._origins.methods(of, name) or self._graph.stores.of(Member(name)):
            return self._of_program(call, function)
        found = (result_of(f"{base}.{name}") for base in self._graph.bases(of))
        gives = next(filter(None, found), "")
        holds = self._held(name, call, function) if gives else NO_TYPES
        if holds and None not in holds:
            return frozenset((LibraryType(gives, holds),))
        return self._attributes.of_class(gives)

    def _held(self, name: str, call: s.Call, function: str) -> ValueTypes:
        """The types of a parameter's value, or of a service's answer, that a node is asked for."""
        plain = [a.value for a in call.arguments if a.name is None and not a.stars]
        match name, plain:
            case "create_client", [type_, *_]:
                answers = self._arguments.messages_of(type_, function)
                return union(self._attributes.of_class(f"{each}_Response") for each in answers)
            case _ if (asked := parameter_of(call)) is not None:
                defaults = self._arguments.declared.get(asked[0], ())
                return union(self._types.of(value, of) or ANY_TYPE for of, value in defaults)
            case _:
                return NO_TYPES

    def _of_parameter(self, call: s.Call, function: str) -> ValueTypes | None:
        """The types of a parameter that a call gives: of its default, as people take it for.

        Without a default they are those of what launch files set.
        """
        asked = parameter_of(call)
        if asked is None or asked[1] not in (Access.GET, Access.DECLARE):
            return None
        name = call.callee.name if isinstance(call.callee, s.MethodCallee) else ""
        if name and result_of(f"{NODE}.{name}"):  # which gives an object that has it
            return None
        set_to = self._origins.table.set_to(asked[0])
        values = map(e.Literal, set_to) if asked[2] is None else (asked[2],)
        return union(self._types.of(value, function) or ANY_TYPE for value in values) or ANY_TYPE


def _of_elements(name: str, given: Sequence[ValueTypes]) -> ValueTypes | None:
    """The types of what a function gives that depend on its arguments alone; None for others."""
    if NO_TYPES in given and name in _COMPUTING:
        return NO_TYPES
    if name in _COPYING:
        return sequence(_COPYING[name], *map(elements_of, given[:1]))
    match name:
        case "builtins.range" | "itertools.count":
            return sequence(None, A_NUMBER)
        case "builtins.enumerate" if given:
            return sequence(None, pair(A_NUMBER, elements_of(given[0])))
        case "builtins.zip":
            return sequence(None, pair(*map(elements_of, given)))
        case "builtins.filter" if len(given) > 1:
            return sequence(None, elements_of(given[1]))
        case "builtins.next" if given:
            return elements_of(given[0]) | union(given[1:])
        case "itertools.repeat" if given:
            return sequence(None, given[0])
        case "itertools.islice" | "itertools.cycle" if given:
            return sequence(None, elements_of(given[0]))
        case "itertools.chain":
            return sequence(None, *map(elements_of, given))
        case "builtins.divmod" if list(given) == [A_NUMBER, A_NUMBER]:
            return pair(A_NUMBER, A_NUMBER)
        case "random.choice" if given:
            return elements_of(given[0])
        case "copy.copy" | "copy.deepcopy" if given:
            return given[0]
        case "os.getenv" | "os.environ.get" if given:
            return union([A_TEXT, *given[1:]])
        case _ if name in OF_NUMBERS_ALONE and given and union(given) == A_NUMBER:
            return A_NUMBER
        case _:
            return None


def _has_methods(type_: ValueType | None) -> bool:
    """Whether a table, or the program, says what methods of a type give."""
    return isinstance(type_, ContainerType | LibraryType | InstanceType) or (
        type_ in (OwnType.TEXT, OwnType.BYTES)
    )
