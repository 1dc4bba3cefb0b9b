"""Hand edits of generated Python: what the model can show comes back, all else is listed."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.printing import print_model
from rebsync.reverse.recovery import extract
from rebsync.source import Source
from tests.forward.compiling import CASES, case_files
from tests.reverse.python.laws import extracted, python_files

MODEL = """\
env int limit = 3;

reactiveclass Robot(4) {
  knownrebecs { Robot other; }
  statevars { int count; boolean busy; }
  Robot(int start) { count = start; self.step(1) after(2); }
  msgsrv step(int by) {
    if (count < limit) { count = count + by; } else { busy = true; }
    other.step(by) after(3);
    helper(by);
  }
  void helper(int n) { delay(n); }
}

main { Robot a(b):(0); Robot b(a):(1); }
"""
PATH = "src/drawn/robot.py"
BODY = "        self.helper(by)\n"


def in_match(*cases: str) -> str:
    """The body with a `match` before it."""
    return "        match by:\n" + "".join(f"            {case}\n" for case in cases) + BODY


# What is replaced by what, and the lines of the model that go and come.
SHOWN = {
    "guard": (
        "self._count < self._limit",
        "self._count <= self._limit",
        "count < limit",
        "count <= limit",
    ),
    "removed send": (
        "        self.send_other_step(by, When(after=3))\n",
        "",
        "    other.step(by) after(3);\n",
        "",
    ),
    "delay": (
        "self._mailbox.delay(n)",
        "self._mailbox.delay(int32(2 * n))",
        "delay(n)",
        "delay(2 * n)",
    ),
    "after": ("When(after=3)", "When(after=4, deadline=9)", "after(3)", "after(4) deadline(9)"),
    "assignment": (
        "self._busy = True",
        "self._busy = not self._busy",
        "busy = true",
        "busy = !busy",
    ),
    "queue": ("Mailbox(4)", "Mailbox(5)", "Robot(4)", "Robot(5)"),
    "early return": (
        BODY,
        "        if by == 2:\n            return\n" + BODY,
        "    helper(by);",
        "    if (by == 2) {\n      return;\n    }\n    helper(by);",
    ),
    "while": (
        BODY,
        "        while self._busy:\n            self._busy = False\n" + BODY,
        "    helper(by);",
        "    while (busy) {\n      busy = false;\n    }\n    helper(by);",
    ),
}
# What is put in where, and the place that is listed.
LISTED = {
    "case behind all": (BODY, in_match("case n: pass", "case 1: self._count = 2"), "case n:"),
    "truth among numbers": (BODY, in_match("case True: self._count = 2"), "True"),
    "complex number": (BODY, in_match("case 1 - 2j: self._count = 2"), "1 - 2j"),
    "parts of a value": (BODY, in_match("case [1, n]: self._count = n"), "[1, n]"),
    "name of a value before": (BODY, in_match("case n: by = 3; self._count = n"), "case n:"),
    "library call in a body": (BODY, BODY + "        time.sleep(by)\n", "time.sleep(by)"),
    "second publisher": (
        "self._mailbox.on_served(",
        "self.p = rospy.Publisher('x', T)\n        self._mailbox.on_served(",
        "self.p = rospy.Publisher('x', T)",
    ),
    "shim does more": (
        "        self._mailbox.receive(_STEP",
        "        self._count = 0\n        self._mailbox.receive(_STEP",
        "self._count = 0",
    ),
    "shim loses a field": ("self.step(msg.by)", "self.step(7)", "self._mailbox.receive"),
    "send fills another value": ("msg.by = by", "msg.by = by + 1", "self._mailbox.publish"),
    "post loses an argument": (
        "lambda: self.step(by)",
        "lambda: self.step(1)",
        "self._mailbox.post",
    ),
    "topic": ('"~step", RobotStep', '"~other", RobotStep', "self._step_sub"),
    "state topic is silent": (
        "self._state_pub.publish(msg)",
        "self._state_pub.publish(other)",
        "self._state_pub.publish(other)",
    ),
    "code beside the class": (
        "class Robot:",
        "rospy.loginfo('x')\n\n\nclass Robot:",
        "rospy.loginfo('x')",
    ),
    "attribute of the class": (
        "    @property\n",
        "    speed = [3]\n\n    @property\n",
        "speed = [3]",
    ),
}


# Of `operands.rebeca`: stores and jumps that are none of the model's any more.
OTHERWISE = {
    "a step of another variable": (
        "before(case2, (case2 := int32.add(case2, 1)))",
        "before(case2, (again := int32.add(again, 1)))",
    ),
    "a longer step": ("int32.add(values4[index3], 1)", "int32.add(values4[index3], 2)"),
    "a step of another element": ("int32.add(values4[index3], 1)", "int32.add(values4[0], 1)"),
    "an element once more": ("int32.add(values2[index2]", "int32.add(values2[index2] * 2"),
    "bounds of another array": ("values3.at(", "values2.at("),
    "a name that is kept": ("            second,\n", "            len(values3),\n"),
    "nothing goes on": (
        "            if case.goes_on:\n                continue\n            self._place = self",
        "            self._place = self",
    ),
    "something else goes on": (
        "            if case.goes_on:\n                continue\n",
        "            if case.goes_on:\n                self._left = 7\n",
    ),
}


@pytest.fixture(scope="module")
def files() -> dict[str, str]:
    return python_files(parse_model(Source("drawn.rebeca", MODEL)).model)


def edited(files: Mapping[str, str], old: str, new: str) -> dict[str, str]:
    assert old in files[PATH], files[PATH]
    return {**files, PATH: files[PATH].replace(old, new, 1)}


@pytest.mark.parametrize("name", SHOWN)
def test_what_the_model_can_show_comes_back(files: dict[str, str], name: str) -> None:
    old, new, gone, come = SHOWN[name]
    found = extracted(edited(files, old, new))
    assert [(f.text, f.why) for f in found.findings] == []
    before = print_model(extracted(files).model)
    assert gone in before
    assert print_model(found.model) == before.replace(gone, come, 1)


@pytest.mark.parametrize("name", LISTED)
def test_what_it_cannot_show_is_listed(files: dict[str, str], name: str) -> None:
    old, new, place = LISTED[name]
    found = extracted(edited(files, old, new))
    assert any(f.text.startswith(place) for f in found.findings), found.findings


@pytest.mark.parametrize("name", OTHERWISE)
def test_operands_in_order_are_looked_at(name: str) -> None:
    files, path = case_files(CASES / "operands.rebeca", "ros1-py"), "src/operands/keeper.py"
    assert extracted(files).findings == ()
    old, new = OTHERWISE[name]
    assert old in files[path]
    found = extracted({**files, path: files[path].replace(old, new, 1)})
    assert any(f.grade.value == "unreadable" for f in found.findings), print_model(found.model)


def test_a_constant_that_another_hides_is_told() -> None:
    """Functions of a class above use the constant of the class that the object is of."""
    files = case_files(CASES / "inheritance.rebeca", "ros1-py")
    for name, above, value in (("car", "Vehicle", 2), ("truck", "Car", 3)):
        path, head = f"src/inheritance/{name}.py", f"class {name.capitalize()}({above}):\n"
        assert head in files[path]
        files[path] = files[path].replace(head, f"{head}    LOWEST = {value}\n")
        found = extract({p: Source(p, text) for p, text in files.items()}).findings
        assert [f.text for f in found] == ["LOWEST = 3"] * (name == "truck")


def test_first_values_that_descendants_share_are_told() -> None:
    """A rebec runs one constructor of the model, so that none of a class above can hold them."""
    files = case_files(CASES / "inheritance.rebeca", "ros1-py")
    for name, old in (("vehicle", "_fuel: int = 0"), ("car", "_trips: int = 0")):
        path, text = f"src/inheritance/{name}.py", files[f"src/inheritance/{name}.py"]
        assert old in text
        for value, listed in (("4", ["4"]), ("int()", [])):
            changed = {**files, path: text.replace(old, old.replace("0", value))}
            found = extract({p: Source(p, t) for p, t in changed.items()}).findings
            assert [f.text for f in found] == listed


def test_a_function_is_that_of_its_own_module() -> None:
    """A method of the model would hide the one by its name that a class above calls."""
    files = case_files(CASES / "inheritance.rebeca", "ros1-py")
    for name, old, count in (("vehicle", "int32(far * 2)", 2), ("car", "+ 1)", 1)):
        path, text = f"src/inheritance/{name}.py", files[f"src/inheritance/{name}.py"]
        assert old in text
        at = text.rindex("\n\n\n", 0, text.index(f"class {name.capitalize()}("))
        function = f"\n\n\ndef more(x: int) -> int:\n    return int32(x * {count})"
        new = "more(far)" if name == "vehicle" else "+ more(1))"
        files[path] = text[:at] + function + text[at:].replace(old, new, 1)
        found = extract({p: Source(p, t) for p, t in files.items()}).findings
        assert [f.text for f in found] == ["more(1)"] * (name == "car")
