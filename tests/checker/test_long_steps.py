"""One state of the compiled engine that takes for ever: bounds, signals and large arrays."""

from __future__ import annotations

import shutil
import signal
import time
from types import FrameType

import pytest

from rebsync.checker.compile_model import ModelText
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits
from rebsync.checker.memory import used_memory
from tests.checker.comparing import System

pytestmark = pytest.mark.skipif(
    not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"
)

_CLASS = """\
reactiveclass A(2) {
    statevars { int x; }
    A() { self.go(); }
    msgsrv go() {
        x = 0;
        %CHOICES%
        assertion(x != 0);
        for (int i = 0; i < %ROUNDS%; i++) { x = x ^ i; }
        x = %LEFT%;
        self.go() after(1);
    }
}
"""


def _search(choices: int, rounds: int, rebecs: int = 1, left: str = "0") -> CompiledSearch:
    """Each body has 2 ** choices ways to run, each of so many rounds of a loop."""
    text = _CLASS.replace("%CHOICES%", "x = x * 2 + ?(0, 1);\n" * choices)
    text = text.replace("%ROUNDS%", str(rounds)).replace("%LEFT%", left)
    main = " ".join(f"A a{number}():();" for number in range(rebecs))
    return CompiledSearch(System.of(f"{text}main {{ {main} }}").program, "ftts")


def test_the_bound_of_time_holds_within_a_state() -> None:
    search = _search(choices=19, rounds=200_000)
    began = time.process_time()
    found = search.run(Limits(seconds=1.0))
    assert found.reason == "the bound of 1 seconds was reached"
    assert time.process_time() - began < 5.0
    assert search.run(Limits()).reason, "what was ended in the middle does not go on"


def test_the_bound_of_memory_holds_within_a_state() -> None:
    search = _search(choices=19, rounds=0, rebecs=12, left="x")
    found = search.run(Limits(memory=used_memory() + 100_000_000, seconds=60.0))
    assert found.reason is not None
    assert "bytes of memory was reached" in found.reason


def test_a_signal_is_heard_within_a_state() -> None:
    class Told(Exception):
        pass

    def tell(number: int, frame: FrameType | None) -> None:
        raise Told

    search = _search(choices=19, rounds=200_000)
    before = signal.signal(signal.SIGALRM, tell)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        with pytest.raises(Told):
            search.run(Limits())
    finally:
        signal.signal(signal.SIGALRM, before)


def test_large_arrays_are_few_words_of_c() -> None:
    variables = "knownrebecs { A o; } statevars { int[300][300] x; A[4] others; }"
    model = f"reactiveclass A(1) {{ {variables} A() {{ }} }}"
    main = " ".join(f"A a{number}(a{number}):();" for number in range(500))
    text = ModelText(System.of(f"{model} main {{ {main} }}").program).render()
    assert len(text) < 500_000
