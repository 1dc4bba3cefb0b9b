"""From packages that were read to their computation graph and what is found in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass
from rebsync.reverse.launch.launched import Launch
from rebsync.rosgraph.ends import PackageCode
from rebsync.rosgraph.findings import Evidence, GraphFinding, interfaces_of, of_rules, program_of
from rebsync.rosgraph.graph import (
    ComputationGraph,
    RosNode,
    graph_of_code,
    graph_of_launch,
    loose_ends,
)
from rebsync.rosgraph.launching import LaunchFiles
from rebsync.rosgraph.rules_absence import nobody, slips
from rebsync.rosgraph.rules_launch import unknown_parameters, unused_remappings
from rebsync.rosgraph.rules_matching import different_types, misfit_qualities

_RULES = (different_types, misfit_qualities, slips, nobody)


@dataclass(frozen=True, slots=True, eq=False)
class AnalysedGraph:
    """A graph with its findings; `launch` is the launch file, by its package and path in that."""

    graph: ComputationGraph
    findings: tuple[GraphFinding, ...]
    launch: str | None = None


def analysed(
    packages: Sequence[PackageCode], title: str, launch: str | None = None
) -> AnalysedGraph:
    """The graph of a launch file, or of all that was read.

    RebsyncError: the launch file is none of those that were read.
    """
    files = LaunchFiles(packages)
    if launch is not None:
        return _of_launch_file(packages, files, launch)
    graph = graph_of_code(packages, title)
    read = [files.read(package, source) for package, source in files.all()]
    systems = [graph_of_launch(packages, each, "").nodes for each in read]
    known = Evidence(
        graph,
        interfaces_of(packages),
        _remapped(read),
        tuple(map(_started, systems)),
        loose_ends(packages),
    )
    return AnalysedGraph(graph, _findings(known, systems))


def _of_launch_file(
    packages: Sequence[PackageCode], files: LaunchFiles, launch: str
) -> AnalysedGraph:
    found = files.named(launch)
    if found is None:
        hint = "it must be in a package that is read; PACKAGE/FILE names one, too"
        raise RebsyncError.of(launch, "RS801", "no such launch file was read", hint)
    package, inside = found
    source = package.files[inside]
    graph = graph_of_launch(packages, files.read(package, source), source.path)
    known = Evidence(graph, interfaces_of(packages), frozenset(), (), loose_ends(packages))
    return AnalysedGraph(graph, _findings(known, [graph.nodes]), f"{package.name}/{inside}")


def _findings(known: Evidence, systems: Sequence[Sequence[RosNode]]) -> tuple[GraphFinding, ...]:
    of_launch = list(_of_launch(systems))
    return tuple(of_rules((*_RULES, lambda _: of_launch), known))


def _remapped(read: Sequence[Launch]) -> frozenset[str]:
    """The last parts of the names that launch files remap, and remap to."""
    remaps = [remap for launch in read for node in launch.nodes for remap in node.remaps]
    names = chain.from_iterable((r.private, r.target) for r in remaps)
    return frozenset(n.rpartition("/")[2] for n in names if isinstance(n, str))


def _started(nodes: Sequence[RosNode]) -> frozenset[tuple[str, str]]:
    """The nodes of a launch file that it starts whatever its arguments are."""
    return frozenset(program_of(n) for n in nodes if n.code is not None and not n.when)


def _of_launch(systems: Sequence[Sequence[RosNode]]) -> Iterator[GraphFinding]:
    for nodes in systems:
        yield from unused_remappings(nodes)
        yield from unknown_parameters(nodes)
