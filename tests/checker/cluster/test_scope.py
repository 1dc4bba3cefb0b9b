"""What a cluster is not asked for is refused, and so is a cluster that there is not."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rebsync.checker.cluster import NoCluster
from rebsync.checker.cluster.connecting import connected
from rebsync.checker.problem import Cluster
from tests.cli.run import ROOT, rebsync

_MODEL = """\
reactiveclass Light(2) {
  statevars { boolean on; }
  Light() { self.turn(); }
  msgsrv turn() { on = !on; self.turn() after(1); }
}
main { Light a():(); Light b():(); }
"""
_PROPERTIES = """\
property {
  define { dark = !a.on; }
  Assertion { same: a.on == a.on; }
  LTL { again: G(F(dark)); }
}
"""


@pytest.fixture
def model(tmp_path: Path) -> Path:
    (tmp_path / "light.property").write_text(_PROPERTIES, encoding="utf-8")
    path = tmp_path / "light.rebeca"
    path.write_text(_MODEL, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ((), "RS934 a cluster does not decide LTL and TCTL (again)"),
        ((), "hint: name the assertions alone (--property-name same), or leave --cluster out"),
        (("--property-name", "again"), "hint: write an assertion, or leave --cluster out"),
        (("--property-name", "same", "--measure", "a.on"), "RS934 a cluster does not measure"),
        (("--property-name", "same", "--symmetry"), "RS934 a cluster does not reduce states by"),
        (("--property-name", "same", "--engine", "interpreted"), "RS934 a cluster does not interp"),
        (("--states", "all.dot"), "--replay, --states, --export and --for-all are for one machine"),
        (("--export", "rmc-xml"), "--replay, --states, --export and --for-all are for one machine"),
    ],
)  # fmt: skip
def test_what_is_refused(model: Path, options: tuple[str, ...], said: str) -> None:
    refused = rebsync("verify", model.name, "--cluster", "local", *options, cwd=model.parent)
    assert refused.status == 2
    assert said in refused.err
    assert not refused.out


def test_workers_of_no_cluster(model: Path) -> None:
    refused = rebsync("verify", model.name, "--workers", "2", cwd=model.parent)
    assert refused.status == 2
    assert "--workers are those of a --cluster" in refused.err


def test_without_ray(model: Path, tmp_path: Path) -> None:
    """As on a machine where it is not installed: here it is hidden."""
    (tmp_path / "ray.py").write_text("raise ImportError", encoding="utf-8")
    options = "--cluster", "local", "--property-name", "same"
    paths = os.pathsep.join((str(tmp_path), str(ROOT)))
    refused = rebsync("verify", model.name, *options, cwd=tmp_path, env={"PYTHONPATH": paths})
    assert refused.status == 2
    assert "RS933 Ray is not installed: pip install 'rebsync[cluster]'" in refused.err
    assert "hint: without --cluster this machine searches" in refused.err


def test_nobody_at_the_address() -> None:
    pytest.importorskip("ray", reason="Ray is not installed: pip install 'rebsync[cluster]'")
    with pytest.raises(NoCluster, match=r"no cluster answers at ray://127\.0\.0\.1:1"):
        connected(Cluster("ray://127.0.0.1:1"))
