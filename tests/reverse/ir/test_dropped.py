"""Law 6 over the form: state that a body may write and the model does not is unreadable."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.reverse.findings import Grade
from tests.reverse.ir.dropped import dropped

_FOLDERS = sorted({p.parent for p in (Path(__file__).parents[1] / "native/cases").rglob("*.py")})


@pytest.mark.parametrize("folder", _FOLDERS, ids=lambda p: p.name)
def test_what_is_not_in_the_model_is_listed(folder: Path) -> None:
    servers, extracted = dropped(folder)
    if any(server.names for server in servers):
        assert any(f.grade is Grade.UNREADABLE for f in extracted.findings), servers
