"""Brings a package and its model in step: what each has changed goes into the other.

All is worked out in memory; nothing is written here.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from rebsync import model as m
from rebsync.config import Config, config_of_record, settings_beside
from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import read_source, source_below
from rebsync.records import dataclass
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import (
    Comparison,
    Place,
    Renamed,
    Undetermined,
    finding,
)
from rebsync.roundtrip.diff.equivalence import compare_with_code, without_equivalent
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.check import read_with, wrongly_merged
from rebsync.roundtrip.merge.code import Stages, ancestors, merged_code
from rebsync.roundtrip.merge.consequences import consequent_files
from rebsync.roundtrip.merge.models import Compared, Favour, as_code_says, merged_model
from rebsync.roundtrip.merge.moved_files import moved_files
from rebsync.roundtrip.package.digests import is_text_of
from rebsync.roundtrip.package.generation import generated
from rebsync.roundtrip.package.manifest import BASE, BASE_MODEL, FOLDER, MANIFEST, with_manifest
from rebsync.roundtrip.package.model_file import is_recorded, properties_beside
from rebsync.roundtrip.package.models import CodeModel, parsed, read_code, read_model
from rebsync.roundtrip.package.record import (
    Record,
    conflict_in,
    read_record,
    recorded_base,
    with_accepted,
)
from rebsync.roundtrip.package.state import is_base_whole
from rebsync.roundtrip.sync.records import with_what_holds
from rebsync.roundtrip.sync.result import Sync
from rebsync.roundtrip.verdict.drift import Mover
from rebsync.roundtrip.verdict.missing_sources import MissingSources, is_of_file
from rebsync.roundtrip.verdict.result import CheckResult
from rebsync.source import NOWHERE, Source
from rebsync.terminal import encoded

_SETTLED = ("RS955", "RS964", "RS965")  # what is put right by writing the records


def synced(checked: CheckResult, favour: Favour) -> Sync:
    """What brings a package in step. RebsyncError: it cannot be worked out."""
    record = checked.record or read_record(checked.package.root)
    asks_again = any(d.code in _SETTLED for f in checked.findings for d in f.diagnostics)
    is_placed = is_recorded(checked.package.root, record, checked.model)
    if checked.drift is None and is_placed and not asks_again:
        return Sync(checked, findings=checked.findings)
    syncing = _Syncing(checked, record, favour, Compared())
    try:
        return syncing.unless_torn(with_what_holds(syncing.result()))
    except RebsyncError as error:
        if not all(d.code == "RS967" for f in error.findings for d in f.diagnostics):
            raise
        if not read_code(checked.package, checked.state).given.unread:
            raise
        return Sync(checked, refused=tuple(error.findings), is_undetermined=True)


def makes_no_model(checked: CheckResult) -> tuple[Findings, ...]:
    """Why what code and model have changed makes no model, so that `synced` would refuse it."""
    record = checked.record or read_record(checked.package.root)
    syncing = _Syncing(checked, record, Favour.MARKERS, Compared())
    today, code = read_model(checked.model), read_code(checked.package, checked.state).given
    try:
        base = syncing._base(today)
        syncing._of_code(base or today, today, code)
        merged = merged_model(base, today, code, syncing.favour, syncing.compared)
        if not merged.conflicts:
            _parsed(Source(today.source.path, merged.text))
    except RebsyncError as error:
        told = (d for f in error.findings for d in f.diagnostics)
        return tuple(error.findings) if all(d.code == "RS967" for d in told) else ()
    return ()


@dataclass(frozen=True, slots=True, eq=False)
class _Syncing:
    checked: CheckResult
    record: Record
    favour: Favour
    compared: Compared

    def result(self) -> Sync:
        """Merges the model, then the code, and proves that both say the same then."""
        today = read_model(self.checked.model)
        code = read_code(self.checked.package, self.checked.state)
        left = [f for f in code.findings if any(d.code == "RS966" for d in f.diagnostics)]
        if left:
            raise RebsyncError(left)
        base = self._base(today)
        apart = self.compared(today, code.given)
        gone = MissingSources(self.checked, self.record)
        if refused := (
            *self._unread(apart, code),
            *gone.without_cause(apart, code.given.model),
            *gone.unparsed(),
        ):
            causes = (*filter(is_of_file, self.checked.findings), *gone.files())
            return Sync(self.checked, refused=causes or refused, is_undetermined=True)
        merged = merged_model(base, today, code.given, self.favour, self.compared)
        told = self._of_code(base or today, today, code.given)
        if merged.conflicts:
            return self._left_open(base, today, merged.text, told)
        source = Source(today.source.path, merged.text)
        model = SourcedModel(_parsed(source), source)
        result = self._with_code(today, model, base, told, code.given)
        return replace(result, properties=_properties(base, today, model))

    def unless_torn(self, sync: Sync) -> Sync:
        """The same unless the code has renamed a class and kept its messages and programs.

        These are called after the class, so that those of the new model would not be the code's.
        """
        apart = self.compared(read_model(self.checked.model), self._code)
        renamed = apart.renamed_classes
        if not (renamed and sync.is_undetermined and sync.changes):
            return sync
        places = {d.element.path: d.right for d in apart.differences if isinstance(d, Renamed)}
        refused = []
        for old, new in renamed.items():
            place = places[old] or Place(Source(self.checked.model, ""), NOWHERE)
            message = f"class {old} is {new} in the code, without its files, messages and topics"
            hint = (
                f"call it {old} here again, and {new} in the model: a sync renames all of it then"
            )
            refused.append(finding(place, "RS969", message, hint))
        return Sync(self.checked, findings=self.checked.findings, refused=tuple(refused))

    @property
    def _code(self) -> SourcedModel:
        return read_code(self.checked.package, self.checked.state).given

    # --- what is known --------------------------------------------------------------------------

    def _base(self, today: SourcedModel) -> SourcedModel | None:
        """The model as of the last time in step, if it is still known."""
        if is_base_whole(self.checked.package, self.record):
            return read_model(f"{self.checked.package.root}/{BASE_MODEL}")
        is_same = is_text_of(encoded(today.source.text), self.record.digest)
        return today if is_same else None

    def _of_code(self, base: SourcedModel, today: SourcedModel, code: SourcedModel) -> SourcedModel:
        """The model of last time with all that the code has changed."""
        found = compare_with_code(today, code, base, self.compared)
        text = as_code_says(base, code, found.of_code or found.apart)
        if text == base.source.text:
            return base
        source = Source(base.source.path, text)
        try:
            return SourcedModel(_parsed(source), source)
        except RebsyncError as error:
            raise self._no_model(error, code) from None

    def _no_model(self, error: RebsyncError, code: SourcedModel) -> RebsyncError:
        """The same, at what of the code cannot be read, for the code alone makes no model."""
        place = (
            code.unread[0].place if code.unread else Place(Source(self.checked.model, ""), NOWHERE)
        )
        found = error.findings[0].diagnostics[0]
        if found.code != "RS967":
            return error
        message = "the changes of the code make no model"
        told = replace(found, span=place.span, message=message)
        return RebsyncError([Findings(place.source, (told,))])

    def _unread(self, apart: Comparison, code: CodeModel) -> Iterator[Findings]:
        """Elements that the code has changed, and of which not all could be read.

        How a server's messages are made and taken apart is such a part of what it takes.
        """
        drift = self.checked.drift
        movers = dict(drift.differences) if drift is not None else {}
        changed = {
            d.element
            for d in apart.differences
            if not isinstance(d, Undetermined) and movers.get(d) is not Mover.MODEL
        }
        hints = {(f.source.path, d.span): d.hint for f in code.findings for d in f.diagnostics}
        is_sent_otherwise = any(e.kind == "parameter" for e in changed)
        for difference in apart.differences:
            if not isinstance(difference, Undetermined):
                continue
            element = difference.element
            if element in changed or (is_sent_otherwise and element.kind == "model"):
                place = difference.right or Place(code.given.source, NOWHERE)
                is_it = element in changed
                how = "was changed in the code" if is_it else "is of messages that have changed"
                message = f"{element} {how} and cannot be taken into the model: {difference.why}"
                hint = hints.get((place.source.path, place.span))
                yield finding(place, "RS959", message, hint or "write it so that extract reads it")

    # --- results --------------------------------------------------------------------------------

    def _left_open(
        self, base: SourcedModel | None, today: SourcedModel, text: str, told: SourcedModel
    ) -> Sync:
        """The model with conflict markers; the code stays as it is.

        What the code says is in the model then, so that it is what both are compared with next.
        """
        last = base.source.text if base is not None else ""
        stages = {"": Stages(last, today.source.text, _theirs(text))}
        records = self._records(told, self._generated(told, _config_of(self.record)))
        return Sync(
            self.checked,
            text,
            records=records,
            conflicts=stages,
            findings=self.checked.findings,
        )

    def _with_code(
        self,
        today: SourcedModel,
        model: SourcedModel,
        base: SourcedModel | None,
        told: SourcedModel,
        code: SourcedModel,
    ) -> Sync:
        options = _config_of(self.record)
        now = self._generated(model, self._config(), self._name)
        recorded = self._recorded() if base is not None else {}
        base = base or today
        before = self._generated(base, options)
        is_as_base = told.source.text == base.source.text
        of_code = before if is_as_base else self._generated(told, options)
        last = ancestors(recorded, before, of_code)
        moved = moved_files(self.checked.state, self.record)
        root = self.checked.package.root
        followed = {p: before[p] for p in consequent_files(root, recorded, before, of_code)}
        merged = merged_code(root, {**last, **followed}, now, self.favour, moved, recorded)
        findings = tuple(f for f in self.checked.findings if not _is_settled(f))
        if merged.refused:
            return Sync(self.checked, findings=findings, refused=merged.refused)
        new_text = model.source.text if model.source.text != today.source.text else None
        if merged.conflicts:
            records = self._records(told, last)
            return Sync(self.checked, new_text, merged.texts, records, merged.conflicts, findings)
        records = self._records(model, now, self._name)
        result = Sync(self.checked, new_text, merged.texts, records, {}, findings)
        return self._proved(result, model, self.compared(today, code), code)

    def _proved(
        self, sync: Sync, model: SourcedModel, before: Comparison, code: SourcedModel
    ) -> Sync:
        """The same if merged code says what the merged model says; `before` is how they stood."""
        findings = sync.findings
        if sync.texts:
            again = read_with(self.checked.state.listing, sync.texts)
            code, findings = again.given, (*filter(_is_of_records, findings), *again.findings)
        proof, _ = without_equivalent(compare(model, code), model, code)
        unread = {d.element for d in before.differences if isinstance(d, Undetermined)}
        if wrong := tuple(wrongly_merged(proof, unread, "take one side with --conflict")):
            return Sync(self.checked, findings=findings, refused=wrong)
        texts = {path: text for path, text in sync.texts.items() if self._differs(path, text)}
        unknown = proof.is_undetermined or _has_unread(findings)
        return replace(sync, texts=texts, findings=findings, is_undetermined=unknown)

    def _recorded(self) -> dict[str, str]:
        """The texts that were generated last time, as far as they are those of the manifest.

        Where a sync was killed among the records, some are older.
        """
        wanted = self.record.files
        texts = recorded_base(self.checked.package.root, BASE).items()
        return {n: t for n, t in texts if is_text_of(encoded(t), wanted.get(n, ""))}

    def _differs(self, path: str, text: str | None) -> bool:
        source = source_below(self.checked.package.root, path)
        return text != (source.text if source is not None else None)

    # --- generation -----------------------------------------------------------------------------

    def _config(self) -> Config:
        """Today's settings, for the dialect that the package is in, with its monitor if any."""
        from rebsync.forward.generate import package_name

        source, config = settings_beside(self.checked.model)
        old = package_name(Path(self.record.model).stem, _config_of(self.record))
        new = package_name(Path(self._name).stem, config)
        if old != new:
            message = f"the package was {old} when its code was generated, and is {new} now"
            hint = "`rebsync generate` writes the new package beside the old one"
            raise RebsyncError.of(source.path, "RS955", message, hint)
        last = _config_of(self.record)
        is_shared = config.shared_runtime or last.shared_runtime
        monitor = config.monitor or last.monitor
        return replace(config, target=last.target, monitor=monitor, shared_runtime=is_shared)

    @property
    def _name(self) -> str:
        """The name of the model from now on: that of its file, if the package keeps its own so."""
        from rebsync.forward.generate import package_name

        now, last = Path(self.checked.model), Path(self.record.model)
        _, config = settings_beside(self.checked.model)
        old = package_name(last.stem, _config_of(self.record))
        is_kept = now.suffix == last.suffix and package_name(now.stem, config) == old
        return now.name if is_kept else self.record.model

    def _generated(
        self, given: SourcedModel, config: Config, name: str | None = None
    ) -> dict[str, str]:
        return generated(given.source, config, Path(name or self.record.model).stem)

    def _records(
        self, given: SourcedModel, files: Mapping[str, str], name: str | None = None
    ) -> dict[str, str | None]:
        """All of `.rebsync/` for a model and what was generated for it."""
        from rebsync.roundtrip.package.discovery import path_to_model

        root = self.checked.package.root
        name = name or self.record.model
        path = path_to_model(self.checked.model, root, name)
        whole = with_manifest(files, name, given.source.text, self._config(), path)
        records: dict[str, str | None] = {
            name: text for name, text in whole.items() if name.startswith(f"{FOLDER}/")
        }
        records[MANIFEST] = with_accepted(whole[MANIFEST], self.record.accepted)
        for name in recorded_base(root, BASE):
            records.setdefault(BASE + name, None)
        return records


# --- parts --------------------------------------------------------------------------------------


def _properties(base: SourcedModel | None, today: SourcedModel, merged: SourcedModel) -> str | None:
    """The new text of the property file beside a model; None where it stays as it is."""
    path = properties_beside(today.source.path)
    if path is None:
        return None
    from rebsync.roundtrip.merge.properties import renamed_properties

    source = read_source(path)
    text = renamed_properties(source, base, today, merged)
    return text if text != source.text else None


def _parsed(source: Source) -> m.Model:
    if conflict_in(source) is not None:
        return parsed(source)
    from rebsync.roundtrip.merge.models import parsed_again

    return parsed_again(source)


def _theirs(text: str) -> str:
    from rebsync.roundtrip.merge.text import decided

    return decided(text, ("model", "code"), False)


def _config_of(record: Record) -> Config:
    """The settings with which a package was generated."""
    return config_of_record(record.options) or Config()


def _is_settled(found: Findings) -> bool:
    """Whether a finding is about what is put right by this."""
    return all(d.code in (*_SETTLED, "RS970") for d in found.diagnostics)


def _is_of_records(found: Findings) -> bool:
    """Whether a finding is not about what code can be read."""
    return not any(d.code in ("RS941", "RS942", "RS943", "RS947") for d in found.diagnostics)


def _has_unread(findings: tuple[Findings, ...]) -> bool:
    return any(d.code == "RS941" for f in findings for d in f.diagnostics)


def relative(path: str, root: str) -> str:
    """A path from a package's folder."""
    return Path(os.path.relpath(path, root)).as_posix()
