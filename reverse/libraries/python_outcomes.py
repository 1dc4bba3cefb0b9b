"""How calls of the modules of Python's own library, and of some others, may end: a rule for each.

Numbers, containers and texts, which both languages have, are in `outcome_rules`.
"""

from __future__ import annotations

from rebsync.reverse.libraries.outcome_rules import WAITS, OutcomeRule, Raises, Size, Tells

MODULES = (
    OutcomeRule(python="random.seed random.shuffle random.normalvariate random.triangular"),
    OutcomeRule(python="statistics.median statistics.mean", empty="statistics.StatisticsError"),
    OutcomeRule(python="statistics.fmean statistics.mode", empty="statistics.StatisticsError"),
    OutcomeRule(python="statistics.stdev statistics.variance", raises="statistics.StatisticsError"),
    OutcomeRule(python="random.random random.uniform random.gauss", gives="number"),
    OutcomeRule(
        python="random.randint",
        raises="builtins.ValueError",
        gives="number",
        when=Raises.UNORDERED,
    ),
    OutcomeRule(python="random.randrange", raises="builtins.ValueError", gives="number"),
    OutcomeRule(python="random.sample", raises="builtins.ValueError", gives="list"),
    OutcomeRule(python="random.choices", raises="builtins.IndexError", gives="list"),
    OutcomeRule(python="random.choice", empty="builtins.IndexError"),
    OutcomeRule(python="itertools.islice itertools.chain itertools.pairwise itertools.product"),
    OutcomeRule(python="itertools.takewhile itertools.accumulate itertools.combinations"),
    OutcomeRule(python="itertools.groupby itertools.zip_longest itertools.permutations"),
    OutcomeRule(python="itertools.chain.from_iterable itertools.starmap itertools.tee"),
    OutcomeRule(python="itertools.dropwhile itertools.filterfalse itertools.compress"),
    OutcomeRule(python="itertools.count itertools.cycle itertools.repeat", acts="may never end"),
    OutcomeRule(python="functools.lru_cache functools.cache functools.wraps", returns=True),
    OutcomeRule(python="typing.final functools.total_ordering", returns=True),
    OutcomeRule(python="functools.partial functools.cmp_to_key"),
    OutcomeRule(python="functools.reduce", raises="builtins.TypeError", when=Raises.NO_START),
    OutcomeRule(python="operator.itemgetter", raises="builtins.LookupError"),
    OutcomeRule(python="operator.attrgetter operator.add operator.mul operator.sub"),
    OutcomeRule(python="bisect.bisect_left bisect.bisect_right bisect.insort heapq.heappush"),
    OutcomeRule(python="heapq.heappop", empty="builtins.IndexError", size=Size.LOSES),
    OutcomeRule(python="heapq.heapreplace", raises="builtins.IndexError"),
    OutcomeRule(
        python="heapq.heapify heapq.heappushpop heapq.nlargest heapq.nsmallest heapq.merge"
    ),
    OutcomeRule(python="time.time time.monotonic time.perf_counter time.time_ns", gives="number"),
    OutcomeRule(python="time.strftime time.monotonic_ns time.perf_counter_ns time.process_time"),
    OutcomeRule(
        python="time.localtime time.gmtime time.ctime",
        raises="builtins.OverflowError builtins.OSError",
        when=Raises.COMPUTED,
    ),
    OutcomeRule(
        python="datetime.datetime.now datetime.datetime.today datetime.datetime.utcnow",
        gives="datetime.datetime",
    ),
    OutcomeRule(python="datetime.date.today", gives="datetime.date"),
    OutcomeRule(python="datetime.datetime.strftime datetime.datetime.isoformat"),
    OutcomeRule(python="datetime.datetime.timestamp datetime.datetime.date datetime.datetime.time"),
    OutcomeRule(python="datetime.timedelta.total_seconds datetime.timezone.utc"),
    OutcomeRule(
        python="datetime.timedelta",
        raises="builtins.OverflowError builtins.ValueError",
        gives="datetime.timedelta",
        when=Raises.COMPUTED,
    ),
    OutcomeRule(
        python="datetime.datetime datetime.date datetime.time",
        raises="builtins.ValueError builtins.OverflowError",
        when=Raises.COMPUTED,
    ),
    OutcomeRule(python="logging.debug logging.info logging.warning logging.error"),
    OutcomeRule(python="logging.critical logging.exception logging.log logging.warn"),
    OutcomeRule(python="threading.Lock threading.RLock threading.local", gives="threading.Lock"),
    OutcomeRule(python="threading.current_thread threading.currentThread threading.get_ident"),
    OutcomeRule(python="threading.Thread threading.Timer threading.main_thread"),
    OutcomeRule(python="threading.Event threading.Condition sys.stdin.fileno"),
    OutcomeRule(python="argparse.ArgumentParser argparse.ArgumentParser.add_argument"),
    OutcomeRule(python="threading.Event.set threading.Event.clear threading.Event.is_set"),
    OutcomeRule(
        python="threading.Thread.is_alive threading.Timer.cancel threading.Thread.setDaemon"
    ),
    OutcomeRule(python="threading.Thread.start threading.Timer.start"),
    OutcomeRule(python="threading.Lock.release", raises="builtins.RuntimeError"),
    OutcomeRule(python="threading.Condition.notify threading.Condition.notify_all"),
    OutcomeRule(python="threading.Condition.notifyAll threading.Thread.getName"),
    OutcomeRule(python="contextlib.suppress contextlib.nullcontext contextlib.ExitStack"),
    OutcomeRule(python="contextlib.ExitStack.enter_context contextlib.ExitStack.callback"),
    OutcomeRule(
        python="re.compile re.sub re.findall re.split re.finditer",
        raises="re.error",
        when=Raises.UNWRITTEN,
    ),
    OutcomeRule(
        python="re.match re.search re.fullmatch",
        raises="re.error",
        when=Raises.UNWRITTEN,
        may_be_none=True,
    ),
    OutcomeRule(python="re.compile.findall re.compile.finditer re.compile.split re.compile.sub"),
    OutcomeRule(python="re.escape re.IGNORECASE re.MULTILINE traceback.format_exc"),
    OutcomeRule(python="os.path.basename os.path.dirname os.path.isdir os.path.normpath"),
    OutcomeRule(python="os.path.splitext os.path.split os.path.join"),
    OutcomeRule(python="os.path.isabs os.path.expandvars os.path.realpath os.path.islink"),
    OutcomeRule(python="os.environ.get os.getenv", may_be_none=True),
    OutcomeRule(python="os.path.abspath os.path.expanduser os.sep os.O_RDONLY os.O_RDWR"),
    OutcomeRule(python="os.O_NONBLOCK os.uname os.getcwd os.access"),
    OutcomeRule(python="os.environ", raises="builtins.KeyError"),
    OutcomeRule(python="json.dumps", gives="str"),
    OutcomeRule(python="dataclasses.replace"),  # of a record, as who calls it is to know
    OutcomeRule(python="pprint.pformat", gives="str"),
    OutcomeRule(
        python="textwrap.dedent textwrap.fill textwrap.indent textwrap.shorten",
        raises="builtins.TypeError",
        gives="str",
        when=Raises.NO_TEXT,
    ),
    OutcomeRule(python="os.getpid", gives="number"),
    OutcomeRule(python="platform.node socket.gethostname", gives="str"),
    OutcomeRule(python="json.loads json.load", raises="json.JSONDecodeError"),
    OutcomeRule(python="yaml.safe_load yaml.load", raises="yaml.YAMLError"),
    OutcomeRule(python="numpy.linalg.inv numpy.linalg.solve", raises="numpy.linalg.LinAlgError"),
    OutcomeRule(python="struct.pack struct.unpack struct.unpack_from", raises="struct.error"),
    OutcomeRule(python="os.open os.close os.lseek os.pread", raises="builtins.OSError"),
    OutcomeRule(python="os.listdir os.stat os.scandir os.read", raises="builtins.OSError"),
    OutcomeRule(python="queue.Queue queue.PriorityQueue queue.LifoQueue queue.SimpleQueue"),
    OutcomeRule(python="queue.Queue.qsize queue.Queue.empty queue.Queue.full"),
    OutcomeRule(python="collections.namedtuple._replace"),
    OutcomeRule(python="queue.Queue.get_nowait", raises="queue.Empty"),
    OutcomeRule(python="queue.Queue.put_nowait", raises="queue.Full"),
    OutcomeRule(
        python="rospy.get_param rospy.get_param_cached rospy.delete_param",
        raises="builtins.KeyError",
        when=Raises.NO_DEFAULT,
    ),
    OutcomeRule(python="rospy.has_param .has_parameter", tells=Tells.HAS),
    OutcomeRule(python="rospy.search_param", may_be_none=True),
    OutcomeRule(
        python=".get_parameter .get_parameters .undeclare_parameter",
        raises="rclpy.exceptions.ParameterNotDeclaredException",
        when=Raises.UNDECLARED,
    ),
    OutcomeRule(
        python=".declare_parameter .declare_parameters",
        raises="rclpy.exceptions.ParameterAlreadyDeclaredException",
        when=Raises.REPEATED,
    ),
    OutcomeRule(python="rospy.ServiceProxy.__call__", raises="rospy.ServiceException"),
    OutcomeRule(
        python="tf2_ros.Buffer.lookup_transform tf2_ros.Buffer.lookup_transform_full"
        " tf2_ros.Buffer.transform"
        " tf.TransformListener.lookupTransform tf.TransformListener.transformPose"
        " tf.TransformListener.transformPoint tf.TransformListener.waitForTransform"
        " .lookup_transform .lookupTransform",
        raises="tf.LookupException tf.ConnectivityException tf.ExtrapolationException",
    ),
    OutcomeRule(python="threading.Event.wait threading.Condition.wait", acts=WAITS),
    OutcomeRule(python="threading.Thread.join subprocess.Popen.wait", acts=WAITS),
    OutcomeRule(python="threading.Lock.acquire queue.Queue.get queue.Queue.put", acts=WAITS),
)
