"""The search of a product in C, for large ones: templates/product.c."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Sequence
from functools import cache, partial

from rebsync.checker.build import Unit, header, libraries
from rebsync.checker.exploration import Unavailable
from rebsync.checker.graph import Graph
from rebsync.checker.temporal.emptiness import Reached, search
from rebsync.checker.temporal.product import Product

_STEPS = 500_000  # between two looks at the bounds
_MORE, _NO_MEMORY = 1, 2
_FAIRNESS = ("none", "weak", "progress")
_MOST_PREDICATES = 10
_POINTER, _WIDE, _LONG, _INT = ctypes.c_void_p, ctypes.c_uint64, ctypes.c_int64, ctypes.c_int32
_INTS = ctypes.POINTER(_INT)


class _Choice(ctypes.Structure):
    _fields_ = tuple((name, ctypes.c_uint32) for name in ("move", "outside", "inside", "decides"))


class _Move(ctypes.Structure):
    _fields_ = (("place", _WIDE), ("kept", _WIDE))


class _Product(ctypes.Structure):
    """`struct product`."""

    decided: int
    entry: int
    _fields_ = (
        *((name, _POINTER) for name in ("first", "target", "time", "actor", "label")),
        *((name, _POINTER) for name in ("choice", "move")),
        *((name, _WIDE) for name in ("states", "width", "full")),
        *((name, _INT) for name in ("shift", "fairness", "decisive", "phase")),
        *((name, _WIDE) for name in ("nodes", "room", "at")),
        *((name, _LONG) for name in ("decided", "entry")),
        *((name, _INTS) for name in ("number", "parent", "rank")),
        *((name, ctypes.POINTER(_WIDE)) for name in ("key", "goals")),
        ("joining", _POINTER),
    )


class _Search:
    """One search; what it found lives as long as it does."""

    def __init__(self, product: Product, library: ctypes.CDLL) -> None:
        self._library = library
        graph = product.graph
        choices, moves = _tables(product)
        self._kept = (graph, product.labels, choices, moves)
        arrays = (graph.first, graph.target, graph.time, graph.actor, product.labels)
        self.fields = _Product(
            *(each.buffer_info()[0] for each in arrays),
            ctypes.addressof(choices),
            ctypes.addressof(moves),
            len(graph),
            product.width,
            product.full,
            product.shift,
            _FAIRNESS.index(product.fairness),
            product.decisive,
        )

    def __del__(self) -> None:
        self._library.rebsync_product_end(ctypes.byref(self.fields))

    def run(self, product: Product) -> Reached:
        """Everything that can be reached. Raises MemoryError, and what `look` raises."""
        fields, initial = ctypes.byref(self.fields), product.graph.initial
        begin = array("Q", initial)
        state = self._library.rebsync_product_begin(fields, begin.buffer_info()[0], len(begin))
        while state == _MORE:
            product.look()
            state = self._library.rebsync_product_go_on(fields, _STEPS)
        if state == _NO_MEMORY:
            raise MemoryError
        found = self.fields
        return Reached(
            found.number, found.key, found.parent, found.rank, found.decided, found.entry, self
        )


def search_compiled(product: Product) -> Reached:
    """The same as `search`, and by it when C cannot do it: a graph of any engine will do."""
    table = product.width << _MOST_PREDICATES
    if len(product.graph) * product.width >= 2**31 or product.full >= 2**64 or table >= 2**16:
        return search(product)
    try:
        library = _library()
    except Unavailable:
        return search(product)
    few = len(product.automaton.predicates) <= _MOST_PREDICATES
    product.classify(partial(_classes, library) if few else None)
    if len(product.values) * product.width >= 2**16:
        return search(product)
    return _Search(product, library).run(product)


@cache
def _library() -> ctypes.CDLL:
    parts = tuple(header(name) for name in ("product.c", "pearce.h"))
    (library,) = libraries((Unit("product", partial(header, "product.c"), parts, "-O2"),))
    library.rebsync_classes.restype = None
    library.rebsync_classes.argtypes = [_POINTER, _WIDE, _WIDE, _POINTER, ctypes.c_uint32, _POINTER]
    library.rebsync_product_begin.argtypes = [_POINTER, _POINTER, _WIDE]
    library.rebsync_product_go_on.argtypes = [_POINTER, _WIDE]
    library.rebsync_product_end.restype = None
    library.rebsync_product_end.argtypes = [_POINTER]
    return library


def _classes(
    library: ctypes.CDLL, graph: Graph, predicates: tuple[int, ...]
) -> tuple[array[int], Sequence[int]]:
    """The values of the predicates side by side are the number of the class."""
    labels = array("i", [0]) * len(graph)
    numbers = array("I", predicates)
    library.rebsync_classes(
        graph.labels.buffer_info()[0],
        graph.words,
        len(graph),
        numbers.buffer_info()[0],
        len(numbers),
        labels.buffer_info()[0],
    )
    return labels, range(1 << len(predicates))


def _tables(product: Product) -> tuple[ctypes.Array[_Choice], ctypes.Array[_Move]]:
    """What the automaton can do for all values of its predicates, in all of its places."""
    choices, moves = [], list[_Move]()
    for values in product.values:
        for place in range(product.width):
            choice = product.choose(values, place)
            sizes = len(choice.outside), len(choice.inside)
            choices.append(_Choice(len(moves), *sizes, choice.decides))
            moves += [_Move(place, 0) for place in choice.outside]
            moves += [_Move(place, kept) for place, kept in product.goals(choice)]
    return (_Choice * max(1, len(choices)))(*choices), (_Move * max(1, len(moves)))(*moves)
