"""`rebsync generate`: write the ROS package of a model."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import click

from rebsync.cli.options import write_output
from rebsync.cli.status import Status
from rebsync.config import TARGETS, Config, settings_beside
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import followed, operating_on, read_source
from rebsync.locking import alone_in
from rebsync.report import print_report
from rebsync.roundtrip.package.manifest import FOLDER, MANIFEST
from rebsync.roundtrip.package.model_file import former_packages, remember
from rebsync.roundtrip.package.seals import attest, is_attested
from rebsync.roundtrip.sync.plan import Action, Step, aside, name_to_keep, plan
from rebsync.roundtrip.sync.shared_plan import shared_steps
from rebsync.source import NOWHERE, Source
from rebsync.stamps import Stamps, stamps
from rebsync.terminal import say, say_lines
from rebsync.writing import replace_tree

_SHOWN = (Action.CREATE, Action.UPDATE, Action.MERGE, Action.DELETE)


@click.command("generate")
@click.argument("model", metavar="MODEL")
@click.option(
    "-o",
    "--output",
    default=".",
    metavar="DIR",
    help="Where the package's folder goes (default: here).",
)
@click.option(
    "--target",
    type=click.Choice(TARGETS),
    help="The dialect of the code (default: that of the settings, else ros1-cpp).",
)
@click.option("--monitor", is_flag=True, help="A node that compares a run with the model as well.")
@click.option(
    "--runtime",
    type=click.Choice(("own", "package")),
    help="Where the run-time part is: in the package, or in `rebsync_runtime` beside it (default: "
    "that of the settings, else own).",
)
@click.option("--list", "only_list", is_flag=True, help="List the files; write nothing.")
@click.option("--diff", "only_diff", is_flag=True, help="Show what would change; write nothing.")
@click.option(
    "--force", is_flag=True, help="Overwrite files edited by hand, keeping each as FILE.orig."
)
def command(
    model: str,
    output: str,
    target: str | None,
    monitor: bool,
    runtime: str | None,
    only_list: bool,
    only_diff: bool,
    force: bool,
) -> Status:
    """Write the ROS package of a model to DIR/<package>.

    Settings come from `rebsync.toml` beside the model. Files edited by hand are never overwritten
    silently.
    """
    if sum((only_list, only_diff, force)) > 1:
        raise click.UsageError("--list, --diff and --force exclude each other")
    if output in ("", "-"):
        raise click.UsageError(f'-o names a directory, not "{output}"')
    _, config = settings_beside(model)
    if target is not None:
        config = replace(config, target=target)
    if monitor:
        config = replace(config, monitor=True)
    if runtime is not None:
        config = replace(config, shared_runtime=runtime == "package")
    source = read_source(model)
    name, files = package_files(source, config, output)
    folder = Path(output) / name
    _real(folder)
    files = _with_accepted(folder, files)
    shared = shared_steps(folder, config)
    if only_list:
        say_lines(str(folder / path) for path in sorted(files))
        say_lines(str(Path(output) / step.path) for step in shared)
        return Status.CLEAN
    if only_diff:
        return _show((*plan(folder, files), *shared))
    if not force and (edited := [s for s in shared if s.action is Action.CONFLICT]):
        print_report([_refusal(Path(output), s) for s in edited], sys.stderr)
        return Status.FINDINGS
    with alone_in(str(folder)):
        if not force:
            _refuse_another_model(str(folder), model)
        if not (folder / FOLDER).exists():
            print_report(former_packages(str(folder), model), sys.stderr)
        before = stamps(str(folder))
        status = _merged(folder, plan(folder, files), source, force, before)
    if status is Status.CLEAN:
        attest(files[MANIFEST])
        remember(str(folder), files[MANIFEST], model)
        _write_shared(Path(output), shared)
    return status


def _real(folder: Path) -> str:
    """Where the package is, or is to be.

    RebsyncError: it is a link that leads out of its repository, or else of the directory it is in.
    """
    with operating_on(str(folder)):
        if folder.is_symlink():
            return followed(str(folder), str(folder.parent))
        return os.path.realpath(folder)


def _merged(
    folder: Path, steps: tuple[Step, ...], source: Source, force: bool, before: Stamps
) -> Status:
    """Writes the files, if what is merged with edits says what the model says."""
    if any(step.action in (Action.KEEP, Action.MERGE) for step in steps):
        from rebsync.roundtrip.sync.plan_check import wrong_in

        wrong = wrong_in(folder, steps, source)
        if wrong and not force:
            print_report(wrong, sys.stderr)
            say(f"{folder}: nothing was written", err=True)
            return Status.FINDINGS
        steps = tuple(aside(step) for step in steps) if wrong else steps
    return _write(folder, steps, force, before)


def _with_accepted(folder: Path, files: dict[str, str]) -> dict[str, str]:
    """The files with what the manifest that is there says of edits by hand."""
    from rebsync.roundtrip.package.record import read_record, with_accepted

    with suppress(RebsyncError):
        record = read_record(str(folder))
        in_step = record.in_step if is_attested(str(folder)) else ""
        if record.accepted or in_step:
            manifest = with_accepted(files[MANIFEST], record.accepted, in_step)
            return {**files, MANIFEST: manifest}
    return files


def _stem(path: str) -> str:
    return Path(path).stem if path != "-" else "model"


def _refuse_another_model(folder: str, model: str) -> None:
    """Two models of one package name must not replace each other's code."""
    from rebsync.roundtrip.package.model_file import other_model

    other = other_model(folder, model, f"{_stem(model)}.rebeca")
    if other is not None:
        raise RebsyncError.of(
            folder,
            "RS708",
            f"this package was made from {other}, not from {model}; nothing was written",
            "choose another `package` in rebsync.toml; if this is its model from now on,"
            f" `rebsync sync --model {model} {folder}`",
        )


def package_files(source: Source, config: Config, output: str = ".") -> tuple[str, dict[str, str]]:
    """The package's name and all its files, `.rebsync/` included; warnings go to stderr.

    `output` is the directory that the package's folder goes to.
    """
    from rebsync.forward.generate import generate, package_name
    from rebsync.forward.limits import limits
    from rebsync.grammars.parser import parse_model
    from rebsync.roundtrip.package.discovery import path_to_model
    from rebsync.roundtrip.package.manifest import with_manifest
    from rebsync.static import analyse

    parsed = parse_model(source)
    analysis = analyse(parsed.model, incomplete=not parsed.ok)
    findings = Findings(source, (*parsed.diagnostics, *analysis.diagnostics))
    if findings.errors:
        raise RebsyncError([Findings(source, findings.errors)])
    stem = _stem(source.path)
    found = limits(parsed.model, analysis, config, stem)
    if any(d.severity is Severity.ERROR for d in found):
        raise RebsyncError([Findings(source, found)])
    if found:
        print_report([Findings(source, found)], sys.stderr)
    files = generate(parsed.model, parsed.comments, analysis, config, stem)
    name = package_name(stem, config)
    file = f"{stem}.rebeca"
    path = path_to_model(source.path, str(Path(output, name)), file)
    return name, with_manifest(files, file, source.text, config, path)


def _write_shared(output: Path, steps: tuple[Step, ...]) -> None:
    """Writes the run-time part that packages share, and keeps what somebody has edited."""
    texts = {s.path: s.new for s in steps if s.action is not Action.UNCHANGED and s.new is not None}
    edited = {name_to_keep(output, s): s.old for s in steps if s.action is Action.CONFLICT}
    texts |= {kept: old for kept, old in edited.items() if old is not None}
    if not steps:
        return
    written = replace_tree(str(output), texts) if texts else []
    say(f"{output / runtime_name(steps)}: {len(steps)} files, {len(written)} of them written")


def runtime_name(steps: tuple[Step, ...]) -> str:
    """The package that the run-time part is."""
    return min(step.path.partition("/")[0] for step in steps)


def _show(steps: tuple[Step, ...]) -> Status:
    changes = [s for s in steps if s.action in (*_SHOWN, Action.CONFLICT)]
    for step in changes:
        if not step.path.startswith(".rebsync/"):
            write_output("-", step.diff())
    return Status.FINDINGS if changes else Status.CLEAN


def _write(folder: Path, steps: tuple[Step, ...], force: bool, before: Stamps) -> Status:
    conflicts = [s for s in steps if s.action is Action.CONFLICT]
    if conflicts and not force:
        print_report([_refusal(folder, s) for s in conflicts], sys.stderr)
        return Status.FINDINGS
    kept = {s.path: name_to_keep(folder, s) for s in conflicts}
    texts = {kept[s.path]: s.old for s in conflicts if s.old is not None}
    texts |= {s.path: s.new for s in steps if s.new is not None and s.action is not Action.KEEP}
    remove = [s.path for s in steps if s.new is None]

    def refuse_changed() -> None:
        before.refuse_changed(str(folder / path) for path in (*texts, *remove))

    written = replace_tree(
        str(folder), texts, remove=remove, ready=refuse_changed, real=_real(folder)
    )
    own = [path for path in written if not path.startswith(".rebsync/")]
    total = sum(not s.path.startswith(".rebsync/") and s.new is not None for s in steps)
    say(f"{folder}: {total} files, {len(own)} of them written")
    for step in steps:
        if step.action is Action.KEEP:
            say(f"kept {folder / step.path}, which is not as generated")
        if step.action is Action.MERGE:
            say(f"merged with your edit of {folder / step.path}")
    for step in conflicts:
        say(f"kept your edit as {folder / kept[step.path]}")
    return Status.CLEAN


def _refusal(folder: Path, step: Step) -> Findings:
    what = "generated anew" if step.new is not None else "generated no more"
    diagnostic = Diagnostic(
        "RS701",
        NOWHERE,
        f"this file was edited by hand and is now {what}; nothing was written",
        "see --diff; `rebsync sync` marks what touches; with --force it is kept as FILE.orig",
    )
    return Findings(Source(str(folder / step.path), ""), (diagnostic,))
