"""Exceptions and classes of the standard libraries: what extends what, which are plain values."""

from __future__ import annotations

from collections.abc import Mapping

TERMINATES = "std::terminate"  # of what ends the program: no handler is for it
# What operations raise that are no calls, in C++ and in Python; in C++ dividing ends the program.
FAILURES: Mapping[str, tuple[str, str]] = {
    "divides by zero": (TERMINATES, "builtins.ZeroDivisionError"),
    "divides the least number by -1": (TERMINATES, "builtins.OverflowError"),
    "lacks the element": ("std::out_of_range", "builtins.IndexError"),
    "lacks the key": ("std::out_of_range", "builtins.KeyError"),
    "lacks the member": ("", "builtins.ValueError"),
    "has another number of elements": ("", "builtins.ValueError"),
    "has a step of zero": ("", "builtins.ValueError"),
    "shifts by less than zero": ("", "builtins.ValueError"),
    "is too great": ("", "builtins.OverflowError"),
    "may be a complex number": ("", "builtins.TypeError"),
    "has a style that is none": ("", "builtins.ValueError"),
    "lacks the argument": ("", "builtins.IndexError"),
    "is empty": ("std::bad_optional_access", "builtins.AttributeError"),
    "is None": ("", "builtins.TypeError"),
    "asks None for an attribute": ("", "builtins.AttributeError"),
    "may have no value yet": ("", "builtins.UnboundLocalError"),
    "may have no such attribute yet": ("", "builtins.AttributeError"),
    "gets other arguments than it takes": ("", "builtins.TypeError"),
    "is of another type": ("", "builtins.TypeError"),
    "may refuse what it gets": ("", "builtins.Exception"),
    "has no such attribute": ("", "builtins.AttributeError"),
    "names what nothing defines": ("", "builtins.NameError"),
    "does not hold": ("", "builtins.AssertionError"),
}
# Of transforms between frames that are not there, or not yet.
TRANSFORM_EXCEPTIONS = ("LookupException", "ConnectivityException", "ExtrapolationException")
# Each exception with the class that it extends.
EXCEPTIONS: Mapping[str, str] = {
    **dict.fromkeys(("std::out_of_range", "std::invalid_argument"), "std::logic_error"),
    **dict.fromkeys(("std::length_error", "std::domain_error"), "std::logic_error"),
    **dict.fromkeys(("std::range_error", "std::overflow_error"), "std::runtime_error"),
    **dict.fromkeys(("std::underflow_error", "std::system_error"), "std::runtime_error"),
    **dict.fromkeys(("std::regex_error",), "std::runtime_error"),
    **dict.fromkeys(("std::logic_error", "std::runtime_error"), "std::exception"),
    "std::bad_array_new_length": "std::bad_alloc",
    **dict.fromkeys(("std::bad_alloc", "std::bad_cast"), "std::exception"),
    **dict.fromkeys(("std::bad_optional_access", "std::bad_variant_access"), "std::exception"),
    **dict.fromkeys(("std::bad_function_call", "std::bad_weak_ptr"), "std::exception"),
    **dict.fromkeys(("std::bad_any_cast", "boost::bad_any_cast"), "std::bad_cast"),
    "boost::bad_lexical_cast": "std::bad_cast",
    "boost::numeric::bad_numeric_cast": "std::bad_cast",
    "std::filesystem::filesystem_error": "std::system_error",
    "nlohmann::json::exception": "nlohmann::detail::exception",
    **dict.fromkeys(("nlohmann::detail::exception", "boost::bad_get"), "std::exception"),
    **dict.fromkeys(("cv::Exception", "image_geometry::Exception"), "std::runtime_error"),
    **dict.fromkeys(("std::bad_typeid",), "std::exception"),
    "rclcpp::exceptions::ParameterNotDeclaredException": "std::runtime_error",
    "rclcpp::exceptions::ParameterAlreadyDeclaredException": "std::runtime_error",
    "rclcpp::ParameterTypeException": "std::runtime_error",
    **dict.fromkeys(("std::ios_base::failure", "pcl::PCLException"), "std::runtime_error"),
    # One of these names stands for the other.
    "tf2::TransformException": "tf::TransformException",
    **dict.fromkeys(("tf::TransformException", "YAML::Exception"), "std::runtime_error"),
    **dict.fromkeys(("cv_bridge::Exception", "fmt::format_error"), "std::runtime_error"),
    **dict.fromkeys(("boost::property_tree::ptree_error",), "std::runtime_error"),
    **dict.fromkeys(("pluginlib::PluginlibException",), "std::runtime_error"),
    "ament_index_cpp::PackageNotFoundError": "std::out_of_range",
    "Json::LogicError": "Json::Exception",
    "Json::Exception": "std::exception",
    **dict.fromkeys(("builtins.IndexError", "builtins.KeyError"), "builtins.LookupError"),
    **dict.fromkeys(("builtins.ZeroDivisionError",), "builtins.ArithmeticError"),
    **dict.fromkeys(("builtins.OverflowError",), "builtins.ArithmeticError"),
    **dict.fromkeys(("builtins.UnicodeDecodeError",), "builtins.ValueError"),
    **dict.fromkeys(("json.JSONDecodeError", "statistics.StatisticsError"), "builtins.ValueError"),
    **dict.fromkeys(("builtins.FileNotFoundError", "builtins.IOError"), "builtins.OSError"),
    **dict.fromkeys(("builtins.TimeoutError", "builtins.PermissionError"), "builtins.OSError"),
    **dict.fromkeys(("builtins.NotImplementedError",), "builtins.RuntimeError"),
    **dict.fromkeys(("builtins.LookupError", "builtins.ArithmeticError"), "builtins.Exception"),
    **dict.fromkeys(("builtins.ValueError", "builtins.OSError"), "builtins.Exception"),
    **dict.fromkeys(("builtins.RuntimeError", "builtins.StopIteration"), "builtins.Exception"),
    **dict.fromkeys(("builtins.AssertionError", "builtins.TypeError"), "builtins.Exception"),
    **dict.fromkeys(("builtins.AttributeError", "struct.error"), "builtins.Exception"),
    **dict.fromkeys(
        ("re.error", "queue.Empty", "queue.Full", "yaml.YAMLError"), "builtins.Exception"
    ),
    "numpy.linalg.LinAlgError": "builtins.ValueError",
    "rospy.ServiceException": "rospy.ROSException",
    "rospy.ROSException": "builtins.Exception",
    **{
        f"rclpy.exceptions.{name}": "rclpy.exceptions.ParameterException"
        for name in ("ParameterNotDeclaredException", "ParameterAlreadyDeclaredException")
    },
    "rclpy.exceptions.ParameterException": "builtins.Exception",
    # Each under the names that packages give it, the oldest first.
    **{f"tf.{name}": f"tf2_ros.{name}" for name in TRANSFORM_EXCEPTIONS},
    **{f"tf2_ros.{name}": f"tf2_py.{name}" for name in TRANSFORM_EXCEPTIONS},
    **{f"tf2_py.{name}": "tf2_ros.TransformException" for name in TRANSFORM_EXCEPTIONS},
    "tf2_ros.TransformException": "tf2_py.TransformException",
    "tf2_py.TransformException": "tf.Exception",
    "tf.Exception": "builtins.Exception",
    "builtins.UnboundLocalError": "builtins.NameError",
    "builtins.NameError": "builtins.Exception",
    "builtins.Exception": "builtins.BaseException",
    "builtins.SystemExit": "builtins.BaseException",
    "builtins.KeyboardInterrupt": "builtins.BaseException",
}
# Classes of objects that have the methods without a class in the rules, and no others that count.
PLAIN_CLASSES = frozenset(
    {
        *("std::vector", "std::map", "std::set", "std::string", "std::optional", "std::queue"),
        *("std::ostream", "std::function", "std::pair", "std::tuple", "std::chrono::time_point"),
        *("std::chrono::duration", "std::chrono::milliseconds", "std::chrono::seconds"),
        *("std::array", "std::bitset", "std::atomic", "std::unique_ptr", "std::shared_ptr"),
        *("list", "dict", "set", "str", "tuple", "deque", "file", "logger"),
    }
)
# Classes whose own classes give, for a value, the member that has it.
ENUMERATIONS = frozenset(
    {"enum.Enum", "enum.IntEnum", "enum.StrEnum", "enum.Flag", "enum.IntFlag", "enum.ReprEnum"}
)
NUMBERED = frozenset({"enum.IntEnum", "enum.IntFlag"})  # whose members are numbers
UNKNOWN_CLASS = "constructor of a type that is not known"  # what a template gives, perhaps
# Names of classes that do the same as another.
CLASSES: Mapping[str, str] = {
    **dict.fromkeys(("std::deque", "std::list", "std::span", "std::stack"), "std::vector"),
    **dict.fromkeys(("std::priority_queue", "std::initializer_list"), "std::vector"),
    **dict.fromkeys(("std::unordered_map", "std::multimap"), "std::map"),
    **dict.fromkeys(("std::unordered_set", "std::multiset"), "std::set"),
    **dict.fromkeys(("std::string_view", "std::basic_string"), "std::string"),
    **dict.fromkeys(("std::stringstream", "std::ostringstream", "std::istringstream"), "file"),
    **dict.fromkeys(("std::ofstream", "std::ifstream", "std::fstream"), "file"),
    **dict.fromkeys(("std::recursive_mutex", "std::shared_mutex"), "std::mutex"),
    **dict.fromkeys(("std::timed_mutex",), "std::mutex"),
    **dict.fromkeys(("std::scoped_lock", "std::lock_guard"), "std::unique_lock"),
    **dict.fromkeys(("std::condition_variable_any",), "std::condition_variable"),
    **dict.fromkeys(("std::atomic_bool", "std::atomic_int", "std::atomic_flag"), "std::atomic"),
    "std::weak_ptr": "std::shared_ptr",
    "std::shared_future": "std::future",
    "builtins.list": "list",
    "builtins.dict": "dict",
    "builtins.set": "set",
    "builtins.frozenset": "set",
    "builtins.str": "str",
    "builtins.tuple": "tuple",
    "builtins.open": "file",
    "io.StringIO": "file",
    "pathlib.Path": "path",
    "collections.deque": "deque",
    "collections.defaultdict": "dict",
    "collections.OrderedDict": "dict",
    "collections.Counter": "dict",
    "logging.getLogger": "logger",
    "logging.Logger": "logger",
    "rclpy.logging.get_logger": "logger",
    "threading.RLock": "threading.Lock",
    "queue.SimpleQueue": "queue.Queue",
    "queue.LifoQueue": "queue.Queue",
    "queue.PriorityQueue": "queue.Queue",
    "multiprocessing.Queue": "queue.Queue",
}

# Streams of C++; some of which exist from the start.
_STREAMS = frozenset({"std::ostream", "std::istream", "std::iostream", "std::ios", "std::ios_base"})
STREAM_OBJECTS = frozenset({f"std::{name}" for name in ("cout", "cerr", "clog", "cin")})
STREAM_FUNCTIONS = frozenset({"std::getline", "std::endl", "std::flush", "std::ws"})


def is_stream(name: str) -> bool:
    """Whether a class is one of streams."""
    return name in _STREAMS or CLASSES.get(name) == "file"
