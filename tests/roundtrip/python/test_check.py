"""What `rebsync check` says of packages in Python, and of those of two languages."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.roundtrip.verdict.drift import Verdict
from tests.roundtrip.python.packages import (
    MIXED,
    MODELS,
    checked,
    classes_without_ancestors,
    made,
    python_of,
    told,
)

FRESH = [
    (name, target)
    for name in MODELS
    for target in ("ros1-py", "ros2-py", MIXED)
    if target != MIXED or len(classes_without_ancestors(name)) > 1
]


_CASES = Path(__file__).parents[2] / "forward" / "cases"


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))


@pytest.mark.parametrize(("name", "target"), FRESH)
def test_fresh_packages_are_in_step(name: str, target: str, tmp_path: Path) -> None:
    root = made(name, target, tmp_path)
    assert checked(root).drift is None, "digests tell it"
    for path in python_of(root):
        path.write_text(path.read_text(encoding="utf-8") + "# a remark\n", encoding="utf-8")
    found = checked(root)
    assert told(found) == []
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, found.drift.differences


HARD = {
    **{"env": "ros2-py", "interfaces": "ros1-py", "moves": "ros2-py", "inheritance": "ros1-py"},
    **{"annotations": "ros1-py", "control": "ros2-py", "names": "ros1-py", "rebecs": "ros2-py"},
}


@pytest.mark.parametrize("name", HARD)
def test_fresh_packages_of_hard_cases_are_in_step(name: str, tmp_path: Path) -> None:
    text = (_CASES / f"{name}.rebeca").read_text(encoding="utf-8")
    root = made(name, HARD[name], tmp_path, text)
    for path in python_of(root):
        path.write_text(path.read_text(encoding="utf-8") + "# a remark\n", encoding="utf-8")
    found = checked(root)
    assert told(found) == []
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, found.drift.differences


def test_quotes_do_not_matter(tmp_path: Path) -> None:
    root = made("warehouse", "ros1-py", tmp_path)
    (path,) = (p for p in python_of(root) if p.name == "dispatcher.py")
    text = path.read_text(encoding="utf-8")
    assert '"a carrier leaves' in text
    path.write_text(text.replace("'", "?").replace('"', "'"), encoding="utf-8")
    found = checked(root)
    assert told(found) == []
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, found.drift.differences


@pytest.mark.parametrize(
    "laid_out", ["FindPackageShare('{}')", 'FindPackageShare(\n            "{}",\n        )']
)
def test_layout_of_what_names_the_package_does_not_matter(laid_out: str, tmp_path: Path) -> None:
    root = made("counter", "ros2-py", tmp_path, "reactiveclass A(1) { A() {} }\nmain {}\n")
    (path,) = root.glob("*/launch/*.py")
    text, named = path.read_text(encoding="utf-8"), 'FindPackageShare("counter")'
    assert named in text
    path.write_text(text.replace(named, laid_out.format("counter")), encoding="utf-8")
    assert told(checked(root)) == []
    path.write_text(text.replace(named, laid_out.format("other")), encoding="utf-8")
    assert told(checked(root)) != []


PLAIN = """\
reactiveclass Counter(3) {
  statevars { int a; float f; }
  Counter() { self.run(); }
  msgsrv run() {
    int i;
    a += 1;
    f = 1.5f;
    for (int k = 0; k < 3; k++) { a = a + k; }
    for (i = 0; i < 3; i += 1) a--;
    if (a > 3) for (int k = 5; k > 3; --k) { a = a - k; } else { self.a = 1; }
    int b = ++a;
    a = (b += 1);
    self.run() after(1);
  }
}
main { Counter c():(); }
"""


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_what_python_does_not_show_is_no_difference(target: str, tmp_path: Path) -> None:
    root = made("counter", target, tmp_path, PLAIN)
    (path,) = (p for p in python_of(root) if p.name == "counter.py")
    path.write_text(path.read_text(encoding="utf-8") + "# a remark\n", encoding="utf-8")
    found = checked(root)
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, (found.drift.differences, told(found))
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("1.5", "2.5"), encoding="utf-8")
    found = checked(root)
    assert found.drift is not None
    assert found.drift.verdict is Verdict.CODE_AHEAD
    ((difference, _),) = found.drift.differences
    assert str(difference.element) == "msgsrv Counter.run"


OVERLOADS = """\
reactiveclass Asker(3) {
  knownrebecs { Teller teller; }
  Asker() { self.ask(); }
  msgsrv ask() { teller.tell(); teller.tell(3); teller.state(); }
}
reactiveclass Teller(3) { msgsrv tell() { } msgsrv tell(int n) { } msgsrv state() { } }
main { Asker a(t):(); Teller t():(); }
"""


def test_overloads_in_the_other_language_are_no_difference(tmp_path: Path) -> None:
    root = made("asking", MIXED, tmp_path, OVERLOADS)
    (path,) = (p for p in python_of(root) if p.name == "asker.py")
    path.write_text(path.read_text(encoding="utf-8") + "# a remark\n", encoding="utf-8")
    found = checked(root)
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, (found.drift.differences, told(found))


def test_programs_are_found_by_the_names_that_they_are_installed_with(tmp_path: Path) -> None:
    root = made("running_example", "ros2-py", tmp_path)
    for name in ("setup.py", "launch/running_example.launch.py"):
        for path in root.rglob(name):
            if ".rebsync" not in path.parts:
                text = path.read_text(encoding="utf-8").replace('"r1_node', '"first_robot')
                path.write_text(text, encoding="utf-8")
    found = checked(root)
    assert found.drift is not None
    assert found.drift.verdict is Verdict.IN_STEP, (found.drift.differences, told(found))


def test_a_program_that_runs_another_class_makes_another_rebec(tmp_path: Path) -> None:
    root = made("running_example", "ros2-py", tmp_path)
    path = root / "running_example" / "setup.py"
    text = path.read_text(encoding="utf-8").replace("example.r1_node:main", "example.r2_node:main")
    path.write_text(text, encoding="utf-8")
    found = checked(root)
    assert found.drift is not None
    assert [str(d.element) for d, _ in found.drift.differences] == ["rebec robot1"]
    assert found.drift.verdict is Verdict.CODE_AHEAD


def test_a_local_of_a_block_is_not_known_behind_it(tmp_path: Path) -> None:
    text = (_CASES / "locals.rebeca").read_text(encoding="utf-8")
    root = made("locals", "ros1-py", tmp_path, text)
    (path,) = [p for p in python_of(root) if p.name == "r.py"]
    code = path.read_text(encoding="utf-8")
    assert "__2" not in code.replace("t__2", "").replace("u__2", ""), "arrays, and another type"
    path.write_text(code.replace("        if n > 2:", "        self._a = k\n        if n > 2:", 1))
    found = checked(root)
    assert found.drift is not None
    assert found.drift.verdict is Verdict.UNDETERMINED
