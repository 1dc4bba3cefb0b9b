"""Which edits run, and in which dialect: by their names, so that a row changes none of another."""

from __future__ import annotations

from hashlib import sha256

from tests.roundtrip.edits.trial import HERE, Case, cases


def drawn(purpose: str, name: str, of: int) -> int:
    """A number below `of`, always the same for a name and what it is drawn for."""
    return int.from_bytes(sha256(f"{purpose} {name}".encode()).digest()[:8], "big") % of


def in_one_dialect(file: str) -> list[Case]:
    """Each case of a file in one of its dialects."""
    by_name: dict[str, list[Case]] = {}
    for case in cases(HERE / file):
        by_name.setdefault(case.name, []).append(case)
    return [of[drawn("dialect", name, len(of))] for name, of in by_name.items()]
