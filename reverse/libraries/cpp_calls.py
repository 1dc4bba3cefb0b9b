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

    `functions` are by their scope and name, `objects` those of classes that ask for something when
    an object is made, with the scopes these classes may have; `macros` have no scope. `methods` are
    by the class of their object and their name, without the methods of nodes and handles.
    """

    library: Library
    functions: Mapping[tuple[str, str], Routine]
    objects: Mapping[str, tuple[Routine, frozenset[str]]]
    macros: Mapping[str, Routine]
    on_nodes: Mapping[str, Routine]
    on_handles: Mapping[str, Routine]
    methods: Mapping[str, Mapping[str, Routine]]
    nodes: Mapping[str, Routine]
    node_scopes: frozenset[str]
    words: frozenset[bytes]
    scoped_words: frozenset[bytes]

    @property
    def node_classes(self) -> frozenset[str]:
        """The names of the classes of nodes."""
        return frozenset(self.nodes)

    @property
    def filters(self) -> frozenset[str]:
        """The classes that subscribe when an object is made, or by a method."""
        found = self.objects.items()
        return frozenset(n for n, (r, _) in found if r.kind is Kind.SUBSCRIPTION)

    @property
    def scopes(self) -> frozenset[str]:
        """The outermost scopes of its names."""
        return frozenset(n.partition("::")[0] for n in self.library.handles | self.library.nodes)

    @property
    def classes(self) -> frozenset[str]:
        """Words of which objects are made; the others are called."""
        return frozenset(self.objects).union(self.nodes)


def _asking(routines: Mapping[str, Routine]) -> dict[str, Routine]:
    return {name: r for name, r in routines.items() if r.kind in ASKING}


def _calls_of(library: Library) -> Calls:
    functions: dict[tuple[str, str], Routine] = {}
    objects: dict[str, tuple[Routine, frozenset[str]]] = {}
    macros: dict[str, Routine] = {}
    own = library.nodes | library.handles
    for full, routine in _asking(library.functions).items():
        name = last(full)
        if routine.kind is Kind.NODELET:
            macros[name] = routine
        elif routine.kind is Kind.NODE and name[:1].isupper():
            continue
        elif name[:1].isupper():
            before = objects.get(name, (routine, frozenset()))
            objects[name] = routine, before[1] | {_scope(full)}
        else:
            functions[_scope(full), name] = routine
    of_classes = {c: _asking(m) for c, m in library.methods.items()}
    nodes = {n: r for c, m in of_classes.items() if c in library.nodes for n, r in m.items()}
    handles = {n: r for c, m in of_classes.items() if c in library.handles for n, r in m.items()}
    others = {last(c): m for c, m in of_classes.items() if c not in own and m}
    kinds = library.functions.items()
    made = {f: r for f, r in kinds if r.kind is Kind.NODE and last(f)[:1].isupper()}
    classes = {last(f): r for f, r in made.items()}
    names = {*nodes, *handles, *(n for m in others.values() for n in m)}
    names |= {n for scope, n in functions if not scope or library.flat}
    words = frozenset(n.encode() for n in (*names, *objects, *macros, *classes))
    scoped = frozenset(n.encode() for _, n in functions) - words
    return Calls(
        *(library, functions, objects, macros, nodes, handles, others),
        *(classes, frozenset(map(_scope, made)), words, scoped),
    )


@derived
def calls() -> tuple[Calls, ...]:
    """What each library is called by."""
    found = (_calls_of(library) for library in libraries(Language.CPP))
    return tuple(calls for calls in found if calls.words)
