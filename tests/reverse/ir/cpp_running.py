"""Texts of C++, compiled and run by g++, and as the intermediate form: both must do the same.

A text has `run()` and tells what it does by `note(x)`. Many texts are one program: to compile the
headers takes longer than the rest.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

from rebsync.reverse.ir.cpp.lowering import program_of as lowered
from rebsync.reverse.ir.program import Program
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source
from tests.reverse.ir.memory import Thrown
from tests.reverse.ir.objects import ObjectInterpreter

FILE = "case.cpp"
_HEAD = """
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>
template <class T> void note(const T& x) { std::cout << x << "\\n"; }
inline void note(bool x) { std::cout << int(x) << "\\n"; }
inline void note(unsigned char x) { std::cout << int(x) << "\\n"; }
inline void note(signed char x) { std::cout << int(x) << "\\n"; }
inline void note(char x) { std::cout << int(x) << "\\n"; }
"""
# Signed numbers wrap, as the lowering says; an exception that nobody handles is told.
_MAIN = """
template <class F> void outcome(F run) {
  try { auto given = run(); std::cout << "gives " << +given << "\\n"; }
  catch (...) { std::cout << "throws\\n"; }
  std::cout << "----\\n";
}
"""


def program_of(text: str) -> Program:
    """The program of one text."""
    return lowered(Code.of([parse(Source(FILE, text))]))


def natively(texts: Sequence[str], folder: Path) -> list[list[str]]:
    """What each text tells and gives, compiled as one program."""
    spaces = [f"namespace case{n} {{\n{text}\n}}\n" for n, text in enumerate(texts)]
    runs = [f"  outcome(case{n}::run);\n" for n in range(len(texts))]
    source, binary = folder / "cases.cpp", folder / "cases"
    source.write_text("".join([_HEAD, _MAIN, *spaces, "int main() {\n", *runs, "}\n"]))
    command = ["g++", "-std=c++17", "-O0", "-w", "-fwrapv", "-o", str(binary), str(source)]
    subprocess.run(command, check=True, timeout=300)
    found = subprocess.run([str(binary)], check=True, capture_output=True, text=True, timeout=60)
    return [part.splitlines() for part in found.stdout.split("----\n")[: len(texts)]]


def by_form(text: str, is_reversed: bool = False) -> list[str]:
    """The same by the interpreter of the form; parts without an order run in one order."""
    interpreter = ObjectInterpreter(program_of(text), is_reversed)
    interpreter.module(FILE)
    try:
        last = f"gives {int(interpreter.call('run'))}"
    except Thrown:
        last = "throws"
    return [*interpreter.notes, last]
