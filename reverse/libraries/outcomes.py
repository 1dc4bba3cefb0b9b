"""How calls of libraries may end: what they raise, whether they wait, and what they give back.

One table for both languages: a rule says what its functions do, with their names in C++ and in
Python; a name that begins with a dot is a method of any object that is not known to be of another
class. What a standard library or a client library has and no table knows may do anything. A
function of any other library gets values, and gives one.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.libraries import (
    client_times,
    cpp,
    looked_through,
    outcome_classes,
    outcome_rules,
    python,
    python_outcomes,
)
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.outcome_classes import PLAIN_CLASSES
from rebsync.reverse.libraries.outcome_rules import Raises, Size, Tells
from rebsync.reverse.libraries.registry import derived
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.libraries.thrown_by_others import THROWN

_LOOKS = frozenset(
    {*(Effect.NONE, Effect.CLOCK, Effect.LOGS, Effect.READS, Effect.RANDOM), Effect.CHANGES}
)
_UNKNOWN = "nothing is known of it"
_ANY_EXCEPTION = frozenset(
    {"builtins.Exception"}
)  # what Python may raise of which no more is known


MessageFields: TypeAlias = Callable[[str], Mapping[str, str] | None]
MessageConstant: TypeAlias = Callable[[str, str], int | str | None]
SetValues: TypeAlias = Callable[[str], Sequence[int | str | None]]


def no_fields(type_: str) -> Mapping[str, str] | None:
    """The fields of messages where none are known."""
    return None


def no_constant(type_: str, name: str) -> int | str | None:
    """The constants of messages where none are known."""
    return None


def no_values(name: str) -> Sequence[int | str | None]:
    """The values of parameters where no launch file is known."""
    return ()


@dataclass(frozen=True, slots=True)
class CallOutcome:
    """How a call may end, besides giving a value.

    `raises` are the exceptions, of which `empty` only where its first argument has no elements, and
    `lacks` only where the object has none for it; `acts` says what else it does, and is empty where
    it does nothing. `size` is what it does to the number of elements of its object. `gives` is the
    class of what it gives; it may be the first argument (`returns`). One that `keeps` only looks at
    classes that it gets, or calls them when it is asked for something. It raises `when` it gets
    some arguments only; what it raises where there are no elements is apart from that.
    """

    raises: frozenset[str] = frozenset()
    empty: frozenset[str] = frozenset()
    acts: str = ""
    size: Size = Size.SAME
    gives: str = ""
    returns: bool = False
    tells: Tells = Tells.NOTHING
    keeps: bool = False
    may_be_none: bool = False
    when: Raises = Raises.ANY


@dataclass(frozen=True, slots=True)
class LibraryOutcomes:
    """The table as a program of one language asks it.

    `opaque` are names of the program itself that no lowering sees through: macros, and modules of
    which it is not known where they are. Where it `trusts_others`, methods of what a library made
    that no table knows raise nothing by their names alone; where it `trusts_types`, values of no
    known type have what is asked of them: messages, in functions of sensors and in users' blocks.
    So are attributes (`trusts_attributes`) where the run-time part is not in the program.
    `messages` are classes in C++ of which headers are included that hold nothing but a message.
    `fields` gives the fields of a type of messages with their types, by their names in ROS, and
    `constant` what such a type gives a name. `set_to` are the values that launch files give
    parameters with the same last name: whole numbers and texts, None for others.
    """

    language: Language
    opaque: frozenset[str] = frozenset()
    trusts_others: bool = False
    trusts_types: bool = True
    trusts_attributes: bool = True
    messages: frozenset[str] = frozenset()
    fields: MessageFields = no_fields
    constant: MessageConstant = no_constant
    set_to: SetValues = no_values

    @property
    def _named(self) -> Mapping[str, CallOutcome]:
        return _named(self.language)

    def function(self, name: str) -> CallOutcome:
        """How a call of a function or class may end, by its full name."""
        name = name.removeprefix("::")
        if name in self.opaque or name.partition(".")[0] in self.opaque:
            return CallOutcome(acts="what it stands for is not known")
        if name == outcome_classes.UNKNOWN_CLASS:
            return CallOutcome(frozenset({"an exception"}), when=Raises.COUNT)
        known = self._named.get(name)
        if known is None and self.language is Language.CPP:
            plain = name.partition("<")[0].removeprefix("new ")
            known = self._named.get(plain.removeprefix("std::").removeprefix("boost::"))
        if known is not None:
            return known
        of, _, last = name.rpartition("::" if self.language is Language.CPP else ".")
        if of and self.language is Language.CPP and (found := self._of_class(of, last)) is not None:
            return found
        effect = of_function(self.language, name).effect
        if effect in _LOOKS:
            return CallOutcome()
        if effect is not Effect.UNKNOWN:
            return CallOutcome(acts=effect.value)
        return self._unknown(name)

    def method(self, of: str | None, name: str) -> CallOutcome:
        """How a call of a method may end, by its object's class, if that is known."""
        if of is not None and (found := self._of_class(of, name)) is not None:
            return found
        is_client = self.language is Language.PYTHON and (of is None or python.is_of_client(of))
        if of is not None and self.is_standard(of) and not is_client:
            return self._unknown(of)
        is_asking = name in python.asking_names() if self.language is Language.PYTHON else False
        acting = python.acting_methods() if self.language is Language.PYTHON else cpp.acting()
        if is_asking or name in acting:
            known = self._named.get(f".{name}", CallOutcome()) if is_client else CallOutcome()
            return replace(known, acts="acts on a node")
        if of is not None and self.is_standard(of):
            return self._unknown(of)
        if of is None or self.language is Language.PYTHON or name in cpp.looking():
            return self._named.get(f".{name}", CallOutcome())
        return self._named.get(f".{name}") or self._unknown(f"{of}::{name}")

    def _unknown(self, name: str) -> CallOutcome:
        """How what no table knows may end: as anything, but of what was looked through.

        In Python what is of none of the standard libraries gets values, and gives one.
        """
        acts = _UNKNOWN if self.is_standard(name) else ""
        if self.language is Language.CPP:
            thrown = {looked_through.thrown_by(name)}
            is_client = bool(acts) and not name.startswith("std::")
            is_client |= name.removeprefix("new ") in self.messages
            quiet = is_client or looked_through.is_looked_through(name)
            return CallOutcome(frozenset() if quiet else frozenset(thrown), acts=acts)
        is_quiet = not acts or python.is_of_client(name)
        return CallOutcome(frozenset() if is_quiet else _ANY_EXCEPTION, acts=acts)

    def is_function(self, name: str) -> bool:
        """Whether a full name in C++ is written as functions are, and no table has such a class."""
        last = name.partition("<")[0].rpartition("::")[2]
        is_class = name in outcome_classes.CLASSES or self.has_methods_of(name)
        is_cpp = self.language is Language.CPP
        return is_cpp and not is_class and not last[:1].isupper() and name not in PLAIN_CLASSES

    def may_be_called(self, name: str) -> bool:
        """Whether what a library has under a name is perhaps a function, that others may call.

        In C++ a name that no table has is taken for that of a constant.
        """
        if self.language is Language.CPP:
            return self.is_known(name)
        return not name.rpartition(".")[2].isupper()  # constants are written so

    def is_known(self, name: str) -> bool:
        """Whether a table has a function or class by its full name."""
        return name in self._named

    @property
    def of_anything(self) -> str:
        """The exception that code raises of which nothing is known."""
        return "an exception" if self.language is Language.CPP else "builtins.Exception"

    def of_failure(self, failure: str) -> str:
        """The exception that an operation raises; empty where none can be caught."""
        return outcome_classes.FAILURES[failure][self.language is Language.PYTHON]

    def are_above(self, name: str) -> Iterable[str]:
        """An exception, and the classes that it extends."""
        yield name
        while name in outcome_classes.EXCEPTIONS:
            name = outcome_classes.EXCEPTIONS[name]
            yield name

    def _of_class(self, of: str, name: str) -> CallOutcome | None:
        """A method of a class of the table; classes that do the same are one."""
        plain = of.partition("<")[0]
        if plain.startswith("boost::") and f"{plain}.{name}" not in self._named:
            plain = plain.replace("boost::", "std::", 1)
        of = outcome_classes.CLASSES.get(plain, plain)
        found = self._named.get(f"{of}.{name}")
        if found is None and of in outcome_classes.PLAIN_CLASSES:
            found = self._named.get(f".{name}", CallOutcome())
        return found

    def is_of_language(self, name: str) -> bool:
        """Whether a name is of Python's own library, and of no other."""
        is_standard = self.language is Language.PYTHON and self.is_standard(name)
        return is_standard and not python.is_of_client(name)

    def has_methods_of(self, name: str) -> bool:
        """Whether the table has methods of a class."""
        return any(known.startswith(f"{name}.") for known in self._named)

    def is_standard(self, name: str) -> bool:
        """Whether a name is of a standard library, or of one that nodes are made with."""
        if self.language is Language.PYTHON:
            first = name.partition(".")[0]
            is_standard = first in sys.stdlib_module_names or first == "builtins"
            return is_standard or python.is_of_client(name)
        is_client = name.startswith(cpp.scopes()) or name.rpartition("::")[2] in cpp.own_classes()
        return is_client or name.startswith("std::") or name.partition("<")[0] in cpp.acting()


@derived
def _named(language: Language) -> Mapping[str, CallOutcome]:
    found: dict[str, CallOutcome] = {}
    for rule in (*outcome_rules.RULES, *THROWN, *client_times.RULES, *python_outcomes.MODULES):
        for name in (rule.cpp if language is Language.CPP else rule.python).split():
            found[name] = CallOutcome(
                frozenset(rule.raises.split()),
                frozenset(rule.empty.split()),
                rule.acts,
                rule.size,
                rule.gives,
                rule.returns,
                rule.tells,
                rule.keeps,
                rule.may_be_none,
                rule.when,
            )
    return found
