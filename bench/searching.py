"""One search in a process of its own: prints what it found and cost, as JSON.

    python bench/searching.py ENGINE LANGUAGE MODEL [CONSTANT=VALUE ...]

ENGINE is interpreted, compiled, paired (with two threads) or compacted (with fingerprints).
Searches several times if that is quick; `cpu` is the least time of this process for a search,
`clock` that by the clock, and `growth` what it added to the memory of the process, in bytes.
"""

from __future__ import annotations

import json
import re
import sys
import time
from pathlib import Path
from typing import Literal

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Limits, Search
from rebsync.checker.lowering import lower
from rebsync.checker.memory import peak_memory, used_memory
from rebsync.checker.problem import Problem
from rebsync.checker.program import Program
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Semantics
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse

ENOUGH = 1.0  # seconds


def source_of(path: Path, constants: dict[str, str]) -> Source:
    """A model with other values for some of its env variables."""
    text = path.read_text(encoding="utf-8")
    for name, value in constants.items():
        text, found = re.subn(rf"(env \w+ {name} =) \w+;", rf"\1 {value};", text)
        assert found == 1, name
    return Source(str(path), text)


def program_of(path: Path, constants: dict[str, str]) -> Program:
    """A model made ready, with other values for some of its env variables."""
    source = source_of(path, constants)
    parsed = parse_model(source)
    analysis = analyse(parsed.model)
    assert parsed.ok and not analysis.errors
    return lower(Problem(source, analysis).analysis, Problem(source, analysis).properties)[0]


def search_of(engine: str, program: Program, semantics: Semantics) -> Search:
    if engine == "interpreted":
        return Interpreted(program, semantics)
    threads = 2 if engine == "paired" else 1
    return CompiledSearch(
        program, semantics, hash_compaction=engine == "compacted", threads=threads
    )


def timed(search: Search) -> tuple[float, float, Exploration]:
    start, began = time.process_time(), time.perf_counter()
    found = search.run(Limits())
    return time.process_time() - start, time.perf_counter() - began, found


def main() -> None:
    engine, language, path, *constants = sys.argv[1:]
    program = program_of(Path(path), dict(c.split("=", 1) for c in constants))
    semantics: Literal["core", "ftts"] = "core" if language == "core" else "ftts"
    search = search_of(engine, program, semantics)
    before = used_memory()
    cpu, clock, found = timed(search)
    growth = peak_memory() - before
    spent = cpu
    while spent < ENOUGH:
        again, passed, found = timed(search_of(engine, program, semantics))
        cpu, clock = min(cpu, again), min(clock, passed)
        spent += again
    assert found.reason is None and not found.events
    figures = {
        "states": found.states,
        "transitions": found.transitions,
        "cpu": cpu,
        "clock": clock,
        "growth": growth,
    }
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
