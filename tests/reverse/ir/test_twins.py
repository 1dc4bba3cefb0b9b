"""Functions of C++ and of Python that mean the same: both forms give the same, however they differ.

`cpp.form` and `python.form` show what of each language ends in its lowering; to write them again:
`python -m tests.reverse.ir.test_twins`.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.reverse.ir.program import FunctionKind, Program
from tests.reverse.ir.cpp_running import FILE
from tests.reverse.ir.cpp_running import program_of as cpp_program
from tests.reverse.ir.dump import dump_class, dump_function
from tests.reverse.ir.interpreter import Interpreter
from tests.reverse.ir.objects import ObjectInterpreter
from tests.reverse.ir.running import MODULE
from tests.reverse.ir.running import program_of as python_program

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_TWINS = sorted(p for p in (Path(__file__).parent / "twins").iterdir() if p.is_dir())


def _inputs(twin: Path) -> list[list[Any]]:
    found: list[list[Any]] = tomllib.loads((twin / "inputs.toml").read_text("utf-8"))["inputs"]
    return found


def _cpp(twin: Path) -> Program:
    return cpp_program((twin / "twin.cpp").read_text("utf-8"))


def _python(twin: Path) -> Program:
    return python_program((twin / "twin.py").read_text("utf-8"), prefix="")


def _dump(program: Program) -> str:
    """The classes and functions of a program, but for what is empty."""
    functions = [program.function(name) for name in program.functions]
    shown = [f for f in functions if f.kind is not FunctionKind.MODULE or f.body]
    classes = [dump_class(c) for c in program.classes.values()]
    return "\n".join([*classes, *map(dump_function, shown)])


def _cpp_results(twin: Path) -> list[int]:
    interpreter = ObjectInterpreter(_cpp(twin))
    interpreter.module(FILE)
    return [interpreter.call("f", *arguments) for arguments in _inputs(twin)]


def _python_results(twin: Path) -> list[int]:
    module = Interpreter(_python(twin)).module(MODULE)
    return [vars(module)["f"](*arguments) for arguments in _inputs(twin)]


def _by_python(twin: Path) -> list[int]:
    space: dict[str, Any] = {}
    exec(compile((twin / "twin.py").read_text("utf-8"), "twin.py", "exec"), space)
    return [space["f"](*arguments) for arguments in _inputs(twin)]


@pytest.mark.parametrize("twin", _TWINS, ids=lambda p: p.name)
def test_both_forms_give_the_same(twin: Path) -> None:
    assert _cpp_results(twin) == _python_results(twin) == _by_python(twin)


@pytest.mark.parametrize("twin", _TWINS, ids=lambda p: p.name)
def test_the_forms_are_as_shown(twin: Path) -> None:
    assert (twin / "cpp.form").read_text("utf-8") == _dump(_cpp(twin))
    assert (twin / "python.form").read_text("utf-8") == _dump(_python(twin))


if __name__ == "__main__":
    for each in _TWINS:
        (each / "cpp.form").write_text(_dump(_cpp(each)), "utf-8")
        (each / "python.form").write_text(_dump(_python(each)), "utf-8")
