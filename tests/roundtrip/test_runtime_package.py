"""The run-time part as a package that others share, against a run-time part of their own."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.config import TARGETS, Config
from rebsync.forward.generate import generate
from rebsync.forward.limits import limits
from rebsync.forward.runtime_package import runtime_packages
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.forward.compiling import CASES
from tests.reverse.laws import extracted

EXAMPLES = Path(__file__).parents[2] / "examples"
WAREHOUSE = EXAMPLES / "warehouse" / "warehouse.rebeca"
# A file of the run-time part, and an edit of it.
EDITS = {
    "ros1-cpp": ("include/rebsync_runtime/mailbox.h", "kQueueSize = 1000", "kQueueSize = 9"),
    "ros1-py": ("src/rebsync_runtime/mailbox.py", "QUEUE_SIZE = 1000", "QUEUE_SIZE = 9"),
    "ros2-cpp": ("msg/Announcement.msg", "\n", "\nint32 more\n"),
    "ros2-py": ("rebsync_runtime/mailbox.py", "QUEUE_SIZE = 1000", "QUEUE_SIZE = 9"),
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    monkeypatch.chdir(tmp_path)
    Path("warehouse.rebeca").write_text(WAREHOUSE.read_text())
    return tmp_path


@pytest.mark.parametrize("target", TARGETS)
def test_the_code_says_the_same_model(target: str) -> None:
    parsed = parse_model(Source(WAREHOUSE.name, WAREHOUSE.read_text()))
    own, shared = (
        generate(parsed.model, (), analyse(parsed.model), config, "warehouse")
        for config in (Config(target=target), Config(target=target, shared_runtime=True))
    )
    beside = {f"~/{path}": text for path, text in runtime_packages(target).items()}
    assert len(own) > len(shared)
    assert not any("mailbox" in path for path in shared)
    found = extracted({**_nodes(shared), **beside})
    assert found.findings == ()
    assert found.model == extracted(_nodes(own)).model


def _nodes(files: dict[str, str]) -> dict[str, str]:
    inside = {p.removeprefix("warehouse/"): t for p, t in files.items()}
    return inside if "package.xml" in inside else files


@pytest.mark.parametrize("target", TARGETS)
def test_edits_of_it_are_told(target: str, capsys: pytest.CaptureFixture[str]) -> None:
    generated = ["generate", "--runtime", "package", "--target", target, "warehouse.rebeca"]
    assert main(generated) == 0
    assert main(["check", "warehouse"]) == 0
    name, old, new = EDITS[target]
    path = Path("rebsync_runtime", name)
    text = path.read_text()
    path.write_text(text + ("# mine\n" if "cpp" not in target or "msg" in name else "// mine\n"))
    assert main(["check", "warehouse"]) == 0
    path.write_text(text.replace(old, new, 1))
    assert text != path.read_text()
    capsys.readouterr()
    for asked in (["check", "warehouse"], ["check", "rebsync_runtime"], ["check", str(path)]):
        assert main(asked) == 4
        assert f"{path}:" in "".join(capsys.readouterr())
    for asked in (["extract", "warehouse"], ["diff", "warehouse.rebeca", "warehouse"]):
        assert main(asked) == 4
        assert f"{path}:" in "".join(capsys.readouterr())
    assert main(generated) == 1  # which keeps the edit
    path.write_text(text)
    assert main(["check", "warehouse"]) == 0
    assert main(["diff", "warehouse.rebeca", "warehouse"]) == 0
    path.unlink()
    assert main(["check", "warehouse"]) == 4
    assert "`rebsync generate --runtime package` writes it" in "".join(capsys.readouterr())
    assert main(generated) == 0
    assert main(["check", "warehouse"]) == 0


def test_an_edit_of_the_code_comes_into_the_model() -> None:
    assert main(["generate", "--runtime", "package", "warehouse.rebeca"]) == 0
    path = Path("warehouse/src/carrier.cpp")
    path.write_text(path.read_text().replace("% 8", "% 9", 1))
    assert main(["sync", "warehouse"]) == 0
    assert main(["check", "warehouse"]) == 0
    assert "% 9" in Path("warehouse.rebeca").read_text()
    assert not Path("warehouse/include/warehouse/mailbox.h").exists()


def test_a_package_may_have_its_own_again() -> None:
    assert main(["generate", "--runtime", "package", "warehouse.rebeca"]) == 0
    assert main(["generate", "--runtime", "own", "warehouse.rebeca"]) == 0
    assert Path("warehouse/include/warehouse/mailbox.h").exists()
    kept = Path("warehouse/.rebsync/base").rglob("*")
    assert not [p for p in kept if p.is_file() and "~" in p.parts]
    assert main(["check", "warehouse"]) == 0


@pytest.mark.parametrize("name", ["services", "actions", "parentheses"])
def test_models_that_need_more_are_refused(name: str) -> None:
    model = parse_model(Source(name, (CASES / f"{name}.rebeca").read_text())).model
    found = limits(model, analyse(model), Config(shared_runtime=True), name)
    assert [d.code for d in found if d.code == "RS713"] == ["RS713"]
    assert not [d for d in limits(model, analyse(model), Config(), name) if d.code == "RS713"]
