"""Verdicts as JUnit XML, which most servers of continuous integration show."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from xml.sax.saxutils import escape, quoteattr

from rebsync.records import dataclass
from rebsync.report import report
from rebsync.roundtrip.verdict.outcome import IN_STEP, Outcome, verdict_of
from rebsync.roundtrip.verdict.report.text import lines
from rebsync.terminal import lines_text, one_line, printable, without_commands, without_old_commands

_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n<testsuites name="rebsync">\n'


@dataclass(frozen=True, slots=True)
class Case:
    """A test case: `element` is what became of it, empty where it passed."""

    name: str
    element: str = ""
    kind: str = ""
    message: str = ""
    text: str = ""


def as_junit(outcomes: Sequence[Outcome]) -> str:
    """A test suite for each package: the step with its model, then each property."""
    return suites_xml((outcome.root, list(_cases(outcome))) for outcome in outcomes)


def suites_xml(suites: Iterable[tuple[str, Sequence[Case]]]) -> str:
    """Test suites by their names, and the cases of each."""
    return f"{_HEAD}{''.join(_suite(name, cases) for name, cases in suites)}</testsuites>\n"


def _suite(name: str, cases: Sequence[Case]) -> str:
    failures, errors = (sum(c.element == e for c in cases) for e in ("failure", "error"))
    counts = f'tests="{len(cases)}" failures="{failures}" errors="{errors}"'
    body = "".join(_element(name, case) for case in cases)
    return f"  <testsuite name={_quoted(name)} {counts}>\n{body}  </testsuite>\n"


def _element(root: str, case: Case) -> str:
    head = f"    <testcase classname={_quoted(root)} name={_quoted(case.name)}"
    text = without_commands(escape(printable(case.text)), "&#35;")
    if not case.element and text:
        return f"{head}>\n      <system-out>{text}</system-out>\n    </testcase>\n"
    if not case.element:
        return f"{head}/>\n"
    what = f"{case.element} type={_quoted(case.kind)} message={_quoted(case.message)}"
    return f"{head}>\n      <{what}>{text}</{case.element}>\n    </testcase>\n"


def _quoted(text: str) -> str:
    return without_old_commands(quoteattr(printable(text)), "&#35;")


def _cases(outcome: Outcome) -> Iterator[Case]:
    verdict = verdict_of(outcome)
    first, *rest = map(one_line, lines(outcome))
    found = report(outcome.findings)
    if verdict == IN_STEP and not found:
        accepted = outcome.checked.accepted if outcome.checked is not None else ()
        yield Case(IN_STEP, text="".join(f"accepted {e.path}: {e.reason}\n" for e in accepted))
    else:
        element = "failure" if outcome.checked is not None else "error"
        message = first.removeprefix(f"{one_line(outcome.root)}: ")
        text = "".join(f"{line}\n" for line in rest) + found
        yield Case(IN_STEP, element, verdict, message, text)
    yield from _properties(outcome)


def _properties(outcome: Outcome) -> Iterator[Case]:
    proof = outcome.proof
    if proof is None:
        return
    from rebsync.checker.show import words
    from rebsync.roundtrip.behaviour.report import caveats, run_lines, violations

    doubt = (proof.reason,) if proof.verdict == "violated" and proof.reason else ()
    rests = "".join(f"caveat: {one_line(each)}\n" for each in (*doubt, *caveats(proof)))
    if proof.verdict == "undetermined":
        yield Case("properties", "failure", "undetermined", proof.reason, rests)
        return
    broken = {v.name: v for v in violations(proof)}
    properties = proof.result.properties if proof.result is not None else ()
    for name, _ in properties:
        if name not in broken:
            yield Case(f"property {name}", text=rests)
    for violation in broken.values():
        run = lines_text(run_lines(proof, violation))
        yield Case(words.title(violation), "failure", "violated", violation.message, rests + run)
    if not properties and not broken:
        yield Case("nothing goes wrong", text=rests)
