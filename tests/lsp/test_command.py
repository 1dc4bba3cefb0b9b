"""`rebsync lsp` where its library is not installed."""

from __future__ import annotations

import pytest

from rebsync.cli import main


def test_a_missing_library_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def find_spec(name: str) -> None:
        assert name == "pygls"

    monkeypatch.setattr("rebsync.cli.lsp.find_spec", find_spec)
    assert main(["lsp"]) == 2
    told = capsys.readouterr().err
    assert "RS816" in told
    assert "pip install 'rebsync[lsp]'" in told
