"""Headers of generated sources: read past, kept in step, and added later without losing edits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.config import TARGETS, Config, SensorBinding
from rebsync.forward.headers import LICENSES, headed
from rebsync.forward.templating import fill
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.normal_form import normal
from rebsync.source import Source
from tests.forward.compiling import CASES, case_config, generated
from tests.reverse.laws import (
    assert_same,
    assert_says,
    extracted,
    told_without_markers,
    without_markers,
)
from tests.reverse.python.laws import assert_says as assert_python_says
from tests.reverse.python.laws import python_normal

# A holder that would be a marker, the end of a comment, or a template elsewhere.
_HOLDER = "2024-2026 A -- B */ {{ x }} --> # rebsync: statevar R.x"
_MODEL = """
// What everybody knows.
@Robot reactiveclass Eye(9) {
  statevars { int level; }
  Eye() { self.battery() after(1); }
  @Sensor msgsrv battery() { level = ?(10, 40); self.battery() after(2); }
}
main { Eye e():(); }
"""
_OWNER = 'license = "MIT"\nmaintainers = [{ name = "Ada", email = "ada@example.org" }]\n'


def _files(name: str, config: Config) -> dict[str, str]:
    """The files; in rclpy without the package of the messages."""
    files = generated((CASES / f"{name}.rebeca").read_text("utf-8"), name, config)
    if config.target != "ros2-py":
        return files
    return {p.removeprefix(f"{name}/"): t for p, t in files.items() if p.startswith(f"{name}/")}


@pytest.mark.parametrize("license_", ["Apache-2.0", None])
@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("name", ["inheritance", "actions"])
def test_it_comes_back(name: str, target: str, license_: str | None) -> None:
    path = CASES / f"{name}.rebeca"
    config = replace(case_config(path), target=target, copyright=_HOLDER, license=license_)
    files = _files(name, config)
    model = parse_model(Source(name, path.read_text("utf-8"))).model
    (assert_python_says if target.endswith("py") else assert_says)(files, model)
    found = extracted(without_markers(files))
    assert [(f.text, f.why) for f in found.findings] == []
    told, wanted = found.model, normal(model)
    if target.endswith("py"):
        told, wanted = python_normal(told), python_normal(wanted)
    assert_same(told_without_markers(told), told_without_markers(wanted))


@pytest.mark.parametrize("target", TARGETS)
def test_a_copyright_that_comes_later_keeps_edits(
    target: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("eyes.rebeca").write_text(_MODEL)
    Path("rebsync.toml").write_text(f'target = "{target}"\n{_OWNER}')
    assert main(["generate", "eyes.rebeca"]) == 0
    assert "`copyright`" in capsys.readouterr().err
    sources = [p for p in Path("eyes").rglob("eye*") if ".rebsync" not in p.parts]
    (sensors,) = (p for p in sources if p.stem == "eye_sensors")
    (code,) = (p for p in sources if p.name in ("eye.cpp", "eye.py"))
    comment = "#" if target.endswith("py") else "//"
    for path in (sensors, code):
        path.write_text(f"{path.read_text()}{comment} mine\n")
    Path("rebsync.toml").write_text(f'target = "{target}"\n{_OWNER}copyright = "2026 ACME"\n')
    main(["check", "eyes"])
    assert "RS955" in capsys.readouterr().out
    assert main(["generate", "eyes.rebeca"]) == 0
    assert "RS710" not in capsys.readouterr().err
    for path in (sensors, code):
        lines = path.read_text().splitlines()
        assert (lines[0], lines[-1]) == (f"{comment} Copyright 2026 ACME", f"{comment} mine")
        assert path.read_text().count("Copyright") == 1
    assert main(["check", "eyes"]) == 0
    assert "RS955" not in capsys.readouterr().out
    model = Path("eyes.rebeca").read_text()
    Path("eyes.rebeca").write_text(model.replace("after(2)", "after(3)"))
    assert main(["sync", "eyes"]) == 0
    lines = code.read_text().splitlines()
    assert (lines[0], lines[-1]) == (f"{comment} Copyright 2026 ACME", f"{comment} mine")
    assert main(["check", "eyes"]) == 0


@pytest.mark.parametrize("target", TARGETS)
def test_where_nobody_says_it_there_is_no_header(target: str) -> None:
    files = generated(_MODEL, "eyes", Config(target=target, license="MIT"))
    assert not [path for path, text in files.items() if "Copyright" in text]


def test_every_licence_has_a_text_with_the_holder_in_it() -> None:
    for name in LICENSES:
        text = fill(f"headers/{name}.j2", line="Copyright 2026 X", holder="X")
        assert text.startswith("Copyright 2026 X\n") and len(text.splitlines()) > 8, name


def test_a_header_stands_behind_the_line_that_says_what_runs_a_script() -> None:
    owned = Config(copyright="2026 X")
    found = headed({"scripts/a": "#!/usr/bin/env python3\npass\n", "a.yaml": "a: 1\n"}, owned)
    notice = "# Copyright 2026 X\n#\n# The licence is in package.xml.\n"
    assert found == {"scripts/a": f"#!/usr/bin/env python3\n{notice}\npass\n", "a.yaml": "a: 1\n"}


def test_a_licence_that_is_spelt_otherwise_is_told(tmp_path: Path) -> None:
    from rebsync.forward.limits import limits
    from rebsync.static import analyse

    model = parse_model(Source("m", _MODEL)).model
    sensor = (SensorBinding("Eye.battery", "/b", "std_msgs/Bool"),)
    for license_, hint in (("Apache 2.0", "Apache-2.0"), ("Proprietary", None), ("MIT", None)):
        config = Config(copyright="2026 X", license=license_, sensors=sensor)
        found = [d.hint or "" for d in limits(model, analyse(model), config, "m")]
        assert any("Apache-2.0" in each for each in found) == (hint is not None), found
