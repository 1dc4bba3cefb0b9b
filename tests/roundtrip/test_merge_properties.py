"""What is renamed in the code is renamed in the property file as well, and nothing else of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.cli.status import Status
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.properties import with_renames
from rebsync.roundtrip.package.models import parsed
from rebsync.source import Source
from tests.roundtrip.mutations.harness import written
from tests.roundtrip.mutations.package import DIALECTS, Package

PROPERTY = """property {
  define {
    a = (one.cell   ==  1);  // cell of one
    /* two.cell */
    near = (one.cell != limit && two.cell != two.other[0]);
  }
  Assertion { Near: near && !a; }
  TCTL { Soon: AF(time <= limit, one.cell == 2); }
}
"""
MODEL = """env int limit = 5;
abstract reactiveclass Base(3) { statevars { int cell; } }
reactiveclass Robot extends Base(3) { statevars { int[2] other; }
  Robot() { cell = limit; other[0] = 1; self.go(); } msgsrv go() { cell = other[0]; } }
main { Robot one():(); Robot two():(); }
"""


def given(text: str) -> SourcedModel:
    source = Source("m.rebeca", text)
    return SourcedModel(parsed(source), source)


def renamed(old: str, new: str) -> str:
    """The property after some words of the model were replaced."""
    after = given(MODEL.replace(old, new))
    return with_renames(Source("m.property", PROPERTY), given(MODEL), after)


def test_a_variable_of_a_class_above() -> None:
    assert renamed("cell", "place") == PROPERTY.replace(".cell ", ".place ").replace(
        "/* two.place", "/* two.cell"
    )


def test_a_rebec() -> None:
    text = PROPERTY.replace("(one.", "(first.").replace(", one.", ", first.")
    assert renamed("one", "first") == text


def test_a_constant_in_a_bound() -> None:
    assert renamed("limit", "most") == PROPERTY.replace("limit", "most")


def test_a_name_that_the_file_defines_itself_stays_apart() -> None:
    assert renamed("limit", "near") == PROPERTY


@pytest.mark.parametrize("dialect", DIALECTS)
def test_lint_is_clean_after_a_sync(
    dialect: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    root = tmp_path / "warehouse"
    package = Package("warehouse", dialect)
    written(package, root)
    model, property_ = root / "warehouse.rebeca", root / "warehouse.property"
    text = (package.example / "warehouse.property").read_text(encoding="utf-8")
    property_.write_bytes(text.replace("\n", "\r\n").encode())
    for path in (p for p in root.rglob("carrier.*") if ".rebsync" not in p.parts):
        names = ("self._cell", "self._at_cell") if package.is_python else ("cell_", "at_cell_")
        path.write_text(path.read_text(encoding="utf-8").replace(*names), encoding="utf-8")
    assert main(["sync", str(root)]) == int(Status.CLEAN)
    wanted = text.replace(".cell", ".at_cell").replace("\n", "\r\n")
    assert property_.read_bytes() == wanted.encode()
    assert main(["lint", str(model), str(property_)]) == int(Status.CLEAN)


def test_a_model_renamed_by_hand_takes_its_property_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    root = tmp_path / "warehouse"
    package = Package("warehouse", "ros1-cpp")
    written(package, root)
    model, property_ = root / "warehouse.rebeca", root / "warehouse.property"
    text = (package.example / "warehouse.property").read_text(encoding="utf-8")
    property_.write_text(text, encoding="utf-8")
    model.write_text(model.read_text(encoding="utf-8").replace("packer", "desk"), encoding="utf-8")
    assert main(["sync", "--dry-run", str(root)]) == int(Status.FINDINGS)
    assert property_.read_text(encoding="utf-8") == text
    assert main(["sync", str(root)]) == int(Status.CLEAN)
    assert property_.read_text(encoding="utf-8") == text.replace("packer.", "desk.")
