"""A class of nodes in C++: its handlers, methods and constructors, as in the model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rebsync.forward.cpp_layout import call_lines, indented
from rebsync.forward.cpp_names import CppNames
from rebsync.forward.cpp_statements import CppStatements
from rebsync.forward.cpp_types import cpp_type, stored_type
from rebsync.forward.cpp_words import CppWords
from rebsync.forward.lineage import ancestors, base_of, interfaces
from rebsync.model import Annotation, Block, Parameter
from rebsync.package import Function, NodeClass, Package, Subscription
from rebsync.printing import print_line
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Piece:
    """One function: its lines in the header and in the source, and the marker above it."""

    marker: str
    declaration: tuple[str, ...]
    definition: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CppClass:
    """One class with all that its C++ needs to know of the package around it."""

    package: Package
    node: NodeClass
    type_name: str
    base_types: tuple[str, ...]
    names: CppNames
    statements: CppStatements
    above: Mapping[int, tuple[str, ...]]
    words: CppWords

    @property
    def ancestors(self) -> list[NodeClass]:
        """The reactive classes that this one descends from, nearest first."""
        return ancestors(self.package, self.node)

    @property
    def owns_mailbox(self) -> bool:
        return not self.node.interface and base_of(self.package, self.node) is None

    @property
    def owns_drive(self) -> bool:
        return self.node.moves and not any(a.moves for a in self.ancestors)

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
            self.names.function(server.server, server.parameters),
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
            for interface in interfaces(self.package, self.node)
            for s in interface.subscriptions
        )

    def forwards(self) -> tuple[Piece, ...]:
        """Inherited handlers that an interface of this class asks for as well."""
        base = base_of(self.package, self.node)
        if base is None:
            return ()
        own = {s.key for s in self.node.subscriptions}
        old = interfaces(self.package, base)
        new = [i for i in interfaces(self.package, self.node) if i not in old]
        wanted = {s.key for i in new for s in i.subscriptions}
        found = {s.key: (s, a) for a in reversed(self.ancestors) for s in a.subscriptions}
        return tuple(
            self._forward(server, owner)
            for key, (server, owner) in found.items()
            if key in wanted - own and server.body is not None
        )

    def _forward(self, server: Subscription, owner: NodeClass) -> Piece:
        name = self.names.function(server.server, server.parameters)
        names = [self.names.local(p.name) for p in server.parameters]
        owner_type = self.statements.expressions.class_types[owner.name]
        return self._function(
            "void",
            name,
            server.parameters,
            [f"{owner_type}::{name}({', '.join(names)});"],
            (f"inherited {owner.name}.{server.server}",),
            override=True,
        )

    def overloads(self) -> list[str]:
        """The functions of the base whose other overloads this class would hide."""
        own = self._signatures(self.node)
        base = base_of(self.package, self.node)
        hidden = {
            name
            for a in self.ancestors
            for name, types in self._signatures(a)
            if (name, types) not in own and any(name == n for n, _ in own)
        }
        if base is None:
            return []
        type_ = self.statements.expressions.class_types[base.name]
        return [f"  using {type_}::{name};" for name in sorted(hidden)]

    def _signatures(self, node: NodeClass) -> set[tuple[str, tuple[str, ...]]]:
        declared = [(s.server, s.parameters) for s in node.subscriptions]
        declared += [(f.name, f.parameters) for f in node.functions]
        return {
            (self.names.function(name, parameters), tuple(stored_type(p.type) for p in parameters))
            for name, parameters in declared
        }

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
            self.names.function(function.name, function.parameters),
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
        passed = [f"{cpp_type(p.type)} {self.names.local(p.name)}" for p in parameters]
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


def braced(head: list[str], lines: list[str]) -> list[str]:
    """A function of these lines."""
    if not lines:
        return [*head[:-1], f"{head[-1]} {{}}"]
    return [*head[:-1], f"{head[-1]} {{", *indented(lines), "}"]
