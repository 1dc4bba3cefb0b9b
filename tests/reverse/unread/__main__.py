"""Writes anew why each row is listed that is: look at the difference."""

from __future__ import annotations

import re
from pathlib import Path

from tests.reverse.unread import CALLS, PROGRAMS, node, places, program, rows, unreadable


def main() -> None:
    """Writes the reasons."""
    for name, row in rows(CALLS).items():
        _write(CALLS, name, row, places(node("roscpp", row, row["call"])).get("timer", []))
    for name, row in rows(PROGRAMS).items():
        _write(PROGRAMS, name, row, [f.why for f in unreadable(program(row))])


def _write(path: Path, name: str, row: dict[str, str], found: list[str]) -> None:
    if "why" in row:
        why = found[0] if found else "NOT LISTED"
        pattern = rf"(?ms)(^\[{name}\]\n.*?^why = )[^\n]*"
        text = path.read_text(encoding="utf-8")
        text = re.sub(pattern, lambda m: f"{m[1]}'{why}'", text, count=1)
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
