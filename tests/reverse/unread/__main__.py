"""Writes anew why each call of `calls.toml` is listed that is: look at the difference."""

from __future__ import annotations

import re

from tests.reverse.unread import CALLS, node, places, rows


def main() -> None:
    """Writes the reasons."""
    text = CALLS.read_text(encoding="utf-8")
    for name, row in rows().items():
        if "why" in row:
            why = places(node("roscpp", row, row["call"])).get("timer", ["NOT LISTED"])[0]
            pattern = rf"(?ms)(^\[{name}\]\n.*?^why = )[^\n]*"
            text = re.sub(pattern, lambda m, why=why: f"{m[1]}'{why}'", text, count=1)
    CALLS.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
