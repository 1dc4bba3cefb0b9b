"""The run-time headers as text: laid out as clang-format does, whatever the package is called."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.ros1.conftest import HEADERS, render, tool


@pytest.mark.parametrize(
    "package", ["p", "a_package_with_a_name_that_is_" + "rather_" * 9 + "long"]
)
@pytest.mark.parametrize("header", HEADERS)
def test_headers_are_formatted(tmp_path: Path, header: str, package: str) -> None:
    formatter = tool("clang-format")
    (tmp_path / ".clang-format").write_text(render("clang-format", package))
    path = tmp_path / header
    path.write_text(render(header, package))
    formatted = subprocess.run(
        [formatter, str(path)], check=True, capture_output=True, text=True
    ).stdout
    assert formatted == path.read_text()
