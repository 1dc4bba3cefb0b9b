"""Writes the models of all workspaces anew: look at the difference first."""

from __future__ import annotations

from tests.reverse.workspaces.cases import CASES, model_of


def main() -> None:
    """Writes `expected.rebeca` of all cases."""
    for case in CASES:
        (case / "expected.rebeca").write_text(model_of(case), encoding="utf-8")


if __name__ == "__main__":
    main()
