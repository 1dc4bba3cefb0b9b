"""How calls of the standard libraries may end: each rule once, with its names in both languages.

A name that begins with a dot is a method, of any object or of the class before the dot.
"""

from __future__ import annotations

from enum import Enum

from rebsync.records import dataclass


class Size(Enum):
    """What a method does to the number of its object's elements."""

    SAME = "same"
    GROWS = "one more, or as many where there is a bound"
    MORE = "perhaps more"
    LOSES = "one less"
    ANY = "any"


class Tells(Enum):
    """What the result of a call says of its first argument, or of its object."""

    NOTHING = "nothing"
    SIZE = "how many elements it has"
    EMPTY = "whether it has none"
    HAS = "whether it has an element, or a key"
    RANGE = "the numbers below it"
    MOST = "the greatest of all"
    PAIRS = "pairs of its elements and others"
    SAME = "the same elements"
    OBJECT = "that it is an object of some class"


class Raises(Enum):
    """For which arguments a call raises what its rule says."""

    ANY = "any"
    NEGATIVE = "a first one that may be negative"
    COUNT = "a first one that is a number of elements, and may be negative"
    NO_ERROR_CODE = "none that is for an error"
    POSITION = "a first one that is a number, and no zero"
    ALONE = "none, which would be given instead"
    NO_DEFAULT = "one that the object may lack, and no second one, which would be given instead"
    ABSENT = "one that the object may lack"
    PART = "a text that is no literal, and a position in it that is no zero; or as COUNT"
    ZERO_SECOND = "a second one that may be zero"
    ZERO_STEP = "a third one that may be zero"
    INFINITE = "a first one that may be no number, or greater than all"
    BOUNDLESS = "a first one that may be greater than all"
    TEXT = "a first one that may be no number"
    COMPUTED = "one that is not written as a number"
    NO_START = "no third one, and a second one that may have no elements"
    POWER = "a second one that is no positive number in the source"
    CODED = "another encoding than UTF-8, which has all characters"
    UNWRITTEN = "a first one that is no text in the source"
    NO_TEXT = "a first one that is of another type than texts"
    UNDECLARED = "the name of a parameter that the node may not have declared"
    REPEATED = "any, where the call may not be the first one"
    UNDECLARED_ALONE = "the name alone of a parameter that nobody declares in the source"
    OTHER_TYPE = "none, of a parameter that is declared with another type in the source"
    UNORDERED = "two of which the second may be the smaller one"
    BEFORE_START = "seconds that may be negative, or more than 32 bits have"
    BEYOND_SPAN = "seconds that may be more than 32 bits have"
    NEGATIVE_PAIR = "two numbers, of which the first one may be negative"
    NO_RATE = "a number that may not be greater than zero"
    NO_NAME = "a text of the source that is no name of ROS"


@dataclass(frozen=True, slots=True)
class OutcomeRule:
    """What some functions do besides giving a value; see `CallOutcome`."""

    cpp: str = ""
    python: str = ""
    raises: str = ""
    empty: str = ""
    acts: str = ""
    size: Size = Size.SAME
    gives: str = ""
    returns: bool = False
    tells: Tells = Tells.NOTHING
    keeps: bool = False
    may_be_none: bool = False
    when: Raises = Raises.ANY


WAITS = "waits"
_ANYTHING = "may do anything"
_ENDLESS = "may never end"
_PROCESS = "runs another program"

RULES = (
    # Numbers.
    OutcomeRule("abs fabs fabsf labs", "builtins.abs math.fabs", gives="number"),
    OutcomeRule("ceil floor round roundf lround llround trunc rint nearbyint lrint"),
    OutcomeRule("sqrt sqrtf cbrt pow exp exp2 expm1 hypot log log10 log1p log2 fma ldexp"),
    OutcomeRule("sin cos tan asin acos atan atan2 sinh cosh tanh fmod remainder copysign erf"),
    OutcomeRule("isfinite isinf isnan isnormal signbit fmin fmax lerp midpoint gcd lcm"),
    OutcomeRule("max", tells=Tells.MOST),
    OutcomeRule("min clamp minmax swap exchange move forward pair tuple make_pair tie"),
    OutcomeRule("make_tuple as_const ref cref addressof sizeof static_cast byte to_integer"),
    OutcomeRule("max_element min_element minmax_element accumulate reduce inner_product count"),
    OutcomeRule("count_if find find_if find_if_not any_of all_of none_of for_each for_each_n"),
    OutcomeRule("copy copy_n copy_if copy_backward fill fill_n transform sort stable_sort rotate"),
    OutcomeRule("nth_element partial_sort reverse unique remove remove_if replace replace_if iota"),
    OutcomeRule("lower_bound upper_bound binary_search equal equal_range adjacent_find mismatch"),
    OutcomeRule("partial_sum adjacent_difference distance next prev advance begin end size data"),
    OutcomeRule("rbegin rend cbegin cend empty back_inserter ostream_iterator is_sorted generate"),
    OutcomeRule("search swap_ranges includes set_union set_intersection set_difference merge"),
    OutcomeRule("shift_left shift_right partition stable_partition sample shuffle ranges::sort"),
    OutcomeRule("memcpy memset memmove memcmp strlen strcmp strncmp getenv to_string quoted"),
    OutcomeRule("atof atoi atol strtol strtod strtof strtoul isdigit isalpha isspace toupper"),
    OutcomeRule("tolower snprintf sprintf printf puts fprintf fputs fflush putchar time difftime"),
    OutcomeRule("unique_ptr shared_ptr static_pointer_cast"),
    OutcomeRule(
        "vector deque list forward_list make_unique make_shared new",
        raises="std::length_error",
        when=Raises.COUNT,
    ),
    OutcomeRule(
        "string wstring basic_string",
        raises="std::length_error std::out_of_range",
        when=Raises.PART,
    ),
    OutcomeRule("dynamic_pointer_cast in_place nullopt make_optional optional numeric_limits"),
    OutcomeRule("array map set unordered_map unordered_set multimap multiset"),
    OutcomeRule("queue stack priority_queue string_view initializer_list span"),
    OutcomeRule("mutex recursive_mutex shared_mutex atomic atomic_bool atomic_int atomic_flag"),
    OutcomeRule("lock_guard scoped_lock unique_lock shared_lock condition_variable hash less"),
    OutcomeRule("greater plus minus equal_to function ifstream ofstream fstream stringstream"),
    OutcomeRule("ostringstream istringstream setprecision setw setfill filesystem::exists"),
    OutcomeRule("std::numeric_limits.max std::numeric_limits.min std::numeric_limits.lowest"),
    OutcomeRule("numeric_limits::max numeric_limits::min numeric_limits::lowest"),
    OutcomeRule("numeric_limits::infinity numeric_limits::quiet_NaN numeric_limits::epsilon"),
    OutcomeRule("numeric_limits::has_infinity size_t int32_t uint32_t int64_t uint64_t"),
    OutcomeRule("chrono::seconds chrono::milliseconds chrono::microseconds chrono::nanoseconds"),
    OutcomeRule("chrono::minutes chrono::hours chrono::duration chrono::duration_cast"),
    OutcomeRule("chrono::steady_clock::now chrono::system_clock::now chrono::time_point"),
    OutcomeRule("chrono::high_resolution_clock::now chrono::steady_clock::time_point"),
    OutcomeRule("chrono::system_clock::to_time_t chrono::system_clock::time_point"),
    OutcomeRule("random_device mt19937 uniform_int_distribution uniform_real_distribution rand"),
    OutcomeRule("normal_distribution default_random_engine literals"),
    OutcomeRule("exception runtime_error logic_error invalid_argument out_of_range domain_error"),
    OutcomeRule("range_error overflow_error underflow_error length_error bad_alloc"),
    OutcomeRule("stoi stol stoll stoul stoull stof stod stold", raises="std::invalid_argument"),
    OutcomeRule("regex regex_match regex_search regex_replace", raises="std::regex_error"),
    OutcomeRule("get visit", raises="std::bad_variant_access"),
    OutcomeRule("any_cast", raises="std::bad_any_cast"),
    OutcomeRule("dynamic_cast", raises="std::bad_cast"),
    OutcomeRule(".value", raises="std::bad_optional_access"),
    OutcomeRule("shared_ptr::from_weak", raises="std::bad_weak_ptr"),
    OutcomeRule(python="builtins.max", empty="builtins.ValueError", tells=Tells.MOST),
    OutcomeRule(python="builtins.min", empty="builtins.ValueError"),
    OutcomeRule(
        python="builtins.round math.floor math.ceil math.trunc",
        raises="builtins.OverflowError builtins.ValueError",
        gives="number",
        when=Raises.INFINITE,
    ),
    OutcomeRule(python="builtins.hash", gives="number"),
    OutcomeRule(
        python="builtins.int",
        raises="builtins.ValueError",
        gives="number",
        when=Raises.INFINITE,
    ),
    OutcomeRule(
        python="builtins.float", raises="builtins.ValueError", gives="number", when=Raises.TEXT
    ),
    OutcomeRule(python="builtins.complex builtins.bytes", raises="builtins.ValueError"),
    OutcomeRule(
        python="math.isfinite math.isinf math.isnan math.hypot math.atan2 math.atan", gives="number"
    ),
    OutcomeRule(
        python="math.sin math.cos math.tan",
        raises="builtins.ValueError",
        gives="number",
        when=Raises.BOUNDLESS,
    ),
    OutcomeRule(python="math.degrees math.radians math.copysign", gives="number"),
    OutcomeRule(python="math.tanh math.pi math.inf math.nan math.e math.tau math.isclose"),
    OutcomeRule(python="math.fsum math.prod math.dist math.gcd math.erf", gives="number"),
    OutcomeRule(
        python="math.sqrt", raises="builtins.ValueError", gives="number", when=Raises.NEGATIVE
    ),
    OutcomeRule(
        python="math.log math.log10 math.log2", raises="builtins.ValueError", gives="number"
    ),
    OutcomeRule(
        python="math.acos math.asin math.log1p math.fmod",
        raises="builtins.ValueError",
        gives="number",
    ),
    OutcomeRule(
        python="math.exp math.pow math.sinh math.cosh",
        raises="builtins.OverflowError builtins.ValueError",
    ),
    OutcomeRule(python="builtins.bool", gives="number"),
    OutcomeRule(python="builtins.repr builtins.format builtins.ascii"),
    OutcomeRule(python="builtins.str builtins.hex builtins.bin builtins.oct", gives="str"),
    OutcomeRule(python="builtins.chr", raises="builtins.ValueError"),
    OutcomeRule(
        python="builtins.divmod", raises="builtins.ZeroDivisionError", when=Raises.ZERO_SECOND
    ),
    OutcomeRule(python="builtins.ord", raises="builtins.TypeError"),
    OutcomeRule(
        python="builtins.pow",
        raises="builtins.ArithmeticError builtins.ValueError",
        gives="number",
        when=Raises.POWER,
    ),
    OutcomeRule(python="builtins.type builtins.dict.fromkeys builtins.int.from_bytes"),
    OutcomeRule(python="math.expm1 math.remainder", raises="builtins.ArithmeticError"),
    OutcomeRule(python="math.factorial math.comb math.perm", raises="builtins.ValueError"),
    OutcomeRule(python="builtins.isinstance", keeps=True, tells=Tells.OBJECT),
    OutcomeRule(python="builtins.issubclass dataclasses.field", keeps=True),
    OutcomeRule(python="builtins.callable builtins.hasattr builtins.id"),
    OutcomeRule(python="builtins.object builtins.slice builtins.super"),
    # Collections.
    OutcomeRule(python="builtins.len", gives="number", tells=Tells.SIZE),
    OutcomeRule(python="builtins.sum builtins.any builtins.all", gives="number"),
    OutcomeRule(".size .length", tells=Tells.SIZE),
    OutcomeRule(".empty", tells=Tells.EMPTY),
    OutcomeRule(".count .contains", tells=Tells.HAS),
    OutcomeRule(
        python="builtins.range",
        raises="builtins.ValueError",
        tells=Tells.RANGE,
        when=Raises.ZERO_STEP,
    ),
    OutcomeRule(python="builtins.enumerate builtins.zip", tells=Tells.PAIRS),
    OutcomeRule(python="builtins.reversed", tells=Tells.SAME),
    OutcomeRule(python="builtins.map builtins.filter"),
    OutcomeRule(python="builtins.sorted builtins.list", gives="list", tells=Tells.SAME),
    OutcomeRule(python="builtins.tuple", gives="tuple", tells=Tells.SAME),
    OutcomeRule(python="builtins.dict", gives="dict"),
    OutcomeRule(python="builtins.set builtins.frozenset", gives="set"),
    OutcomeRule(python="collections.deque", gives="deque", tells=Tells.SAME),
    OutcomeRule(python="collections.defaultdict", gives="defaultdict", keeps=True),
    OutcomeRule(python="collections.Counter", gives="defaultdict"),
    OutcomeRule(python="collections.OrderedDict", gives="dict"),
    OutcomeRule(python="builtins.next", raises="builtins.StopIteration", when=Raises.NO_DEFAULT),
    OutcomeRule(python="builtins.iter", acts=_ENDLESS),
    OutcomeRule(python="dataclasses.dataclass builtins.staticmethod", returns=True),
    OutcomeRule(python="builtins.classmethod builtins.property enum.unique", returns=True),
    OutcomeRule(python="abc.abstractmethod contextlib.contextmanager", returns=True),
    OutcomeRule(python="dataclasses.replace dataclasses.asdict enum.auto"),
    OutcomeRule(python="typing.NamedTuple enum.Enum enum.IntEnum typing.TypeVar typing.NewType"),
    OutcomeRule(python="typing.Protocol abc.ABC enum.IntFlag enum.Flag typing.Generic"),
    OutcomeRule(python="collections.namedtuple copy.copy copy.deepcopy bisect.bisect"),
    OutcomeRule(python="builtins.print sys.stdout.write sys.stderr.write warnings.warn"),
    OutcomeRule("cerr cout clog endl flush hex dec fixed boolalpha", "sys.stdout sys.stderr"),
    OutcomeRule(python="sys.stdout.flush sys.stderr.flush sys.maxsize sys.platform sys.argv"),
    OutcomeRule(python="logging.getLogger rclpy.logging.get_logger", gives="logger"),
    OutcomeRule(python="builtins.Exception builtins.ValueError builtins.KeyError"),
    OutcomeRule(python="builtins.RuntimeError builtins.IndexError builtins.TypeError"),
    OutcomeRule(python="builtins.OSError builtins.ZeroDivisionError builtins.LookupError"),
    OutcomeRule(python="builtins.AssertionError builtins.NotImplementedError"),
    OutcomeRule(python="builtins.SystemExit builtins.StopIteration builtins.OverflowError"),
    OutcomeRule(python="builtins.AttributeError builtins.BaseException"),
    OutcomeRule(
        python="re.compile.match re.compile.search re.compile.fullmatch shutil.which",
        may_be_none=True,
    ),
    OutcomeRule(python="traceback.print_exc traceback.print_stack sys.exc_info"),
    OutcomeRule(python="base64.b64encode uuid.uuid4 uuid.uuid1 hashlib.md5 hashlib.sha256"),
    OutcomeRule(python="string.Template string.ascii_letters string.digits"),
    OutcomeRule(python="json.dumps pathlib.Path os.path.exists os.path.join os.path.isfile"),
    OutcomeRule(python="os.getpid os.linesep os.name sys.version_info sys.executable sys.path"),
    OutcomeRule(python="builtins.open", raises="builtins.OSError", gives="file"),
    # Methods.
    OutcomeRule(python=".append .appendleft .insert .add", size=Size.GROWS),
    OutcomeRule(".push_back .push_front .emplace_back .emplace_front .push", size=Size.GROWS),
    OutcomeRule(".insert .emplace .try_emplace .insert_or_assign", size=Size.GROWS),
    OutcomeRule(python=".extend .setdefault .update .extendleft", size=Size.MORE),
    OutcomeRule(python=".pop .popleft .popitem", empty="builtins.IndexError", size=Size.LOSES),
    OutcomeRule(
        python="dict.pop", raises="builtins.KeyError", size=Size.ANY, when=Raises.NO_DEFAULT
    ),
    OutcomeRule(python="set.pop", empty="builtins.KeyError", size=Size.LOSES),
    OutcomeRule(python=".remove", raises="builtins.ValueError", size=Size.ANY, when=Raises.ABSENT),
    OutcomeRule(python=".move_to_end", raises="builtins.KeyError", when=Raises.ABSENT),
    OutcomeRule(python=".index .rindex", raises="builtins.ValueError", when=Raises.ABSENT),
    OutcomeRule(python="set.remove", raises="builtins.KeyError", size=Size.ANY, when=Raises.ABSENT),
    OutcomeRule(python=".discard .clear", size=Size.ANY),
    OutcomeRule(".pop_front .pop_back .pop", size=Size.LOSES),
    OutcomeRule(".clear .assign .reset", size=Size.ANY),
    OutcomeRule(".resize", raises="std::length_error", size=Size.ANY, when=Raises.NEGATIVE),
    OutcomeRule(".reserve", raises="std::length_error", when=Raises.NEGATIVE),
    OutcomeRule("new[]", raises="std::bad_array_new_length", when=Raises.NEGATIVE),
    OutcomeRule("bitset", raises="std::invalid_argument", when=Raises.TEXT),
    OutcomeRule(".test", raises="std::out_of_range"),
    OutcomeRule("std::atomic.test"),
    OutcomeRule(".erase std::vector.erase", size=Size.ANY),
    OutcomeRule("std::vector.assign", raises="std::length_error", size=Size.ANY, when=Raises.COUNT),
    OutcomeRule(
        "std::vector.insert", raises="std::length_error", size=Size.GROWS, when=Raises.COUNT
    ),
    OutcomeRule("std::map.erase std::set.erase", size=Size.ANY),
    OutcomeRule(
        "std::string.erase std::string.insert std::string.replace std::string.compare",
        raises="std::out_of_range",
        size=Size.ANY,
        when=Raises.POSITION,
    ),
    OutcomeRule(
        ".at std::vector.at std::array.at std::map.at std::string.at", raises="std::out_of_range"
    ),
    OutcomeRule(
        "std::string.append std::string.assign",
        raises="std::out_of_range",
        size=Size.ANY,
        when=Raises.PART,
    ),
    OutcomeRule("std::string.substr", raises="std::out_of_range"),
    OutcomeRule("std::optional.value", raises="std::bad_optional_access"),
    OutcomeRule(python=".decode", raises="builtins.UnicodeDecodeError"),
    OutcomeRule(python=".encode", raises="builtins.UnicodeDecodeError", when=Raises.CODED),
    OutcomeRule(python=".strip .split .lower .upper .replace .format .join .rstrip .lstrip"),
    OutcomeRule(python=".read .readline .readlines .write", raises="builtins.OSError"),
    OutcomeRule(".keys .elements std::map.keys", "dict.get .values .copy"),
    OutcomeRule(python=".items", tells=Tells.PAIRS),
    OutcomeRule("std::random_device.operator() std::mutex.unlock std::unique_lock.unlock"),
    OutcomeRule(
        "std::mutex.try_lock std::unique_lock.owns_lock std::condition_variable.notify_one"
    ),
    OutcomeRule("std::condition_variable.notify_all"),
    OutcomeRule(python=".to_bytes", raises="builtins.OverflowError"),
    OutcomeRule(python="path.exists path.is_file path.joinpath"),
    OutcomeRule(python="path.read_text path.read_bytes", raises="builtins.OSError", gives="str"),
    # What waits, runs others, or ends the program.
    OutcomeRule("sleep usleep nanosleep clock_nanosleep pause", "time.sleep", acts="takes time"),
    OutcomeRule("this_thread::sleep_for this_thread::sleep_until", acts="takes time"),
    OutcomeRule("select pselect poll ppoll epoll_wait epoll_pwait recv recvfrom", acts=WAITS),
    OutcomeRule("recvmsg accept accept4 pthread_rwlock_rdlock", acts=WAITS),
    OutcomeRule("this_thread::get_id"),
    OutcomeRule(
        "system popen pclose execv execvp execl execlp fork vfork posix_spawn", acts=_PROCESS
    ),
    OutcomeRule(
        "exit _exit _Exit abort quick_exit terminate kill raise longjmp", acts="ends the node"
    ),
    OutcomeRule("exit std::exit std::abort std::terminate std::_Exit", acts="ends the node"),
    OutcomeRule("signal sigaction atexit at_quick_exit setitimer alarm", acts=_ANYTHING),
    OutcomeRule(
        "async thread jthread pthread_create call_once packaged_task", acts="starts a thread"
    ),
    OutcomeRule(
        "pthread_join pthread_cond_wait sem_wait sem_timedwait sigwait sigwaitinfo", acts=WAITS
    ),
    OutcomeRule("wait waitpid wait3 wait4 msgrcv mq_receive semop lockf flock tcdrain", acts=WAITS),
    OutcomeRule("connect send sendto sendmsg getaddrinfo gethostbyname", acts=WAITS),
    OutcomeRule(
        "read readv pread preadv fread recvmmsg mq_send mq_timedreceive msgsnd", acts=WAITS
    ),
    OutcomeRule("mq_timedsend semtimedop waitid sigsuspend sigtimedwait getdelim", acts=WAITS),
    OutcomeRule("pthread_rwlock_wrlock pthread_spin_lock pthread_barrier_wait", acts=WAITS),
    OutcomeRule("pthread_cond_timedwait pthread_mutex_timedlock pthread_timedjoin_np", acts=WAITS),
    OutcomeRule("mtx_lock mtx_timedlock cnd_wait cnd_timedwait thrd_join", acts=WAITS),
    OutcomeRule("thrd_sleep", acts="takes time"),
    OutcomeRule("ioctl fcntl syscall", acts=_ANYTHING),
    OutcomeRule("execve execle execlpe execvpe fexecve posix_spawnp clone", acts=_PROCESS),
    OutcomeRule("getchar getc fgetc gets fgets scanf fscanf getline getch getpass", acts=WAITS),
    OutcomeRule("std::condition_variable.wait std::condition_variable.wait_for", acts=WAITS),
    OutcomeRule("std::condition_variable.wait_until std::future.get std::future.wait", acts=WAITS),
    OutcomeRule("std::mutex.lock std::unique_lock.lock pthread_mutex_lock", acts=WAITS),
    OutcomeRule("std::thread.join .join .wait .wait_for .wait_until .timed_wait", acts=WAITS),
    OutcomeRule("std::future.wait_for std::atomic.wait std::promise.get_future", acts=WAITS),
    OutcomeRule("std::cin cin std::wcin stdin", "sys.stdin", acts=WAITS),
    OutcomeRule(python=".acquire .wait .result", acts=WAITS),
    OutcomeRule(
        python=".recv .recvfrom .accept .connect .sendall", raises="builtins.OSError", acts=WAITS
    ),
    OutcomeRule(python="queue.Queue.join .communicate .readexactly .serve_forever", acts=WAITS),
    OutcomeRule(
        python="sys.exit builtins.exit builtins.quit os._exit os.abort", acts="ends the node"
    ),
    OutcomeRule(python="builtins.input sys.stdin.readline sys.stdin.read", acts=WAITS),
    OutcomeRule(
        python="builtins.eval builtins.exec builtins.getattr builtins.setattr", acts=_ANYTHING
    ),
    OutcomeRule(
        python="builtins.delattr builtins.globals builtins.locals builtins.vars", acts=_ANYTHING
    ),
    OutcomeRule(python="builtins.compile builtins.__import__ builtins.breakpoint", acts=_ANYTHING),
)
