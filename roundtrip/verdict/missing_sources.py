"""What the code lacks only because a file is gone, or not all of it can be read."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.files import read_source
from rebsync.records import dataclass
from rebsync.reverse.files.packages import MANIFEST
from rebsync.reverse.syntax.unparsed import NO_CPP, NO_PYTHON
from rebsync.roundtrip.diff.difference import (
    Aspect,
    Changed,
    Comparison,
    Difference,
    Place,
    Removed,
    finding,
)
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.verdict.drift import Mover
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.roundtrip.verdict.result import CheckResult

_LAUNCH = (".launch", ".launch.py")
_LAUNCHING = re.compile(r".*\.launch(?:\.py)?\Z")
_PROGRAM = re.compile(r"(?:.*/)?\w+_node(?:\.cpp|\.py)?\Z")
_HINT = "put back what is missing, or take out by hand all that belongs to it"
_SAID = frozenset({Aspect.ARGUMENT, Aspect.BINDING, Aspect.INITIAL})
_REMARK = re.compile(r'"""[\s\S]*?"""|/\*[\s\S]*?\*/|(?:#|//)[^\n]*')


@dataclass(frozen=True, slots=True)
class MissingSources:
    """What a package has lost since it was generated, if what it says is taken as it is."""

    checked: CheckResult
    record: Record

    def without_cause(self, apart: Comparison, code: m.Model) -> Iterator[Findings]:
        """Why classes and rebecs that the code lacks are not to be taken out of the model.

        A launch file is gone, starts nothing or is not read as a whole, a file cannot be read at
        all, or a generated program still runs the class.
        """
        removed = [d.element for d in apart.differences if self._is_by_code(d)]
        rebecs = [e for e in removed if e.kind == "rebec"]
        classes = [e.path for e in removed if e.kind in ("reactiveclass", "interface")]
        yield from self._unread_system(apart)
        if rebecs or classes:
            yield from filter(is_of_file, self.checked.findings)
        if rebecs:
            yield from (f for f in self.files() if f.source.path.endswith(_LAUNCH))
            if code.main is None or not code.main.rebecs:
                message = "no rebec is started here, and the model has some"
                yield from self._at(self._generated(_LAUNCHING), message)
        for name in classes:
            message = f"this runs {name}, and no class of that name is read"
            yield from self._at(self._running(name), message)

    def _unread_system(self, apart: Comparison) -> Iterator[Findings]:
        """What of the launch file is not known, where rebecs or constants seem to be gone.

        They may be there: a loop starts nodes, a file of another package sets parameters.
        """
        if not any(self._is_of_system(d) for d in apart.differences):
            return
        from rebsync.reverse.files.reading import read
        from rebsync.reverse.nodes.node_launch import system_of
        from rebsync.reverse.scaffold.facts import package_name
        from rebsync.roundtrip.package.units import as_one

        listing = as_one(self.checked.state.listing)
        package = package_name(listing.files.get(MANIFEST, ""))
        system = system_of(read(listing).files, package)
        for unknown in system.launch.unknowns if system is not None else ():
            message = (
                f"{unknown.what} is not known ({unknown.why}), so nothing that the launch file"
            )
            message += " may say is taken out of the model"
            hint = "write it in a way that can be read, or change the model by hand as well"
            yield finding(Place(unknown.source, unknown.span), "RS959", message, hint)

    def _is_of_system(self, difference: Difference) -> bool:
        """Whether it is the code that lacks something that a launch or parameter file says."""
        if difference.element.kind not in ("rebec", "env"):
            return False
        if isinstance(difference, Changed) and difference.aspect in _SAID:
            return self._mover(difference) is not Mover.MODEL
        return self._is_by_code(difference)

    def unparsed(self) -> Iterator[Findings]:
        """Files that do not parse, where the code seems to lack what may be in these."""
        if any(self._is_by_code(d) for d in self._differences()):
            for found in self.checked.findings:
                told = tuple(d for d in found.diagnostics if is_mistake(d))
                if told:
                    yield Findings(found.source, told)

    def _differences(self) -> Iterator[Difference]:
        drift = self.checked.drift
        return (d for d, _ in drift.differences) if drift is not None else iter(())

    def files(self) -> Iterator[Findings]:
        """Generated files that are not there."""
        for name in self.checked.state.missing:
            place = Place(Source(f"{self.checked.package.root}/{name}", ""), NOWHERE)
            hint = "`rebsync generate` writes it anew"
            yield finding(place, "RS969", "this generated file is not there", hint)

    def _is_by_code(self, difference: Difference) -> bool:
        """Whether it is the code that lacks an element, and not the model that has one more."""
        return isinstance(difference, Removed) and self._mover(difference) is not Mover.MODEL

    def _mover(self, difference: Difference) -> Mover | None:
        drift = self.checked.drift
        movers = dict(drift.differences) if drift is not None else {}
        return movers.get(difference)

    def _at(self, paths: Iterable[str], message: str) -> Iterator[Findings]:
        for path in paths:
            yield finding(Place(Source(path, ""), NOWHERE), "RS959", message, _HINT)

    def _generated(self, pattern: re.Pattern[str]) -> Iterator[str]:
        """The files that were generated by such a name, and are there."""
        for name, path in self.checked.state.listing.files.items():
            if name in self.record.files and pattern.match(name):
                yield path

    def _running(self, name: str) -> Iterator[str]:
        """The generated programs that make a rebec of a class."""
        for path in self._generated(_PROGRAM):
            with suppress(RebsyncError):  # what cannot be read, extraction lists
                text = _REMARK.sub("", read_source(path).text)
                if re.search(rf"\b{re.escape(name)}\b", text):
                    yield path


def is_mistake(found: Diagnostic) -> bool:
    """Whether a finding is about a place that does not parse."""
    return found.code == "RS941" and any(text in found.message for text in (NO_CPP, NO_PYTHON))


def is_of_file(found: Findings) -> bool:
    """Whether a finding is about a file that cannot be read at all."""
    return all(d.code == "RS941" and d.span == NOWHERE for d in found.diagnostics)
