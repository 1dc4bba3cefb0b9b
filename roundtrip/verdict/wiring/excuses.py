"""Why facts of the wiring may be otherwise than when the code was generated."""

from __future__ import annotations

import re
from itertools import chain

from rebsync.records import dataclass
from rebsync.reverse.scaffold.fact import (
    CLOCK,
    CONSTANT,
    HANDED,
    NOT_GIVEN,
    PLAYED,
    PROGRAM,
    PYTHON_SETTING,
    SPACE,
    TOLD,
    TOLD_TYPE,
    TYPE,
    UNKNOWN,
    Fact,
    Facts,
)
from rebsync.reverse.unknowns import Open
from rebsync.roundtrip.diff.difference import (
    Added,
    Aspect,
    Changed,
    Comparison,
    Difference,
    Moved,
    Removed,
    Renamed,
)
from rebsync.roundtrip.verdict.wiring.defaults import is_always_given
from rebsync.roundtrip.verdict.wiring.fields import is_renamed, is_told_of
from rebsync.roundtrip.verdict.wiring.names import (
    TOPICS,
    JoinedTopics,
    is_about,
    is_of_runtime,
    leads_in,
)
from rebsync.roundtrip.verdict.wiring.others import is_of_another_tool, is_of_others, reaches_in
from rebsync.roundtrip.verdict.wiring.runtime_settings import is_of_all_rebecs, waits_longer

_JOINING = frozenset(
    {
        *(Aspect.TYPE, Aspect.PARAMETERS, Aspect.BINDING, Aspect.EXTENDS, Aspect.IMPLEMENTS),
        *(Aspect.ABSTRACT, Aspect.ANNOTATION),
    }
)
# What was not there when the code was generated makes a difference too.
_UNWANTED = frozenset(
    {
        *("setting", "compiler option", "step of the build", "command"),
        *("environment", "launch file", UNKNOWN, "parameters", PYTHON_SETTING),
    }
)
_ALONE = r"(?<![\w.]){}\b(?!\s+as\b)"
_OPEN = f"{Open.__name__}("  # a value that depends on how it is launched
_HELPING = frozenset({PROGRAM, PLAYED, TYPE, SPACE})


@dataclass(frozen=True, slots=True, eq=False)
class Excuses:
    """Why facts may be otherwise.

    `of_code` is what the code has changed, `groups` are the classes and kinds whose wiring has to
    follow that, `files` the names of all files. `before` and `now` are None where it is not known
    who is joined with whom.
    """

    base: Facts
    today: Facts
    of_code: Comparison
    groups: frozenset[str]
    files: frozenset[str]
    before: JoinedTopics | None
    now: JoinedTopics | None

    def hold(self, key: tuple[str, str, str]) -> bool:
        """Whether the facts of a key need not be as they were."""
        first = (self.base.get(key) or self.today[key])[0]
        if first.kind in _HELPING or (first.kind == CONSTANT and key not in self.today):
            return True
        is_others = is_of_others(self.base, self.today, first.owner)
        if first.kind == HANDED or (is_others and key not in self.base):
            return not reaches_in(self.base, self.today, self.now, first)
        if key not in self.base and not self._is_unwanted(first):
            return True
        if self._has_moved(first) or self._is_renamed(key) or self._follows(first):
            return True
        if first.kind == "default" and is_always_given(self.base, self.today, key):
            return True
        if is_of_all_rebecs(self.today, key) or waits_longer(self.base, self.today, key):
            return True
        if first.kind == "import" and key not in self.today:
            return not self._is_named(first)
        if first.kind == "parameters" and key not in self.base:
            return is_of_another_tool(self.base, self.today, first.name)
        if first.kind == "node" and first.name == "ns":
            return self._is_in_one_space
        if first.kind == "node" and first.name == CLOCK:
            return self._are_by_one_clock
        if first.kind in (TOLD, TOLD_TYPE):
            return self._is_told(first)
        if first.kind == "field":
            return is_told_of(first, self.base, self.today, self.of_code)
        return (first.kind == "remap" or first.kind in TOPICS) and self._same_are_joined(key)

    def is_known_to_differ(self, key: tuple[str, str, str]) -> bool:
        """Whether it is known that messages get elsewhere, where facts of names are other ones."""
        if self.groups or self.before is None or self.now is None:
            return False
        is_one = len({fact.value for fact in self.today.get(key, ())}) < 2
        is_name = key[0] == "remap" or key[0] in TOPICS
        return is_name and is_one and not self.now.delivers_as(self.before)

    @property
    def _is_in_one_space(self) -> bool:
        """Whether all generated nodes and their parameters are in one namespace."""
        own = self._nodes
        found = {
            "" if fact.value == NOT_GIVEN else fact.value.strip("/")
            for (kind, owner, name), facts in self.today.items()
            for fact in facts
            if kind == SPACE or ((kind, name) == ("node", "ns") and owner in own)
        }
        return len(found) == 1

    @property
    def _are_by_one_clock(self) -> bool:
        """Whether all generated nodes follow the same clock, of the two that there are."""
        given = (self.today.get(("node", name, CLOCK), ()) for name in self._nodes)
        told = {fact.value for facts in given for fact in facts}
        others = told - {repr(True), repr(False), NOT_GIVEN}
        return len(told) < 2 and all(value.startswith(_OPEN) for value in others)

    @property
    def _nodes(self) -> frozenset[str]:
        return frozenset(owner for kind, owner, _ in self.base if kind == TYPE)

    def _has_moved(self, fact: Fact) -> bool:
        """Whether a fact is about a file that is somewhere else, or called otherwise."""
        message = f"{fact.owner or fact.name}.msg"
        about = {"source of a program": fact.name, "field": message, "message": message}
        return about.get(fact.kind, fact.name) not in self.files and fact.kind in about

    def _is_renamed(self, key: tuple[str, str, str]) -> bool:
        """Whether a program is installed by another name, by which launch files start it."""
        if key[0] != "installed program" or key in self.today:
            return False
        values = {fact.value for fact in self.base.get(key, ())}
        new = {
            name
            for (kind, owner, name), facts in self.today.items()
            if kind == key[0] and (kind, owner, name) not in self.base
            if values == {fact.value for fact in facts}
        }
        starts = {f.value for (k, *_), found in self.today.items() if k == TYPE for f in found}
        return bool(new & starts) and key[2] not in starts

    def _is_told(self, field: Fact) -> bool:
        """Whether a state message has a field that another version of its variable fills, or none.

        A field that neither the message nor the code has is not told, which hides nothing: who
        reads the message misses it.
        """
        kind, owner, name = field.key
        other = TOLD_TYPE if kind == TOLD else TOLD
        if field.key not in self.today:
            return (other, owner, name) not in self.today and bool(name)
        return kind == TOLD and is_renamed(
            self.base[field.key], self.today[field.key], self.of_code
        )

    def _follows(self, fact: Fact) -> bool:
        """Whether it is about what the code has changed on the whole."""
        if fact.kind in _UNWANTED:
            return False
        if fact.kind == "default":
            return fact.owner in self.groups or "env" in self.groups
        if fact.kind in ("remap", "node", "parameter") or fact.kind.endswith(" program"):
            return bool(self.groups - {"env"})
        if fact.kind in (TOLD, TOLD_TYPE):
            return fact.owner.lower() in {g.replace("_", "").lower() for g in self.groups}
        if fact.kind == "field":
            return any(fact.owner.startswith(group) for group in self.groups)
        return fact.owner in self.groups

    def _is_unwanted(self, fact: Fact) -> bool:
        """Whether it makes a difference that there is something that was not generated."""
        if fact.kind == PYTHON_SETTING:
            return any(kind == "Python package" for kind, *_ in self.base)
        if fact.kind != "remap":
            return fact.kind in _UNWANTED
        if ("node", fact.owner, "pkg") in self.base and (TYPE, fact.owner, "") not in self.base:
            return self._is_of_a_topic(fact)
        is_own = not fact.owner or (TYPE, fact.owner, "") in self.base
        is_met = is_of_runtime(self.today, fact) or is_about(self.now, self.today, fact)
        return is_own and is_met

    def _is_named(self, fact: Fact) -> bool:
        """Whether the code of a class still has a name, alone and not as what another is for."""
        facts = chain.from_iterable(f for (_, of, _), f in self.today.items() if of == fact.owner)
        texts = {f.source.text for f in facts if not f.source.path.endswith(".msg")}
        return not texts or any(map(re.compile(_ALONE.format(fact.name)).search, texts))

    def _is_of_a_topic(self, remap: Fact) -> bool:
        """Whether a remap has the last name of a topic of the package, where no more is known."""
        last = remap.name.rpartition("/")[2].lstrip("~")
        topics = (found for (kind, *_), found in self.today.items() if kind in TOPICS)
        return any(last in re.findall(r"\w+", fact.value) for found in topics for fact in found)

    def _same_are_joined(self, key: tuple[str, str, str]) -> bool:
        """Whether all are joined as they were, whatever topics are called."""
        if self.before is None or self.now is None or not self.now.is_as(self.before):
            return False
        now = self.today.get(key, ())
        if len({fact.value for fact in now}) > 1:
            return False  # which of them counts depends on their order
        is_new = key[0] == "remap" and key[1] and key not in self.base
        if is_new and any(leads_in(self.now, self.today, fact) for fact in now):
            return False
        if key[0] == "remap" and any(is_of_runtime(self.today, fact) for fact in now):
            return False
        shapes = ({_shape(f) for f in facts.get(key, ())} for facts in (self.base, self.today))
        return key[0] == "remap" or len(set(map(frozenset, shapes))) == 1


def _shape(fact: Fact) -> str:
    """What a fact says beside the name of a topic."""
    return fact.value.partition('"')[0]


def changed_groups(of_code: Comparison) -> frozenset[str]:
    """The classes and kinds of elements of which the wiring follows what the code has changed."""
    groups = {d.element.group or "" for d in of_code.differences if _joins(d)}
    return frozenset(
        groups | {d.element.kind for d in of_code.differences if d.element.kind == "env"}
    )


def _joins(difference: Difference) -> bool:
    """Whether the wiring has to follow a difference."""
    match difference:
        case Added() | Removed() | Renamed() | Moved():
            return difference.element.kind not in ("env", "statevar", "method", "parameter")
        case Changed(aspect=aspect):
            return aspect in _JOINING
        case _:
            return False
