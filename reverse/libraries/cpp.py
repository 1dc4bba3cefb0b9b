"""What the readers of C++ ask of the tables: names without their scopes, as code writes them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rebsync.reverse.libraries.cpp_calls import asking_words, calls, last
from rebsync.reverse.libraries.registry import derived, libraries
from rebsync.reverse.libraries.routines import (
    ACTING,
    ANY_CONTAINER,
    Access,
    Effect,
    Kind,
    Language,
    Library,
    Options,
    Routine,
)

_READ = frozenset({Access.GET, Access.DECLARE})
_LOOKS = frozenset({Effect.NONE, Effect.CLOCK})


@derived
def _libraries() -> tuple[Library, ...]:
    return libraries(Language.CPP)


# --- nodes and handles --------------------------------------------------------------------------


@derived
def roots() -> frozenset[str]:
    """The full names of the classes of nodes that are the node's own library's."""
    return frozenset(n for library in _libraries() for n in library.nodes)


@derived
def node_names() -> frozenset[str]:
    """The full names that classes of nodes may have."""
    found = ((c.node_scopes, c.nodes) for c in calls())
    return frozenset(
        f"{scope}::{name}" for scopes, names in found for scope in scopes for name in names
    )


@derived
def managed() -> frozenset[str]:
    """The names of classes of nodes whose state others change."""
    return frozenset(last(n) for library in _libraries() for n in library.managed)


@derived
def handles() -> frozenset[str]:
    """The names of classes of node handles."""
    return frozenset(last(n) for library in _libraries() for n in library.handles)


@derived
def own_classes() -> frozenset[str]:
    """Handles and what is made of them: the library's, whose own code asks for nothing."""
    found = (c for c in calls() if c.on_handles)
    return handles().union(*([*c.methods, *c.objects] for c in found)) - rates().keys()


@derived
def handle_methods() -> Mapping[str, Routine]:
    """The methods of node handles that ask for something."""
    return {n: r for c in calls() for n, r in c.on_handles.items()}


@derived
def timers_of_handles() -> frozenset[str]:
    """Those of them that make a timer."""
    return frozenset(n for n, r in handle_methods().items() if r.kind is Kind.TIMER)


@derived
def node_methods() -> Mapping[str, Routine]:
    """The methods of nodes that ask for something."""
    return {n: r for c in calls() for n, r in c.on_nodes.items()}


@derived
def made_of_handles() -> Mapping[str, Mapping[str, Routine]]:
    """The methods, by class, of what is made of a node handle."""
    return {k: m for c in calls() if c.on_handles for k, m in c.methods.items()}


@derived
def functions() -> Mapping[tuple[str, str], Routine]:
    """The functions that ask for something, by scope and name, of libraries with handles."""
    return {k: r for c in calls() if c.on_handles for k, r in c.functions.items()}


@derived
def rates() -> Mapping[str, Routine]:
    """The classes of rates."""
    return {n: r for c in calls() for n, (r, _) in c.objects.items() if r.kind is Kind.RATE}


@derived
def own_handles() -> Mapping[str, str]:
    """Functions that give a node handle, with its namespace."""
    return {n: r.result for n, r in _methods() if r.kind is Kind.HANDLE}


@derived
def own_names() -> frozenset[str]:
    """Methods that give the name of their node, with which private names begin."""
    return frozenset(n for n, r in _methods() if r.kind is Kind.NAME)


@derived
def entries() -> frozenset[str]:
    """Functions of classes that programs outside of the files call."""
    return frozenset({"main"}).union(*(library.entries for library in _libraries()))


@derived
def options() -> Mapping[str, Options]:
    """Classes that hold the arguments of a call."""
    return {n: o for library in _libraries() for n, o in library.options.items()}


# --- parameters and values ----------------------------------------------------------------------


@derived
def reading() -> frozenset[str]:
    """Methods of nodes that give the value of a parameter, or write it to an argument."""
    found = node_methods().items()
    return frozenset(n for n, r in found if r.kind is Kind.PARAMETER and r.access in _READ)


@derived
def declaring() -> frozenset[str]:
    """Those of them that declare the parameter."""
    return frozenset(n for n in reading() if node_methods()[n].access is Access.DECLARE)


@derived
def value_classes() -> frozenset[str]:
    """Classes that hold the value that they are made of."""
    return frozenset(n for library in _libraries() for n in library.plain)


@derived
def qualities() -> Mapping[str, int | None]:
    """Classes of qualities of service, with the depth they have by themselves."""
    return {n: d for library in _libraries() for n, d in library.table.qualities.items()}


@derived
def profiles() -> Mapping[str, int]:
    """Names of qualities of service, with their depths."""
    return {n: d for library in _libraries() for n, d in library.table.profiles.items()}


@derived
def unmodelled() -> Mapping[str, tuple[Routine, Library]]:
    """By full names what makes something that has no place in a model, and of which library."""
    return {n: (r, library) for library in _libraries() for n, r in library.unmodelled.items()}


@derived
def policies() -> Mapping[str, tuple[str, str]]:
    """Reliability and durability of those that have other ones than the usual."""
    return {n: p for library in _libraries() for n, p in library.table.policies.items()}


@derived
def spans() -> Mapping[str, float]:
    """Functions and classes that make a span of time, full, with the seconds of their unit."""
    return {n: s for library in _libraries() for n, s in library.table.spans.items()}


# --- what calls do ------------------------------------------------------------------------------


def _people() -> Iterator[Library]:
    """The libraries that people's code calls."""
    return (library for library in _libraries() if not library.generated)


def _methods() -> Iterator[tuple[str, Routine]]:
    for library in _people():
        for of_class in library.methods.values():
            yield from of_class.items()


def _functions() -> Iterator[tuple[str, Routine]]:
    """All functions by their last names."""
    for library in _people():
        yield from ((last(n), r) for n, r in library.functions.items())


def _routines() -> Iterator[tuple[str, Routine]]:
    """All routines by their last names."""
    yield from _functions()
    yield from _methods()


@derived
def names_of(*kinds: Kind, result: str | None = None) -> frozenset[str]:
    """The full names of the functions of some kinds, or those with a result."""
    found = ((n, r) for lib in _libraries() for n, r in lib.functions.items() if r.kind in kinds)
    return frozenset(n for n, r in found if result is None or r.result == result)


@derived
def named(*kinds: Kind) -> frozenset[str]:
    """The last names of the functions and methods of some kinds."""
    return frozenset(n for n, r in _routines() if r.kind in kinds)


@derived
def scopes() -> tuple[str, ...]:
    """How names begin that are a client library's."""
    return tuple(sorted({f"{scope}::" for c in calls() for scope in c.scopes}))


@derived
def seconds() -> frozenset[str]:
    """Classes of spans of time, and of points in it, that are made of a number of seconds."""
    found = (n for lib in _people() for n, r in lib.functions.items() if r.kind is Kind.SPAN)
    return frozenset(n for n in found if n not in spans())


@derived
def finishing() -> frozenset[str]:
    """Functions that serve messages until the node ends, or end it."""
    waits = frozenset({Effect.RUNS, Effect.ENDS})
    found = ((n, r) for lib in _people() for n, r in lib.functions.items())
    kinds = (Kind.SPIN, Kind.SHUTDOWN)
    return frozenset(n for n, r in found if r.kind in kinds and r.effect in waits)


@derived
def waiting() -> frozenset[str]:
    """Names of what lets messages be served, or starts or ends that, and is nothing in a model."""
    kinds = frozenset({Kind.SPIN, Kind.SHUTDOWN})
    starts = (n for n, r in _methods() if r.kind is Kind.START)
    return named(*kinds).union(starts, serving_once())


@derived
def serving_once() -> frozenset[str]:
    """Names of what lets messages be served that wait, and waits for no others."""
    return frozenset(n for n, r in _routines() if r.kind is Kind.SERVE and not r.arguments)


@derived
def running_callbacks() -> frozenset[str]:
    """Names of what runs callbacks, and comes back."""
    found = _routines()
    return frozenset(n for n, r in found if r.effect is Effect.RUNS and r.kind is not Kind.SPIN)


@derived
def acting() -> Mapping[str, str]:
    """What routines do that act on a node, by their last names; whatever they are called on."""
    found = ((n, r) for n, r in _routines() if r.kind is not Kind.POLL)
    return {n: r.effect.value for n, r in found if r.effect in ACTING}


@derived
def setting() -> frozenset[str]:
    """What sets parameters, or takes them away: functions by full names, methods by their own."""
    functions = ((n, r) for lib in _libraries() for n, r in lib.functions.items())
    wanted = frozenset({Access.SET, Access.DELETE})
    return frozenset(n for n, r in (*functions, *_methods()) if r.access in wanted)


@derived
def failing() -> frozenset[str]:
    """Those of them that have no condition, and so never go on."""
    return frozenset(n for n, r in _functions() if r.kind is Kind.CHECK and not r.arguments)


@derived
def logging() -> tuple[str, ...]:
    """The beginnings of the names of macros that log."""
    return tuple(prefix for library in _libraries() for prefix in library.logs)


def asks_first(name: str) -> bool:
    """Whether a macro that logs gets a condition, and only then looks at what it is to say."""
    return name.startswith(logging()) and ("_COND" in name or "_EXPRESSION" in name)


@derived
def keeping_arguments() -> frozenset[str]:
    """Functions that change none of their arguments, by their last names."""
    effects = frozenset({Effect.NONE, Effect.RANDOM, Effect.CHANGES, Effect.LOGS})
    kinds = frozenset({Kind.OTHER, Kind.LOG})
    found = {n for n, r in _functions() if r.effect in effects and r.kind in kinds}
    setting = (n for n, r in handle_methods().items() if r.access is Access.SET)
    return frozenset(found.union(setting))


@derived
def copying() -> frozenset[str]:
    """Methods of containers, which copy what they get."""
    found = (m for lib in _people() for c, m in lib.methods.items() if c == ANY_CONTAINER)
    return frozenset(n for methods in found for n in methods)


@derived
def copying_scopes() -> frozenset[str]:
    """The outermost namespaces of libraries whose constructors only copy what they get."""
    return frozenset(scope for library in _libraries() for scope in library.copying)


@derived
def looking() -> frozenset[str]:
    """Methods that only look at their object."""
    plain = frozenset({Kind.OTHER, Kind.CLOCK, Kind.TOLD, Kind.AUDIENCE})
    found = (
        pair
        for library in _libraries()
        for of_class, methods in library.methods.items()
        for pair in methods.items()
        if of_class != ANY_CONTAINER
    )
    looks = {n for n, r in found if r.effect in _LOOKS and r.kind in plain and not r.arguments}
    return frozenset(looks - acting().keys())


# --- files --------------------------------------------------------------------------------------


@derived
def marks() -> tuple[bytes, ...]:
    """Where none of these is in a file, it calls no library."""
    return tuple(m.encode() for library in _libraries() for m in library.marks)


@derived
def starts() -> tuple[bytes, ...]:
    """Where none of these is in any file of a package, it has no node."""
    return tuple(s.encode() for library in _libraries() for s in library.starts)


@derived
def _flat_marks() -> tuple[bytes, ...]:
    return tuple(m.encode() for library in _libraries() if library.flat for m in library.marks)


def is_flat(data: bytes) -> bool:
    """Whether a text may use a library whose nodes have parameters of their own, and clocks."""
    return any(mark in data for mark in _flat_marks())


@derived
def registering() -> tuple[str, ...]:
    """The macros that make a component of a class."""
    return tuple(library.registers for library in _libraries() if library.registers)


@derived
def registering_in_builds() -> tuple[str, ...]:
    """The commands of CMake that do so."""
    return tuple(c for library in _libraries() for c in library.commands)


@derived
def including() -> Mapping[str, str]:
    """By what code names a library, where that is not its own name."""
    return {library.name: library.included for library in _libraries() if library.included}


@derived
def versions() -> Mapping[str, tuple[int, ...]]:
    """Macros that compare a library's version with their arguments, and the newest version."""
    return {n: v for library in _libraries() for n, v in library.versions.items()}


@derived
def threaded() -> frozenset[str]:
    """What makes callbacks run beside each other."""
    return frozenset().union(*(library.threaded for library in _libraries()))


@derived
def macros() -> tuple[str, ...]:
    """The beginnings of names of macros that are known to hide no statement."""
    found = (n for library in _libraries() for n in library.functions if n.isupper())
    return (*logging(), *found)


@derived
def telling_words() -> frozenset[str]:
    """Words of which one is in code that asks for something, sends, or lets messages be served.

    Without those that count only after a scope: `scopes` has these.
    """
    checks = (name for name in named(Kind.CHECK) if name.isupper() and "_" in name)
    return asking_words().union(checks, named(Kind.PUBLISH, Kind.SPIN, Kind.SERVE))
