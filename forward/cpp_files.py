"""The header and the source of one class in C++."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.forward.cpp_class import CppClass, Piece, braced
from rebsync.forward.cpp_messages import own_subscriptions, sends, server_constants, shims
from rebsync.forward.cpp_types import class_type, is_text, parameter_type
from rebsync.forward.cpp_warnings import silenced
from rebsync.forward.cpp_wiring import members, ros_members, seen_functions, state_lines
from rebsync.forward.lineage import base_of, shared_interfaces
from rebsync.forward.sends import bodies
from rebsync.forward.templating import fill
from rebsync.model import Cast, Declaration, Interface, Parameter, walk
from rebsync.package import NodeClass
from rebsync.printing import print_line


def header(
    c: CppClass,
    model_name: str,
    constructors: list[str],
    access: list[str],
    root: str = "",
    closing: Sequence[str] = (),
) -> str:
    """`include/<package>/<class>.h`; `access` is what ROS asks of the class besides.

    `root` is the class that those without a base descend from; the `closing` lines stand behind
    the class.
    """
    package, node = c.package.name, c.node
    shared = shared_interfaces(c.package)
    bases = [
        f"public {'virtual ' if name in shared else ''}{type_}"
        for name, type_ in zip(node.bases, c.base_types, strict=True)
    ]
    if root and c.owns_mailbox:
        bases.insert(0, f"public {root}")
    groups = [g for g in _function_groups(c) if g]
    return fill(
        "cpp/class.h.j2",
        package=package,
        c=c,
        model_name=model_name,
        guard=c.words.guard(package, node.file),
        system_includes=_system_includes(node),
        includes=_includes(c),
        markers=[
            *(f"annotation {print_line(a).strip()}" for a in node.annotations),
            f"{'interface' if node.interface else 'reactiveclass'} {node.name}",
        ],
        rebecs=_rebec_types(c),
        bases=f" : {', '.join(bases)}" if bases else "",
        access_lines=access,
        access="protected" if node.inherited_from else "private",
        handlers=c.handlers(),
        constructor_declarations=constructors,
        function_groups=groups,
        member_groups=_member_groups(c),
        closing=closing,
    )


def _function_groups(c: CppClass) -> list[list[str]]:
    state = ["  void publishState(const Served& served);"] if c.node.executable else []
    if c.node.executable and (c.node.inherited_from or base_of(c.package, c.node) is not None):
        state = [f"  {_virtual(c)}void publishState(const Served& served){_override(c)};"]
    elif not c.node.executable and base_of(c.package, c.node) is None and not c.node.interface:
        state = ["  virtual void publishState(const Served& served) = 0;"]
    return [
        c.overloads(),
        _declared(c.constructs()),
        _declared((*c.handlers(), *c.forwards())),
        _declared(c.functions()),
        _declared(shims(c)),
        _declared(sends(c)),
        state,
    ]


def _virtual(c: CppClass) -> str:
    return "" if base_of(c.package, c.node) is not None else "virtual "


def _override(c: CppClass) -> str:
    return " override" if base_of(c.package, c.node) is not None else ""


def _declared(pieces: tuple[Piece, ...]) -> list[str]:
    return [line for piece in pieces for line in piece.declaration]


def _member_groups(c: CppClass) -> list[list[str]]:
    runtime = ["  Mailbox mailbox_;"] if c.owns_mailbox else []
    if c.owns_drive:
        runtime.append("  Drive drive_;")
    state = [f"  {c.words.publisher(c.node.state.name)} state_pub_;"] if c.node.executable else []
    return [g for g in (runtime, members(c), [*ros_members(c), *state]) if g]


# --- source -------------------------------------------------------------------------------------


def source(c: CppClass, constructors: list[list[str]], closing: Sequence[str] = ()) -> str:
    """`src/<class>.cpp`; the `closing` lines stand behind its namespace."""
    pieces = [*c.constructs(), *c.handlers(), *c.forwards(), *c.functions()]
    pieces += [*shims(c), *sends(c)]
    definitions = [*constructors]
    definitions += [list(p.definition) for p in pieces if p.definition]
    if c.node.executable:
        definitions.append(_publish_state(c))
    package = c.package.name
    includes = []
    if c.node.executable and not c.words.TYPED_PUBLISHERS:
        includes.append(c.words.message_header(package, c.node.state.name))
    if any(s.draws for s in c.node.sensors):
        includes.append(f"{package}/{c.node.file}_sensors.{c.words.HEADER}")
    return fill(
        "cpp/class.cpp.j2",
        package=package,
        c=c,
        includes=sorted(includes),
        servers=server_constants(c),
        definitions=definitions,
        declared=_declared_types(c),
        closing=closing,
        silenced=silenced(c.statements.expressions.analysis.classes[c.node.name].declaration),
    )


def _rebec_types(c: CppClass) -> list[str]:
    """The other classes whose rebecs the header names."""
    declaration = c.statements.expressions.analysis.classes[c.node.name].declaration
    types = [n.type for n in walk(declaration) if isinstance(n, Parameter)]
    types += [p.type for q in c.node.publishers for p in q.parameters]
    types += [p.type for s in c.node.self_sends for p in s.parameters]
    types += [s.type for s in c.node.members]
    names = {t.name for t in types if is_text(t)} | {k.type for k in c.node.values_known}
    return sorted(class_type(n) for n in names - {c.node.name})


def _declared_types(c: CppClass) -> list[str]:
    """The other classes that only the source names, as those of locals or of casts."""
    declaration = c.statements.expressions.analysis.classes[c.node.name].declaration
    own = [] if isinstance(declaration, Interface) else bodies(declaration)
    types = [n.type for body in own for n in walk(body) if isinstance(n, Cast | Declaration)]
    names = {class_type(t.name) for t in types if is_text(t)} - {class_type(c.node.name)}
    return sorted(names - set(_rebec_types(c)))


def _publish_state(c: CppClass) -> list[str]:
    lines = [
        f"{c.words.message(c.node.state.name)} msg;",
        "msg.server = served.server;",
        "msg.arguments = served.arguments;",
        "msg.arrival = served.arrival;",
        "msg.start = served.start;",
        "msg.now = served.now;",
        *state_lines(c),
        f"{c.words.published('state_pub_')}(msg);",
    ]
    return braced([f"void {c.type_name}::publishState(const Served& served)"], lines)


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
    if c.owns_drive:
        names.add("drive")
    if c.node.sensors:
        names.add("sensor")
    names |= {c.package.node_class(b).file for b in c.node.bases}
    found = {f"{package}/{n}.{c.words.HEADER}" for n in names}
    types = {s.type for s in c.node.sensors} | {p.message.name for p in c.node.publishers}
    if not c.node.interface:
        types |= {s.message.name for s in own_subscriptions(c)}
    if c.node.executable and c.words.TYPED_PUBLISHERS:
        types.add(c.node.state.name)
    found |= {c.words.message_header(package, t) for t in types}
    return sorted(found)


def sensor_header(c: CppClass) -> str:
    """`include/<package>/<class>_sensors.h`: the user's part of the sensors."""
    package = c.package.name
    types = {c.words.message_header(package, s.type) for s in c.node.sensors}
    return fill(
        "cpp/sensors.h.j2",
        package=package,
        c=c,
        guard=c.words.guard(package, f"{c.node.file}_sensors"),
        system_includes=["cstdint"],
        includes=sorted(types),
        seen=seen_functions(c),
    )
