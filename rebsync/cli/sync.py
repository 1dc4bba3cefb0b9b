"""`rebsync sync`: bring packages and their models in step."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import write_output
from rebsync.cli.status import Status, status_of, worst
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.files import read_source
from rebsync.locking import alone_in
from rebsync.patches import patch
from rebsync.report import print_report
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.verdict.check import check_merged
from rebsync.source import NOWHERE, Source
from rebsync.stamps import Stamps, stamps
from rebsync.terminal import named, say
from rebsync.writing import told

if TYPE_CHECKING:
    from rebsync.roundtrip.sync.result import Sync


@click.command("sync")
@click.argument("paths", metavar="[PATH...]", nargs=-1)
@click.option("--model", metavar="FILE", help="The model, where it is not found by itself.")
@click.option(
    "--conflict",
    type=click.Choice(["markers", "ours", "theirs"]),
    default="markers",
    show_default=True,
    help="Where both changed one element: mark it, or take the model's (ours) or the code's side.",
)
@click.option("--dry-run", is_flag=True, help="Show what would change; write nothing.")
def command(paths: tuple[str, ...], model: str | None, conflict: str, dry_run: bool) -> Status:
    """Bring packages and the models that they were made from in step.

    What the model has changed is generated into the code, edits by hand being kept; what the code
    has changed is put into the model's own text. PATH is a package, a directory with several, a
    file in a package, or a model; the current directory if none is given. Exit status: 0 in step,
    1 a conflict is left or nothing could be merged, 2 something cannot be read, 4 undetermined.
    """
    packages = list(find(paths or (".",), model))
    return worst([_one(package, conflict, dry_run) for package in packages])


def _one(package: ManagedPackage, conflict: str, dry_run: bool) -> Status:
    try:
        package.to_write()
        if dry_run:
            return _shown(_worked_out(package, conflict))
        models = _models_of(package)
        with alone_in(package.root, *models):
            before = stamps(package.root, *models, *_beside(models))
            return _done(_worked_out(package, conflict), before)
    except RebsyncError as error:
        print_report(error.findings, sys.stderr)
        unmerged = {"RS955", "RS967"}
        return (
            Status.FINDINGS
            if all(d.code in unmerged for f in error.findings for d in f.diagnostics)
            else Status.UNUSABLE
        )
    except RecursionError:
        why = "something in it nests deeper than rebsync reads"
        print_report(RebsyncError.of(package.root, "RS111", why).findings, sys.stderr)
        return Status.UNUSABLE


def _models_of(package: ManagedPackage) -> tuple[str, ...]:
    """The model, which is to be written as well, if it is found."""
    from rebsync.roundtrip.package.model_file import model_of
    from rebsync.roundtrip.package.record_merge import read_merged_record

    try:
        return (package.model or model_of(package, read_merged_record(package.root)),)
    except RebsyncError:
        return ()  # what is wrong is told when it is worked out


def _beside(models: tuple[str, ...]) -> Iterator[str]:
    """The property files of models."""
    from rebsync.roundtrip.package.model_file import properties_beside

    return filter(None, map(properties_beside, models))


def _worked_out(package: ManagedPackage, conflict: str) -> Sync:
    from rebsync.roundtrip.merge.models import Favour
    from rebsync.roundtrip.sync.sync import synced

    return synced(check_merged(package), Favour(conflict))


def _done(sync: Sync, before: Stamps) -> Status:
    """Writes it, and tells what was done."""
    root = sync.checked.package.root
    if sync.refused:
        return _refused(sync)
    from rebsync.roundtrip.sync.writing import write

    written = write(sync, before)
    for path in written:
        say(f"wrote {told(path)}" if Path(path).exists() else f"deleted {path}")
    print_report(sync.findings, sys.stderr)
    if sync.conflicts:
        sys.stdout.flush()
        print_report([_open(sync, path) for path in sync.conflicts], sys.stderr)
        return Status.FINDINGS
    status = _status(sync)
    if sync.is_joined_otherwise:
        say(f"{named(root)}: nodes are joined otherwise than {sync.checked.model} says")
    elif status is Status.UNDETERMINED:
        say(f"{named(root)}: as far as the code can be read, in step with {sync.checked.model}")
    else:
        say(f"{named(root)}: in step with {sync.checked.model}")
    return status


def _shown(sync: Sync) -> Status:
    """Shows the changes as a patch."""
    if sync.refused:
        return _refused(sync)
    write_output("-", "".join(_patch(sync)))
    sys.stdout.flush()
    print_report(sync.findings, sys.stderr)
    print_report([_open(sync, path) for path in sync.conflicts], sys.stderr)
    status = _status(sync)
    return worst([status, Status.FINDINGS if sync.changes else Status.CLEAN])


def _patch(sync: Sync) -> Iterator[str]:
    changes: dict[str, str | None] = {**sync.beside}
    changes |= {f"{sync.checked.package.root}/{p}": t for p, t in sync.texts.items()}
    for path, text in changes.items():
        exists = Path(path).is_file()
        old = read_source(path).text if exists else ""
        before = f"a/{path}" if exists else "/dev/null"
        yield patch(old, text or "", before, f"b/{path}" if text is not None else "/dev/null")


def _refused(sync: Sync) -> Status:
    print_report(sync.findings, sys.stderr)
    print_report(sync.refused, sys.stderr)
    say(f"{named(sync.checked.package.root)}: nothing was written", err=True)
    return Status.UNDETERMINED if sync.is_undetermined else Status.FINDINGS


def _status(sync: Sync) -> Status:
    found = [status_of(f for f in sync.findings if not _is_unread(f))]
    found.append(Status.FINDINGS if sync.conflicts else Status.CLEAN)
    found.append(Status.UNDETERMINED if sync.is_undetermined else Status.CLEAN)
    return worst(found)


def _is_unread(found: Findings) -> bool:
    return all(d.code == "RS941" for d in found.diagnostics)


def _open(sync: Sync, path: str) -> Findings:
    where = f"{sync.checked.package.root}/{path}" if path else sync.checked.model
    message = "model and code have changed the same here, each in its own way"
    hint = "decide between the conflict markers, then `rebsync sync` again; or use --conflict"
    return Findings(Source(where, ""), (Diagnostic("RS966", NOWHERE, message, hint),))
