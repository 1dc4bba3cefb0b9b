"""Writes the closed models and assumptions of all cases anew: look at the difference first."""

from __future__ import annotations

from tests.reverse.environment.cases import CASES, closed_model


def main() -> None:
    """Writes `expected.rebeca` and `assumptions.txt` of all cases."""
    for case in CASES:
        model, told = closed_model(case)
        (case / "expected.rebeca").write_text(model, encoding="utf-8")
        (case / "assumptions.txt").write_text(told, encoding="utf-8")


if __name__ == "__main__":
    main()
