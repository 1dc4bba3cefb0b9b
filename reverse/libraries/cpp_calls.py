"""The calls of libraries that ask for something, as C++ writes them: by scopes and last names."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.records import dataclass
from rebsync.reverse.libraries.registry import derived, libraries
from rebsync.reverse.libraries.routines import ASKING, Kind, Language, Library, Routine


def last(name: str) -> str:
    """The last part of a full name."""
    return name.rpartition("::")[2]


def _scope(name: str) -> str:
    """The last scope of a full name: `param` of `ros::param::get`."""
    return last(name.rpartition("::")[0])


@dataclass(frozen=True, eq=False, slots=True)
class Calls:
    """What a library is called by: routines by what code says of them.

    `functions` are by their scope and name; `objects` those of classes that ask for something when
    an object is made, with the scopes these classes may have, `filters` those that subscribe;
    `nodes` those that make nodes, in `node_scopes`; `macros` have no scope. `methods` are by the
    class of their object and their name, without the methods of nodes and handles; `known` are all
    classes whose methods the library has, which do nothing of the kind but what is said of them.

    `classes` are the words of which objects are made; the others are called. `words` are all words
    that are looked for, without those that count only after a scope; `scopes` the outermost ones.
    """

    library: Library
    functions: Mapping[tuple[str, str], Routine]
    objects: Mapping[str, tuple[Routine, frozenset[str]]]
    filters: frozenset[str]
    macros: Mapping[str, Routine]
    nodes: Mapping[str, Routine]
    node_scopes: frozenset[str]
    on_nodes: Mapping[str, Routine]
    on_handles: Mapping[str, Routine]
    methods: Mapping[str, Mapping[str, Routine]]
    known: frozenset[str]
    classes: frozenset[str]
    words: frozenset[bytes]
    scoped_words: frozenset[bytes]
    scopes: frozenset[str]


def _asking(routines: Mapping[str, Routine]) -> dict[str, Routine]:
    return {name: r for name, r in routines.items() if r.kind in ASKING}


def _calls_of(library: Library) -> Calls:
    asking = _asking(library.functions)
    macros = {n: r for n, r in asking.items() if r.kind is Kind.NODELET}
    classes = {n: r for n, r in asking.items() if last(n)[:1].isupper() and n not in macros}
    made = {n: r for n, r in classes.items() if r.kind is Kind.NODE}
    nodes = {last(n): r for n, r in made.items()}
    objects = _objects({n: r for n, r in classes.items() if n not in made})
    functions = {
        (_scope(n), last(n)): r for n, r in asking.items() if n not in macros and n not in classes
    }
    on_nodes, on_handles, others = _methods(library)
    names = {*on_nodes, *on_handles, *(n for m in others.values() for n in m)}
    names |= {n for scope, n in functions if not scope or library.flat}
    words = frozenset(n.encode() for n in (*names, *objects, *macros, *nodes))
    return Calls(
        library=library,
        functions=functions,
        objects=objects,
        filters=frozenset(n for n, (r, _) in objects.items() if r.kind is Kind.SUBSCRIPTION),
        macros=macros,
        nodes=nodes,
        node_scopes=frozenset(map(_scope, made)),
        on_nodes=on_nodes,
        on_handles=on_handles,
        methods=others,
        known=frozenset(map(last, library.methods.keys() - library.nodes - library.handles)),
        classes=frozenset({*objects, *nodes}),
        words=words,
        scoped_words=frozenset(n.encode() for _, n in functions) - words,
        scopes=frozenset(n.partition("::")[0] for n in library.handles | library.nodes),
    )


def _objects(classes: Mapping[str, Routine]) -> dict[str, tuple[Routine, frozenset[str]]]:
    """Classes by their last names, with all scopes that they have."""
    found: dict[str, tuple[Routine, frozenset[str]]] = {}
    for full, routine in classes.items():
        _, scopes = found.get(last(full), (routine, frozenset()))
        found[last(full)] = routine, scopes | {_scope(full)}
    return found


def _methods(
    library: Library,
) -> tuple[dict[str, Routine], dict[str, Routine], dict[str, dict[str, Routine]]]:
    """The methods of nodes, of handles, and those of other classes by these."""
    asking = {of: _asking(methods) for of, methods in library.methods.items()}
    nodes = {n: r for of, m in asking.items() if of in library.nodes for n, r in m.items()}
    handles = {n: r for of, m in asking.items() if of in library.handles for n, r in m.items()}
    own = library.nodes | library.handles
    return nodes, handles, {last(of): m for of, m in asking.items() if of not in own and m}


@derived
def calls() -> tuple[Calls, ...]:
    """What each library is called by."""
    found = (_calls_of(library) for library in libraries(Language.CPP))
    return tuple(calls for calls in found if calls.words)


@derived
def asking_words() -> frozenset[str]:
    """Names of functions and methods that ask for something; other libraries have such classes."""
    found = (word.decode() for c in calls() for word in c.words)
    return frozenset(found).difference(*(c.classes for c in calls()))


@derived
def library_names() -> frozenset[str]:
    """The last names of functions of libraries but for macros of theirs."""
    names = {last(name) for library in libraries(Language.CPP) for name in library.functions}
    return frozenset(n for n in names if not n.isupper())


@derived
def first_called() -> frozenset[str]:
    """Methods of classes that run before an object of these serves anything."""
    return frozenset[str]().union(*(library.first for library in libraries(Language.CPP)))
