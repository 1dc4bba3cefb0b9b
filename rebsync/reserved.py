"""Names that generated code takes for itself: what a model calls something else must give way to.

Writers carry the model's names past these (`rebsync.names.carry`), readers carry them back.
"""

from __future__ import annotations

from collections.abc import Collection

from rebsync.names import CPP_KEYWORDS, PYTHON_KEYWORDS, carry, uncarry

RUNTIME_CLASSES = frozenset(
    {
        *("Actions", "Announcement", "Beginning", "Clients", "Drive", "Inherited", "Mailbox"),
        *("Pose", "Publishers", "Rebec", "RebecNode", "Recipient", "Sensor", "Served", "Server"),
        *("Services", "Snapshot", "Startup"),
        *("Stopped", "Timing", "Violation", "Watchdog", "When"),
    }
)
# What the code of a class names in its namespace.
RUNTIME_TYPES = RUNTIME_CLASSES | {
    *("boost", "detail", "diagnostic_msgs", "geometry_msgs", "ros", "std", "std_msgs"),
}
_FREE_FUNCTIONS = frozenset(
    {
        *("after", "as", "deadline", "declareArray", "described", "divide", "divideBy", "flatten"),
        *("narrow", "readArray"),
        *("remainder", "remainderBy", "text", "to", "unflatten", "unused", "widen"),
    }
)
NO_CLASSES = (
    CPP_KEYWORDS
    | RUNTIME_TYPES
    | _FREE_FUNCTIONS
    | {"ActionServer", "action", "actionlib", "kNull", "lifecycle", "msg", "nodes"}
    | {"rcl_interfaces", "rclcpp", "rclcpp_action", "reportLine", "srv"}
)
RUNTIME_TOPICS = frozenset({"cmd_vel", "state"})
SENDER_FIELD = "sender"
RUNTIME_FIELDS = ("timing", SENDER_FIELD)
# The annotations that offer a message server to clients from outside.
OFFERS = frozenset({"Action", "Service"})
# That of a message server that gets messages from outside of the model, which is then open.
OPEN = "Open"
# That of one of whose messages from other rebecs no more wait than so many: the oldest are lost.
KEEP_LAST = "KeepLast"
# What the response of a service has beside the fields of the reply.
RESPONSE_FIELD = "answered"
STATE_FIELDS = ("server", "arguments", "arrival", "start", "now")
RUNTIME_MEMBERS = frozenset({"mailbox", "drive", "node", "state", "state_pub"})
RUNTIME_CONSTANTS = frozenset(
    {
        *("kAligned", "kFarAway", "kNever", "kNoPriority", "kNull", "kPatience", "kPause"),
        *("kPeriod", "kQueueSize", "kRounded", "kSilence", "kSoon"),
    }
)
RUNTIME_FUNCTIONS = _FREE_FUNCTIONS | {
    *("choose", "construct", "create_publisher", "declare_parameter", "globalPriority"),
    *("mailbox", "priority", "publishState"),
    *("shiftLeft", "shiftLeftBy", "shiftRight", "shiftRightBy"),
}
# What no local variable, parameter or function of a class may be called.
RESERVED = CPP_KEYWORDS | RUNTIME_FUNCTIONS | RUNTIME_CONSTANTS | RUNTIME_TYPES
# What the constructor of a class has beside the parameters of the model.
OF_CONSTRUCTOR = frozenset({"global", "node", "options"})
# What a known rebec's topics may not be called after.
OWN_TOPICS = frozenset({"port", "sensor"})
# Entries of the parameter server that no env variable may be called after.
RESERVED_GLOBALS = frozenset(
    {
        *("drive", "mailbox", "rosdistro", "roslaunch", "rosversion", "run_id", "startup"),
        "use_sim_time",
    }
)


def carry_local(name: str, reserved: Collection[str], functions: Collection[str]) -> str:
    """A local variable or parameter: the model's own name where it hides nothing."""
    carried = stem = carry(name, reserved)
    while stem.endswith("_v"):
        stem = stem[:-2]
    return f"{carried}_v" if f"{stem}_v" in functions else carried


def uncarry_local(carried: str, reserved: Collection[str], functions: Collection[str]) -> str:
    """The model's name behind one that `carry_local` made, or that somebody chose."""
    name = uncarry(carried, reserved)
    if carry_local(name, reserved, functions) != carried and carried.endswith("_v"):
        shorter = uncarry(carried[:-2], reserved)
        if carry_local(shorter, reserved, functions) == carried:
            return shorter
    return name


# The headers of generated packages that are the same for every model.
RUNTIME_HEADERS = (
    *("actions", "clients", "drive", "lifecycle", "mailbox", "sensor", "services", "startup"),
    *("values", "watchdog"),
)

# The files of a monitor, which compares a run of the system with the model.
MONITOR_FILES = ("monitor_machine", "monitor_model", "monitor_node", "monitor_run")

# --- Python -------------------------------------------------------------------------------------

# What the module of a class names, beside its messages and classes.
PYTHON_GLOBALS = frozenset(
    {
        *("AT_ONCE", "Any", "Array", "Byte", "Drive", "Float", "Literal", "Mailbox", "NULL"),
        *("NO_PRIORITY", "Publishers", "QUEUE_SIZE", "Rebec", "Sensor", "Served", "Server"),
        *("Short", "TYPE_CHECKING", "Timing", "When", "array", "before", "boolean", "copied"),
        *("divide", "flatten", "float32", "float64", "global_priority", "int16", "int32", "int8"),
        *("modulus", "power", "priority", "put", "put_item", "quotient", "read_array", "rclpy"),
        *("remainder", "rospy", "rounds", "shift_left", "shift_right", "square_root", "switch"),
        *("text", "to", "to_boolean", "to_byte", "to_double", "to_float", "to_int", "to_rebec"),
        *("to_short", "unflatten", "sensors"),
    }
)
_PYTHON_BUILTINS = frozenset({"bool", "float", "int", "lambda", "property", "range", "super"})
# What no local variable, parameter, handler or method may be called.
PYTHON_RESERVED = (
    PYTHON_KEYWORDS
    | PYTHON_GLOBALS
    | _PYTHON_BUILTINS
    | {"_drive", "_mailbox", "_publish_state", "_state_pub", "_wire"}
    | {"ABC", "abstractmethod", "block", "construct", "mailbox", "msg", "node", "self"}
    | {"KEPT", "Node", "declare_array", "declared", "when"}
)
# What a node of rclpy has, Humble to rolling, that no function of a class may hide.
_NODE_FUNCTIONS = frozenset(
    {
        *("PARAM_REL_TOL", "add_on_set_parameters_callback", "add_post_set_parameters_callback"),
        *("add_pre_set_parameters_callback", "add_waitable", "clients", "context"),
        *("count_clients", "count_publishers", "count_services", "count_subscribers"),
        *("create_client", "create_guard_condition", "create_publisher", "create_rate"),
        *("create_service", "create_subscription", "create_timer", "declare_parameter"),
        *("declare_parameters", "default_callback_group", "describe_parameter"),
        *("describe_parameters", "destroy_client", "destroy_guard_condition", "destroy_node"),
        *("destroy_publisher", "destroy_rate", "destroy_service", "destroy_subscription"),
        *("destroy_timer", "executor", "get_client_names_and_types_by_node", "get_clock"),
        *("get_fully_qualified_name", "get_fully_qualified_node_names", "get_logger", "get_name"),
        *("get_namespace", "get_node_names", "get_node_names_and_namespaces"),
        *("get_node_names_and_namespaces_with_enclaves", "get_parameter", "get_parameter_or"),
        *("get_parameter_type", "get_parameter_types", "get_parameters"),
        *("get_parameters_by_prefix", "get_publisher_names_and_types_by_node"),
        *("get_publishers_info_by_topic", "get_service_names_and_types"),
        *("get_service_names_and_types_by_node", "get_subscriber_names_and_types_by_node"),
        *("get_subscriptions_info_by_topic", "get_topic_names_and_types", "guards", "handle"),
        *("has_parameter", "list_parameters", "publishers", "remove_on_set_parameters_callback"),
        *("remove_post_set_parameters_callback", "remove_pre_set_parameters_callback"),
        *("remove_waitable", "resolve_service_name", "resolve_topic_name", "services"),
        *("set_descriptor", "set_parameters", "set_parameters_atomically", "subscriptions"),
        *("timers", "undeclare_parameter", "wait_for_node", "waitables"),
    }
)
# The same of its own members, without their first underscore.
_NODE_MEMBERS = frozenset(
    {
        *("allow_undeclared_parameters", "apply_descriptor", "apply_descriptor_and_set"),
        *("apply_descriptors", "apply_floating_point_range", "apply_integer_range"),
        *("call_post_set_parameters_callback", "call_pre_set_parameters_callback"),
        *("check_undeclared_parameters", "clients", "clock", "context"),
        *("count_clients_or_servers", "count_publishers_or_subscribers"),
        *("declare_parameter_common", "default_callback_group", "descriptors"),
        *("get_info_by_topic", "guards", "logger", "logger_service"),
        *("on_set_parameters_callbacks", "parameter_event_publisher", "parameter_overrides"),
        *("parameter_service", "parameters", "parameters_callbacks"),
        *("post_set_parameters_callbacks", "pre_set_parameters_callbacks", "publishers"),
        *("rate_group", "services", "set_parameters", "set_parameters_atomically"),
        *("set_parameters_atomically_common", "subscriptions", "time_source", "timers"),
        *("type_description_service", "validate_qos_or_depth_parameter"),
        *("validate_topic_or_service_name", "wake_executor"),
    }
)
# What no handler or method may be called.
PYTHON_FUNCTIONS = PYTHON_RESERVED | _NODE_FUNCTIONS
NO_PYTHON_CLASSES = NO_CLASSES | PYTHON_RESERVED | {"stoppable"}
PYTHON_MEMBERS = _NODE_MEMBERS | {
    *("drive", "mailbox", "node", "publish_state", "state_pub", "wire"),
}
