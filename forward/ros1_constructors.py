"""The constructors of a class in ROS 1 C++, and the `main` that calls one."""

from __future__ import annotations

from rebsync.forward.cpp_class import CppClass, braced
from rebsync.forward.cpp_layout import call_lines
from rebsync.forward.cpp_types import cpp_type, cpp_value, parameter_type
from rebsync.forward.cpp_wiring import advertised, wiring
from rebsync.forward.templating import fill
from rebsync.model import Type
from rebsync.names import graph_name
from rebsync.package import ConstructorOf


def _parameters(c: CppClass, constructor: ConstructorOf) -> list[str]:
    """The node and the model's own."""
    own = [f"{parameter_type(p.type)} {c.names.argument(p.name)}" for p in constructor.parameters]
    return ["const ros::NodeHandle& node", *own]


def access(c: CppClass) -> list[str]:
    """What `main` reaches the rebec by."""
    if not c.owns_mailbox:
        return []
    polymorphic = bool(c.node.bases or c.node.inherited_from or c.node.abstract)
    destructor = [f"  virtual ~{c.type_name}() = default;"] if polymorphic else []
    return [*destructor, "", "  Mailbox& mailbox() { return mailbox_; }"]


def _wiring_parameters(queue_length: int | None = None) -> list[str]:
    """An abstract class tells its queue length here, although every heir has its own."""
    length, priority = "std::size_t queue_length", "int best_priority"
    if queue_length is not None:
        length, priority = f"{length} = {queue_length}", f"{priority} = kNoPriority"
    return ["const Inherited& inherited", "const ros::NodeHandle& node", length, priority]


def constructor_declarations(c: CppClass) -> list[str]:
    """The constructors of the C++ class, in its header."""
    lines: list[str] = []
    if c.node.executable:
        for constructor in c.node.constructors:
            parameters = _parameters(c, constructor)
            explicit = "explicit " if len(parameters) == 1 else ""
            lines += call_lines(f"{explicit}{c.type_name}", parameters, ";", "  ")
    if c.node.inherited_from or not c.node.executable:
        length = None if c.node.executable else c.node.queue_length
        lines += call_lines(c.type_name, _wiring_parameters(length), ";", "  ")
    return lines


def constructor_definitions(c: CppClass) -> list[list[str]]:
    """What they do: base and members first, then publishers and subscriptions."""
    definitions = []
    wires_itself = not c.node.inherited_from
    if c.node.executable:
        for constructor in c.node.constructors:
            definitions.append(_constructor(c, constructor, wires_itself))
    if c.node.inherited_from or not c.node.executable:
        head = call_lines(f"{c.type_name}::{c.type_name}", _wiring_parameters(), "")
        initial = _initialisers(c, ("inherited", "queue_length", "best_priority"))
        unused = ["unused(inherited);"] if c.owns_mailbox else []
        lines = [*unused, *_set_up(c), *wiring(c)]
        definitions.append(with_initialisers(head, initial, lines))
    return definitions


def _constructor(c: CppClass, constructor: ConstructorOf, wires_itself: bool) -> list[str]:
    parameters = _parameters(c, constructor)
    head = call_lines(f"{c.type_name}::{c.type_name}", parameters, "")
    best = best_priority(c)
    queue = (str(c.node.queue_length), *([best] if best else []))
    if wires_itself:
        initial = _initialisers(c, ("Inherited()", queue[0], best or "kNoPriority"))
    else:
        initial = [f"{c.type_name}(Inherited(), node, {queue[0]}, {best or 'kNoPriority'})"]
    lines = [*_set_up(c), *wiring(c)] if wires_itself else []
    state = f'advertise<{c.node.state.name}>("state", kQueueSize, true)'
    lines.append(f"state_pub_ = ros::NodeHandle(node).{state};")
    lines.append("mailbox_.onServed([this](const Served& served) { publishState(served); });")
    if constructor.body is not None:
        names = [p.split()[-1] for p in parameters[1:]]
        lines.append(f"mailbox_.construct([=] {{ construct({', '.join(names)}); }});")
    return with_initialisers(head, initial, lines)


def _initialisers(c: CppClass, values: tuple[str, str, str]) -> list[str]:
    """Base or mailbox first, then drive and sensors."""
    inherited, queue_length, best = values
    base = next(
        (t for t, b in zip(c.base_types, c.node.bases, strict=True) if not _is_interface(c, b)),
        None,
    )
    if base is not None:
        found = [f"{base}({inherited}, node, {queue_length}, {best})"]
    else:
        priority = "" if best == "kNoPriority" else f", {best}"
        found = [f"mailbox_(node, {queue_length}{priority})"]
    if c.owns_drive:
        found.append("drive_(node, mailbox_)")
    for sensor in c.node.sensors:
        found.append(f'{c.names.sensors[sensor.server]}(node, "sensor/{sensor.name}")')
    return found


def _set_up(c: CppClass) -> list[str]:
    """Publishers to known rebecs, and what the launch file and config/params.yaml set."""
    lines = []
    for known in c.node.known:
        if not known.is_value:
            lines += advertised(c, c.node.publishers_to(known))
            continue
        key = f"knownrebecs/{graph_name(known.name)}"
        lines.append(f'{c.names.members[known.name]} = node.param<std::string>("{key}", "");')
    if c.node.env:
        lines.append("const ros::NodeHandle global;")
    for env in c.node.env:
        lines += _read_env(c.names.env[env.name], env.key, env.type, cpp_value(env.value))
    return lines


def _read_env(member: str, key: str, type_: Type, value: str) -> list[str]:
    if type_.dimensions:
        return [f"{member} = {value};", f'readArray(global, "{key}", {member});']
    match type_.name:
        case "byte" | "short":
            return [f'{member} = narrow<{cpp_type(type_)}>(global.param("{key}", {value}));']
        case "float":
            return [f'{member} = static_cast<float>(global.param("{key}", {value}));']
        case _:
            return [f'{member} = global.param("{key}", {value});']


def _is_interface(c: CppClass, name: str) -> bool:
    return c.package.node_class(name).interface


def with_initialisers(head: list[str], initial: list[str], lines: list[str]) -> list[str]:
    first = f"    : {initial[0]}"
    rest = [f"      {i}" for i in initial[1:]]
    listed = [line + "," for line in (first, *rest)]
    listed[-1] = listed[-1][:-1]
    return [*head, *braced(listed, lines)]


def best_priority(c: CppClass) -> str:
    own = [c.node, *c.ancestors]
    priorities = [s.priority for n in own for s in n.subscriptions if s.priority is not None]
    return str(min(priorities)) if priorities else ""


def node_main(c: CppClass) -> str:
    """`src/<class>_node.cpp`: reads the constructor's arguments and runs one rebec."""
    chosen = [i for i in c.node.constructors if i.runs]
    constructor = (chosen or c.node.constructors)[0]
    arguments = ["node"]
    for key, parameter in zip(constructor.keys, constructor.parameters, strict=True):
        arguments.append(_private(key, parameter.type))
    construction = call_lines(f"{c.package.name}::{c.type_name} rebec", arguments, ";", "  ")
    return fill("ros1_cpp/node.cpp.j2", package=c.package.name, c=c, construction=construction)


def _private(key: str, type_: Type) -> str:
    """A private parameter as an argument of the constructor."""
    match type_.name:
        case "int":
            return f'node.param("{key}", 0)'
        case "byte" | "short":
            return f'static_cast<{cpp_type(type_)}>(node.param("{key}", 0))'
        case "boolean":
            return f'node.param("{key}", false)'
        case "float":
            return f'static_cast<float>(node.param("{key}", 0.0))'
        case "double":
            return f'node.param("{key}", 0.0)'
        case _:
            return f'node.param<std::string>("{key}", "")'
