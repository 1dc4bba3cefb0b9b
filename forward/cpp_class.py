"""A class of nodes as the pieces of its C++ header and source: declarations and definitions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rebsync.forward.cpp_layout import call_lines, indented, with_trailing_comments
from rebsync.forward.cpp_names import (
    CppNames,
    function_name,
    local_name,
    publisher_place,
    seen_functions,
)
from rebsync.forward.cpp_statements import CppStatements
from rebsync.forward.cpp_types import cpp_type, cpp_value, parameter_type
from rebsync.model import Annotation, Block, Parameter, Type
from rebsync.names import graph_name
from rebsync.package import (
    ConstructorOf,
    Field,
    Function,
    NodeClass,
    Package,
    Publisher,
    SelfSend,
    Subscription,
)
from rebsync.printing import print_line


@dataclass(frozen=True, slots=True)
class Piece:
    """One function: its lines in the header and in the source, and the marker above it."""

    marker: str
    declaration: tuple[str, ...]
    definition: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CppClass:
    """Writes the C++ of one class; `ros` gives the few words that ROS 1 and 2 spell differently."""

    package: Package
    node: NodeClass
    type_name: str
    base_types: tuple[str, ...]
    names: CppNames
    statements: CppStatements
    above: Mapping[int, tuple[str, ...]]

    # --- handlers, methods, constructor ---------------------------------------------------------

    def handlers(self) -> tuple[Piece, ...]:
        """The bodies of the message servers, named and typed as in the model."""
        return tuple(self._handler(s) for s in self.node.subscriptions)

    def _handler(self, server: Subscription) -> Piece:
        markers = [f"msgsrv {server.path}", *self._annotations(server.annotations)]
        inherited = server.inherited or self._from_interface(server)
        virtual = server.overridden and not inherited
        return self._function(
            "void",
            function_name(server.server),
            server.parameters,
            None if server.body is None else self.statements.body(server.body, server.parameters),
            tuple(markers),
            virtual=virtual,
            override=inherited,
            remarks=self._remarks_above(server.body),
        )

    def _from_interface(self, server: Subscription) -> bool:
        return any(
            s.key == server.key
            for base in self.node.bases
            for s in self.package.node_class(base).subscriptions
        )

    def functions(self) -> tuple[Piece, ...]:
        """The local methods."""
        return tuple(self._method(f) for f in self.node.functions)

    def _method(self, function: Function) -> Piece:
        lines = None
        if function.body is not None:
            lines = self.statements.body(function.body, function.parameters)
            if function.type.name != "void" and not self.statements.returns(function.body):
                lines.append("return {};")
        return self._function(
            cpp_type(function.type),
            function_name(function.name),
            function.parameters,
            lines,
            (f"method {function.path}", *self._annotations(function.annotations)),
            virtual=(function.overridden or function.body is None) and not function.overrides,
            override=function.overrides,
            remarks=self._remarks_above(function.body),
        )

    def constructs(self) -> tuple[Piece, ...]:
        """The constructors of the model: what runs at time 0."""
        return tuple(
            self._function(
                "void",
                "construct",
                c.parameters,
                self.statements.body(c.body, c.parameters),
                (f"constructor {self.node.name}", *self._annotations(c.annotations)),
                remarks=self._remarks_above(c.body),
            )
            for c in self.node.constructors
            if c.body is not None
        )

    def _function(
        self,
        result: str,
        name: str,
        parameters: tuple[Parameter, ...],
        lines: list[str] | None,
        markers: tuple[str, ...],
        virtual: bool = False,
        override: bool = False,
        remarks: tuple[str, ...] = (),
    ) -> Piece:
        # by value, as in the model, where a body may assign its parameters
        passed = [f"{cpp_type(p.type)} {local_name(p.name)}" for p in parameters]
        before = "virtual " if virtual else ""
        after = (" override" if override else "") + (" = 0" if lines is None else "")
        declaration = call_lines(f"{before}{result} {name}", passed, f"{after};", "  ")
        definition: list[str] = []
        if lines is not None:
            definition = [*remarks, *(f"// rebsync: {m}" for m in markers)]
            definition += braced(
                call_lines(f"{result} {self.type_name}::{name}", passed, ""), lines
            )
        marked = [f"  // rebsync: {m}" for m in markers] if lines is None else []
        return Piece(markers[0], (*marked, *declaration), tuple(definition))

    def _remarks_above(self, body: Block | None) -> tuple[str, ...]:
        """The model's comments between this member and the one before."""
        return () if body is None else self.above.get(id(body), ())

    def _annotations(self, annotations: tuple[Annotation, ...]) -> Iterator[str]:
        return (f"annotation {print_line(a).strip()}" for a in annotations)

    # --- messages in ----------------------------------------------------------------------------

    def own_subscriptions(self) -> tuple[Subscription, ...]:
        """The servers whose subscription this class makes; its ancestors made the others."""
        return tuple(s for s in self.node.subscriptions if not s.inherited)

    def shims(self) -> tuple[Piece, ...]:
        """What unpacks a message and puts it into the mailbox."""
        return tuple(self._shim(s) for s in self.own_subscriptions())

    def _shim(self, server: Subscription) -> Piece:
        message = server.message
        values = [unpacked(f, p) for f, p in zip(message.fields, server.parameters, strict=True)]
        name = self.names.shims[server.key]
        head = f"const {message.name}::ConstPtr& msg"
        sender = "msg->sender" if message.carries_sender else '""'
        text = f"text({', '.join(values)})" if values else '""'
        capture = "this, msg" if values else "this"
        body = f"[{capture}] {{ {function_name(server.server)}({', '.join(values)}); }}"
        arguments = [self.names.servers[server.key], "msg->timing", sender, text, body]
        return Piece(
            "",
            (f"  void {name}({head});",),
            tuple(
                braced(
                    [f"void {self.type_name}::{name}({head})"],
                    call_lines("mailbox_.receive", arguments, ";"),
                )
            ),
        )

    # --- messages out ---------------------------------------------------------------------------

    def sends(self) -> tuple[Piece, ...]:
        """The helpers that fill a message and send it."""
        return (
            *(self._send(q) for q in self.node.publishers),
            *(self._self_send(s) for s in self.node.self_sends),
        )

    def _send(self, publisher: Publisher) -> Piece:
        place = publisher_place(publisher)
        helper, member = self.names.sends[place], self.names.publishers[place]
        message = publisher.message
        passed = [f"{parameter_type(p.type)} {local_name(p.name)}" for p in publisher.parameters]
        where = member
        if publisher.known is None:
            passed.insert(0, "const std::string& to_")
            where = f"to({member}, to_)"
        lines = [f"{message.name} msg_;"]
        lines += [packed(f, p) for f, p in zip(message.fields, publisher.parameters, strict=True)]
        if message.carries_sender:
            lines.append("msg_.sender = mailbox_.self();")
        lines.append(f"mailbox_.publish({where}, msg_, when_);")
        marker = f"send {self.node.name}.{publisher.known or publisher.target}.{publisher.server}"
        return self._helper(helper, passed, lines, marker)

    def _self_send(self, send: SelfSend) -> Piece:
        passed = [f"{parameter_type(p.type)} {local_name(p.name)}" for p in send.parameters]
        names = [local_name(p.name) for p in send.parameters]
        text = f"text({', '.join(names)})" if names else '""'
        body = f"[=] {{ {function_name(send.server)}({', '.join(names)}); }}"
        arguments = [self.names.servers[send.key], "when_", text, body]
        lines = call_lines("mailbox_.post", arguments, ";")
        marker = f"send {self.node.name}.self.{send.server}"
        return self._helper(self.names.self_sends[send.key], passed, lines, marker)

    def _helper(self, name: str, passed: list[str], lines: list[str], marker: str) -> Piece:
        declared = [*passed, "const When& when_ = When()"]
        defined = [*passed, "const When& when_"]
        definition = [f"// rebsync: {marker}"]
        definition += braced(call_lines(f"void {self.type_name}::{name}", defined, ""), lines)
        return Piece(
            marker, tuple(call_lines(f"void {name}", declared, ";", "  ")), tuple(definition)
        )

    # --- members --------------------------------------------------------------------------------

    def members(self) -> list[str]:
        """State variables, known rebecs and env values, each with its marker beside it."""
        lines = [
            (f"{cpp_type(m.type)} {self.names.members[m.name]}{{}};", f"rebsync: statevar {m.path}")
            for m in self.node.members
        ]
        lines += [
            (f"std::string {self.names.members[k.name]};", f"rebsync: knownrebec {k.path}")
            for k in self.node.known
        ]
        lines += [
            (f"{cpp_type(e.type)} {self.names.env[e.name]}{{}};", f"rebsync: env {e.name}")
            for e in self.node.env
        ]
        return indented(with_trailing_comments(lines))

    def ros_members(self) -> list[str]:
        """Publishers, subscribers and sensors."""
        lines = [
            f"  Sensor<{s.type.replace('/', '::')}> {self.names.sensors[s.server]};"
            for s in self.node.sensors
        ]
        for publisher in self.node.publishers:
            kind = "ros::Publisher" if publisher.known is not None else "Publishers"
            lines.append(f"  {kind} {self.names.publishers[publisher_place(publisher)]};")
        lines += [
            f"  ros::Subscriber {self.names.subscribers[s.key]};" for s in self.own_subscriptions()
        ]
        return lines

    # --- wiring ---------------------------------------------------------------------------------

    def servers(self) -> list[str]:
        """The descriptors of the servers: name and priority."""
        return [
            f'constexpr Server {self.names.servers[s.key]}{{"{s.server}", '
            f"{'kNoPriority' if s.priority is None else s.priority}}};"
            for s in self.node.subscriptions
            if not s.inherited or s.priority is not None
        ]

    def parameters_read(self) -> list[str]:
        """Reads what the launch file and config/params.yaml set."""
        lines = []
        for known in self.node.known:
            member = self.names.members[known.name]
            key = f"knownrebecs/{graph_name(known.name)}"
            lines.append(f'{member} = node.param<std::string>("{key}", "");')
        if self.node.env:
            lines.append("const ros::NodeHandle global;")
        for env in self.node.env:
            lines += self._read_env(
                self.names.env[env.name], env.key, env.type, cpp_value(env.value)
            )
        return lines

    def _read_env(self, member: str, key: str, type_: Type, value: str) -> list[str]:
        if type_.dimensions:
            return [f"{member} = {value};", f'readArray(global, "{key}", {member});']
        match type_.name:
            case "byte" | "short":
                return [f'{member} = narrow<{cpp_type(type_)}>(global.param("{key}", {value}));']
            case "float":
                return [f'{member} = static_cast<float>(global.param("{key}", {value}));']
            case _:
                return [f'{member} = global.param("{key}", {value});']

    def advertised(self) -> list[str]:
        """Makes the publishers."""
        lines = []
        for publisher in self.node.publishers:
            member = self.names.publishers[publisher_place(publisher)]
            message = publisher.message.name
            if publisher.known is not None:
                lines.append(f'{member} = mailbox_.advertise<{message}>("{publisher.topic}");')
            else:
                target = f'"{publisher.topic}", "{publisher.key}"'
                lines.append(f"{member} = mailbox_.advertiseAll<{message}>({target});")
        return lines

    def subscribed(self) -> list[str]:
        """Makes the subscriptions."""
        lines = []
        for server in self.own_subscriptions():
            member, shim = self.names.subscribers[server.key], self.names.shims[server.key]
            arguments = f'"{server.topic}", &{self.type_name}::{shim}, this'
            function = "subscribeOnBridge" if server.on_bridge else "subscribe"
            lines.append(f"{member} = mailbox_.{function}({arguments});")
        return lines

    def state_lines(self) -> list[str]:
        """Fills the state message from the state variables, inherited ones included."""
        return [_assigned("msg.", f, self.names.members[f.source]) for f in self.node.state.fields]

    def constructor_parameters(self, constructor: ConstructorOf) -> list[str]:
        """The parameters of the class constructor: the node and the model's own."""
        own = [f"{parameter_type(p.type)} {local_name(p.name)}" for p in constructor.parameters]
        return ["const ros::NodeHandle& node", *own]

    def seen(self) -> list[tuple[str, str, str, str]]:
        """The user functions of the sensors: result, name, message type, expression."""
        found = []
        for sensor in self.node.sensors:
            for index, (draw, name) in enumerate(
                zip(sensor.draws, seen_functions(sensor), strict=True)
            ):
                type_ = sensor.type.replace("/", "::")
                read = f"msg.{draw.field}" + (" != 0" if draw.type.name == "boolean" else "")
                if not sensor.stands_in:
                    first = cpp_value(draw.alternatives[0]) if draw.alternatives else "{}"
                    read = sensor.seen if sensor.seen and index == 0 else first
                found.append((cpp_type(draw.type), name, type_, read))
        return found


def braced(head: list[str], lines: list[str]) -> list[str]:
    """A function of these lines."""
    if not lines:
        return [*head[:-1], f"{head[-1]} {{}}"]
    return [*head[:-1], f"{head[-1]} {{", *indented(lines), "}"]


def unpacked(field: Field, parameter: Parameter) -> str:
    """The field of a received message as a value of the parameter's type."""
    type_ = parameter.type
    if type_.dimensions:
        return f"unflatten<{cpp_type(type_)}>(msg->{field.name})"
    return f"msg->{field.name}" + (" != 0" if type_.name == "boolean" else "")


def packed(field: Field, parameter: Parameter) -> str:
    """The statement that stores a parameter in the field of a message."""
    return _assigned("msg_.", field, local_name(parameter.name))


def _assigned(message: str, field: Field, value: str) -> str:
    if field.type.dimensions:
        return f"flatten({value}, {message}{field.name});"
    return f"{message}{field.name} = {value};"
