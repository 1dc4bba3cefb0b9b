"""The files of monitors: what is generated, what else stays as it is, and what reads it back."""

from __future__ import annotations

import ast
import shutil
import subprocess
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.config import TARGETS, Config, parse_config
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from tests.forward.compiling import generated
from tests.forward.monitor_cases import MODEL
from tests.reverse.laws import assert_says, told_without_markers, without_markers

GOLDEN = Path(__file__).parent / "monitors"
_CORE = ("monitor_machine", "monitor_run")


def _package(target: str, monitor: bool = True, text: str = MODEL) -> dict[str, str]:
    return generated(text, "patrol", Config(target=target, monitor=monitor))


def own_files(target: str) -> dict[str, str]:
    """What depends on the model in a monitor: node, tables and launch file."""
    plain, monitored = _package(target, monitor=False), _package(target)
    new = {path: text for path, text in monitored.items() if path not in plain}
    return {p: t for p, t in new.items() if not Path(p).stem.startswith(_CORE)}


@pytest.mark.parametrize("target", TARGETS)
def test_goldens(target: str) -> None:
    root = GOLDEN / target
    found = {p.relative_to(root).as_posix(): p for p in root.rglob("*") if p.is_file()}
    assert {path: p.read_text(encoding="utf-8") for path, p in found.items()} == own_files(target)


@pytest.mark.parametrize("target", TARGETS)
def test_nothing_else_changes_but_build_files(target: str) -> None:
    plain, monitored = _package(target, monitor=False), _package(target)
    changed = {path for path, text in plain.items() if monitored[path] != text}
    assert {Path(path).name for path in changed} <= {"CMakeLists.txt", "setup.py"}
    assert len(monitored) - len(plain) == 5


@pytest.mark.parametrize("target", TARGETS)
def test_a_model_comes_back_from_a_package_with_a_monitor(target: str) -> None:
    model = parse_model(Source("patrol.rebeca", MODEL)).model
    files = _package(target)
    assert_says(files, model)
    assert_says(without_markers(files), told_without_markers(model))


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_python_is_that_of_noetic(target: str) -> None:
    for path, text in _package(target).items():
        if "monitor" in path and not path.endswith(".launch"):
            ast.parse(text, feature_version=(3, 8))


def test_a_class_may_be_called_monitor() -> None:
    text = MODEL.replace("Cart", "Monitor").replace("cart", "monitor")
    files = _package("ros1-cpp", text=text)
    assert "src/monitor_node.cpp" in files
    assert 'name="monitor_v" pkg="patrol" type="monitor_node"' in files["launch/monitor.launch"]
    assert "class Monitor" in files["include/patrol/monitor_2.h"]


def test_a_mixed_package_has_one_monitor() -> None:
    settings = 'monitor = true\n[targets]\nCart = "ros1-py"\n'
    files = generated(MODEL, "patrol", parse_config(Source("rebsync.toml", settings)))
    monitors = sorted(p for p in files if "monitor" in p)
    assert [Path(p).suffix for p in monitors] == [".h", ".h", ".h", ".launch", ".cpp"]
    assert "src/monitor_node.cpp" in files["CMakeLists.txt"]


def test_without_rebecs_there_is_no_monitor() -> None:
    text = MODEL.partition("main {")[0] + "main {\n}\n"
    assert not [path for path in _package("ros1-cpp", text=text) if "monitor" in path]


# --- commands -----------------------------------------------------------------------------------


@pytest.fixture
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "patrol.rebeca"
    path.write_text(MODEL, encoding="utf-8")
    return path


@pytest.mark.parametrize("target", TARGETS)
def test_an_edited_monitor_is_undetermined(target: str, model: Path) -> None:
    assert main(["generate", model.name, "--target", target, "--monitor"]) == 0
    assert main(["check"]) == 0
    edits = [p for p in Path("patrol").rglob("monitor_*") if ".rebsync" not in p.parts]
    assert len(edits) == 4
    for path in edits:
        before = path.read_text(encoding="utf-8")
        changed = next(n for n in ("1024", "4096", "0.25", "250", '"patrol.rebeca"') if n in before)
        path.write_text(before.replace(changed, '"x"' if '"' in changed else "7"), encoding="utf-8")
        assert main(["check"]) == 4, path
        path.write_text(before, encoding="utf-8")
    assert main(["check"]) == 0


def test_sync_keeps_the_monitor_of_the_command_line(model: Path) -> None:
    assert main(["generate", model.name, "--monitor"]) == 0
    model.write_text(MODEL.replace("after(4)", "after(5)"), encoding="utf-8")
    assert main(["sync"]) == 0
    tables = Path("patrol/include/patrol/monitor_model.h").read_text(encoding="utf-8")
    assert "{Op::kConst, 5, 0, {}}" in tables
    assert main(["check"]) == 0


def test_the_monitor_alone(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["monitor", model.name, "-o", "out"]) == 0
    written = [p for p in Path("out").rglob("*") if p.is_file()]
    assert len(written) == 5
    assert main(["monitor", model.name, "-o", "out"]) == 0
    node = Path("out/patrol/src/monitor_node.cpp")
    node.write_text("// ours\n", encoding="utf-8")
    assert main(["monitor", model.name, "-o", "out"]) == 1
    assert node.read_text(encoding="utf-8") == "// ours\n"
    assert "RS701" in capsys.readouterr().err
    assert main(["monitor", model.name, "-o", "out", "--force"]) == 0
    assert "watch_" in node.read_text(encoding="utf-8")


# --- the compiler -------------------------------------------------------------------------------


@pytest.mark.skipif(shutil.which("g++") is None, reason="no g++")
def test_the_tables_compile(tmp_path: Path) -> None:
    for path, text in _package("ros1-cpp").items():
        if not path.startswith("include/patrol/monitor"):
            continue
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    source = tmp_path / "tables.cpp"
    source.write_text(
        '#include "patrol/monitor_model.h"\n#include "patrol/monitor_run.h"\n'
        "int main() { return patrol::monitoring::Run(patrol::monitoring::theModel()).waiting(); }\n"
    )
    strict = ["-std=c++14", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wno-conversion"]
    command = ["g++", "-fsyntax-only", *strict, f"-I{tmp_path / 'include'}", str(source)]
    subprocess.run(command, check=True)
