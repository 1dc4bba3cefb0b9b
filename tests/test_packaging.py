"""Three places name the packages: pyproject.toml, the links in rebsync/, the folders themselves."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parent.parent
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SETUPTOOLS = PROJECT["tool"]["setuptools"]
FOLDERS = {name: ROOT / folder for name, folder in SETUPTOOLS["package-dir"].items()}
LINKED = [name for name in FOLDERS if "." in name]
DATA = "rebsync.examples"  # a link too, and no package of Python


@pytest.mark.parametrize("package", LINKED)
def test_the_link_in_the_source_tree_leads_to_the_folder(package: str) -> None:
    link = ROOT.joinpath(*package.split("."))
    assert link.is_symlink()
    assert not link.readlink().is_absolute()
    assert link.resolve() == FOLDERS[package].resolve()


def test_there_is_no_other_link() -> None:
    links = {f"rebsync.{path.name}" for path in (ROOT / "rebsync").iterdir() if path.is_symlink()}
    assert links == {*LINKED, DATA}


def test_every_folder_with_code_is_a_listed_package() -> None:
    found = set()
    for package, folder in FOLDERS.items():
        for marker in folder.rglob("__init__.py"):
            inner = marker.parent.relative_to(folder).parts
            found.add(".".join((package, *inner)))
    assert found == set(SETUPTOOLS["packages"])


def test_no_code_lies_outside_of_the_packages() -> None:
    for package, folder in FOLDERS.items():
        for module in folder.rglob("*.py"):
            assert (module.parent / "__init__.py").is_file(), f"{module} is not part of {package}"


def test_every_data_file_is_packaged() -> None:
    wanted: set[Path] = set()
    for package, patterns in SETUPTOOLS["package-data"].items():
        for pattern in patterns:
            wanted.update(ROOT.joinpath(*package.split(".")).resolve().glob(pattern))
    for folder in FOLDERS.values():
        for path in folder.rglob("*"):
            if path.is_file() and path.suffix not in (".py", ".pyc"):
                assert path in wanted, f"{path.relative_to(ROOT)} would not be installed"


@pytest.mark.parametrize("script", ["tools/setup", ".ci/run"])
def test_every_folder_is_compiled_before_tests(script: str) -> None:
    """Links to folders are not followed: what they lead to would be compiled for each command."""
    lines = re.findall(r"-m compileall -q (.+)", (ROOT / script).read_text(encoding="utf-8"))
    wanted = {str(FOLDERS[name].relative_to(ROOT)) for name in ("rebsync", *LINKED)}
    assert [wanted - set(line.split()) for line in lines] == [set()]


def test_the_version_is_told_once() -> None:
    init = (ROOT / "rebsync" / "__init__.py").read_text(encoding="utf-8")
    assert re.findall(r'__version__ = "(.+)"', init) == [PROJECT["project"]["version"]]


@pytest.mark.parametrize("path", sorted(ROOT.glob("rebsync/*.py")), ids=lambda path: path.name)
def test_core_modules_do_not_import_the_top_level_folders(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"^(from|import) (forward|grammars|reverse|roundtrip)\b", text, re.M)


@pytest.mark.parametrize("plugin", ["launch_testing", "launch_ros", "launch_pytest"])
def test_plugins_of_a_sourced_ros_2_are_not_loaded(plugin: str, tmp_path: Path) -> None:
    """Those of Humble and Jazzy: their hooks do not fit, or warn, which is an error here."""
    facts = tmp_path / f"{plugin}_of_ros-1.0.dist-info"
    facts.mkdir()
    (facts / "METADATA").write_text(f"Name: {plugin}_of_ros\nVersion: 1.0\n")
    (facts / "entry_points.txt").write_text(f"[pytest11]\n{plugin} = no_such_module_of_ros\n")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "--collect-only", "-q", __file__],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
