"""A report on law 6: what bodies in Python may write of the state, and the model's do not.

    python -m tests.reverse.ir.dropped DIRECTORY...

Each directory with Python in it is extracted. A server of the model and the method of its name in
the class of its name are compared: attributes that the method may write (its effects in the form)
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
from rebsync.reverse.analysis.effects import EffectAnalysis
from rebsync.reverse.analysis.library_effects import RECEIVER, LibraryEffect
from rebsync.reverse.analysis.locations import Member
from rebsync.reverse.analysis.writes import written
from rebsync.reverse.findings import Grade
from rebsync.reverse.ir.program import Class, Program
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.python.py_index import PyCode
from rebsync.reverse.python.py_tree import parse
from rebsync.reverse.recovery import Extracted, extract
from rebsync.source import Source
from tests.reverse.ir.tracing import TABLE

_READ = (".py", ".launch", ".xml", ".msg", ".txt", ".yaml", ".cfg")
_ACTS = LibraryEffect(acts=True, calls=False)
_LIBRARIES = {
    **TABLE,
    **{f".{name}": _ACTS for name in ("publish", "debug", "info", "warn", "warning", "error")},
    **{f".{name}": _ACTS for name in ("get_logger", "get_clock", "now", "to_msg", "sleep", "log")},
    **{f".{name}": LibraryEffect(calls=False) for name in ("get", "keys", "values", "format")},
    **{f".{n}": LibraryEffect(frozenset({RECEIVER}), calls=False) for n in ("pop", "clear")},
}


def _known(name: str) -> LibraryEffect | None:
    found = _LIBRARIES.get(name)
    if found is None and (name.startswith("rospy.log") or ".msg." in name):
        return _ACTS
    return found


@dataclass(frozen=True, slots=True)
class Dropped:
    """A server, and the state variables that its method may write and it does not.

    None of them is known where the method may do anything.
    """

    server: str
    names: tuple[str, ...] | None
    why: tuple[str, ...] = ()


def dropped(folder: Path) -> tuple[list[Dropped], Extracted]:
    """The report on one directory, and what was extracted."""
    paths = [p for p in sorted(folder.rglob("*")) if p.suffix in _READ and p.is_file()]
    files = {p.relative_to(folder).as_posix(): Source(str(p), p.read_text("utf-8")) for p in paths}
    extracted = extract(files)
    sources = [source for name, source in files.items() if name.endswith(".py")]
    program = python_program(PyCode.of([parse(source) for source in sources]))
    analysis = EffectAnalysis(program, _known)
    return list(_compared(extracted.model, program, analysis)), extracted


def _compared(model: m.Model, program: Program, analysis: EffectAnalysis) -> Iterator[Dropped]:
    by_name = {c.name.rpartition(":")[2]: c for c in program.classes.values()}
    for read in model.classes:
        class_ = by_name.get(read.name)
        if not isinstance(read, m.ReactiveClass) or class_ is None:
            continue
        state = {d.name for v in read.members if isinstance(v, m.StateVars) for d in _names(v)}
        for member in read.members:
            method = _method(class_, getattr(member, "name", ""), analysis)
            if isinstance(member, m.MessageServer) and method is not None:
                yield _of_server(f"{read.name}.{member.name}", member, method, state, analysis)


def _names(variables: m.StateVars) -> Iterator[m.Declarator]:
    for declaration in variables.declarations:
        yield from declaration.declarators


def _method(class_: Class, name: str, analysis: EffectAnalysis) -> str | None:
    graph = analysis.graph
    for owner in (class_.name, *graph.bases(class_.name)):
        found = graph.program.classes.get(owner)
        if found is not None and name in dict(found.methods):
            return dict(found.methods)[name]
    return None


def _of_server(
    name: str, server: m.MessageServer, method: str, state: set[str], analysis: EffectAnalysis
) -> Dropped:
    effects = analysis.of(method)
    if effects.anything:
        return Dropped(name, None, tuple(sorted({why for why, _ in effects.why})))
    may = {w.name.strip("_") for w in effects.writes if isinstance(w, Member) and w.name}
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
                shown = ", ".join(server.names or server.why[:2])
                where = f"{folder.name}: {server.server}"
                print(f"{where}: {kind}: {shown}{'' if listed else ' (not listed)'}")
    print(dict(kinds))


if __name__ == "__main__":
    main(sys.argv[1:])
