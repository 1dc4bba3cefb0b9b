"""How generated nodes are joined: topics, priorities of servers, remaps, fields of messages.

An extracted model does not show these: it knows who sends what to whom, not by which topic. So they
must be as they were generated, but for classes whose servers, known rebecs or instances changed:
there they follow the change. A topic may have another name where it still joins the same.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import chain

from rebsync.diagnostics import Diagnostic, Findings
from rebsync.records import dataclass
from rebsync.reverse.scaffold.fact import (
    CLOCK,
    CONSTANT,
    NOT_GIVEN,
    PLAYED,
    PROGRAM,
    SPACE,
    TYPE,
    Fact,
    Facts,
)
from rebsync.reverse.scaffold.facts import facts_of, package_name
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
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.package.units import manifest_of
from rebsync.roundtrip.verdict.wiring.defaults import is_always_given
from rebsync.roundtrip.verdict.wiring.fields import hand_on_alike, is_told_of
from rebsync.roundtrip.verdict.wiring.names import (
    TOPICS,
    JoinedTopics,
    is_about,
    joined,
    leads_in,
    replaced,
)
from rebsync.source import NOWHERE, Source

_WIRED = (
    *(".cpp", ".h", ".hpp", ".launch", ".py", ".msg", ".srv", ".action"),
    *("CMakeLists.txt", "config/params.yaml", "package.xml", "setup.cfg"),
)
_JOINING = frozenset(
    {
        *(Aspect.TYPE, Aspect.PARAMETERS, Aspect.BINDING, Aspect.EXTENDS, Aspect.IMPLEMENTS),
        *(Aspect.ABSTRACT, Aspect.ANNOTATION),
    }
)
# Without these extraction lists what they were for; and somebody may call them otherwise.
_MISSED = frozenset(
    {"subscription", "publisher", "sensor", "priority", "sending", "type of the parameter"}
)
# What was not there when the code was generated makes a difference too.
_UNWANTED = frozenset(
    {
        *("setting", "compiler option"),
        *("environment", "launch file", "unknown", "parameters"),
    }
)
# Values of facts of which only matters that they are there.
_PRESENT = frozenset({"generated", "there", "loaded", "included", "given", "built"})
_SAYING = frozenset({"receiving", "sending", "set-up"})
_HELPING = frozenset({PROGRAM, PLAYED, TYPE, SPACE})
_HINT = "take the edit back: no model tells this"
_LISTS = ("mailbox/rebecs", "mailbox/instances")
# Run-time parameters that are settings of the model.
_SETTINGS = {
    parameter: f"set `{name}` in rebsync.toml instead; then `rebsync sync` says it here"
    for parameter, name in (
        ("mailbox/time_unit", "time_unit"),
        ("drive/cell_size", "cell_size"),
        ("drive/kind", "drive"),
        ("drive/heading", "heading"),
        ("drive/odometry", "[drive] odometry"),
    )
}


@dataclass(frozen=True, slots=True)
class Odd:
    """Facts of one key that are not as they were; one of the two may be missing.

    Without any, nodes are joined otherwise all the same: `is_lost` says that messages get lost.
    """

    before: tuple[Fact, ...]
    now: tuple[Fact, ...]
    finding: Findings
    is_lost: bool = False


def odd_facts(
    package: ManagedPackage, record: Record, now: PackageState, of_code: Comparison
) -> tuple[Odd, ...]:
    """The facts that are not as they were when the code was generated."""
    touched = [n for n in {*now.changed, *now.missing} & record.files.keys() if _is_wiring(n)]
    new = [n for n in now.changed if n not in record.files and _is_wiring(n)]
    if not touched:
        return ()
    listed = now.listing.files
    old_paths = {n: f"{package.root}/{BASE}{n}" for n in record.files if _is_wiring(n)}
    old = package_name(f"{package.root}/{BASE}{manifest_of(record.files)}")
    own = package_name(listed.get(manifest_of(listed), ""))
    before = facts_of({n: old_paths[n] for n in touched}, old)
    after = facts_of({n: listed[n] for n in [*touched, *new] if n in listed}, own)
    if _values(before) == _values(after) and old == own:
        return ()
    today = facts_of({n: p for n, p in listed.items() if _is_wiring(n)}, own)
    base, free = replaced(facts_of(old_paths, old), today)
    sides = joined(base, free), joined(today, free)
    files = frozenset(name.rpartition("/")[2] for name in listed)
    excuses = _Excuses(base, today, of_code, _groups(of_code), files, *sides)
    keys = [*base, *(k for k in today if k not in base)]
    found = [
        odd
        for key in keys
        if not excuses.hold(key)
        and (odd := _odd(package, base.get(key, []), today.get(key, []))) is not None
    ]
    told = (o for o in found if o.finding.diagnostics[0].message not in record.accepted)
    is_told = any(f.kind in ("remap", *TOPICS) for odd in told for f in (*odd.before, *odd.now))
    return (*found, *(() if is_told else _unseen(package, excuses)))


def _values(facts: Facts) -> dict[tuple[str, str, str], set[str]]:
    return {key: {fact.value for fact in found} for key, found in facts.items()}


def _is_wiring(name: str) -> bool:
    return name.endswith(_WIRED) or name.rpartition("/")[0].endswith("scripts")


def _odd(package: ManagedPackage, before: list[Fact], now: list[Fact]) -> Odd | None:
    """What of the facts of one key is not as it was."""
    old, new = {f.value for f in before}, {f.value for f in now}
    first = (before or now)[0]
    if old == new or (not new and _is_missed(first)):
        return None
    what = " ".join(filter(None, ("the", first.kind, first.name)))
    what += f" of {first.owner}" if first.owner else ""
    message = f"{what} {_change(first.kind, old, new)}"
    place = next((f for f in now if f.value not in old), now[0] if now else None)
    source = place.source if place else Source(f"{package.root}/{_inside(package, first)}", "")
    span = place.span if place else NOWHERE
    hint = _hint(first)
    finding = Findings(source, (Diagnostic("RS956", span, message, hint),))
    return Odd(tuple(before), tuple(now), finding)


def _is_missed(fact: Fact) -> bool:
    """Whether extraction tells that something is gone.

    It knows a server by what a class sends itself as well, whatever the class listens to; in Python
    by the function that receives.
    """
    is_cpp = fact.source.path.endswith(".cpp")
    is_heard = fact.kind == "subscription" or (fact.kind == "sensor" and not is_cpp)
    return fact.kind in _MISSED and not is_heard


def _change(kind: str, old: set[str], new: set[str]) -> str:
    """What is another now than it was when it was generated."""
    if kind in _SAYING:
        return _said(old, new)
    was, said = (_shown(each - _PRESENT) for each in (old, new))
    if not new:
        return f"is gone; it was {was}" if was else "is gone"
    if not old:
        return f"is new: {said}" if said else "is new"
    if not was:
        return f"is {said}"
    return f"is {said}; it was {was}"


def _said(old: set[str], new: set[str]) -> str:
    """What a function says otherwise: only the statements that are other ones."""
    before, now = ([s for text in each for s in text.split("; ")] for each in (old, new))
    said = _shown(s for s in now if s not in before)
    was = _shown(s for s in before if s not in now)
    if not said:
        return f"is without {was}"
    return f"is with {said}; it was with {was}" if was else f"is with {said} as well"


def _shown(values: Iterable[str]) -> str:
    return " and ".join(sorted(values))


def _hint(fact: Fact) -> str:
    """What to do about a fact that is another."""
    match fact.kind:
        case "remap" | "publisher" | "subscription" | "sensor":
            return "let the other end have the same name, or take the edit back"
        case "priority" | "best priority":
            return "give the priority in the model, then `rebsync sync`; or take the edit back"
        case "parameter" if fact.name.startswith(_LISTS):
            return "let this list name all rebecs of the model, each once"
        case "parameter":
            return _SETTINGS.get(fact.name, _HINT)
        case "field" | "sending":
            return "take the edit back, or tell of it in the model"
        case _:
            return _HINT


def _unseen(package: ManagedPackage, excuses: _Excuses) -> Iterator[Odd]:
    """What is joined otherwise, though no fact that was there before is another."""
    if excuses.groups or excuses.before is None or excuses.now is None:
        return
    lost = excuses.before.loses(excuses.now)
    if (what := lost or excuses.before.gains(excuses.now)) is not None:
        message = f"nodes are joined otherwise: {what}"
        hint = "look at the names of topics in the code and in the launch file"
        new = (f for key, facts in excuses.today.items() if key not in excuses.base for f in facts)
        remap = next((f for f in new if f.kind == "remap"), None)
        source = remap.source if remap is not None else Source(package.root, "")
        span = remap.span if remap is not None else NOWHERE
        diagnostic = Diagnostic("RS956", span, message, hint)
        yield Odd((), (), Findings(source, (diagnostic,)), lost is not None)


def _inside(package: ManagedPackage, fact: Fact) -> str:
    return fact.source.path.removeprefix(f"{package.root}/{BASE}")


# --- excuses ------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class _Excuses:
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
        if key not in self.base and not self._is_unwanted(first):
            return True
        if self._has_moved(first) or self._is_renamed(key) or self._follows(first):
            return True
        if first.kind == "default" and is_always_given(self.base, self.today, key):
            return True
        if first.kind == "import" and key not in self.today:
            return not self._is_named(first)
        if first.kind == "parameters" and key not in self.base:
            return self._is_of_another_tool(first.name)
        if first.kind == "node" and first.name == "ns":
            return self._is_in_one_space
        if first.kind == "node" and first.name == CLOCK:
            return self._are_by_one_clock
        if first.kind == "field":
            return is_told_of(first, self.base, self.today, self.of_code)
        if first.kind in ("receiving", "sending"):
            return hand_on_alike(self.base[key], self.today.get(key, ()), self.today)
        return (first.kind == "remap" or first.kind in TOPICS) and self._same_are_joined(key)

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
        """Whether all generated nodes follow the same clock."""
        given = (self.today.get(("node", name, CLOCK), ()) for name in self._nodes)
        return len({fact.value for facts in given for fact in facts}) < 2

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

    def _follows(self, fact: Fact) -> bool:
        """Whether it is about what the code has changed on the whole."""
        if fact.kind in _UNWANTED:
            return False
        if fact.kind == "default":
            return fact.owner in self.groups or "env" in self.groups
        if fact.kind in ("remap", "node", "parameter") or fact.kind.endswith(" program"):
            return bool(self.groups - {"env"})
        if fact.kind == "field":
            return any(fact.owner.startswith(group) for group in self.groups)
        return fact.owner in self.groups

    def _is_unwanted(self, fact: Fact) -> bool:
        """Whether it makes a difference that there is something that was not generated."""
        if fact.kind != "remap":
            return fact.kind in _UNWANTED
        if ("node", fact.owner, "pkg") in self.base and (TYPE, fact.owner, "") not in self.base:
            return self._is_of_a_topic(fact)
        is_own = not fact.owner or (TYPE, fact.owner, "") in self.base
        return is_own and is_about(self.now, self.today, fact)

    def _is_of_another_tool(self, section: str) -> bool:
        """Whether a section of parameters is for a node that is none of the package."""
        nodes = {owner for kind, owner, _ in self.today if kind == TYPE}
        is_known = bool(nodes) and all(re.fullmatch(r"\w+", n) and n != "None" for n in nodes)
        name = section.rpartition("/")[2]
        return is_known and re.fullmatch(r"\w+", name) is not None and name not in nodes

    def _is_named(self, fact: Fact) -> bool:
        """Whether the code of a class still has a name."""
        facts = chain.from_iterable(f for (_, of, _), f in self.today.items() if of == fact.owner)
        texts = {fact.source.text for fact in facts}
        return not texts or any(re.search(rf"\b{fact.name}\b", text) for text in texts)

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
        shapes = ({_shape(f) for f in facts.get(key, ())} for facts in (self.base, self.today))
        return key[0] == "remap" or len(set(map(frozenset, shapes))) == 1


def _shape(fact: Fact) -> str:
    """What a fact says beside the name of a topic."""
    return fact.value.partition('"')[0]


def _groups(of_code: Comparison) -> frozenset[str]:
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
