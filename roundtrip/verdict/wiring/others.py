"""Whether nodes of other packages, whose publishers nobody knows, may reach generated ones.

By what launch files hand to them: names of nodes, and of the topics by which these are joined.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rebsync.reverse.scaffold.fact import HANDED, OPEN, OWN, TYPE, Fact, Facts
from rebsync.roundtrip.verdict.wiring.names import RUNTIME_TOPICS, JoinedTopics, leads_in

_TOKEN = re.compile(r"[\w./~]+")
_FILE = re.compile(r"\.[A-Za-z]\w*\Z")
# What a program puts a name together from: `{robot}/cmd_vel`, `%s/cmd_vel`.
_TEMPLATE = re.compile(r"(?:\{\w*\}|%[sd])\S*/|/\S*(?:\{\w*\}|%[sd])")
_STATE = "state"  # on which generated nodes only tell of themselves


def is_of_others(base: Facts, today: Facts, node: str) -> bool:
    """Whether a node is new, and of another package."""
    of = {fact.value for fact in today.get(("node", node, "pkg"), ())}
    return bool(of) and OWN not in of and (TYPE, node, "") not in base


def reaches_in(base: Facts, today: Facts, now: JoinedTopics | None, fact: Fact) -> bool:
    """Whether what others are given has a name that is one of generated nodes, or their topics."""
    nodes = frozenset(owner for kind, owner, _ in base if kind == TYPE)
    if fact.kind in (HANDED, "environment"):
        return _tells_of(today, nodes, now, fact)
    words = {*re.findall(r"\w+", fact.value)}
    if fact.kind == "remap":
        is_known = now is not None and not leads_in(now, today, fact)
        return not is_known or not words.isdisjoint(nodes)
    is_renaming = fact.name == "ns" or ":=" in fact.value
    return is_renaming and not words.isdisjoint(nodes)


def is_of_another_tool(base: Facts, today: Facts, section: str) -> bool:
    """Whether a section of parameters is for a node that is none of the package."""
    nodes = {owner for kind, owner, _ in today if kind == TYPE}
    is_known = bool(nodes) and all(re.fullmatch(r"\w+", n) and n != "None" for n in nodes)
    name = section.rpartition("/")[2]
    own = {node for node in nodes if not is_of_others(base, today, node)}
    return is_known and re.fullmatch(r"\w+", name) is not None and name not in own


def _tells_of(today: Facts, nodes: frozenset[str], now: JoinedTopics | None, handed: Fact) -> bool:
    """Whether a text that others are given names a generated node, or one of its topics.

    One that is told of the state alone is not: nobody takes that in.
    """
    told = f"{handed.value} {handed.name}" if handed.name.startswith("parameter") else handed.value
    if now is None or OPEN in told or _TEMPLATE.search(told):
        return True
    topics = {n.strip("/") for n in (*now.names, *RUNTIME_TOPICS, *_targets(today, nodes))}
    names = _graph_names(told)
    return any(name in topics or _names(name.split("/"), nodes) for name in names)


def _graph_names(text: str) -> Iterator[str]:
    """The names of nodes and topics that a text may have; files are none."""
    for token in _TOKEN.findall(text):
        if not _FILE.search(token.rstrip(".")):
            yield token.strip("~/.")


def _names(parts: list[str], nodes: frozenset[str]) -> bool:
    """Whether a name has that of a node, but for the topic on which this tells of its state."""
    is_state = len(parts) > 1 and parts[-1] == _STATE and parts[-2] in nodes
    return not nodes.isdisjoint(parts[:-2] if is_state else parts)


def _targets(today: Facts, nodes: frozenset[str]) -> Iterator[str]:
    """What topics of generated nodes are called by remaps."""
    for (kind, node, _), found in today.items():
        if kind == "remap" and node in nodes | {""}:
            yield from (fact.value for fact in found)
