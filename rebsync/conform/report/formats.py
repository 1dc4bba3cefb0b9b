"""What there is to say of a recorded run, in each of the forms of the command."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.checker.show.data import Json
from rebsync.conform.conformance import Conformance
from rebsync.conform.matching import Subject
from rebsync.conform.report.text import findings, lines, property_line
from rebsync.report import report
from rebsync.roundtrip.verdict.report.junit import Case, suites_xml
from rebsync.terminal import lines_text


def as_text(
    found: Conformance,
    subject: Subject,
    paths: Sequence[str],
    style: str,
    more: Sequence[str] = (),
    times: Json | None = None,
) -> str:
    """The answer in one of the forms of the command; `more` lines, and `times` of the run."""
    match style:
        case "json":
            from rebsync.conform.report.data import conformance_json

            return conformance_json(found, subject, paths, times)
        case "sarif" | "github":
            return report(findings(found, subject), style)
        case "junit":
            return suites_xml([(subject.source.path, list(_cases(found, subject, paths)))])
        case _:
            return lines_text([*lines(found, subject, paths), *more])


def _cases(found: Conformance, subject: Subject, paths: Sequence[str]) -> Iterator[Case]:
    first, *rest = lines(found, subject, paths)
    text = "".join(f"{line}\n" for line in rest)
    if found.verdict == "conforms":
        yield Case("conforms", text=f"{first}\n{text}")
    else:
        message = found.deviation.message if found.deviation is not None else found.reason
        yield Case("conforms", "failure", found.verdict, message, text)
    for evaluated in found.properties:
        name, line = f"property {evaluated.name}", property_line(evaluated)
        if evaluated.verdict in ("violated", "undetermined"):
            yield Case(name, "failure", evaluated.verdict, line)
        else:
            yield Case(name, text=line)
