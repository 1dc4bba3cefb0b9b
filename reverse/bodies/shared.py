"""What the readers of a body, and of those that stand in it, have in common."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import (
    Meaning,
    Member,
    Publishes,
    Record,
    Scope,
    Variable,
)
from rebsync.source import Span

# Words of the model that are none of C++.
WORDS = frozenset(
    {
        *("abstract", "after", "deadline", "env", "extends", "featurevar", "implements", "import"),
        *("instanceof", "interface", "knownrebecs", "main", "msgsrv", "null", "package", "byte"),
        *("reactiveclass", "record", "self", "sender", "statevars", "super", "boolean", "now"),
        *("delay", "assertion", "currentMessageArrival", "currentMessageDeadline", "String"),
        *("currentMessageWaitingTime", "Timer", "ArrayList", "ReactiveClass"),
    }
)


@dataclass(slots=True)
class Shared:
    """What the readers of a body share with those of the bodies that stand in it.

    `demoted` are locals, or fields of local messages, whose values the model cannot know;
    `names` are the names of the model that all locals got, `kept` those that no other may have,
    `made` those of locals that the code does not have; `running` are the functions that are read,
    each at the place of its call, which is so many levels of code deep: `depth`.
    `again` says that locals were demoted since the body began: what is read counts for nothing,
    but shows which others are.
    `wide` are the bits of locals that hold more than an `int`, by their names in the model,
    `subscripts` the lengths of arrays with an index that nobody tests, by the places of elements.
    """

    demoted: set[str] = field(default_factory=set)
    names: set[str] = field(default_factory=set)
    kept: set[str] = field(default_factory=set)
    made: set[str] = field(default_factory=set)
    wide: dict[str, int] = field(default_factory=dict)
    subscripts: dict[Span, int] = field(default_factory=dict)
    running: list[tuple[int, str]] = field(default_factory=list)
    depth: int = 0
    # The names of the model that the members of the class have, with the members.
    of_members: tuple[Mapping[str, Member], frozenset[str]] | None = None
    again: bool = False

    def taken(self, scope: Scope) -> set[str]:
        """The names of the model that mean something at a place."""
        if self.of_members is None or self.of_members[0] is not scope.members:
            self.of_members = scope.members, frozenset(names_of(scope.members.values()))
        return {*self.of_members[1], *names_of(scope.locals.values())}

    def demote(self, names: Iterable[str]) -> None:
        """Has the body read again without these locals."""
        self.demoted.update(names)
        self.again = True

    def add(self, variable: Variable) -> None:
        """Keeps in mind what a local can hold; of two of a name the one without a sign."""
        if variable.wide:
            known = self.wide.get(variable.name, variable.wide)
            self.wide[variable.name] = known if known == variable.wide else 32

    def clear(self) -> None:
        """Forgets the locals: the body is read again."""
        for names in (self.names, self.kept, self.made, self.wide, self.subscripts):
            names.clear()
        self.again = False


def names_of(meanings: Iterable[Meaning]) -> Iterator[str]:
    """The names of the model that come with what names of the code stand for."""
    for meaning in meanings:
        match meaning:
            case Variable(name) | m.Name(name):
                yield name
            case Record(fields, there=there):
                yield from (v.name for v in fields.values())
                yield there
            case Publishes(targets):
                yield from (t.known for t in targets if t.known is not None)
