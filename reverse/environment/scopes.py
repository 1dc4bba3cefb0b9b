"""Which variable a name is in a body: a local of it, or one of its class."""

from __future__ import annotations

from typing import TypeAlias

from rebsync import model as m
from rebsync.records import dataclass

Variable: TypeAlias = tuple[str, str]  # its class, or a body as `Class.server`, and its name


@dataclass(frozen=True, slots=True)
class Scope:
    """The names in one body of a class; `body` is empty outside of bodies."""

    owner: str
    body: str = ""
    locals: frozenset[str] = frozenset()

    @classmethod
    def of(cls, owner: m.ReactiveClass, member: m.ClassMember) -> Scope:
        """That of a constructor, server or method: locals of one name are taken together.

        A local with the name of a variable of the class is taken for that, as both may be meant.
        """
        if not isinstance(member, m.Constructor | m.MessageServer | m.Method):
            return cls(owner.name)
        names = {parameter.name for parameter in member.parameters}
        names |= _declared(member.body)
        of_class = _declared(*(x for x in owner.members if isinstance(x, m.StateVars)))
        return cls(owner.name, member.name, frozenset(names - of_class))

    def variable(self, name: str) -> Variable:
        """The variable that a name is here."""
        return (f"{self.owner}.{self.body}", name) if name in self.locals else (self.owner, name)


def _declared(*parts: m.Node | None) -> set[str]:
    nodes = (node for part in parts if part is not None for node in m.walk(part))
    return {node.name for node in nodes if isinstance(node, m.Declarator)}
