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

# What goes through the one value that it gets to its end.
CONSUMING = frozenset(
    {
        *("builtins.list", "builtins.tuple", "builtins.set", "builtins.frozenset", "builtins.dict"),
        *("builtins.sum", "builtins.min", "builtins.max", "builtins.sorted", "builtins.any"),
        *("builtins.all", "collections.Counter"),
    }
)
# Modules besides those of Python and ROS whose values have an end when they are iterated: arrays,
# tables, images, what a file has that is read at once.
FINITE = frozenset(
    {"numpy", "scipy", "pandas", "cv2", "PIL", "yaml", "matplotlib", "networkx", "shapely"}
    | {"tf", "tf2_ros", "tf_transformations", "transforms3d", "sensor_msgs_py", "cv_bridge"}
    | {"ros_numpy", "rospkg", "ament_index_python", "xacro", "urdf_parser_py", "psutil"}
)
# Methods whose results have an end, whatever their object is: of mappings and texts.
FINITE_METHODS = frozenset(
    {"items", "keys", "values", "iteritems", "iterkeys", "itervalues", "split", "splitlines"}
    | {"tolist", "copy"}
)
# What gives a line when somebody writes one.
STREAMS = frozenset({"sys.stdin"})


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
