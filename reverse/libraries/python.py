"""What the readers of Python ask of the tables: by full names, and by the last names of methods."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from rebsync.reverse.libraries.registry import derived, libraries
from rebsync.reverse.libraries.routines import (
    ASKING,
    Access,
    Effect,
    Kind,
    Language,
    Library,
    Routine,
)
from rebsync.reverse.libraries.tables.standard import ACTING_WORDS

_GIVING = frozenset({Access.GET, Access.DECLARE})
_SILENT = frozenset({*_GIVING, Access.HAS})
_LEVELS = "debug|info|warn|warning|error|fatal"


def _last(name: str) -> str:
    return name.rpartition(".")[2]


@derived
def _libraries() -> tuple[Library, ...]:
    return libraries(Language.PYTHON)


@derived
def clients() -> tuple[Library, ...]:
    """The client libraries: those that something can be asked of."""
    return tuple(
        library
        for library in _libraries()
        if any(r.kind in ASKING for r in library.functions.values())
    )


def client_in(text: str) -> Library:
    """The client library of a module: one with nodes as objects that it names, else another."""
    flat = [library for library in clients() if library.flat and library.name in text]
    return [*flat, *(library for library in clients() if not library.flat)][0]


# --- functions and methods ----------------------------------------------------------------------


def _functions() -> Iterator[tuple[str, Routine]]:
    for library in _libraries():
        yield from library.functions.items()


def _methods() -> Iterator[tuple[str, Routine]]:
    for library in _libraries():
        if not library.generated:
            for of_class in library.methods.values():
                yield from of_class.items()


@derived
def _by_name() -> Mapping[str, tuple[Routine, ...]]:
    found: dict[str, tuple[Routine, ...]] = {}
    for name, routine in _functions():
        found[name] = (*found.get(name, ()), routine)
    return found


def function(name: str, count: int = 0, keywords: Collection[str] = ()) -> Routine | None:
    """A function by its full name; of two libraries' the one that is called so."""
    same = _by_name().get(name, ())
    for routine in same if len(same) > 1 else ():
        own = dict(routine.keywords).keys() - {
            k for r in same if r != routine for k, _ in r.keywords
        }
        if count >= routine.least or not own.isdisjoint(keywords):
            return routine
    return next((r for r in same if len(same) == 1 or r.least > 8), None)


def asks(name: str, count: int, keywords: Collection[str]) -> Routine | None:
    """A function that asks for something, by its full name."""
    found = function(name, count, keywords)
    return found if found is not None and found.kind in ASKING else None


@derived
def kind_of(name: str) -> Kind | None:
    """What a function is for, by its full name."""
    found = function(name)
    return found.kind if found is not None else None


@derived
def names_of(*kinds: Kind, result: str | None = None) -> frozenset[str]:
    """The full names of the functions of some kinds, or those with a result."""
    found = ((n, r) for n, r in _functions() if r.kind in kinds)
    return frozenset(n for n, r in found if result is None or r.result == result)


@derived
def methods_of(*kinds: Kind) -> frozenset[str]:
    """The names of the methods of some kinds."""
    return frozenset(n for n, r in _methods() if r.kind in kinds)


@derived
def named(*kinds: Kind) -> frozenset[str]:
    """The last names of the functions and methods of some kinds."""
    functions = (_last(n) for n, r in _functions() if r.kind in kinds)
    return methods_of(*kinds).union(functions)


@derived
def node_classes() -> frozenset[str]:
    """The full names of the classes of nodes."""
    return frozenset(n for library in _libraries() for n in library.nodes)


def sends_while_active(name: str) -> bool:
    """Whether a method makes a publisher that sends only while the life cycle is active."""
    return any(name in library.managed_senders for library in _libraries())


@derived
def managed() -> frozenset[str]:
    """The full names of classes of nodes whose state others change."""
    return frozenset(n for library in _libraries() for n in library.managed)


@derived
def node_method(name: str, of: str | None = None) -> Routine | None:
    """The method of nodes that asks for something; of any library, or of that of a node's class."""
    for library in _libraries():
        if of is None or of in library.nodes or of in library.functions:
            for class_ in library.nodes:
                found = library.methods.get(class_, {}).get(name)
                if found is not None and found.kind in ASKING:
                    return found
    return None


@derived
def node_class() -> str:
    """The class of a node of which nothing else is known."""
    return next(c for lib in clients() if lib.flat for c in lib.methods if c in lib.nodes)


def is_of_client(name: str) -> bool:
    """Whether a full name is of a client library, or of what is used with it."""
    return name.partition(".")[0] in client_modules()


def of_nodes(name: str) -> bool:
    """Whether a name is of a client library with nodes that are objects."""
    return name.partition(".")[0] in {lib.name for lib in clients() if lib.flat}


@derived
def client_modules() -> frozenset[str]:
    """The modules of the client libraries, and of what is used with them."""
    return frozenset(m for library in clients() for m in library.marks)


@derived
def asking_names() -> frozenset[str]:
    """The last names of all that asks for something."""
    return named(*ASKING)


@derived
def messages_of_any_type() -> frozenset[str]:
    """Classes that stand for messages of all types."""
    return frozenset(n for library in _libraries() for n in library.plain)


# --- parameters and values ----------------------------------------------------------------------


@derived
def own_names() -> Mapping[str, str]:
    """Functions that give the node's name, with which private names begin, or its namespace."""
    return {n: r.result for n, r in _functions() if r.kind is Kind.NAME}


@derived
def own_name_methods() -> Mapping[str, str]:
    """Methods of nodes that give the same."""
    return {n: r.result for n, r in _methods() if r.kind is Kind.NAME}


@derived
def parameter_methods() -> frozenset[str]:
    """Methods of nodes that give the value of a parameter."""
    found = ((n, r) for n, r in _methods() if r.kind is Kind.PARAMETER)
    return frozenset(n for n, r in found if r.access in _GIVING)


@derived
def declaring() -> frozenset[str]:
    """Those of them that declare it."""
    found = ((n, r) for n, r in _methods() if r.kind is Kind.PARAMETER)
    return frozenset(n for n, r in found if r.access is Access.DECLARE)


@derived
def giving_parameters() -> frozenset[str]:
    """Last names of what gives the value of a parameter."""
    found = ((_last(n), r) for n, r in _functions() if r.kind is Kind.PARAMETER)
    return parameter_methods().union(n for n, r in found if r.access in _GIVING)


@derived
def silent_parameters() -> frozenset[str]:
    """Last names of what looks at a parameter, or declares some: nothing of a model changes."""
    found = ((_last(n), r) for n, r in (*_functions(), *_methods()) if r.kind is Kind.PARAMETER)
    return methods_of(Kind.DECLARED).union(n for n, r in found if r.access in _SILENT)


@derived
def profiles() -> Mapping[str, int]:
    """The depths of qualities of service, by their last names, or the last two."""
    return {n: d for library in _libraries() for n, d in library.table.profiles.items()}


@derived
def unmodelled() -> Mapping[str, tuple[Routine, Library]]:
    """By full names what makes something that has no place in a model, and of which library."""
    return {n: (r, library) for library in _libraries() for n, r in library.unmodelled.items()}


@derived
def policies() -> Mapping[str, tuple[str, str]]:
    """Reliability and durability of those that have other ones than the usual."""
    return {n: p for library in _libraries() for n, p in library.table.policies.items()}


# --- what calls do ------------------------------------------------------------------------------


@derived
def acting_methods() -> frozenset[str]:
    """Methods of objects of the client libraries that act, under whatever name they are called."""
    effects = {Effect.SENDS, Effect.TIME, Effect.RUNS, Effect.WAITS, Effect.ENDS, Effect.CHANGES}
    found = (
        (n, r) for lib in clients() for methods in lib.methods.values() for n, r in methods.items()
    )
    return frozenset(n for n, r in found if r.effect in effects or r.kind is Kind.SET)


@derived
def acting() -> re.Pattern[str]:
    """How names begin of what may act, of which nothing else is known."""
    words = sorted(methods_of(Kind.PUBLISH) - {"publish"})
    return re.compile("|".join((*ACTING_WORDS, *map(re.escape, words))))


@derived
def harmless() -> frozenset[str]:
    """Last names of functions of Python, and methods of its texts and lists, that touch no node."""
    library = next(lib for lib in _libraries() if lib.name == "Python")
    functions = (
        (n, r) for n, r in library.functions.items() if n.startswith(("builtins.", "copy."))
    )
    methods = (pair for of_class in library.methods.values() for pair in of_class.items())
    plain = frozenset({Effect.NONE, Effect.LOGS, Effect.CHANGES})
    return frozenset(_last(n) for n, r in (*functions, *methods) if r.effect in plain)


# --- logs and clocks ----------------------------------------------------------------------------


@derived
def log_calls() -> re.Pattern[str]:
    """What is called to log, as it is written in people's code."""
    names = sorted(n for n in names_of(Kind.LOG) if not n.startswith("builtins."))
    functions = "|".join(
        rf"({re.escape(n.rpartition('.')[0])}\.)?{re.escape(_last(n))}" for n in names
    )
    loggers = "|".join(rf"{re.escape(g)}\(\)" for lib in clients() for g in lib.logs)
    return re.compile(
        rf"(?:{functions})\Z|(?:\w+\.)*(?:{loggers}|_?logger_?|_?log)\.(?:{_LEVELS})\Z"
    )


@derived
def log_words() -> re.Pattern[str]:
    """The same as generated code and what is around it may write it."""
    names = "|".join(sorted(map(re.escape, (n for n in names_of(Kind.LOG) if "builtins" not in n))))
    loggers = "|".join(rf"{re.escape(g)}\([^()]*\)" for lib in clients() for g in lib.logs)
    levels = rf"(?:{_LEVELS}|critical|exception|log)"
    return re.compile(
        rf"(?:{names}|(?:\w+\.)*(?:{loggers})\.(?:{_LEVELS}|set_level)|print"
        rf"|logging\.(?:getLogger\([^()]*\)\.)?{levels}|(?:self\.)?_?log(?:ger)?\.{levels})\Z"
    )


@derived
def clocks() -> frozenset[str]:
    """What tells the time, as code calls it."""
    return names_of(Kind.CLOCK) | {"self.get_clock"}


@derived
def clock_modules() -> frozenset[str]:
    """The modules of functions that log or tell the time."""
    names = names_of(Kind.CLOCK, Kind.LOG)
    return frozenset(n.partition(".")[0] for n in names) - {"builtins"}


@derived
def modules_of_logs() -> frozenset[str]:
    """The modules of functions that log."""
    return frozenset(n.partition(".")[0] for n in names_of(Kind.LOG)) - {"builtins"}


@derived
def only_running() -> re.Pattern[str]:
    """A condition that only says that the node runs, without blanks."""
    ended = "|".join(map(re.escape, sorted(names_of(Kind.RUNNING, result="!bool"))))
    runs = "|".join(map(re.escape, sorted(names_of(Kind.RUNNING, result="bool"))))
    return re.compile(rf"\(?(not(?=[(\w])\(?(?:{ended})\(\)\)?|(?:{runs})\(\)|True|1)\)?")


@derived
def running() -> re.Pattern[str]:
    """What of a condition says that the node runs."""
    ended = {_last(n) for n in names_of(Kind.RUNNING, result="!bool")}
    runs = {_last(n) for n in names_of(Kind.RUNNING, result="bool")}
    words = [*(rf"{n}\(\)" for n in sorted(ended)), *(rf"\b{n}\(\)" for n in sorted(runs))]
    return re.compile("|".join((*words, r"^\(?(True|1)\)?$")))


# --- hooks and files ----------------------------------------------------------------------------


@derived
def hooks() -> Mapping[str, tuple[tuple[str, Routine], ...]]:
    """What hands a function over for other reasons than messages, timers and services.

    By the last name, each with its module; empty for a method.
    """
    found: dict[str, tuple[tuple[str, Routine], ...]] = {}
    functions = ((n.rpartition(".")[0], _last(n), r) for n, r in _functions())
    for of, name, routine in (*functions, *(("", n, r) for n, r in _methods())):
        if hook_roles(routine):
            found[name] = (*found.get(name, ()), (of, routine))
    return found


def hook_roles(routine: Routine) -> frozenset[str]:
    """The roles of the arguments that are called for such reasons."""
    roles = {*routine.arguments, *(role for _, role in routine.keywords)}
    is_hook = routine.kind in (Kind.HOOK, Kind.START)
    return frozenset(roles & ({"callback", "listener"} if is_hook else {"listener"}))


@derived
def marks() -> tuple[bytes, ...]:
    """Where none of these is in a file, it asks nothing of ROS."""
    return tuple(m.encode() for library in _libraries() for m in library.marks)
