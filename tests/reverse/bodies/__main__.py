"""Writes what is expected of the cases anew: `python -m tests.reverse.bodies`."""

from __future__ import annotations

from rebsync.files import read_source
from tests.reverse.bodies.reading import CASES, mistakes, read_case, told

for case in sorted(CASES.glob("*.cpp")):
    source = read_source(str(case))
    case.with_suffix(".expected").write_text(told(source), encoding="utf-8")
    for mistake in mistakes(read_case(source)[0]):
        print(f"{case.name}: {mistake}")
