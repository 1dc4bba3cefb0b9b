"""What Python calls to log, and what may be called in what is logged."""

from __future__ import annotations

HARMLESS = frozenset({"str", "repr", "len", "format", "round"})
# What only gives a value of what it gets. By these names alone; what may fail is asked elsewhere.
LOOKS = HARMLESS | {
    *("abs", "all", "any", "bool", "dict", "divmod", "enumerate", "filter", "float", "frozenset"),
    *("int", "isinstance", "list", "map", "max", "min", "range", "reversed", "set", "sorted"),
    *("sum", "tuple", "type", "zip"),
}
# Of these the first argument is called, and of all what has one of these names.
CALLING, CALLED = frozenset({"filter", "map"}), frozenset({"default", "key"})
_MATHS = (
    *("acos", "asin", "atan", "atan2", "ceil", "cos", "degrees", "exp", "fabs", "floor", "hypot"),
    *("isclose", "isfinite", "isinf", "isnan", "log", "log10", "log2", "radians", "sin", "sqrt"),
    *("tan", "trunc"),
)
# The same of modules of Python, by full names; some ask the machine for what no model has.
COMPUTING = frozenset(
    {
        *(f"math.{name}" for name in _MATHS),
        *(
            "dataclasses.replace",
            "json.dumps",
            "pprint.pformat",
            "os.path.basename",
            "os.path.join",
        ),
        *("textwrap.dedent", "textwrap.fill", "textwrap.indent", "textwrap.shorten"),
        *("datetime.date.today", "datetime.datetime.now", "datetime.datetime.utcnow"),
        *("os.environ.get", "os.getenv", "os.getpid", "platform.node", "socket.gethostname"),
        *("time.ctime", "time.strftime"),
    }
)
# Methods that give other texts of a text.
OF_TEXTS = frozenset(
    {
        *("capitalize", "center", "expandtabs", "format", "ljust", "lower", "lstrip", "replace"),
        *("rjust", "rstrip", "split", "splitlines", "strip", "swapcase", "title", "upper", "zfill"),
    }
)
# What makes texts of values.
MAKING_TEXTS = frozenset({"ascii", "bin", "format", "hex", "oct", "repr", "str"})
# What may be asked of what tells the time.
ON_CLOCKS = frozenset({"isoformat", "now", "to_msg", "to_nsec", "to_sec"})
# The methods of a logger of Python's library that only log.
LEVELS = frozenset({"debug", "info", "warning", "error", "critical"})
# What makes texts of an object.
TEXTS = frozenset({"__str__", "__repr__", "__format__"})
