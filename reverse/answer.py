"""What is told of a package: its model, a report, or one object with everything."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rebsync import model as m
from rebsync.diagnostics import Findings
from rebsync.printing import print_model
from rebsync.records import dataclass
from rebsync.reverse.build.manifests import name_in
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import is_python
from rebsync.reverse.files.reading import Chosen
from rebsync.reverse.graph import Graph
from rebsync.reverse.graph_json import graph_data
from rebsync.reverse.models.texts import shown
from rebsync.reverse.recovery import Extracted, extract
from rebsync.reverse.report import as_json, as_text, diagnostics, grade_of, report_data, summary
from rebsync.terminal import json_text

_NOTHING = Extracted(m.Model((), (), None), (), ())


@dataclass(frozen=True, slots=True)
class Answer:
    """What is told of a package, as texts that another process can hand over.

    `model` is None where no class was found; then `asks` says if the code asks something of ROS.
    `summary` says how much is exact, and is empty when all is. `report` and `whole` are empty
    unless they are wanted.
    """

    name: str
    root: str
    grade: str
    model: str | None
    asks: bool
    findings: tuple[Findings, ...]
    summary: str
    report: str = ""
    whole: str = ""

    @property
    def is_read(self) -> bool:
        """Whether there is something of a model or of ROS in it."""
        return self.model is not None or self.asks


def answer(given: Chosen, style: str | None, whole: bool) -> Answer:
    """Reads a package; `style` is that of the report, `whole` asks for the object."""
    readable = given.only is None or given.only in given.files
    read = extract(given.files, given.only) if readable else _NOTHING
    extracted = replace(read, findings=given.findings + read.findings)
    model = _model(extracted)
    report = as_text if style == "text" else as_json
    return Answer(
        _package(given) or Path(given.root).resolve().name,
        given.root,
        grade_of(extracted),
        model,
        model is None and bool(_graph(given, extracted).facts),
        () if whole or style == "json" else diagnostics(extracted.findings),
        summary(extracted) if extracted.findings else "",
        report(extracted) if style is not None else "",
        package_json(given, extracted) if whole else "",
    )


def package_json(given: Chosen, extracted: Extracted) -> str:
    """All that is known of a package, as one object on one line: graph, model, report."""
    return json_text(
        {
            "package": _package(given),
            "path": given.root,
            "file": given.only,
            **graph_data(_graph(given, extracted)),
            "model": _model(extracted),
            "texts": [shown(text) for text in extracted.texts],
            "report": report_data(extracted),
        }
    )


def _package(given: Chosen) -> str | None:
    """The name that the manifest of a package gives it."""
    manifest = given.files.get("package.xml")
    return name_in(manifest) if manifest is not None else None


def _model(extracted: Extracted) -> str | None:
    return print_model(extracted.model) if extracted.model.classes else None


def _graph(given: Chosen, extracted: Extracted) -> Graph:
    """What the nodes ask of ROS: in the file that is asked for, if it is code."""
    asked = given.files.get(given.only or "")
    if asked is None or not (Path(asked.path).suffix in CODE or is_python(asked.path, asked)):
        return extracted.graph
    path = asked.path
    graph = extracted.graph
    return Graph(
        tuple(f for f in graph.facts if f.site.place.source.path == path),
        tuple(u for u in graph.unmodelled if u.site.place.source.path == path),
    )
