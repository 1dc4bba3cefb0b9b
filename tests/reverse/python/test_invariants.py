"""What state variables hold between messages: sums and divisions of Python that need no cut."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.reverse.recovery import extract
from rebsync.source import Source
from tests.forward.compiling import case_files

MODEL = """
env int limit = 5;
reactiveclass C(5) {
  statevars { int n; int m; int[3] list; }
  C(int start) { n = 0; m = 0; self.step(); self.change(1); }
  msgsrv step() { n = n + 1; if (n >= 3) { n = 0; } list[n] = m; self.step() after(1); }
  msgsrv change(byte k) { m = k; shift(); }
  msgsrv back() { n = limit > 2 ? 0 : 1; }
  void shift() { list[0] = m; }
}
main { C c():(1); }
"""
SUM, REST = "        self._n = int32(self._n + 1)\n", "        self._n = (self._n + 1) % 3\n"
UPDATE = "        self._n += 1\n"
BACK = "    def back(self) -> None:\n        self._n = 0 if self._limit > 2 else 1\n"
SHIFT = "    def shift(self) -> None:\n        self._list[0] = self._m\n"
START = "        self._n = 0\n        self._m = 0\n"

# What is written in place of what, and what of it is told.
EDITS = [
    ([(SUM, UPDATE)], []),
    ([(SUM, UPDATE), ("if self._n >= 3:", "if self._n == 3:")], []),
    ([(SUM, UPDATE), ("if self._n >= 3:", "if self._n != 3:")], []),
    ([(SUM, UPDATE), ("if self._n >= 3:", "if self._n > self._m:")], ["self._n += 1"]),
    ([(SUM, UPDATE), ("            self._n = 0\n", "            self._m = 0\n")], ["self._n += 1"]),
    (
        [(SUM, UPDATE), (BACK, BACK.replace("= 0 if self._limit > 2 else 1", "+= 1"))],
        ["self._n += 1"] * 2,
    ),
    (
        [
            (SUM, UPDATE),
            (BACK, BACK.replace("= 0 if self._limit > 2 else 1", "= 7 if self._n > 1 else -9")),
        ],
        [],
    ),
    ([(SUM, UPDATE), (BACK, BACK.replace("= 0 if self._limit > 2 else 1", "= self._m"))], []),
    ([(SUM, UPDATE), (START, START.replace("n = 0", "n = start"))], ["self._n += 1"]),
    ([(SUM, UPDATE), (START, START.replace("n = 0", "n = start & 7"))], []),
    # in the middle of another body
    (
        [(SUM, UPDATE), (SHIFT, SHIFT.replace("_list[0] = self._m", "_n += 1"))],
        ["self._n += 1"] * 2,
    ),
    ([(SUM, UPDATE), (BACK, BACK + "        self.step()\n")], ["self._n += 1", "self.step()"]),
    (
        [
            (SUM, SUM + "        self.shift()\n"),
            (SHIFT, SHIFT.replace("_list[0] = self._m", "_m += 1")),
        ],
        ["self._m += 1"],
    ),
    # a name that hides the variable
    ([(SUM, "        n = self._m\n" + UPDATE), ("if self._n >= 3", "if n >= 3")], ["self._n += 1"]),
    # divisions, which round to the lower number
    ([(SUM, REST)], []),
    ([(SUM, REST), (BACK, BACK.replace("= 0 if self._limit > 2 else 1", "= 2"))], []),
    (
        [(SUM, REST), (BACK, BACK.replace("= 0 if self._limit > 2 else 1", "= -2"))],
        ["(self._n + 1) % 3"],
    ),
    (
        [(SUM, REST), (BACK, BACK.replace("= 0 if self._limit > 2 else 1", "= self._m"))],
        ["(self._n + 1) % 3"],
    ),
    ([(SUM, "        self._n = (self._n + 1) % -3\n")], ["(self._n + 1) % -3"]),
    (
        [(SUM, "        self._n = (self._n + 1) % (self._m + 1)\n")],
        ["(self._n + 1) % (self._m + 1)"],
    ),
    ([(SUM, "        self._n = int32((self._m + 1) % 3)\n")], ["(self._m + 1) % 3"]),
    ([(SUM, "        self._n = int32(int8((self._m + 1) % 3))\n")], ["(self._m + 1) % 3"]),
    ([(SUM, "        self._n = (self._n + 9) // 2\n")], []),
    ([(SUM, "        half = 9 // 2\n        self._n = half\n")], []),
    ([(SUM, "        half = self._m // 2\n        self._n = half\n")], ["self._m // 2"]),
    ([(SUM, "        self._n = self._m // 2\n")], ["self._m // 2"]),
    ([(SUM, "        if self._m >= 0:\n            self._n = self._m // 2\n")], []),
    ([(SUM, "        self._n = 7 // self._m\n")], ["7 // self._m"]),
    ([(SUM, "        self._n = 7 % max(1, self._m)\n")], []),
    ([(SUM, "        self._list[self._m % 3] = 1\n")], ["self._m % 3"]),
    ([(SUM, "        if self._m % 2 == 1:\n            self._n = 1\n")], ["self._m % 2"]),
    ([(SUM, "        while self._m % 2 == 1:\n            self._m = 1\n")], ["self._m % 2"]),
    ([(SUM, "        self.send_self_change(self._m % 2)\n")], ["self._m % 2"]),
    ([(SUM, "        self.send_self_step(When(after=self._m % 2))\n")], ["self._m % 2"]),
    # something in the class that nobody reads
    (
        [(SUM, REST), (BACK, BACK + "        other(self)\n")],
        ["(self._n + 1) % 3", "other(self)", "self._n + 1"],
    ),
]


@pytest.mark.parametrize(
    ("edits", "told"), EDITS, ids=["; ".join(new.strip() for _, new in e) for e, _ in EDITS]
)
@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_class(edits: list[tuple[str, str]], told: list[str], target: str, fresh: Fresh) -> None:
    path, files = fresh[target]
    text = files[path].text
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    found = extract({**files, path: Source(path, text)}).findings
    assert sorted(f.text for f in found) == sorted(told), found


@pytest.mark.parametrize(
    ("target", "name", "old", "new", "told"),
    [
        ("ros1-py", "params.yaml", "limit: 5", "limit: 6", False),
        ("ros1-py", "params.yaml", "limit: 5", "limit: 2147483647", True),
        ("ros1-py", "params.yaml", "limit: 5", "limits: 5", False),
        ("ros1-py", "c.py", '"limit", 5', '"limit", 6', False),
        (
            "ros1-py",
            "held.launch",
            '<param name="start"',
            '<param name="limit" value="7"/>\n    <param name="start"',
            True,
        ),
        (
            "ros1-py",
            "held.launch",
            "<node ",
            '<param name="limit" value="2147483647"/>\n  <node ',
            True,
        ),
        (
            "ros1-py",
            "held.launch",
            "<node ",
            '<param name="limit" value="$(env LIMIT)"/>\n  <node ',
            True,
        ),
        ("ros2-py", "params.yaml", "limit: 5", "limit: 6", False),
        ("ros2-py", "params.yaml", "limit: 5", "limit: 2147483647", True),
        ("ros2-py", "held.launch.py", '"start": 1,', '"start": 1, "env.limit": 2147483647,', True),
    ],
)
def test_constants(target: str, name: str, old: str, new: str, told: bool, fresh: Fresh) -> None:
    path, files = fresh[target]
    text = files[path].text.replace(
        BACK, BACK.replace("= 0 if self._limit > 2 else 1", "= self._limit + 1")
    )
    edited = {**files, path: Source(path, text)}
    other = next(p for p in files if p.endswith(name) and not p.startswith(".rebsync"))
    assert edited[other].text.count(old) == 1
    edited[other] = Source(other, edited[other].text.replace(old, new))
    found = extract(edited).findings
    assert ("self._limit + 1" in [f.text for f in found]) is told, found


def test_a_class_with_heirs(tmp_path: Path) -> None:
    model = tmp_path / "held.rebeca"
    heir = "reactiveclass D extends C(5) { D() { n = 2; } msgsrv more() { n = n + 1; } }\nmain"
    model.write_text(MODEL.replace("main", heir))
    files = {p: Source(p, text) for p, text in case_files(model, "ros1-py").items()}
    path = "src/held/c.py"
    edited = Source(path, files[path].text.replace(SUM, REST))
    found = extract({**files, path: edited}).findings
    assert [f.text for f in found] == ["(self._n + 1) % 3", "self._n + 1"]


Fresh = dict[str, tuple[str, dict[str, Source]]]


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Fresh:
    model = tmp_path_factory.mktemp("model") / "held.rebeca"
    model.write_text(MODEL)
    found = {}
    for target in ("ros1-py", "ros2-py"):
        files = {p.removeprefix("held/"): t for p, t in case_files(model, target).items()}
        path = next(p for p in files if Path(p).name == "c.py")
        found[target] = path, {p: Source(p, t) for p, t in files.items()}
    return found
