"""Generated packages please the linters of ament that they bring, as far as Debian has these."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from rebsync.config import Config, SensorBinding
from rebsync.forward.headers import LICENSES
from tests.forward.compiling import generated, written

_MODEL = """
env int[2] steps = {1, 2};
@Robot reactiveclass Eye(9) {
  knownrebecs { Desk desk; }
  statevars { boolean pressed; int level; int x; }
  Eye() { self.bumper() after(2); self.battery() after(3); self.go() after(1); }
  @Sensor msgsrv bumper() { pressed = ?(false, true); self.bumper() after(2); }
  @Sensor msgsrv battery() { level = ?(10, 40); desk.report(level); self.battery() after(2); }
  @priority(1) msgsrv go() { @Move(X+1, Y); delay(1); x = x + steps[0]; self.go() after(2); }
}
reactiveclass Desk(9) {
  statevars { int last; }
  msgsrv report(int v) { if (v > 20) { last = v; } else { last = last / 2; } }
}
main { Eye e(d):(); Desk d():(); }
"""
_TOOLS = {
    "ament_cmake_copyright": ("ament_copyright",),
    "ament_cmake_clang_format": ("ament_clang_format", "--config", ".clang-format"),
    "ament_cmake_cpplint": ("ament_cpplint",),
    "ament_cmake_flake8": ("ament_flake8", "--config", ".flake8"),
    "ament_cmake_lint_cmake": ("ament_lint_cmake",),
    "ament_cmake_pep257": ("ament_pep257",),
    "ament_cmake_xmllint": ("ament_xmllint",),
}
_LICENSES = {"unknown": "Proprietary"}
_PATH = "/usr/bin:/bin"
_DEPEND = re.compile(r"<test_depend>(ament_cmake_\w+)</test_depend>")


def _run(folder: Path, command: Sequence[str]) -> str:
    """Run a tool of the system in a folder; what it prints. What it finds fails the test."""
    done = subprocess.run(
        command,
        cwd=folder,
        env={"PATH": _PATH, "LANG": "C.UTF-8", "HOME": os.environ.get("HOME", "/")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def _lack(what: str) -> None:
    if os.environ.get("CI") == "true":
        pytest.fail(f"no {what}")
    pytest.skip(f"no {what}")


def _lint(folder: Path) -> Iterator[str]:
    """Run each linter that the package.xml in a folder asks for; their names."""
    for name in _DEPEND.findall((folder / "package.xml").read_text("utf-8")):
        tool, *options = _TOOLS[name]
        if f"set({name}_FOUND TRUE)" in (folder / "CMakeLists.txt").read_text("utf-8"):
            continue  # so ament_lint_auto passes it over
        if shutil.which(tool, path=_PATH) is None:
            _lack(tool)
        _run(folder, [tool, *options, "."])
        yield name


def _package(case: str, target: str, directory: Path) -> Path:
    bump = SensorBinding("Eye.bumper", "/bump", "std_msgs/Bool", "msg.data")
    bound = case == "bound"
    config = Config(
        target=target,
        odometry="/odom" if bound else None,
        sensors=(bump,) if bound else (),
        license=_LICENSES.get(case, "Apache-2.0"),
        copyright=None if case == "plain" else "2024-2026, 2028 Müller & Söhne, 3 Ltd.",
    )
    return written(generated(_MODEL, "eyes", config), directory, "eyes", config)


@pytest.mark.parametrize("case", ["plain", "bound", "unknown"])
def test_linters_are_content_with_cpp(case: str, tmp_path: Path) -> None:
    found = set(_lint(_package(case, "ros2-cpp", tmp_path)))
    assert found == set(_TOOLS) - (set() if case == "bound" else {"ament_cmake_copyright"})


@pytest.mark.parametrize("case", ["plain", "bound", "unknown"])
def test_linters_are_content_with_python(case: str, tmp_path: Path) -> None:
    folder = _package(case, "ros2-py", tmp_path)
    assert list(_lint(folder / "eyes_interfaces")) == [
        "ament_cmake_lint_cmake",
        "ament_cmake_xmllint",
    ]
    needed = "import pytest, ament_copyright, ament_flake8, ament_pep257, ament_xmllint"
    if subprocess.run(["/usr/bin/python3", "-c", needed], stderr=subprocess.DEVNULL).returncode:
        _lack(needed.removeprefix("import "))
    tests = ["/usr/bin/python3", "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    shown = _run(folder / "eyes", tests)
    assert ("4 passed" if case == "bound" else "3 passed, 1 skipped") in shown


@pytest.mark.parametrize("target", ["ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py"])
@pytest.mark.parametrize("name", LICENSES)
def test_every_source_has_a_header_that_ament_knows(name: str, target: str, tmp_path: Path) -> None:
    if shutil.which("ament_copyright", path=_PATH) is None:
        _lack("ament_copyright")
    bump = SensorBinding("Eye.bumper", "/bump", "std_msgs/Bool")
    config = Config(target=target, copyright="2026 ACME", license=name, sensors=(bump,))
    folder = written(generated(_MODEL, "eyes", config), tmp_path, "eyes", config)
    shown = _run(folder, ["ament_copyright", "--verbose", "."])
    sources = [p for e in ("cpp", "h", "hpp", "py") for p in folder.rglob(f"*.{e}")]
    sources = [p for p in sources if p.parent != folder or p.name != "setup.py"]
    told = [line for line in shown.splitlines() if "copyright=ACME (2026), license=" in line]
    assert len(told) >= len(sources) - 1 > 4, shown
    for path in (*folder.rglob("scripts/*"), *folder.rglob("*.launch"), *folder.rglob("setup.py")):
        lines = path.read_text().splitlines()
        assert "Copyright 2026 ACME" in "".join(lines[:2]), path
        assert path.parent.name != "scripts" or lines[0].startswith("#!"), path
