"""The annotations that markers and the set-up of a class of generated C++ show."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from rebsync import model as m
from rebsync.reserved import OFFERS
from rebsync.reverse.bodies.written import annotation
from rebsync.reverse.generated.annotations import of_class, of_server
from rebsync.reverse.generated.cpp_roles import Roles
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of


def annotations_in(markers: Collection[str], owner: CppClass) -> tuple[m.Annotation, ...]:
    """The annotations that markers in a class hold."""
    span = owner.cpp.span(owner.node)
    return tuple(a for text in markers if (a := annotation(text, span)) is not None)


def class_annotations(all_roles: Mapping[str, Roles], owner: CppClass) -> Iterator[m.Annotation]:
    """Those of a class."""
    is_marked = any(x.startswith("reactiveclass ") for x in owner.markers)
    return of_class(
        annotations_in(owner.markers, owner) if is_marked else None,
        has_drive=any(text_of(f.type) == "Drive" for f in owner.fields),
        on_bridge=all_roles[owner.name].on_bridge,
    )


def server_annotations(
    code: Code, all_roles: Mapping[str, Roles], owner: CppClass, function: CppFunction, name: str
) -> Iterator[m.Annotation]:
    """Those of a server, by the function that serves it."""
    is_marked = any(x.startswith("msgsrv ") for x in function.markers)
    return of_server(
        annotations_in(function.markers, owner) if is_marked else None,
        set_up_of(code, all_roles, owner, function, name),
        is_sensor=name in all_roles[owner.name].sensors,
    )


def set_up_of(
    code: Code, all_roles: Mapping[str, Roles], owner: CppClass, function: CppFunction, name: str
) -> tuple[m.Annotation, ...] | None:
    """What the set-up shows of a server, here or in a class above; None if it shows none."""
    overload = name, len(function.parameters)
    for above in code.lineage(owner.name):
        shown = all_roles[above.name].annotations.get(overload)
        if shown is not None:
            same = [f for f in above.functions if f.name == function.name]
            same = [f for f in same if len(f.parameters) == overload[1]]
            index = next((i for i, f in enumerate(same) if f.types == function.types), 0)
            found = shown[min(index, len(shown) - 1)]
            # A service or action is said where it is offered, and nowhere below.
            return found if above is owner else tuple(a for a in found if a.name not in OFFERS)
    return None
