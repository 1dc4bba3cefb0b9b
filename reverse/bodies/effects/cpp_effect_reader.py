"""The interface between the parts that look for effects of C++, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.effects import cpp_roots
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import Meaning, Scope
from rebsync.reverse.syntax.cpp_tree import Cpp


@dataclass(slots=True)
class EffectReader(ABC):
    """Looks through pieces of one body; that its `own` locals change is only noted, in `written`,
    with `everything` that any variable does. `inner` are the names that the piece declares."""

    cpp: Cpp
    scope: Scope
    own: frozenset[str] = frozenset()
    written: set[str] = field(default_factory=set)
    everything: bool = False
    returning: bool = False
    inner: set[str] = field(default_factory=set)

    def touches(self, node: Node, why: str, hint: str = "") -> Touches:
        """What to raise where a place touches what the model has."""
        touches = Touches(self.cpp.span(node), why, hint)
        touches.texts = cpp_roots.texts_in(node, self.root_of(node)[1])
        if not self.inner:
            touches.at = node.start_byte, node.end_byte
        return touches

    def root_of(self, node: Node) -> tuple[str, Meaning | None]:
        """The variable that an expression is part of, with what it stands for."""
        return cpp_roots.root(self.scope, self.inner, node)

    def is_noted(self, name: str) -> bool:
        """Whether that a variable changes is only noted."""
        return self.everything or (name in self.own and name in self.scope.locals)

    def changes(self, node: Node, name: str, why: str, path: str = "") -> None:
        """Notes that a local of the body changes; what else the model has may not."""
        if not self.is_noted(name):
            raise self.touches(node, why)
        self.written.add(f"{name}.{path}" if path else name)

    @abstractmethod
    def check(self, node: Node) -> None:
        """Raises `Touches` where a piece of code may touch what the model has."""

    @abstractmethod
    def arguments(self, arguments: Sequence[Node]) -> None:
        """Arguments of a function that is not known: it may keep or change what it gets."""

    @abstractmethod
    def anew(
        self, cpp: Cpp, scope: Scope, inner: Collection[str], returning: bool = False
    ) -> EffectReader:
        """For another body, of which `inner` are the names that it declares."""
