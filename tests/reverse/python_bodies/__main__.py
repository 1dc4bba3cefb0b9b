"""Writes what is expected of each case anew: look at the difference before you commit it."""

from __future__ import annotations

from tests.reverse.python_bodies.reading import CASES, extracted, said

for case in CASES:
    model, findings = said(extracted(case))
    case.with_suffix(".rebeca").write_text(model, encoding="utf-8")
    case.with_suffix(".txt").write_text(findings, encoding="utf-8")
