"""A report on law 6: what bodies in Python may write of the state, and the model's do not.

    python -m tests.reverse.ir.dropped DIRECTORY...

Each directory with Python in it is extracted. A server of the model and the method of its name in
the class of its name are compared: attributes that the method or what it calls stores in
and that are state variables must be among what the server writes. It knows names only, so it is a
report for people, and no verdict.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.writes import written
from rebsync.reverse.findings import Grade
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.program import Class, Program
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.recovery import Extracted, extract
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse
from rebsync.source import Source
from tests.reverse.ir.tracing import KEEPING, Reach

_READ = (".py", ".launch", ".xml", ".msg", ".txt", ".yaml", ".cfg")


# What the client libraries have that calls nothing of what it gets.
_CLIENT = frozenset(
    f".{n}" for n in ("publish", "debug", "info", "warn", "warning", "error", "now", "sleep", "get")
)


@dataclass(frozen=True, slots=True)
class Dropped:
    """A server, and the state variables that its method may write and it does not.

    None of them is known where the method may run anything.
    """

    server: str
    names: tuple[str, ...] | None


def dropped(folder: Path) -> tuple[list[Dropped], Extracted]:
    """The report on one directory, and what was extracted."""
    paths = [p for p in sorted(folder.rglob("*")) if p.suffix in _READ and p.is_file()]
    files = {p.relative_to(folder).as_posix(): Source(str(p), p.read_text("utf-8")) for p in paths}
    extracted = extract(files)
    sources = [source for name, source in files.items() if name.endswith(".py")]
    program = python_program(PyCode.of([parse(source) for source in sources]))
    reach = Reach(program, Language.PYTHON, KEEPING | _CLIENT)
    return list(_compared(extracted.model, program, reach)), extracted


def _compared(model: m.Model, program: Program, reach: Reach) -> Iterator[Dropped]:
    by_name = {c.name.rpartition(":")[2]: c for c in program.classes.values()}
    for read in model.classes:
        class_ = by_name.get(read.name)
        if not isinstance(read, m.ReactiveClass) or class_ is None:
            continue
        state = {d.name for v in read.members if isinstance(v, m.StateVars) for d in _names(v)}
        for member in read.members:
            method = _method(class_, getattr(member, "name", ""), reach)
            if isinstance(member, m.MessageServer) and method is not None:
                yield _of_server(f"{read.name}.{member.name}", member, method, state, reach)


def _names(variables: m.StateVars) -> Iterator[m.Declarator]:
    for declaration in variables.declarations:
        yield from declaration.declarators


def _method(class_: Class, name: str, reach: Reach) -> str | None:
    graph = reach.origins.graph
    for owner in (class_.name, *graph.bases(class_.name)):
        found = graph.program.classes.get(owner)
        if found is not None and name in dict(found.methods):
            return dict(found.methods)[name]
    return None


def _of_server(
    name: str, server: m.MessageServer, method: str, state: set[str], reach: Reach
) -> Dropped:
    names = reach.of(method)
    if names is None:
        return Dropped(name, None)
    nodes = (n for each in names for n in walk(reach.program.function(each).body))
    targets = (t for n in nodes for t in (*getattr(n, "targets", ()), getattr(n, "target", None)))
    may = {t.name.strip("_") for t in targets if isinstance(t, e.Attribute)}
    says = {n.removeprefix("self.") for n in written(server)}
    return Dropped(name, tuple(sorted(n for n in state if n.strip("_") in may and n not in says)))


def main(folders: list[str]) -> None:
    """Prints what is dropped, and the figures."""
    kinds: Counter[str] = Counter()
    for folder in map(Path, folders):
        servers, extracted = dropped(folder)
        listed = any(f.grade is Grade.UNREADABLE for f in extracted.findings)
        for server in servers:
            kind = "unknown" if server.names is None else "dropped" if server.names else "silent"
            kinds[f"{kind}, {'listed' if listed else 'not listed'}"] += 1
            if server.names is None or server.names:
                shown = ", ".join(server.names or ())
                where = f"{folder.name}: {server.server}"
                print(f"{where}: {kind}: {shown}{'' if listed else ' (not listed)'}")
    print(dict(kinds))


if __name__ == "__main__":
    main(sys.argv[1:])
