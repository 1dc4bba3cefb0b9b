"""The packages of the examples please the field's own tools."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from tests.regenerate import models
from tests.ros1.conftest import tool
from tests.ros1.test_examples import EXAMPLES, example_package
from tests.ros1.workspace import SYSTEM_PATH

PACKAGES = [m.parent / m.stem for m in models()]
IDS = [p.name for p in PACKAGES]


@pytest.mark.parametrize("package", PACKAGES, ids=IDS)
def test_clang_format_changes_nothing(package: Path) -> None:
    formatter = tool("clang-format")
    sources = [*package.glob("src/*.cpp"), *package.glob("include/*/*.h")]
    assert sources
    for source in sources:
        done = subprocess.run(
            [formatter, f"--style=file:{package / '.clang-format'}", source.name],
            cwd=source.parent,
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stdout == source.read_text(), source


@pytest.mark.parametrize("package", PACKAGES, ids=IDS)
def test_catkin_lint_finds_nothing(package: Path) -> None:
    done = subprocess.run(
        [tool("catkin_lint"), "--offline", "-W2", "--strict", str(package)],
        capture_output=True,
        text=True,
        env={"PATH": SYSTEM_PATH, "HOME": os.environ.get("HOME", "/")},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "checked 1 packages and found 0 problems" in done.stdout + done.stderr


@pytest.mark.parametrize("name", IDS)
def test_catkin_lint_finds_nothing_in_python(name: str, tmp_path: Path) -> None:
    package = example_package(EXAMPLES / name, "ros1-py", tmp_path)
    test_catkin_lint_finds_nothing(package)


@pytest.mark.parametrize("package", PACKAGES, ids=IDS)
def test_xml_is_well_formed(package: Path) -> None:
    files = [str(package / "package.xml"), *map(str, package.glob("launch/*"))]
    done = subprocess.run([tool("xmllint"), "--noout", *files], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
