"""What of Python's library gives elements without end, and what hands elements on one by one.

From the documentation of `itertools` and of the built-in functions.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.reverse.ir import expressions as e

# With as many arguments as this, or fewer, they have no end; of `iter` see below.
_MOST = {"itertools.count": 2, "itertools.cycle": 1, "itertools.repeat": 1}
MAKERS = frozenset(_MOST)
# What they give ends where the first of their arguments does.
SHORTEST = frozenset({"builtins.zip", "builtins.map"})
# Their first argument is called, and not iterated.
AFTER_FUNCTION = frozenset({"builtins.map", "itertools.starmap", "itertools.takewhile"})
# They take an element when they are asked for one.
LAZY = (
    SHORTEST
    | AFTER_FUNCTION
    | {
        *("builtins.enumerate", "builtins.iter", "itertools.islice", "itertools.chain"),
        *("itertools.chain.from_iterable", "itertools.pairwise", "itertools.accumulate"),
        *("itertools.zip_longest", "itertools.tee", "itertools.cycle"),
    }
)
# What leaves an iterator where it is, or takes one element of it. To look for one that suits, as
# `filter` does, may take all.
ONE_BY_ONE = (
    LAZY
    | MAKERS
    | {"builtins.next", "builtins.isinstance", "builtins.print", "builtins.id", "builtins.type"}
)


def makes(name: str, given: Sequence[e.Expression]) -> bool:
    """Whether a call of a function with some arguments gives elements without end.

    `iter(function, last)` asks a function again and again, which may never give the last.
    """
    if name == "builtins.iter":
        return len(given) == 2
    return name in _MOST and len(given) <= _MOST[name]


def is_bounded(name: str, given: Sequence[e.Expression]) -> bool:
    """Whether a call gives no more elements than it is told: `islice(values, 3)`."""
    if name != "itertools.islice" or len(given) < 2:
        return False
    last = given[1] if len(given) == 2 else given[2]
    return not (isinstance(last, e.Literal) and last.value is None)
