"""What is wrong, or may be, in a computation graph: each with its code and place.

A finding is a warning where the code and the launch file alone prove it. That something is not
there is only a note: other machines, tools and people publish and call as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.records import dataclass
from rebsync.reverse.graph import Place
from rebsync.rosgraph.ends import PackageCode
from rebsync.rosgraph.graph import ComputationGraph, NodeEnd, RosNode
from rebsync.source import Source


@dataclass(frozen=True, slots=True)
class GraphFinding:
    """A finding with its place, and `others` that it is about."""

    code: str
    place: Place
    message: str
    hint: str | None = None
    others: tuple[tuple[Place, str], ...] = ()
    severity: Severity = Severity.WARNING


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """What the rules look at: the graph, its packages, and names that launch files remap.

    `systems` are the nodes that each launch file starts for certain, by `program_of`; `loose` the
    ends of code that any node may run.
    """

    graph: ComputationGraph
    interfaces: frozenset[str]
    remapped: frozenset[str]
    systems: tuple[frozenset[tuple[str, str]], ...]
    loose: tuple[NodeEnd, ...]

    def together(self, one: RosNode, other: RosNode) -> bool:
        """Whether two nodes are known to run in one system."""
        if self.graph.launch is not None:
            return not one.when and not other.when
        both = {program_of(one), program_of(other)}
        return one is other or any(both <= system for system in self.systems)


def program_of(node: RosNode) -> tuple[str, str]:
    """By what a node is known again in another graph of the same packages."""
    return node.package, node.label


Rule = Callable[[Evidence], Iterable[GraphFinding]]


def interfaces_of(packages: Sequence[PackageCode]) -> frozenset[str]:
    """The types that the packages which were read define, as `package/Type`."""
    return frozenset(f"{p.name}/{t}" for p in packages for t in p.interfaces)


def diagnostics(found: Iterable[GraphFinding]) -> tuple[Findings, ...]:
    """The findings by their files; places in other files are told in the hint."""
    by_path: dict[str, tuple[Source, list[Diagnostic]]] = {}
    for finding in found:
        source = finding.place.source
        by_path.setdefault(source.path, (source, []))[1].append(_diagnostic(finding))
    return tuple(
        Findings(source, tuple(sorted(listed, key=lambda d: (d.span.start, d.code))))
        for _, (source, listed) in sorted(by_path.items())
    )


def _diagnostic(finding: GraphFinding) -> Diagnostic:
    own = finding.place.source.path
    here = tuple((p.span, remark) for p, remark in finding.others if p.source.path == own)
    elsewhere = [(p, remark) for p, remark in finding.others if p.source.path != own]
    parts = [finding.hint] if finding.hint else []
    parts += [f"{remark}: {p.source.path}:{p.line}" for p, remark in elsewhere]
    return Diagnostic(
        finding.code,
        finding.place.span,
        finding.message,
        "; ".join(parts) or None,
        related=here,
        severity=finding.severity,
    )


def of_rules(rules: Iterable[Rule], known: Evidence) -> Iterator[GraphFinding]:
    """All that some rules find, each once for a place."""
    seen: set[tuple[str, str, int, str]] = set()
    for rule in rules:
        for finding in rule(known):
            place = finding.place
            key = finding.code, place.source.path, place.span.start, finding.message
            if key not in seen:
                seen.add(key)
                yield finding
