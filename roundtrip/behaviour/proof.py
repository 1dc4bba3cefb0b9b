"""Model-checks what the code of a package says: do the properties still hold?"""

from __future__ import annotations

from dataclasses import field, replace

from rebsync.checker.problem import Options, Problem
from rebsync.checker.result import Result, Verdict
from rebsync.checker.show import words
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import read_source
from rebsync.printing import print_model
from rebsync.records import dataclass
from rebsync.roundtrip.diff.correspondence import Both, correspondence
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.package.cache.store import key_of, load, save
from rebsync.roundtrip.package.model_file import properties_beside
from rebsync.roundtrip.package.models import CodeModel
from rebsync.source import Source


@dataclass(frozen=True, slots=True)
class Proof:
    """What a verification of the extracted model says.

    `path` is that of the user's model, `source` the text that was verified; `places` tells for its
    lines where they are in model and code. `subject` is the text of the properties. `reason` says
    why the verdict is no better, empty if nothing is in its way. With `names` it is about the
    properties of these names only, and what is always checked.
    """

    verdict: Verdict
    reason: str
    path: str
    source: Source
    result: Result | None = None
    places: dict[int, Both] = field(default_factory=dict)
    subject: str = ""
    names: tuple[str, ...] = ()
    remarks: tuple[Findings, ...] = ()

    @property
    def broken(self) -> tuple[str, ...]:
        """What is violated, by name."""
        violations = self.result.violations if self.result is not None else ()
        return tuple(words.title(v) for v in violations)


def prove(
    code: CodeModel,
    today: SourcedModel,
    property_path: str | None,
    options: Options,
    names: tuple[str, ...] = (),
) -> Proof:
    """Verifies what the code says against the properties of the model, or those of some names.

    RebsyncError: the properties cannot be read, or none has such a name.
    """
    text = print_model(code.given.model)
    source = Source(f"{code.given.source.path} as a model", text)
    path = property_path or properties_beside(today.source.path)
    properties = read_source(path) if path is not None else None
    problem = _problem(source, properties, today.source.path)
    if not isinstance(problem, Problem):
        return problem
    problem = problem.named(names)
    result = _verified(problem, options)
    places: dict[int, Both] = {}
    if result.violations:
        from rebsync.grammars.parser import parse_model

        places = correspondence(source, parse_model(source).model, code.given, today)
    reason, model = result.reason or "", today.source.path
    subject = properties.text if properties is not None else ""
    proof = Proof(result.verdict, reason, model, source, result, places, subject, names)
    return _judged(proof, code)


def unless_edited(proof: Proof, count: int) -> Proof:
    """The same unless places of generated code are edited that no model describes."""
    if not count:
        return proof
    places = f"{count} places are" if count > 1 else "a place is"
    reason = f"{places} not as generated, and in no model"
    return replace(proof, verdict="undetermined", reason=reason)


def _problem(source: Source, properties: Source | None, model: str) -> Problem | Proof:
    """What is to be verified; or why nothing can be."""
    from rebsync.checker.sizes import check_sizes
    from rebsync.grammars.parser import parse_model
    from rebsync.static import analyse

    parsed = parse_model(source)
    analysis = analyse(parsed.model, incomplete=not parsed.ok)
    found = [*parsed.diagnostics, *analysis.diagnostics]
    if not _errors(found):
        found += check_sizes(analysis)
    if errors := _errors(found):
        reason = f"what the code says is no whole model: {errors[0].message}"
        return Proof("undetermined", reason, model, source)
    if properties is None:
        return Problem(source, analysis)
    from rebsync.grammars.properties import parse_properties
    from rebsync.property_check import check_properties

    read = parse_properties(properties)
    if errors := _errors(list(read.diagnostics)):
        raise RebsyncError([Findings(properties, errors)])
    if errors := _errors(list(check_properties(read.properties, analysis))):
        reason = f"the properties do not fit what the code says: {errors[0].message}"
        return Proof("undetermined", reason, model, source, remarks=(Findings(properties, errors),))
    return Problem(source, analysis, read.properties, properties)


def _errors(found: list[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(d for d in dict.fromkeys(found) if d.severity is Severity.ERROR)


def _verified(problem: Problem, options: Options) -> Result:
    """The result, from the cache if nothing it depends on has changed."""
    properties = problem.property_source
    told = (properties.path, properties.text) if properties is not None else ("", "")
    names = repr([entry.name for entry in problem.properties.all])
    key = key_of("proof", problem.source.path, problem.source.text, *told, names, repr(options))
    result = load(key, Result)
    if result is None:
        from rebsync.checker.verify import verify

        result = verify(problem, options)
        if result.verdict != "undetermined":
            save(key, result)
    return result


def _judged(proof: Proof, code: CodeModel) -> Proof:
    """Nothing holds, and nothing is certain to fail, where the code is not all there."""
    if code.given.unread:
        count = len(code.given.unread)
        reason = f"{count} place{'s' if count > 1 else ''} of the code cannot be read"
        return replace(proof, verdict="undetermined", reason=reason)
    inexact = any(d.code == "RS942" for f in code.findings for d in f.diagnostics)
    if inexact and proof.verdict == "violated":
        return replace(proof, reason="the model allows more than the code: it may do none of this")
    return proof
