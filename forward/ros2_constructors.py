"""The constructors of a class in ROS 2 C++: what a component container or `main` calls."""

from __future__ import annotations

from rebsync.forward.cpp_class import CppClass
from rebsync.forward.cpp_layout import call_lines, statement_lines
from rebsync.forward.cpp_types import cpp_type, cpp_value
from rebsync.forward.cpp_wiring import advertised, wiring
from rebsync.forward.lineage import base_of
from rebsync.forward.ros1_constructors import best_priority, with_initialisers
from rebsync.forward.templating import fill
from rebsync.model import Type
from rebsync.names import graph_name
from rebsync.package import ConstructorOf, Value

_OPTIONS = "const {}::NodeOptions& options"
_PARAMETERS = {
    "byte": ("int", "0"),
    "short": ("int", "0"),
    "int": ("int", "0"),
    "boolean": ("bool", "false"),
    "float": ("double", "0.0"),
    "double": ("double", "0.0"),
}
_CASTS = {
    "byte": "narrow<int8_t>",
    "short": "narrow<int16_t>",
    "float": "static_cast<float>",
}


def root(c: CppClass) -> str:
    """What the classes of nodes descend from: that with a life cycle is made from outside."""
    return "lifecycle::RebecNode" if c.package.settings.lifecycle else "rclcpp::Node"


def _options(c: CppClass) -> str:
    return _OPTIONS.format(root(c).partition("::")[0])


def constructor_declarations(c: CppClass) -> list[str]:
    """The constructors of the C++ class, in its header."""
    lines = [f"  explicit {c.type_name}({_options(c)});"] if c.node.executable else []
    if c.node.inherited_from or not c.node.executable:
        length = None if c.node.executable else c.node.queue_length
        lines += call_lines(c.type_name, _wiring_parameters(c, length), ";", "  ")
    return lines


def access(c: CppClass) -> list[str]:
    """The destructor, which stops the serving thread while the members that it uses are there."""
    return [f"  ~{c.type_name}() override {{ mailbox_.stop(); }}"] if c.node.executable else []


def _wiring_parameters(c: CppClass, queue_length: int | None = None) -> list[str]:
    """An abstract class tells its queue length here, although every heir has its own."""
    length, priority = "std::size_t queue_length", "int best_priority"
    if queue_length is not None:
        length, priority = f"{length} = {queue_length}", f"{priority} = kNoPriority"
    return ["const Inherited& inherited", _options(c), length, priority]


def constructor_definitions(c: CppClass) -> list[list[str]]:
    """What they do: node, base and members first, then parameters, publishers, subscriptions."""
    definitions = []
    wires_itself = not c.node.inherited_from
    if c.node.executable:
        definitions.append(_constructor(c, wires_itself))
    if c.node.inherited_from or not c.node.executable:
        head = call_lines(f"{c.type_name}::{c.type_name}", _wiring_parameters(c), "")
        initial = _initialisers(c, "inherited", "queue_length", "best_priority")
        definitions.append(with_initialisers(head, initial, [*_set_up(c), *wiring(c)]))
    return definitions


def _constructor(c: CppClass, wires_itself: bool) -> list[str]:
    """The public one: it constructs the rebec and starts to serve."""
    head = [f"{c.type_name}::{c.type_name}({_options(c)})"]
    own, best = f'Inherited{{"{c.node.file}"}}', best_priority(c) or "kNoPriority"
    length = str(c.node.queue_length)
    if wires_itself:
        initial = _initialisers(c, own, length, best)
    else:
        initial = [f"{c.type_name}({own}, options, {length}, {best})"]
    lines = [*_set_up(c), *wiring(c)] if wires_itself else []
    kept = "rclcpp::QoS(kQueueSize).transient_local()"
    state = f"create_publisher<{c.words.message(c.node.state.name)}>"
    lines += statement_lines(f"state_pub_ = {state}", ['"~/state"', kept], ";")
    lines.append("mailbox_.onServed([this](const Served& served) { publishState(served); });")
    lines += _constructed(c)
    lines.append("mailbox_.start();")
    return with_initialisers(head, initial, lines)


def _initialisers(c: CppClass, inherited: str, queue_length: str, best: str) -> list[str]:
    """Base or node and mailbox first, then drive and sensors."""
    base = base_of(c.package, c.node)
    if base is not None:
        type_ = c.statements.expressions.class_types[base.name]
        found = [f"{type_}({inherited}, options, {queue_length}, {best})"]
    else:
        name = "inherited.name" if inherited == "inherited" else f'"{c.node.file}"'
        priority = "" if best == "kNoPriority" else f", {best}"
        found = [f"{root(c)}({name}, options)", f"mailbox_(*this, {queue_length}{priority})"]
    if c.owns_drive:
        found.append("drive_(*this, mailbox_)")
    for sensor in c.node.sensors:
        found.append(f'{c.names.sensors[sensor.server]}(*this, "sensor/{sensor.name}")')
    return found


# --- parameters ---------------------------------------------------------------------------------


def running(c: CppClass) -> ConstructorOf:
    """The constructor that `main` uses, or the first one."""
    chosen = [i for i in c.node.constructors if i.runs]
    return (chosen or c.node.constructors)[0]


def _constructed(c: CppClass) -> list[str]:
    """Declares the arguments of the model's constructor and calls it."""
    constructor = running(c)
    if constructor.body is None:
        return []
    lines, names = [], []
    for key, parameter in zip(constructor.keys, constructor.parameters, strict=True):
        names.append(c.names.argument(parameter.name))
        target = f"const {cpp_type(parameter.type)} {names[-1]}"
        lines += _declared(target, key, parameter.type, None, "argument of the constructor")
    call = f"construct({', '.join(names)});"
    return [*lines, f"mailbox_.construct([=] {{ {call} }});"]


def _set_up(c: CppClass) -> list[str]:
    """Publishers to known rebecs, and what the launch file and config/params.yaml set."""
    lines = []
    for known in c.node.known:
        if not known.is_value:
            lines += advertised(c, c.node.publishers_to(known))
            continue
        key, type_ = f"knownrebecs.{graph_name(known.name)}", Type(known.type)
        lines += _declared(c.names.members[known.name], key, type_, None, "known rebec")
    for env in c.node.env:
        member = c.names.env[env.name]
        lines += _declared(member, f"env.{env.key}", env.type, env.value, "constant of the model")
    return lines


def _declared(
    target: str, key: str, type_: Type, value: Value | None, description: str
) -> list[str]:
    """The statement that declares a parameter of the node and stores its value."""
    described = f'described("{description}")'
    if type_.dimensions:
        whole = (
            f"{cpp_type(type_)}{cpp_value(value)}" if value is not None else cpp_type(type_) + "{}"
        )
        return statement_lines(
            f"{target} = declareArray", ["*this", f'"{key}"', whole, described], ";"
        )
    kind, nothing = _PARAMETERS.get(type_.name, ("std::string", '""'))
    given = nothing if value is None else cpp_value(value)
    cast = _CASTS.get(type_.name, "")
    return statement_lines(
        f"{target} = {cast}{'(' if cast else ''}declare_parameter<{kind}>",
        [f'"{key}"', given, described],
        ");" if cast else ";",
    )


def node_main(c: CppClass) -> str:
    """`src/<class>_node.cpp`: runs one rebec in a process of its own."""
    lifecycle = c.package.settings.lifecycle
    return fill("ros2_cpp/node.cpp.j2", package=c.package.name, c=c, lifecycle=lifecycle)


def component(c: CppClass) -> str:
    """The class of a component: with a life cycle that of the node, which makes the rebec."""
    space = "nodes::" if c.package.settings.lifecycle else ""
    return f"{c.package.name}::{space}{c.type_name}"


def managed(c: CppClass) -> list[str]:
    """The class of the node with a life cycle, behind that of the rebec in its header."""
    if not c.node.executable or not c.package.settings.lifecycle:
        return []
    name = f"k{c.type_name}"
    return [
        "",
        "namespace nodes {",
        "",
        f'inline constexpr char {name}[] = "{c.node.file}";',
        f"using {c.type_name} = lifecycle::Managed<::{c.package.name}::{c.type_name}, {name}>;",
        "",
        "}  // namespace nodes",
    ]


def registration(c: CppClass) -> list[str]:
    """What makes the class a component."""
    if not c.node.executable:
        return []
    name = component(c)
    macro = f"RCLCPP_COMPONENTS_REGISTER_NODE({name})"
    return ["", "#include <rclcpp_components/register_node_macro.hpp>", "", macro]
