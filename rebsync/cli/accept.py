"""`rebsync accept`: what no verdict can be given on was looked at, and is as it is to be."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import replace

import click

from rebsync.cli.status import Status
from rebsync.diagnostics import RebsyncError
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import ACCEPTED
from rebsync.roundtrip.verdict.acceptance import acceptable, entries_text, read_entries
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.result import AcceptedFinding
from rebsync.terminal import named, one_line, say
from rebsync.writing import replace_tree

_PLACE = re.compile(r"(.+?):(\d+)(?::\d+)?:?\Z")


@click.command("accept")
@click.argument("findings", metavar="[FINDING...]", nargs=-1)
@click.option("--reason", metavar="TEXT", help="Why it is as it is to be; others will read this.")
@click.option("--list", "is_list", is_flag=True, help="List what was accepted; change nothing.")
def command(findings: tuple[str, ...], reason: str | None, is_list: bool) -> Status:
    """Accept places of which `rebsync check` can give no verdict.

    FINDING is FILE:LINE, as `rebsync check` prints it. With --list it is a package, as for `check`.
    """
    if is_list:
        for package in find(findings or (".",)):
            _list(package)
        return Status.CLEAN
    if not findings:
        raise click.UsageError("name what is to be accepted, as FILE:LINE")
    if reason is None or not reason.strip():
        raise click.UsageError("say with --reason why it is as it is to be")
    wanted: dict[str, tuple[ManagedPackage, set[tuple[str, int]]]] = {}
    for finding in findings:
        path, line = _place(finding)
        (package,) = find((path,))
        wanted.setdefault(package.root, (package, set()))[1].add((os.path.realpath(path), line))
    chosen = [(package, list(_found(package, places))) for package, places in wanted.values()]
    for package, entries in chosen:
        _write(package, [replace(entry, reason=reason.strip()) for entry in entries])
    return Status.CLEAN


def _place(finding: str) -> tuple[str, int]:
    found = _PLACE.match(finding)
    if found is None:
        raise click.UsageError(f'"{finding}" is no FILE:LINE, as `rebsync check` tells it')
    return found[1], int(found[2])


def _list(package: ManagedPackage) -> None:
    for entry in read_entries(package.root):
        say(f"{named(package.root)}/{entry.path}: {entry.code} {one_line(entry.finding)}")
        say(f"  {one_line(entry.reason)}")


def _found(package: ManagedPackage, places: set[tuple[str, int]]) -> Iterator[AcceptedFinding]:
    """The entries for some lines of a package. RebsyncError: there is nothing to accept."""
    left = set(places)
    for found, each, entry in acceptable(check(package)):
        line = found.source.position(each.span.start).line
        key = os.path.realpath(found.source.path), line
        if key in places:
            left.discard(key)
            yield entry
    for path, line in sorted(left):
        message = f"there is nothing in line {line} of it that may be accepted"
        hint = "only what `rebsync check` cannot tell is; for differences there is `rebsync sync`"
        raise RebsyncError.of(os.path.relpath(path), "RS946", message, hint)


def _write(package: ManagedPackage, entries: list[AcceptedFinding]) -> None:
    old = [e for e in read_entries(package.root) if e.key not in {each.key for each in entries}]
    replace_tree(package.to_write(), {ACCEPTED: entries_text([*old, *entries])})
    for entry in entries:
        say(f"accepted {named(package.root)}/{entry.path}: {entry.code} {one_line(entry.finding)}")
