"""Functions of nodes in C++ that may wait for a lock that they hold, and those that may not."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_CASES = tomllib.loads(Path(__file__).with_name("locks.toml").read_text("utf-8"))
_AROUND = """
struct Guard {
  explicit Guard(std::mutex& m) : held_(m) { held_.lock(); }
  ~Guard() { held_.unlock(); }
  std::mutex& held_;
};
using Other = Guard;
struct Held {
  explicit Held(std::mutex& m) : inner_(m) {}
  std::lock_guard<std::mutex> inner_;
};
struct Never {
  explicit Never(std::mutex& m) { m.lock(); }
};
template <class M>
struct Any {
  explicit Any(M& m) : m_(m) { m_.lock(); }
  ~Any() { m_.unlock(); }
  M& m_;
};
struct Posix {
  explicit Posix(pthread_mutex_t* m) : m_(m) { pthread_mutex_lock(m_); }
  ~Posix() { pthread_mutex_unlock(m_); }
  pthread_mutex_t* m_;
};
struct Store {
  void begin() { own_.lock(); }
  void end() { own_.unlock(); }
  void put() { std::lock_guard<std::mutex> l(own_); }
  std::mutex own_;
};
template <class S>
struct Every {
  explicit Every(S& s) : s_(s) { s_.own_.lock(); }
  ~Every() { s_.own_.unlock(); }
  S& s_;
};
struct Inherited : Guard {
  using Guard::Guard;
};
struct Node {
  void on() {
    BODY
  }
  void inner() { Guard b(mutex_); }
  std::unique_lock<std::mutex> hold() {
    std::unique_lock<std::mutex> l(mutex_);
    return l;
  }
  void keep(std::unique_lock<std::mutex> l) {}
  std::mutex mutex_, other_;
  pthread_mutex_t posix_;
  Store store_;
  int count_ = 0;
};
"""


@pytest.mark.parametrize("name", _CASES)
def test_locks(name: str) -> None:
    case = _CASES[name]
    code = Code.of([parse(Source("node.cpp", _AROUND.replace("BODY", case["body"])))])
    functions = [f for f in code.functions_of(code.classes["Node"]) if f.name == "on"]
    assert len(functions) == 1
    found = {why for _, _, why in CppForm(code).odd_locks(functions)}
    assert case["why"] in found if case["why"] else not found, found


def test_functions_of_known_files_leave_nothing_locked() -> None:
    """`begin` leaves a lock for who calls it; of the run-time part `check` compares the text."""
    helper = "struct Store { void begin() { own_.lock(); } std::mutex own_; };"
    node = "struct Node { void on() { store_.begin(); store_.begin(); } Store store_; };"
    files = [parse(Source("store.h", helper)), parse(Source("node.cpp", node))]
    code = Code.of(files)
    functions = code.functions_of(code.classes["Node"])
    assert list(CppForm(code).odd_locks(functions))
    assert not list(CppForm(code, files[:1]).odd_locks(functions))
