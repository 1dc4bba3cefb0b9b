"""Generated Python gives the model back: of examples, of drawn models, laid out anew."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.config import ClassTarget, Config
from rebsync.files import read_source
from rebsync.forward.generate import generate
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.laws import (
    assert_same,
    extracted,
    told_without_markers,
    without_markers,
)
from tests.reverse.python.laws import assert_says, python_files, python_normal, without_chains
from tests.strategies import models

EXAMPLES = sorted((Path(__file__).parents[3] / "examples").iterdir())
TARGETS = ("ros1-py", "ros2-py")
LENGTHS = (60, 160)


def model_of(example: Path) -> m.Model:
    return parse_model(read_source(str(example / f"{example.name}.rebeca"))).model


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda e: e.name)
def test_examples_come_back(example: Path, target: str) -> None:
    model = model_of(example)
    assert_says(python_files(model, target), model)


@pytest.mark.parametrize(
    ("name", "target"), list(zip(("whiles_and_fors", "operands"), TARGETS, strict=True))
)
def test_hard_cases_come_back(name: str, target: str) -> None:
    path = Path(__file__).parents[2] / "forward" / "cases" / f"{name}.rebeca"
    model = parse_model(read_source(str(path))).model
    assert_says(python_files(model, target), model)


_COUNTED = "        for cell in range(8):\n"
# As versions of rebsync before decision 86 wrote it.
_STEPPED = """        cell: int = 0
        for again_ in rounds():
            if again_:
                cell = int32.add(cell, 1)
            if not (cell < 8):
                break
"""


@pytest.mark.parametrize("target", TARGETS)
def test_loops_of_earlier_versions_are_read(target: str) -> None:
    model = model_of(next(e for e in EXAMPLES if e.name == "warehouse"))
    files = python_files(model, target)
    (path,) = (p for p in files if p.endswith("/dispatcher.py"))
    assert _COUNTED in files[path]
    text = files[path].replace(_COUNTED, _STEPPED)
    files[path] = text.replace("    remainder,\n", "    remainder,\n    rounds,\n")
    assert_says(files, model)


@given(models(), st.sampled_from(TARGETS))
def test_drawn_models_come_back(model: m.Model, target: str) -> None:
    assert_says(python_files(model, target), model)


@given(models(), st.sampled_from(TARGETS))
def test_they_come_back_without_markers(model: m.Model, target: str) -> None:
    found = extracted(without_markers(python_files(model, target)))
    assert [(f.text, f.why) for f in found.findings] == []
    told = told_without_markers(without_chains(python_normal(found.model)))
    assert_same(told, told_without_markers(without_chains(python_normal(normal(model)))))


@pytest.mark.parametrize("target", [*TARGETS, "ros2-cpp"])
def test_constants_of_a_system_without_rebecs_come_back(target: str) -> None:
    text = "env int e = 3; abstract reactiveclass Robot(3) { Robot() {} msgsrv go() {} } main {}"
    model = parse_model(Source("model", text)).model
    assert_says(python_files(model, target), model)


def test_a_package_in_two_languages_comes_back() -> None:
    model = model_of(EXAMPLES[-1])
    config = Config(targets=(ClassTarget("Carrier", "ros1-py"),))
    files = generate(model, (), analyse(model), config, "drawn")
    assert {p.rpartition(".")[2] for p in files} >= {"py", "cpp"}
    assert_says(files, model)


@pytest.mark.skipif(find_spec("ruff") is None, reason="ruff is not installed")
@pytest.mark.parametrize("length", LENGTHS)
def test_layout_does_not_matter(length: int, tmp_path: Path) -> None:
    for example in EXAMPLES:
        model = model_of(example)
        folder = tmp_path / example.name
        files = python_files(model)
        for path, text in files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text, encoding="utf-8")
        subprocess.run(
            [
                *(sys.executable, "-m", "ruff", "format", "--quiet", "--isolated"),
                *(f"--line-length={length}", str(folder)),
            ],
            check=True,
        )
        laid_out = {p: (folder / p).read_text(encoding="utf-8") for p in files}
        assert_says(laid_out, model)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("text", [r"say \"no\"", r"it's", r"\"it's\"", r"a \\ b", r"\" \\\" '"])
def test_texts_with_quotes_come_back(text: str, target: str) -> None:
    body = f'reactiveclass R(2) {{ R() {{ assertion(true, "{text}"); }} }} main {{ R r():(); }}'
    model = parse_model(Source("model", body)).model
    assert_says(python_files(model, target), model)


@pytest.mark.parametrize("target", TARGETS)
def test_who_asks_for_a_sender_later_or_elsewhere_leaves_shims_as_they_are(target: str) -> None:
    """A handler asks for no sender if one that it posts does, nor if the run-time part may."""
    text = """
    interface Movable { msgsrv speed(); }
    reactiveclass Robot implements Movable (3) {
      Robot() { self.speed(); }
      msgsrv speed() { self.again((byte) 1); }
      msgsrv again(byte code) { ((Robot) sender).again(code); }
    }
    reactiveclass Other(3) { Other() {} msgsrv level(byte code) { self.level(code); } }
    main { Robot robot():(); Other other():(); }
    """
    model = parse_model(Source("model", text)).model
    assert_says(python_files(model, target), model)
