"""How much of some Python has a lowering: python -m tests.reverse.ir.coverage DIRECTORY..."""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.ir.walk import statements
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse
from rebsync.source import Source


def main(folders: list[str]) -> None:
    """Prints how many statements of the form there are, how many are `Unsupported`, and why."""
    files, total, reasons = 0, 0, Counter[str]()
    for path in (p for folder in folders for p in sorted(Path(folder).rglob("*.py"))):
        source = Source(str(path), path.read_text("utf-8", "replace"))
        program = python_program(PyCode.of([parse(source)]))
        files += 1
        for name in program.functions:
            for statement in statements(program.function(name).body):
                total += 1
                if isinstance(statement, s.Unsupported):
                    reasons[statement.reason] += 1
    print(f"{files} files, {total} statements, {reasons.total()} unsupported")
    for reason, count in reasons.most_common():
        print(f"{count:6} {reason}")


if __name__ == "__main__":
    main(sys.argv[1:])
