"""The Python of generated packages: it means what the model does, and pleases linters."""

from __future__ import annotations

import ast
import subprocess
import sys
from contextlib import suppress
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import pytest

from rebsync.config import ClassTarget, Config, Maintainer
from rebsync.forward.limits import limits
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.forward.compiling import CASES, case_config, case_files, generated, written
from tests.forward.python_packages import imported
from tests.regenerate import models
from tests.reverse.laws import assert_says
from tests.ros1.arithmetic import Value
from tests.ros1.test_arithmetic import START, drawn_bodies, expected_values, model_of

_DRAWN = 400
_TARGET = Config(target="ros1-py")
# Their sensors are bound with expressions of C++.
_IN_CPP = frozenset({"sensors"})


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The cases and the examples as Python packages, each in its directory."""
    directory = tmp_path_factory.mktemp("packages")
    for case in sorted(CASES.glob("*.rebeca")):
        if case.stem not in _IN_CPP:
            config = replace(case_config(case), target="ros1-py")
            written(case_files(case, "ros1-py"), directory, case.stem, config)
    for model in models():
        text = model.read_text(encoding="utf-8")
        written(generated(text, model.stem, _TARGET), directory, model.stem, _TARGET)
    return directory


def test_it_is_python_3_8(packages: Path) -> None:
    files = [*packages.glob("*/src/*/*.py"), *packages.glob("*/scripts/*")]
    assert len(files) > 100
    for file in files:
        ast.parse(file.read_text(encoding="utf-8"), str(file), feature_version=(3, 8))


@pytest.mark.skipif(find_spec("ruff") is None, reason="ruff is not installed")
def test_ruff_finds_nothing(packages: Path) -> None:
    command = [sys.executable, "-m", "ruff", "check", "--no-cache", "--quiet", str(packages)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.stdout + done.stderr == ""


@pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed")
@pytest.mark.parametrize("name", ["arrays", "control", "inheritance", "interfaces", "warehouse"])
def test_mypy_finds_nothing(packages: Path, name: str, tmp_path: Path) -> None:
    source = packages / name / "src"
    stubs = source / name / "msg.pyi"
    stubs.write_text("from typing import Any\ndef __getattr__(name: str) -> Any: ...\n")
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports"]
    command += ["--no-warn-return-any", "--cache-dir", str(tmp_path), "-p", name]
    done = subprocess.run(command, cwd=source, capture_output=True, text=True)
    stubs.unlink()
    assert done.returncode == 0, done.stdout + done.stderr


def test_arithmetic(tmp_path: Path) -> None:
    bodies = drawn_bodies(_DRAWN)
    package = written(generated(model_of(bodies), "calc", _TARGET), tmp_path, "calc", _TARGET)
    wrong = []
    with imported(package, "calc") as module:
        rebec = module.Calc()
        broken = (sys.modules["calc.values"].Violation, IndexError)
        for number, wanted in enumerate(expected_values(bodies)):
            assert wanted is not None
            found = after(rebec, number, broken)
            differ = {n: (found[n], wanted[n]) for n in wanted if found[n] != wanted[n]}
            if differ:
                wrong.append(f"{bodies[number]}\n    {differ}")
    assert not wrong, f"{len(wrong)} of {len(bodies)}:\n" + "\n".join(wrong[:5])


def after(rebec: object, number: int, broken: tuple[type[Exception], ...]) -> dict[str, Value]:
    """The variables after a body that starts with those of every body."""
    for name, value in START.items():
        values = sys.modules["calc.values"]
        setattr(rebec, f"_{name}", values.Array(value) if isinstance(value, list) else value)
    with suppress(*broken):
        getattr(rebec, f"m{number}")()
    held = {name: getattr(rebec, f"_{name}") for name in START}
    return {n: list(v) if isinstance(START[n], list) else v for n, v in held.items()}


@pytest.mark.parametrize(
    ("targets", "message"),
    [
        ({"Robt": "ros1-py"}, 'rebsync.toml gives a target to "Robt", which is no class'),
        ({"Base": "ros1-py"}, '"Heir" and its ancestor "Base" must be in one language'),
        ({"Other": "ros2-py"}, "only ros1-cpp and ros1-py go together in one package"),
    ],
)
def test_dialects_that_do_not_go_together(targets: dict[str, str], message: str) -> None:
    text = (
        "reactiveclass Base(1) { } reactiveclass Heir extends Base (1) { }\n"
        "reactiveclass Other(1) { } main { Heir h():(); Other o():(); }\n"
    )
    model = parse_model(Source("mixed.rebeca", text)).model
    chosen = tuple(ClassTarget(*item) for item in targets.items())
    config = Config(
        targets=chosen, license="MIT", copyright="2026 A", maintainers=(Maintainer("A", "a@b.org"),)
    )
    found = limits(model, analyse(model), config, "mixed")
    assert [(d.code, d.message) for d in found] == [("RS709", message)]


def test_nodes_of_rclpy_keep_their_own_members() -> None:
    """A class is a node, and calls nothing of the model as nodes call theirs."""
    text = """
reactiveclass A(5) {
  statevars { int clock; int parameters; }
  A(int n) { clock = n; self.handle(n); }
  msgsrv handle(int n) { timers(n); self.executor(); }
  msgsrv executor() { }
  void timers(int n) { parameters = n; }
}
main { A a():(1); }
"""
    model = parse_model(Source("clash.rebeca", text)).model
    files = generated(text, "clash", Config(target="ros2-py"))
    tree = ast.parse(files["clash/clash/a.py"])
    class_ = next(n for n in tree.body if isinstance(n, ast.ClassDef))
    assert [ast.unparse(b) for b in class_.bases] == ["Node"]
    functions = {n.name for n in class_.body if isinstance(n, ast.FunctionDef)}
    assert not functions & {"handle", "executor", "timers"}
    stored = {n.attr for n in ast.walk(class_) if isinstance(n, ast.Attribute)}
    assert not stored & {"_clock", "_parameters"}
    assert_says(files, model)


_FILES = """
reactiveclass Msg(2) { msgsrv go() { self.go() after(1); } }
reactiveclass Import extends Msg (2) { }
reactiveclass Control(2) { knownrebecs { Import i; } msgsrv go() { i.go(); } }
reactiveclass ControlNode(2) { msgsrv go() { self.go() after(1); } }
reactiveclass ArmStandIn(2) { msgsrv go() { self.go() after(1); } }
main { Msg m():(); Import i():(); Control c(i):(); ControlNode n():(); ArmStandIn a():(); }
"""


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_classes_whose_names_are_those_of_files(target: str) -> None:
    """Their modules can be imported, and what is started of them is what has a main."""
    files = generated(_FILES, "files", Config(target=target))
    modules = {path: ast.parse(text) for path, text in files.items() if _is_python(path, text)}
    assert not [p for p in files if p.endswith(("src/files/msg.py", "/import.py"))]
    if target == "ros2-py":
        having = {Path(path).stem for path, tree in modules.items() if _has_main(tree)}
        texts = (
            n.value for n in ast.walk(modules["files/setup.py"]) if isinstance(n, ast.Constant)
        )
        entries = dict(str(text).split(" = ") for text in texts if " = " in str(text))
        assert entries == {name: f"files.{name}:main" for name in having}
        assert len(having) == 5


def _is_python(path: str, text: str) -> bool:
    return path.endswith(".py") or text.startswith("#!/usr/bin/env python")


def _has_main(tree: ast.Module) -> bool:
    return any(isinstance(n, ast.FunctionDef) and n.name == "main" for n in tree.body)
