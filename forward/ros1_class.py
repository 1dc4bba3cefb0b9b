"""The header, the source and the `main` of one class in ROS 1 C++."""

from __future__ import annotations

from rebsync.forward.cpp_class import CppClass, Piece, braced
from rebsync.forward.cpp_layout import call_lines
from rebsync.forward.cpp_types import cpp_type, parameter_type
from rebsync.forward.cpp_warnings import silenced
from rebsync.forward.templating import fill
from rebsync.model import Cast, Type, walk
from rebsync.package import ConstructorOf, NodeClass
from rebsync.printing import print_line


def header(c: CppClass, model_name: str) -> str:
    """`include/<package>/<class>.h`."""
    package, node = c.package.name, c.node
    bases = ", ".join(f"public {b}" for b in c.base_types)
    polymorphic = bool(node.bases or node.inherited_from or node.abstract)
    groups = [g for g in _function_groups(c) if g]
    return fill(
        "ros1_cpp/class.h.j2",
        package=package,
        c=c,
        model_name=model_name,
        guard=f"{package}_{node.file}_H".upper(),
        system_includes=_system_includes(node),
        includes=_includes(c),
        markers=[
            *(f"annotation {print_line(a).strip()}" for a in node.annotations),
            f"{'interface' if node.interface else 'reactiveclass'} {node.name}",
        ],
        bases=f" : {bases}" if bases else "",
        polymorphic=polymorphic,
        owns_mailbox=_owns_mailbox(c),
        access="protected" if node.inherited_from else "private",
        handlers=c.handlers(),
        constructor_declarations=_constructor_declarations(c),
        function_groups=groups,
        member_groups=_member_groups(c),
    )


def _function_groups(c: CppClass) -> list[list[str]]:
    state = ["  void publishState(const Served& served);"] if c.node.executable else []
    if c.node.executable and (c.node.inherited_from or _base(c) is not None):
        state = [f"  {_virtual(c)}void publishState(const Served& served){_override(c)};"]
    elif not c.node.executable and _base(c) is None and not c.node.interface:
        state = ["  virtual void publishState(const Served& served) = 0;"]
    return [
        _declared(c.constructs()),
        _declared(c.handlers()),
        _declared(c.functions()),
        _declared(c.shims()),
        _declared(c.sends()),
        state,
    ]


def _virtual(c: CppClass) -> str:
    return "" if _base(c) is not None else "virtual "


def _override(c: CppClass) -> str:
    return " override" if _base(c) is not None else ""


def _declared(pieces: tuple[Piece, ...]) -> list[str]:
    return [line for piece in pieces for line in piece.declaration]


def _member_groups(c: CppClass) -> list[list[str]]:
    runtime = ["  Mailbox mailbox_;"] if _owns_mailbox(c) else []
    if _owns_drive(c):
        runtime.append("  Drive drive_;")
    state = ["  ros::Publisher state_pub_;"] if c.node.executable else []
    return [g for g in (runtime, c.members(), [*c.ros_members(), *state]) if g]


def _base(c: CppClass) -> NodeClass | None:
    """The reactive class that this one extends."""
    bases = (c.package.node_class(b) for b in c.node.bases)
    return next((b for b in bases if not b.interface), None)


def _owns_mailbox(c: CppClass) -> bool:
    return not c.node.interface and _base(c) is None


def _owns_drive(c: CppClass) -> bool:
    return c.node.moves and not any(a.moves for a in _ancestors(c))


def _ancestors(c: CppClass) -> list[NodeClass]:
    found, base = [], _base(c)
    while base is not None:
        found.append(base)
        bases = (c.package.node_class(b) for b in base.bases)
        base = next((b for b in bases if not b.interface), None)
    return found


# --- constructors -------------------------------------------------------------------------------


def _wiring_parameters() -> list[str]:
    return [
        "const Inherited& inherited",
        "const ros::NodeHandle& node",
        "std::size_t queue_length",
        "int best_priority",
    ]


def _constructor_declarations(c: CppClass) -> list[str]:
    lines: list[str] = []
    if c.node.executable:
        for constructor in c.node.constructors:
            parameters = c.constructor_parameters(constructor)
            explicit = "explicit " if len(parameters) == 1 else ""
            lines += call_lines(f"{explicit}{c.type_name}", parameters, ";", "  ")
    if c.node.inherited_from or not c.node.executable:
        lines += call_lines(c.type_name, _wiring_parameters(), ";", "  ")
    return lines


def _constructor_definitions(c: CppClass) -> list[list[str]]:
    definitions = []
    wires_itself = not c.node.inherited_from
    if c.node.executable:
        for constructor in c.node.constructors:
            definitions.append(_constructor(c, constructor, wires_itself))
    if c.node.inherited_from or not c.node.executable:
        head = call_lines(f"{c.type_name}::{c.type_name}", _wiring_parameters(), "")
        initial = _initialisers(c, ("inherited", "queue_length", "best_priority"))
        unused = ["unused(inherited);"] if _owns_mailbox(c) else []
        definitions.append(_with_initialisers(head, initial, [*unused, *_wiring(c)]))
    return definitions


def _constructor(c: CppClass, constructor: ConstructorOf, wires_itself: bool) -> list[str]:
    parameters = c.constructor_parameters(constructor)
    head = call_lines(f"{c.type_name}::{c.type_name}", parameters, "")
    best = _best_priority(c)
    queue = (str(c.node.queue_length), *([best] if best else []))
    if wires_itself:
        initial = _initialisers(c, ("Inherited()", queue[0], best or "kNoPriority"))
    else:
        initial = [f"{c.type_name}(Inherited(), node, {queue[0]}, {best or 'kNoPriority'})"]
    lines = _wiring(c) if wires_itself else []
    state = f'advertise<{c.node.state.name}>("state", kQueueSize, true)'
    lines.append(f"state_pub_ = ros::NodeHandle(node).{state};")
    lines.append("mailbox_.onServed([this](const Served& served) { publishState(served); });")
    if constructor.body is not None:
        names = [p.split()[-1] for p in parameters[1:]]
        lines.append(f"mailbox_.construct([=] {{ construct({', '.join(names)}); }});")
    return _with_initialisers(head, initial, lines)


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
    if _owns_drive(c):
        found.append("drive_(node, mailbox_)")
    for sensor in c.node.sensors:
        found.append(f'{c.names.sensors[sensor.server]}(node, "sensor/{sensor.name}")')
    return found


def _is_interface(c: CppClass, name: str) -> bool:
    return c.package.node_class(name).interface


def _with_initialisers(head: list[str], initial: list[str], lines: list[str]) -> list[str]:
    first = f"    : {initial[0]}"
    rest = [f"      {i}" for i in initial[1:]]
    listed = [line + "," for line in (first, *rest)]
    listed[-1] = listed[-1][:-1]
    return [*head, *braced(listed, lines)]


def _wiring(c: CppClass) -> list[str]:
    return [*c.parameters_read(), *c.advertised(), *c.subscribed()]


def _best_priority(c: CppClass) -> str:
    own = [c.node, *_ancestors(c)]
    priorities = [s.priority for n in own for s in n.subscriptions if s.priority is not None]
    return str(min(priorities)) if priorities else ""


# --- source -------------------------------------------------------------------------------------


def source(c: CppClass) -> str:
    """`src/<class>.cpp`."""
    pieces = [*c.constructs(), *c.handlers(), *c.functions(), *c.shims(), *c.sends()]
    definitions = _constructor_definitions(c)
    definitions += [list(p.definition) for p in pieces if p.definition]
    if c.node.executable:
        definitions.append(_publish_state(c))
    package = c.package.name
    includes = [f"{package}/{c.node.state.name}.h"] if c.node.executable else []
    if any(s.draws for s in c.node.sensors):
        includes.append(f"{package}/{c.node.file}_sensors.h")
    return fill(
        "ros1_cpp/class.cpp.j2",
        package=package,
        c=c,
        includes=sorted(includes),
        servers=c.servers(),
        definitions=definitions,
        cast_to=_cast_to(c),
        silenced=silenced(c.statements.expressions.analysis.classes[c.node.name].declaration),
    )


def _cast_to(c: CppClass) -> list[str]:
    """The other classes that a cast of a rebec names."""
    expressions = c.statements.expressions
    declaration = expressions.analysis.classes[c.node.name].declaration
    names = {n.type.name for n in walk(declaration) if isinstance(n, Cast)}
    types = expressions.class_types
    return sorted(types[n] for n in names if n in types and n != c.node.name)


def _publish_state(c: CppClass) -> list[str]:
    lines = [
        f"{c.node.state.name} msg;",
        "msg.server = served.server;",
        "msg.arguments = served.arguments;",
        "msg.arrival = served.arrival;",
        "msg.start = served.start;",
        "msg.now = served.now;",
        *c.state_lines(),
        "state_pub_.publish(msg);",
    ]
    return braced([f"void {c.type_name}::publishState(const Served& served)"], lines)


def node_main(c: CppClass) -> str:
    """`src/<class>_node.cpp`: reads the constructor's arguments and runs one rebec."""
    constructor = c.node.constructors[0]
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


# --- includes -----------------------------------------------------------------------------------


def _system_includes(node: NodeClass) -> list[str]:
    text = " ".join(
        parameter_type(t)
        for t in (
            *(m.type for m in node.members),
            *(e.type for e in node.env),
            *(p.type for s in node.subscriptions for p in s.parameters),
            *(p.type for f in node.functions for p in f.parameters),
        )
    )
    found = {"cstddef", "cstdint", "string"}
    if "std::array" in text:
        found.add("array")
    return sorted(found)


def _includes(c: CppClass) -> list[str]:
    package = c.package.name
    names = {"mailbox"} if not c.node.interface else set()
    if _owns_drive(c):
        names.add("drive")
    if c.node.sensors:
        names.add("sensor")
    names |= {c.package.node_class(b).file for b in c.node.bases}
    names |= {s.message.name for s in c.own_subscriptions()} if not c.node.interface else set()
    names |= {p.message.name for p in c.node.publishers}
    found = {f"{package}/{n}.h" for n in names}
    found |= {sensor_include(package, s.type) for s in c.node.sensors}
    return sorted(found)


def sensor_include(package: str, type_: str) -> str:
    """The header of a sensor's message type."""
    return f"{type_}.h" if "/" in type_ else f"{package}/{type_}.h"


def sensor_header(c: CppClass) -> str:
    """`include/<package>/<class>_sensors.h`: the user's part of the sensors."""
    package = c.package.name
    types = {sensor_include(package, s.type) for s in c.node.sensors}
    return fill(
        "ros1_cpp/sensors.h.j2",
        package=package,
        c=c,
        guard=f"{package}_{c.node.file}_SENSORS_H".upper(),
        system_includes=["cstdint"],
        includes=sorted(types),
        seen=c.seen(),
    )
