"""Writes what is expected of each case anew: look at the difference before you commit it."""

from __future__ import annotations

from tests.reverse.nodes.cases import CASES, extracted, said


def main() -> None:
    """Writes the models and findings of all cases."""
    for case in CASES:
        model, findings = said(extracted(case))
        (case / "expected.rebeca").write_text(model, encoding="utf-8")
        (case / "findings.txt").write_text(findings, encoding="utf-8")


if __name__ == "__main__":
    main()
