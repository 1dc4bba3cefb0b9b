"""How generated nodes are joined: topics, priorities of servers, remaps, fields of messages.

An extracted model does not show these: it knows who sends what to whom, not by which topic. So they
must be as they were generated, but for classes whose servers, known rebecs or instances changed:
there they follow the change. A topic may have another name where it still joins the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from rebsync.diagnostics import Diagnostic, Findings
from rebsync.records import dataclass
from rebsync.reverse.scaffold.fact import (
    HANDED,
    UNKNOWN,
    Fact,
    Facts,
)
from rebsync.reverse.scaffold.facts import facts_of, package_name
from rebsync.roundtrip.diff.difference import (
    Comparison,
)
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.package.units import manifest_of
from rebsync.roundtrip.verdict.wiring.excuses import Excuses, changed_groups
from rebsync.roundtrip.verdict.wiring.names import (
    TOPICS,
    joined,
    replaced,
)
from rebsync.source import NOWHERE, Source

_WIRED = (
    *(".cpp", ".h", ".hpp", ".launch", ".py", ".msg", ".srv", ".action"),
    *("CMakeLists.txt", ".yaml", ".yml", ".xml", "setup.cfg"),
)
# Without these extraction lists what they were for; and somebody may call them otherwise.
_MISSED = frozenset({"subscription", "publisher", "sensor", "priority", "type of the parameter"})
# Values of facts of which only matters that they are there.
_PRESENT = frozenset({"generated", "there", "loaded", "included", "given", "built"})
_SAYING = frozenset({"receiving", "sending", "set-up"})
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
    `is_known` says that messages are known to get elsewhere than the model sends them.
    """

    before: tuple[Fact, ...]
    now: tuple[Fact, ...]
    finding: Findings
    is_lost: bool = False
    is_known: bool = False


def odd_facts(
    package: ManagedPackage, record: Record, now: PackageState, of_code: Comparison
) -> tuple[Odd, ...]:
    """The facts that are not as they were when the code was generated."""
    touched = [n for n in {*now.changed, *now.missing} & record.files.keys() if _is_wiring(n)]
    new = [n for n in now.changed if n not in record.files and _is_wiring(n)]
    counts = [*touched, *(n for n in new if n.endswith("setup.cfg"))]
    if not counts and not any(map(_is_launch, new)):
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
    excuses = Excuses(base, today, of_code, changed_groups(of_code), files, *sides)
    keys = [*base, *(k for k in today if k not in base)]
    # of files beside those generated, as launch files may be, only what others do in the system
    keys = keys if counts else [k for k in keys if k[0] == HANDED]
    found = [
        replace(odd, is_known=excuses.is_known_to_differ(key))
        for key in keys
        if not excuses.hold(key)
        and (odd := _odd(package, base.get(key, []), today.get(key, []))) is not None
    ]
    told = (o for o in found if o.finding.diagnostics[0].message not in record.accepted)
    is_told = any(f.kind in ("remap", *TOPICS) for odd in told for f in (*odd.before, *odd.now))
    return (*found, *(() if is_told or not counts else _unseen(package, excuses)))


def _values(facts: Facts) -> dict[tuple[str, str, str], set[str]]:
    return {key: {fact.value for fact in found} for key, found in facts.items()}


def _is_wiring(name: str) -> bool:
    return name.endswith(_WIRED) or name.rpartition("/")[0].endswith("scripts")


def _is_launch(name: str) -> bool:
    """Whether it is a launch file, or one that it may include or load."""
    return name.endswith((".launch", ".launch.py", ".xml", ".yaml", ".yml"))


def _odd(package: ManagedPackage, before: list[Fact], now: list[Fact]) -> Odd | None:
    """What of the facts of one key is not as it was."""
    old, new = {f.value for f in before}, {f.value for f in now}
    first = (before or now)[0]
    if old == new or (not new and _is_missed(first)):
        return None
    what = " ".join(filter(None, ("the", first.kind, first.name)))
    what += f" of {first.owner}" if first.owner else ""
    message = f"{what} {_change(first.kind, old, new)}"
    if first.kind == UNKNOWN and new:
        message = f"{first.name} is not known: {_shown(new - old)}"
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
        case "field":
            return "take the edit back, or tell of it in the model"
        case _:
            return _HINT


def _unseen(package: ManagedPackage, excuses: Excuses) -> Iterator[Odd]:
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
