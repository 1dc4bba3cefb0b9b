"""Code that is not evaluated in the order of the model is listed; what is generated never is."""

from __future__ import annotations

from collections.abc import Collection, Iterable

import pytest

from rebsync.config import TARGETS, Config
from tests.forward.compiling import generated
from tests.reverse.laws import extracted

MODEL = """\
reactiveclass Base(5) {
  statevars { int count; int level; }
  Base() { }
  int low() { return level; }
  int rate() { return 1; }
  msgsrv work() { STATEMENT_OF_BASE }
}
reactiveclass G extends Base(5) {
  statevars { int[4] queue; int[3][3] grid; int head; }
  G() { self.go(0); }
  int rate() { count = count + 1; return count; }
  int take() { count = count + 1; return count; }
  int peek() { return count; }
  int later() { self.go(1) after(2); return 1; }
  msgsrv go(int a) { }
SERVERS  msgsrv put(int a, int b) { level = a + b; self.put(8, 9) after(1); }
}
main { G g():(); }
"""
OPEN = {  # statements of the model, and what says them in C++ but for the order
    "self.put(take(), take());": "sendSelfPut(take(), take());",
    "self.put(count, take());": "sendSelfPut(count_, take());",
    "self.put(later(), later());": "sendSelfPut(later(), later());",
    "self.put(count, rate());": "sendSelfPut(count_, rate());",
    "head = count - take();": "head_ = count_ - take();",
    "head = a++ - a;": "head_ = a++ - a;",
    "head = head++;": "head_ = head_++;",
    "count += take();": "count_ += take();",
    "queue[count] = take();": "queue_.at(count_) = take();",
    "queue[head] = head++;": "queue_.at(head_) = head_++;",
    "queue[head] += later();": "queue_.at(head_) += later();",
    "head = grid[take()][take()];": "head_ = grid_.at(take()).at(take());",
    "grid[take()][count] = 3;": "grid_.at(take()).at(count_) = 3;",
    "if (take() > count) { head = 1; }": "if (take() > count_) {\n    head_ = 1;\n  }",
}
IN_ORDER = {  # the same where the order makes no difference
    "self.put(level, take());": "sendSelfPut(level_, take());",
    "self.put(a, take());": "sendSelfPut(a, take());",
    "self.put(peek(), low());": "sendSelfPut(peek(), low());",
    "self.put(count, peek());": "sendSelfPut(count_, peek());",
    "head = level - take();": "head_ = level_ - take();",
    "head = a++ - head;": "head_ = a++ - head_;",
    "count = take();": "count_ = take();",
    "level += take();": "level_ += take();",
    "queue[0] = take();": "queue_[0] = take();",
    "grid[level][take()] = 4;": "grid_.at(level_).at(take()) = 4;",
    "queue[head] = peek();": "queue_.at(head_) = peek();",
    "if (take() > 1 && count > 2) { head = 1; }": (
        "if (take() > 1 && count_ > 2) {\n    head_ = 1;\n  }"
    ),
}
STORES = {  # in Python the order of the value and of what it is stored into
    "queue[count] = take();": ("self._queue[self._count] = self.take()", True),
    "queue[head] = rate();": ("self._queue[self._head] = self.rate()", True),
    "queue[head] += later();": (
        "self._queue[self._head] = int32.add(self._queue[self._head], self.later())",
        True,
    ),
    "queue[0] = take();": ("self._queue[0] = self.take()", False),
    "queue[head] = peek();": ("self._queue[self._head] = self.peek()", False),
    "self.put(count, take());": ("self.send_self_put(self._count, self.take())", False),
}


def _package(target: str, statements: Iterable[str], of_base: str = "") -> dict[str, str]:
    """A package with a server for each statement: s0, s1, ..."""
    servers = (f"  msgsrv s{i}(int a) {{ {each} }}\n" for i, each in enumerate(statements))
    text = MODEL.replace("SERVERS", "".join(servers)).replace("STATEMENT_OF_BASE", of_base)
    return generated(text, "g", Config(target=target))


def _listed(target: str, plain: str, code: Collection[str]) -> list[bool]:
    """Whether the order is told of, for lines of code written by hand into a server each."""
    files = _package(target, [f"head = {1000 + i};" for i in range(len(code))])
    for number, line in enumerate(code):
        old = plain.format(1000 + number)
        assert sum(old in text for text in files.values()) == 1
        files = {path: text.replace(old, line) for path, text in files.items()}
    found = extracted(files).findings
    assert all("order" in f.why for f in found), found
    return [f"G.s{i}" in {f.within for f in found} for i in range(len(code))]


@pytest.mark.parametrize("target", TARGETS)
def test_what_is_generated_has_the_order_of_the_model(target: str) -> None:
    found = extracted(_package(target, [*OPEN, *IN_ORDER, *STORES]))
    assert [(f.text, f.why) for f in found.findings] == []


@pytest.mark.parametrize("target", ["ros1-cpp", "ros2-cpp"])
def test_cpp_that_leaves_the_order_open_is_listed(target: str) -> None:
    code = [*OPEN.values(), *IN_ORDER.values()]
    listed = _listed(target, "head_ = {};", code)
    assert dict(zip(code, listed, strict=True)) == {c: c in OPEN.values() for c in code}


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_python_finds_what_it_stores_into_late(target: str) -> None:
    listed = _listed(target, "self._head = {}", [code for code, _ in STORES.values()])
    wanted = dict(STORES.values())
    assert dict(zip(wanted, listed, strict=True)) == wanted


def test_a_function_that_another_class_overrides_may_act() -> None:
    files = _package("ros1-cpp", [], "level = rate() - count;")
    source = files["src/base.cpp"]
    assert "const auto left = rate(); const auto right = count_;" in source
    assert extracted(files).findings == ()
    files["src/base.cpp"] = source.replace(
        source[source.index("level_ = [&]") :].partition("\n")[0], "level_ = rate() - count_;"
    )
    assert ["order" in f.why for f in extracted(files).findings] == [True]
