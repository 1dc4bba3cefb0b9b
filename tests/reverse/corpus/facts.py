"""One fact and the answer at its place: what the answer is worth, key by key."""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.records import dataclass
from tests.reverse.corpus.values import (
    OPEN,
    RIGHT,
    WRONG,
    Json,
    Verdict,
    judge,
    judge_null,
    same,
    worst,
)

TYPED = frozenset({"publisher", "subscription", "service", "client"})
NAMELESS = frozenset({"timer", "rate"})
_DETAILS = (
    *("depth", "latched", "single", "transport", "callback", "period", "one_shot", "autostart"),
    *("hz", "default", "value", "anonymous", "node_class", "partial"),
)
_USUAL: dict[str, Json] = {"autostart": True, "single": False, "anonymous": False}


@dataclass(frozen=True, slots=True)
class Pair:
    """A fact with the answer at its place, and what that is worth, key by key."""

    fact: Json
    answer: Json
    keys: dict[str, Verdict]
    details: dict[str, Verdict]

    @property
    def verdict(self) -> Verdict:
        """Of what makes the fact what it is: name, type, access."""
        return worst(self.keys.values())

    @property
    def agreement(self) -> tuple[int, int]:
        """How much the two agree, to be compared with other pairs."""
        keys = sum(_WORTH[v] for v in self.keys.values())
        return keys, sum(_WORTH[v] for v in self.details.values())


_WORTH = {RIGHT: 2, OPEN: 1, WRONG: 0}


def paired(fact: Json, answer: Json) -> Pair:
    """An answer judged by a fact."""
    details = {k: v for k in _DETAILS if (v := _detail(k, fact, answer)) is not None}
    return Pair(fact, answer, _keys(fact, answer), details)


def _keys(fact: Json, answer: Json) -> dict[str, Verdict]:
    """The verdicts on what makes a fact what it is."""
    kind = fact["kind"]
    keys = {}
    if fact.get("nodelet"):
        keys["nodelet"] = _bool(_last(fact["nodelet"]) == _last(answer.get("nodelet") or ""))
    elif kind not in NAMELESS:
        keys["name"] = _value(fact["name"], answer["name"], fact.get("partial"))
    if kind in TYPED:
        keys["type"] = _value(fact["type"], answer["type"])
    if kind == "parameter":
        keys["access"] = _bool(fact["access"] == answer["access"])
    return keys


def _detail(key: str, fact: Json, answer: Json) -> Verdict | None:
    """The verdict on a further key; None where the fact does not speak of it."""
    wanted, given = fact.get(key, _USUAL.get(key)), answer.get(key, _USUAL.get(key))
    if key in _USUAL and key not in fact and key not in answer:
        return None
    if key == "partial":
        return None if wanted is None else _bool(_partial_of(answer) is not None)
    if key not in fact and key not in _USUAL:
        return None
    if key == "callback":
        return _callback(fact, given)
    if key == "default":
        return _default(fact, given)
    if key == "node_class":
        return _bool(_last(wanted or "") == _last(given or ""))
    return _value(wanted, given)


def _value(wanted: Json, given: Json, partial: str | None = None) -> Verdict:
    return judge_null(given, partial) if wanted is None else judge(wanted, given)


def _bool(right: bool) -> Verdict:
    return RIGHT if right else WRONG


def _last(name: str) -> str:
    """A name without the namespaces or classes around it."""
    return name.rpartition("::")[2]


def _partial_of(answer: Json) -> Json:
    name = answer["name"]
    every = name.get("one_of", [name]) if isinstance(name, dict) else []
    found = [n.get("partial", n.get("relative")) for n in every if isinstance(n, dict)]
    return next((f for f in found if f is not None), None)


def _default(fact: Json, given: Json) -> Verdict:
    """The default of a parameter; what the variable holds when nothing is found is one too."""
    wanted = fact["default"]
    if "fallback" in fact and not isinstance(given, dict) and same(fact["fallback"], given):
        return RIGHT
    if wanted is None:
        unknowable = "why" in fact and judge_null(given) is RIGHT
        if given in (None, []) or unknowable:
            return RIGHT
        return OPEN if "unknown" in _keys_of(given) else WRONG
    return WRONG if given is None else judge(wanted, given)


def _keys_of(value: Json) -> Iterable[str]:
    return value if isinstance(value, dict) else ()


def _callback(fact: Json, given: Json) -> Verdict:
    """What is called; a functor's class is as good as what it calls."""
    wanted = fact["callback"]
    if wanted is None:
        return _bool(given is None)
    if given is None:
        return WRONG
    if isinstance(wanted, dict):
        called = given.get("one_of", [given])
        names = {_name_of(c) for c in called}
        return OPEN if None in names else _bool(names == set(wanted["one_of"]))
    allowed = {wanted, fact.get("through", wanted)}
    if "unknown" in given:
        return OPEN
    return _bool(bool(allowed & {_name_of(given), given.get("through", "")}))


def _name_of(called: Json) -> str | None:
    name = called.get("function")
    return name if isinstance(name, str) else None


def pair_at_site(site: Json, answer: Json) -> Pair:
    """An answer at a call of a helper whose argument names the parameter."""
    return Pair(site, answer, {"name": judge(site["name"], answer["name"])}, {})
