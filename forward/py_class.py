"""A class of nodes in Python: its handlers, methods and constructors, as in the model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rebsync.forward.lineage import ancestors, base_of
from rebsync.forward.py_layout import indented
from rebsync.forward.py_names import PyNames
from rebsync.forward.py_statements import PyStatements
from rebsync.forward.py_types import py_type, unset_value
from rebsync.model import Annotation, Block, Parameter, Type
from rebsync.package import ConstructorOf, Function, NodeClass, Package
from rebsync.printing import print_line
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class PyClass:
    """One class with all that its Python needs to know of the package around it."""

    package: Package
    node: NodeClass
    type_name: str
    base_types: tuple[str, ...]
    names: PyNames
    statements: PyStatements
    above: Mapping[int, tuple[str, ...]]

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

    @property
    def is_abstract(self) -> bool:
        """Whether a body is left to others."""
        bodies = [
            s.body for s in self.node.subscriptions if s.path.startswith(f"{self.node.name}.")
        ]
        return None in (*bodies, *(f.body for f in self.node.functions))

    # --- functions ------------------------------------------------------------------------------

    def constructs(self) -> list[list[str]]:
        """The constructors of the model: what runs at time 0."""
        return [
            self._function(
                self.construct(c),
                c.parameters,
                c.body,
                (f"constructor {self.node.name}", *annotation_markers(c.annotations)),
            )
            for c in self.node.constructors
            if c.body is not None
        ]

    def construct(self, constructor: ConstructorOf) -> str:
        """The name of a constructor, told apart from others by its class or types."""
        if len(self.node.constructors) == 1:
            return f"construct__{self.type_name}" if self.ancestors else "construct"
        types = (str(p.type).replace("[", "_").replace("]", "") for p in constructor.parameters)
        return f"construct__{'_'.join(types) or 'void'}"

    def handlers(self) -> list[list[str]]:
        """The bodies of the message servers, named and typed as in the model."""
        own = self.node.name
        return [
            self._function(
                self.names.function(s.server, s.parameters),
                s.parameters,
                s.body,
                (f"msgsrv {s.path}", *annotation_markers(s.annotations)),
            )
            for s in self.node.subscriptions
            if s.body is not None or s.path.startswith(f"{own}.")
        ]

    def functions(self) -> list[list[str]]:
        """The local methods."""
        return [self._method(f) for f in self.node.functions]

    def _method(self, function: Function) -> list[str]:
        markers = (f"method {function.path}", *annotation_markers(function.annotations))
        name = self.names.function(function.name, function.parameters)
        return self._function(name, function.parameters, function.body, markers, function.type)

    def _function(
        self,
        name: str,
        parameters: tuple[Parameter, ...],
        body: Block | None,
        markers: tuple[str, ...],
        result: Type | None = None,
    ) -> list[str]:
        remarks = self.above.get(id(body), ()) if body is not None else ()
        head = [f"#{r[2:]}" for r in remarks]
        head += [f"# rebsync: {m}" for m in markers]
        returned = py_type(result) if result is not None else "None"
        passed = ["self", *parameters_of(self.names, parameters)]
        definition = f"def {name}({', '.join(passed)}) -> {returned}:"
        if body is None:
            return [*head, "@abstractmethod", definition, *indented(["raise NotImplementedError"])]
        lines = self.statements.body(body, parameters, result)
        if returned != "None" and not self.statements.returns(body):
            lines = [line for line in lines if line != "pass"]
            assert result is not None
            lines.append(f"return {unset_value(result)}")
        if lines == ["..."]:
            return [*head, f"{definition} ..."]
        return [*head, definition, *indented(lines)]


def parameters_of(names: PyNames, parameters: tuple[Parameter, ...]) -> list[str]:
    """The parameters of a function, with the types of the model."""
    return [f"{names.local(p.name)}: {py_type(p.type)}" for p in parameters]


def annotation_markers(annotations: tuple[Annotation, ...]) -> Iterator[str]:
    """What the markers of annotations say."""
    return (f"annotation {print_line(a).strip()}" for a in annotations)
