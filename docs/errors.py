"""Writes errors.md, the page of all codes, beside this file: `python docs/errors.py`."""

from __future__ import annotations

from pathlib import Path

from rebsync import codes

PAGE = Path(__file__).with_name("errors.md")

SECTIONS = (
    ("RS1xx: syntax", codes.SYNTAX),
    ("RS2xx: names", codes.NAMES),
    ("RS3xx: types", codes.TYPES),
    ("RS4xx: declarations and structure", codes.STRUCTURE),
    ("RS5xx: warnings about a model that is accepted", codes.WARNINGS),
    ("RS6xx: warnings about robotic models", codes.ROBOTIC),
    ("RS7xx: generation and export", codes.GENERATION),
    ("RS8xx: files, options, configuration", codes.FILES),
    ("RS90x and RS91x: properties", codes.PROPERTIES),
    ("RS91x: questions", codes.QUESTIONS),
    ("RS92x: runs and state spaces", codes.RUNS),
    ("RS94x: extraction", codes.EXTRACTION),
    ("RS95x and RS96x: model and code in step", codes.STEP),
    ("RS97x: differences between two models", codes.DIFFERENCES),
    ("RS98x: recorded runs", codes.CONFORMANCE),
    ("RS99x: the computation graph", codes.GRAPH),
)

HEAD = """\
# Error codes

What rebsync finds it reports as `file:line:column: CODE message`, with the line, a caret and, where
there is one, a hint. `rebsync lint --fix` makes the corrections that are certain. Each code stands
for one kind of mistake, so that a search or a filter can rely on it.
"""


def errors_page() -> str:
    """The text of the page, from the table of codes."""
    return HEAD + "".join(_section(title, table) for title, table in SECTIONS)


def _section(title: str, table: dict[str, str]) -> str:
    rows = "".join(f"| {code} | {meaning} |\n" for code, meaning in sorted(table.items()))
    return f"\n## {title}\n\n| code | what it stands for |\n|---|---|\n{rows}"


if __name__ == "__main__":
    PAGE.write_text(errors_page(), encoding="utf-8")
