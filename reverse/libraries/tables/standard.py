"""The standard libraries of C++ and Python, POSIX and boost: each rule once, with its names.

A rule says what its functions do, and how they are called in each language: `functions` by names
that stand alone, `methods` of objects of which nothing is known.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from rebsync.records import dataclass
from rebsync.reverse.libraries.routines import (
    ANY_CONTAINER,
    RECEIVER,
    Effect,
    Kind,
    Language,
    Library,
    LogCall,
    Routine,
)

_KEY = (("key", "callback"),)
_ARGUMENTS = {Kind.SLEEP: ("period",), Kind.CHECK: ("condition",)}


@dataclass(frozen=True, slots=True)
class Rule:
    """What some functions do, with their names in C++ and in Python, by blanks."""

    does: Effect
    cpp: str = ""
    python: str = ""
    kind: Kind = Kind.OTHER
    writes: tuple[str, ...] = ()
    arguments: tuple[str, ...] = ()
    keywords: tuple[tuple[str, str], ...] = ()

    @property
    def routine(self) -> Routine:
        """The functions as one routine."""
        arguments = self.arguments or _ARGUMENTS.get(self.kind, ())
        result = "seconds" if self.kind is Kind.CLOCK else ""
        return Routine(
            self.kind, arguments, self.keywords, result=result, does=self.does, writes=self.writes
        )


FUNCTIONS = (
    # Numbers.
    Rule(Effect.NONE, "abs fabs fabsf labs", "builtins.abs math.fabs"),
    Rule(Effect.NONE, "max min fmax fmin clamp"),
    Rule(Effect.NONE, python="builtins.max builtins.min builtins.sorted", keywords=_KEY),
    Rule(Effect.NONE, "ceil floor round roundf lround trunc rint", "builtins.round"),
    Rule(Effect.NONE, python="math.ceil math.floor math.trunc"),
    Rule(
        Effect.NONE, "sqrt sqrtf cbrt pow exp exp2 expm1 hypot", "builtins.pow math.sqrt math.pow"
    ),
    Rule(Effect.NONE, python="math.exp math.expm1 math.hypot"),
    Rule(Effect.NONE, "log log10 log1p log2", "math.log math.log10 math.log1p math.log2"),
    Rule(Effect.NONE, "sin cos tan asin acos atan atan2", "math.sin math.cos math.tan"),
    Rule(Effect.NONE, python="math.asin math.acos math.atan math.atan2"),
    Rule(Effect.NONE, "sinh cosh tanh", "math.sinh math.cosh math.tanh"),
    Rule(Effect.NONE, "fmod remainder mod", "math.fmod math.remainder"),
    Rule(Effect.NONE, "isfinite isinf isnan isnormal signbit", "math.isfinite math.isinf"),
    Rule(Effect.NONE, python="math.isnan"),
    Rule(Effect.NONE, "atof atoi to_string", "builtins.int builtins.float builtins.bool"),
    Rule(Effect.NONE, "static_cast defined", "builtins.str builtins.repr builtins.format"),
    # Collections.
    Rule(Effect.NONE, python="builtins.len builtins.sum builtins.any builtins.all"),
    Rule(Effect.NONE, python="builtins.range builtins.list builtins.tuple builtins.dict"),
    Rule(Effect.NONE, python="builtins.set builtins.reversed builtins.zip"),
    Rule(Effect.NONE, python="builtins.enumerate builtins.chr"),
    Rule(Effect.NONE, python="builtins.map builtins.filter", arguments=("callback",)),
    Rule(Effect.NONE, python="builtins.ord builtins.isinstance builtins.type builtins.hasattr"),
    Rule(Effect.NONE, python="builtins.getattr copy.deepcopy"),
    # Chance, clocks, time.
    Rule(Effect.RANDOM, "rand", "random.randint random.choice random.random random.uniform"),
    Rule(Effect.CLOCK, "std::chrono::system_clock::now std::chrono::steady_clock::now"),
    Rule(Effect.CLOCK, python="time.time time.monotonic time.perf_counter", kind=Kind.CLOCK),
    Rule(Effect.TIME, "sleep usleep nanosleep clock_nanosleep", "time.sleep", Kind.SLEEP),
    Rule(Effect.TIME, "sleep_for sleep_until", kind=Kind.SLEEP),
    Rule(Effect.WAITS, "select pselect poll ppoll epoll_wait epoll_pwait", kind=Kind.POLL),
    # Logs.
    Rule(Effect.LOGS, "printf std::printf puts std::puts", "builtins.print", Kind.LOG),
    Rule(Effect.LOGS, "fprintf"),
    # Files, which no model has.
    Rule(Effect.CHANGES, "close fcntl fclose ioctl open socket write"),
    # What ends the program, or checks that it goes on.
    Rule(Effect.ENDS, "exit _exit abort quick_exit terminate kill raise"),
    Rule(Effect.ENDS, "__builtin_trap __builtin_unreachable unreachable"),
    Rule(Effect.ENDS, python="sys.exit builtins.exit builtins.quit", kind=Kind.EXIT),
    Rule(Effect.LEAVES, "longjmp fork execv execvp alarm"),
    Rule(Effect.CHECKS, "assert BOOST_ASSERT", kind=Kind.CHECK),
)
METHODS = (
    Rule(Effect.NONE, "at back front count empty length max_size size", "strip split lower upper"),
    Rule(Effect.NONE, "c_str str cbegin cend", "startswith endswith encode decode replace join"),
    Rule(Effect.WAITS, "join wait wait_for wait_until timed_wait acquire arrive_and_wait"),
)
# Methods of containers, which copy what they get.
CONTAINERS = (
    Rule(
        Effect.CHANGES,
        "push_back push push_front reserve resize insert assign erase append",
        "append",
        writes=(RECEIVER,),
    ),
    Rule(Effect.NONE, "at count find substr"),
)
# How the names of Python's functions and methods begin, of which nothing is known but that they
# wait, end the node, or lead to its callbacks; as patterns.
ACTING_WORDS = (
    *("sleep", "wait", "spin", "publish", "shutdown", "exit", "_exit", "abort", "kill", "cancel"),
    *("destroy", "start", "stop", "reset", "call", "shut", "run", "exec", "eval", "unregister"),
    *("register", "setattr", "delattr", "connect", "raise", "input", "acquire", "set_param"),
    *("create_(pub|sub|timer|serv|client|rate|node|guard)", "signal", "send_goal"),
    *("add_(node|call|on_|done|list|wait)", "execute", "getch", "readline", r"read\b", "recv"),
    *(
        "accept",
        "join",
        "get_key",
        "import_module",
        "deserialize",
        "f(set|del)$",
        "__(import|call|set|del|enter|exit)",
        "globals",
    ),
)
# Methods of queues and threads of Python that wait where they get no value: of dictionaries and
# texts methods of the same names get one.
WAITING_ALONE = frozenset({"get", "join"})
# The objects that C++ writes texts to, for people to read.
STREAMS = frozenset(
    {"std::cout", "std::cerr", "std::clog", "cout", "cerr", "clog", "std::endl", "endl"}
)
# The seconds of a unit of `std::chrono`, by its class, by the ending of a literal, and as a ratio.
UNITS = {
    **{"hours": Fraction(3600), "minutes": Fraction(60), "seconds": Fraction(1)},
    **{"milliseconds": Fraction(1, 10**3), "microseconds": Fraction(1, 10**6)},
    **{"nanoseconds": Fraction(1, 10**9)},
}
SUFFIXES = {
    **{"h": UNITS["hours"], "min": UNITS["minutes"], "s": UNITS["seconds"]},
    **{"ms": UNITS["milliseconds"], "us": UNITS["microseconds"], "ns": UNITS["nanoseconds"]},
}
RATIOS = {
    "std::nano": UNITS["nanoseconds"],
    "std::micro": UNITS["microseconds"],
    "std::milli": UNITS["milliseconds"],
}
# The seconds of the unit that functions sleep in.
SLEEPS = {"sleep": UNITS["seconds"], "usleep": UNITS["microseconds"]}
# What makes threads wait for each other, which changes nothing of a model, as a pattern.
LOCKS = r"(threading|_thread|thread)\.(R?Lock|Condition|(Bounded)?Semaphore|allocate_lock)"


# What logs in Python, with the arguments that it takes.
_LOG_KEYWORDS = frozenset({"exc_info", "stack_info", "stacklevel", "extra"})
LOG_CALLS = {
    f"{of}.{level}": LogCall(keywords=_LOG_KEYWORDS)
    for of in ("logging", "logging.getLogger()")
    for level in ("debug", "info", "warning", "warn", "error", "critical", "fatal", "exception")
} | {f"{of}.log": LogCall(1, keywords=_LOG_KEYWORDS) for of in ("logging", "logging.getLogger()")}


def _named(rules: Sequence[Rule], language: Language) -> Mapping[str, Routine]:
    is_cpp = language is Language.CPP
    return {n: r.routine for r in rules for n in (r.cpp if is_cpp else r.python).split()}


def _library(name: str, language: Language, containers: str) -> Library:
    methods = {"": _named(METHODS, language), containers: _named(CONTAINERS, language)}
    copying = ("std", "boost", "Eigen", "cv", "pcl") if language is Language.CPP else ()
    functions = _named(FUNCTIONS, language)
    threaded = frozenset({"thread", "jthread", "async", "pthread_create"})
    return Library(
        name,
        language,
        functions,
        methods,
        copying=copying,
        threaded=threaded if language is Language.CPP else frozenset(),
        log_arguments=LOG_CALLS if language is Language.PYTHON else {},
        flat=False,
    )


LIBRARIES = (
    _library("std", Language.CPP, ANY_CONTAINER),
    _library("Python", Language.PYTHON, "builtins.list"),
)
