"""`rebsync graph`: the computation graph of packages, without building or running anything."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import output_option, refuse_to_overwrite, write_output
from rebsync.cli.status import Status, status_of
from rebsync.diagnostics import RebsyncError
from rebsync.terminal import json_text, lines_text, say

if TYPE_CHECKING:
    from rebsync.rosgraph.analysis import AnalysedGraph
    from rebsync.rosgraph.ends import PackageCode
    from rebsync.rosgraph.findings import GraphFinding
    from rebsync.rosgraph.picture import Picture

FORMATS = ("text", "html", "svg", "dot", "mermaid", "json", "sarif", "github")
_OF_FINDINGS = ("sarif", "github")


@click.command("graph")
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option(
    "--launch", metavar="FILE", help="The nodes that a launch file starts, not all that is read."
)
@click.option(
    "--diff", "revision", metavar="REV", help="What is different since a revision of git."
)
@click.option(
    "--format",
    "style",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="html: a page to search; svg, dot, mermaid: a drawing; sarif, github: findings only.",
)
@output_option
def command(
    paths: tuple[str, ...], launch: str | None, revision: str | None, style: str, output: str
) -> Status:
    """Draw the nodes of packages with their topics, services and actions, and what is wrong there.

    PATH is a package or a directory with several. Nothing is built or run. Exit status: 0 no
    findings but notes, 1 findings; with --diff 0 no difference, 1 differences; 2 nothing read.
    """
    from rebsync.report import print_report, report
    from rebsync.rosgraph.findings import diagnostics
    from rebsync.rosgraph.picture import changes, merged, picture_of

    for path in paths:
        refuse_to_overwrite(path, output)
    now = _now(paths, launch)
    picture, findings = picture_of(now.graph), list(now.findings)
    if revision is not None:
        before = _before(paths, now.launch, revision)
        picture = merged(picture_of(before.graph), picture)
        told = {(f.code, f.message) for f in before.findings}
        findings = [f for f in findings if (f.code, f.message) not in told]
    listed = diagnostics(findings)
    if style in _OF_FINDINGS:
        write_output(output, report(listed, style))
    else:
        write_output(output, _drawn(picture, findings, style, is_diff=revision is not None))
        if style == "text":
            print_report(listed, sys.stderr)
        elif findings and style not in ("html", "json"):
            say(f"{len(findings)} findings; --format text lists them", err=True)
    if revision is not None:
        return Status.FINDINGS if any(changes(picture)) else Status.CLEAN
    return status_of(listed)


def _now(paths: Sequence[str], launch: str | None) -> AnalysedGraph:
    from rebsync.reverse.build.workspace import in_workspace
    from rebsync.reverse.files.parallel import each
    from rebsync.reverse.files.reading import all_listings
    from rebsync.rosgraph.analysis import analysed
    from rebsync.rosgraph.reading import read_package

    packages: list[PackageCode] = list(each(in_workspace(all_listings(paths)), read_package))
    if not any(package.nodes for package in packages):
        raise RebsyncError.of(
            paths[0], "RS943", "no code that asks ROS for anything was found here"
        )
    return analysed(packages, ", ".join(paths), launch)


def _before(paths: Sequence[str], launch: str | None, revision: str) -> AnalysedGraph:
    """The same as of a revision; without nodes where it has no such launch file."""
    from rebsync.rosgraph.analysis import analysed
    from rebsync.rosgraph.launching import LaunchFiles
    from rebsync.rosgraph.revision import packages_of_revision

    packages = packages_of_revision(revision, paths)
    if launch is not None and LaunchFiles(packages).named(launch) is None:
        return analysed([], revision)
    return analysed(packages, revision, launch)


def _drawn(picture: Picture, findings: Sequence[GraphFinding], style: str, *, is_diff: bool) -> str:
    match style:
        case "html":
            from rebsync.rosgraph.page import graph_page

            return graph_page(picture, findings)
        case "svg":
            from rebsync.rosgraph.svg import as_svg

            return as_svg(picture)
        case "dot":
            from rebsync.rosgraph.dot import as_dot

            return as_dot(picture)
        case "mermaid":
            from rebsync.rosgraph.dot import as_mermaid

            return as_mermaid(picture)
        case "json":
            from rebsync.rosgraph.data import graph_data

            return json_text(graph_data(picture, findings), indent=2) + "\n"
        case _:
            from rebsync.rosgraph.text import change_lines, lines

            return lines_text(change_lines(picture) if is_diff else lines(picture))
