"""What functions and methods of Python's own library take: how many arguments, of which kinds.

A signature has a kind for each argument: `kind` must be there, `kind?` may be, `*kind` are all that
follow, `**kind` all others by name, `name=kind` is given by its name, `name:kind?` by either.
`a|b` is one of two kinds. A name in several rows takes what any of them says; what no row has may
refuse what it gets.
"""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.records import dataclass
from rebsync.reverse.libraries.registry import derived


@dataclass(frozen=True, slots=True)
class LibrarySignature:
    """The kinds of what a function takes by place, of which some must be there, and by name."""

    places: tuple[str, ...]
    required: int
    rest: str
    names: Mapping[str, str]

    def kind(self, name: str | int) -> str:
        """The kind of an argument, by its name or its place; empty where there is none."""
        if isinstance(name, str):
            return self.names.get(name) or self.names.get("*", "")
        return self.places[name] if name < len(self.places) else self.rest


_TIME = "datetime.datetime"
_UNITS = "days seconds microseconds milliseconds minutes hours weeks"
_ROS_TIMES = "rospy.Time genpy.Time rospy.rostime.Time"
_SPANS = "rospy.Duration genpy.Duration rospy.rostime.Duration"
_OF_ENDS = (
    "callback_group=any event_callbacks=any qos_overriding_options=any publisher_class=any"
    " content_filter_options=any acceptable_callbacks=any"
)
_POLICIES = (
    "history=any reliability=any durability=any lifespan=any deadline=any liveliness=any"
    " liveliness_lease_duration=any avoid_ros_namespace_conventions=any"
)
# The kinds are said in `analysis/python/library_arguments.py`.
_FUNCTIONS: tuple[tuple[str, str], ...] = (
    (
        "",
        """
        object super threading.Lock threading.RLock threading.local threading.current_thread
        threading.currentThread threading.get_ident threading.main_thread threading.Event time.time
        time.time_ns time.monotonic time.monotonic_ns time.perf_counter time.perf_counter_ns
        time.process_time random.random datetime.datetime.today datetime.datetime.utcnow
        datetime.date.today os.getpid os.getcwd os.uname platform.node socket.gethostname uuid.uuid1
        uuid.uuid4 sys.exc_info sys.stdout.flush sys.stderr.flush sys.stdin.fileno
        queue.SimpleQueue enum.auto contextlib.ExitStack threading.Condition itertools.count""",
    ),
    (
        "number",
        """
        abs chr math.fabs math.floor math.ceil math.trunc math.sqrt math.exp math.expm1 math.sin
        math.cos math.tan math.asin math.acos math.atan math.sinh math.cosh math.tanh math.degrees
        math.radians math.erf math.isnan math.isinf math.isfinite math.log10 math.log2 math.log1p
        time.sleep itertools.count""",
    ),
    ("whole", "bin hex oct math.factorial"),
    (
        "number number",
        """
        math.atan2 math.pow math.fmod math.copysign math.remainder divmod random.uniform
        random.gauss random.normalvariate operator.add operator.sub operator.mul itertools.count""",
    ),
    ("number number?", "math.log"),
    ("number ndigits:whole|none?", "round"),
    ("number number rel_tol=share abs_tol=share", "math.isclose"),
    ("number number", "pow"),
    ("*number", "math.hypot"),
    ("*whole", "math.gcd"),
    ("whole whole", "math.comb random.randint"),
    ("whole whole?", "math.perm"),
    ("whole whole? whole?", "range random.randrange"),
    ("number? number? number?", "random.triangular"),
    ("numbers", "math.fsum statistics.fmean statistics.mean statistics.median"),
    ("numbers", "statistics.stdev statistics.variance"),
    ("hashables", "statistics.mode"),
    ("numbers start=number", "math.prod"),
    ("numbers number?", "sum"),
    ("iterable start=list|tuple", "sum"),
    ("iterable list|tuple", "sum"),
    ("number|text|bytes?", "int float"),
    ("number? number?", "complex"),
    ("any?", "bool str type"),
    (
        "any",
        """
        repr ascii callable id typing.final functools.total_ordering enum.unique
        abc.abstractmethod staticmethod classmethod functools.cache functools.lru_cache
        contextlib.contextmanager dataclasses.asdict operator.itemgetter""",
    ),
    ("shallow|none", "copy.copy"),
    ("deep|none memo:mapping?", "copy.deepcopy"),
    ("any any", "isinstance"),
    ("instance", "vars"),
    ("any text?", "format"),
    ("any text", "hasattr"),
    ("hashable", "hash"),
    ("text|bytes", "ord json.loads"),
    ("sized", "len"),
    ("sequence|mapping", "reversed"),
    ("iterable", "any all iter"),
    ("function any", "iter"),
    ("iterable?", "list tuple"),
    ("hashables?", "set frozenset"),
    ("hashables any?", "dict.fromkeys"),
    ("iterable start:whole?", "enumerate"),
    ("*iterable", "zip itertools.chain itertools.product itertools.zip_longest"),
    ("*iterable fillvalue=any", "itertools.zip_longest"),
    ("iterable maxlen:length|none?", "collections.deque"),
    ("maxlen=length|none", "collections.deque"),
    ("function mapping?", "collections.defaultdict"),
    ("mapping|pairs? **any", "dict collections.OrderedDict"),
    ("hashables|mapping?", "collections.Counter"),
    ("iterable any?", "next"),
    ("iterable key=function|none reverse=number", "sorted"),
    ("iterable default=any key=function|none", "max min"),
    ("value value *value key=function|none", "max min"),
    ("function iterable *iterable", "map itertools.starmap"),
    ("function|none iterable", "filter itertools.filterfalse"),
    ("function iterable any?", "functools.reduce"),
    ("function *any", "functools.partial"),
    ("function", "functools.cmp_to_key functools.wraps contextlib.contextmanager property"),
    ("*any sep=text|none end=text|none file=function|none flush=any", "print"),
    (
        "*any",
        """
        Exception ValueError KeyError RuntimeError IndexError TypeError OSError ZeroDivisionError
        LookupError AssertionError NotImplementedError SystemExit StopIteration OverflowError
        AttributeError BaseException contextlib.suppress""",
    ),
    ("whole|none whole|none? whole|none?", "slice"),
    ("iterable length|none length|none?", "itertools.islice"),
    (
        "iterable",
        """
        itertools.chain.from_iterable itertools.groupby itertools.pairwise itertools.cycle
        itertools.tee itertools.permutations""",
    ),
    ("numbers", "itertools.accumulate"),
    ("iterable function", "itertools.accumulate"),
    ("iterable key:function|none?", "itertools.groupby"),
    ("function iterable", "itertools.takewhile itertools.dropwhile"),
    ("iterable iterable", "itertools.compress"),
    ("iterable length", "itertools.combinations itertools.permutations"),
    ("any length?", "itertools.repeat"),
    ("sequence", "random.choice"),
    ("list", "random.shuffle heapq.heapify heapq.heappop"),
    ("list any", "heapq.heappush heapq.heappushpop heapq.heapreplace bisect.insort"),
    ("sequence any", "bisect.bisect bisect.bisect_left bisect.bisect_right"),
    ("number|text|none?", "random.seed"),
    ("sequence length", "random.sample"),
    ("sequence weights:numbers|none? k=length", "random.choices"),
    ("whole iterable key=function|none", "heapq.nlargest heapq.nsmallest"),
    ("*iterable", "heapq.merge"),
    (
        "text",
        """
        operator.attrgetter sys.stdout.write sys.stderr.write re.escape textwrap.dedent
        os.path.basename os.path.dirname os.path.isdir os.path.isfile os.path.exists os.path.islink
        os.path.isabs os.path.normpath os.path.abspath os.path.realpath os.path.expanduser
        os.path.expandvars os.path.split os.path.splitext shutil.which string.Template""",
    ),
    ("text *text", "os.path.join pathlib.Path"),
    ("text default:any?", "os.getenv os.environ.get"),
    ("text?", "logging.getLogger"),
    ("text width:whole?", "textwrap.fill"),
    ("text whole placeholder=text", "textwrap.shorten"),
    ("text text", "textwrap.indent"),
    ("text", "time.strftime"),
    ("number|none?", "time.localtime time.gmtime time.ctime"),
    ("number? number? number? number?", "datetime.time"),
    ("number number number", "datetime.date"),
    ("number number number number? number? number? number?", _TIME),
    ("", f"{_TIME}.now"),
    (" ".join(f"{name}:number?" for name in _UNITS.split()), "datetime.timedelta"),
    ("pattern flags:number?", "re.compile"),
    ("pattern text flags:number?", "re.match re.search re.fullmatch re.findall re.finditer"),
    ("pattern text whole?", "re.split"),
    ("pattern replacement text", "re.sub"),
    ("plain|none indent=number|text|none ensure_ascii=number separators=tuple", "json.dumps"),
    ("orderly indent=number|text|none sort_keys=number separators=tuple", "json.dumps"),
    ("bytes", "base64.b64encode"),
    ("bytes?", "hashlib.md5 hashlib.sha256"),
    ("maxsize:number?", "queue.Queue queue.PriorityQueue queue.LifoQueue"),
    (
        "group:none? target:function? name:text|none? args:iterable? kwargs:mapping? daemon=any",
        "threading.Thread",
    ),
    ("number function args:iterable? kwargs:mapping?", "threading.Timer"),
    ("any?", "contextlib.nullcontext threading.Condition"),
    ("whole any *any", "logging.log"),
    ("text", "warnings.warn"),
    ("maxsize:whole|none?", "functools.lru_cache"),
    (
        "init=number repr=number eq=number order=number unsafe_hash=number frozen=number "
        "match_args=number kw_only=number slots=number",
        "dataclasses.dataclass",
    ),
    (
        "any *any",
        """
        logging.debug logging.info logging.warning logging.error logging.critical logging.warn
        logging.exception pprint.pformat""",
    ),
    ("any **any", "dataclasses.replace"),
    ("default=any default_factory=any init=any repr=any compare=any", "dataclasses.field"),
    ("limit:number|none? chain:any?", "traceback.format_exc traceback.print_exc"),
    ("text any rename=any defaults=any", "collections.namedtuple"),
    ("text any", "typing.NewType"),
    ("text *any", "typing.TypeVar struct.pack"),
    ("text bytes", "struct.unpack"),
    ("text bytes number?", "struct.unpack_from"),
    ("text?", "os.listdir os.scandir argparse.ArgumentParser"),
    ("description=any prog=any add_help=any formatter_class=any", "argparse.ArgumentParser"),
    ("text", "os.stat pathlib.Path.exists"),
    ("text number", "os.access os.open"),
    ("text|number text? encoding=text|none errors=text|none newline=text|none", "open"),
    ("number", "os.close"),
    ("number number", "os.read"),
    ("number number number", "os.lseek os.pread"),
    ("any any", "json.dump"),
    ("any", "json.load yaml.safe_load yaml.load"),
    ("any Loader=any", "yaml.load"),
    ("file=any", "traceback.print_exc traceback.print_stack"),
    ("", "traceback.print_stack"),
)
_METHODS: tuple[tuple[str, str], ...] = (
    (
        "",
        """
        str.lower str.upper str.title str.capitalize str.swapcase str.casefold str.isdigit
        str.isalpha str.isalnum str.isnumeric str.isdecimal str.isspace str.isupper str.islower
        str.isidentifier str.isprintable list.clear list.copy list.reverse dict.clear dict.copy
        dict.keys dict.values dict.items dict.popitem dict.iteritems dict.iterkeys dict.itervalues
        set.clear set.copy set.pop deque.clear deque.copy deque.pop deque.popleft deque.reverse
        number.is_integer number.bit_length number.conjugate bytes.hex list.pop str.strip
        str.lstrip str.rstrip str.split str.rsplit str.splitlines deque.rotate
        datetime.datetime.timestamp datetime.datetime.date datetime.datetime.time
        datetime.datetime.isoformat datetime.datetime.weekday datetime.datetime.timetuple
        datetime.date.isoformat datetime.date.weekday datetime.timedelta.total_seconds""",
    ),
    ("text", "datetime.datetime.strftime datetime.date.strftime datetime.time.strftime"),
    ("text|none", "str.strip str.lstrip str.rstrip"),
    ("sep:separator|none maxsplit:whole?", "str.split str.rsplit"),
    ("maxsplit=whole", "str.split str.rsplit"),
    ("separator", "str.partition str.rpartition"),
    ("any", "str.splitlines"),
    ("text text number?", "str.replace"),
    ("texts", "str.join"),
    ("text", "str.removeprefix str.removesuffix"),
    ("text|texts_of_tuple number? number?", "str.startswith str.endswith"),
    ("text number? number?", "str.find str.rfind str.index str.rindex str.count"),
    ("whole", "str.zfill str.expandtabs deque.rotate list.pop"),
    ("whole letter?", "str.center str.ljust str.rjust"),
    ("encoding:text? errors:text?", "str.encode bytes.decode"),
    ("*any **any", "str.format"),
    (
        "any",
        """
        list.append list.remove list.count deque.append deque.appendleft deque.remove deque.count
        tuple.count dict.has_key""",
    ),
    ("any number? number?", "list.index tuple.index deque.index"),
    ("whole any", "list.insert"),
    ("iterable", "list.extend deque.extend deque.extendleft"),
    ("key=function|none reverse=number", "list.sort"),
    ("hashable", "set.add set.discard set.remove"),
    (
        "*hashables",
        """
        set.update set.union set.intersection set.difference set.difference_update
        set.intersection_update set.issubset set.issuperset set.isdisjoint""",
    ),
    ("hashables", "set.symmetric_difference"),
    ("hashable any?", "dict.get dict.pop dict.setdefault"),
    ("mapping|pairs", "dict.update"),
    ("hashables|mapping", "dict.subtract"),
    ("last:any?", "dict.popitem"),
    ("hashable last:any?", "dict.move_to_end"),
)
# What constructors of client libraries take: times are not negative.
_CLIENTS: tuple[tuple[str, str], ...] = (
    ("secs:number?", _SPANS),
    ("secs:whole? nsecs:whole?", _SPANS),
    ("secs:length?", _ROS_TIMES),
    ("secs:natural? nsecs:natural?", _ROS_TIMES),
    ("number", "rospy.Duration.from_sec genpy.Duration.from_sec"),
    ("length", "rospy.Time.from_sec rospy.Time.from_seconds genpy.Time.from_sec"),
    ("seconds=seconds nanoseconds=number", "rclpy.duration.Duration"),
    ("seconds=length nanoseconds=length clock_type=any", "rclpy.time.Time"),
    (
        "name:any data_class:any subscriber_listener:any? tcp_nodelay:any? latch:any? headers:any?"
        " queue_size:whole|none?",
        "rospy.Publisher",
    ),
    (
        "name:any data_class:any callback:any? callback_args:any? queue_size:whole|none?"
        " buff_size:whole? tcp_nodelay:any?",
        "rospy.Subscriber",
    ),
    (f"msg_type:any? topic:any? qos_profile:natural|quality? {_OF_ENDS}", "Node.create_publisher"),
    (
        f"msg_type:any? topic:any? callback:any? qos_profile:natural|quality? raw=any {_OF_ENDS}",
        "Node.create_subscription",
    ),
    (f"depth=natural {_POLICIES}", "rclpy.qos.QoSProfile"),
    ("message", "rclpy.duration.Duration.from_msg rclpy.time.Time.from_msg"),
    ("message clock_type:any", "rclpy.time.Time.from_msg"),
)


@derived
def _signatures() -> Mapping[str, tuple[LibrarySignature, ...]]:
    found: dict[str, tuple[LibrarySignature, ...]] = {}
    for text, names in (*_FUNCTIONS, *_METHODS, *_CLIENTS):
        read = _read(text)
        for name in names.split():
            found[name] = (*found.get(name, ()), read)
    return found


def _read(text: str) -> LibrarySignature:
    places: list[str] = []
    required, rest, names = 0, "", {}
    for argument in text.split():
        plain = argument.removesuffix("?")
        by_name, is_named, kind = plain.partition("=")
        name, is_either, either = plain.partition(":")
        if argument.startswith("**"):
            names["*"] = argument[2:]
        elif argument.startswith("*"):
            rest = argument[1:]
        elif is_named:
            names[by_name] = kind
        else:
            places.append(either if is_either else plain)
            required += plain == argument
            if is_either:
                names[name] = either
    return LibrarySignature(tuple(places), required, rest, names)


def signatures(name: str) -> tuple[LibrarySignature, ...]:
    """The signatures of a function by its full name, or of a method by that of its class."""
    return _signatures().get(name.removeprefix("builtins."), ())
