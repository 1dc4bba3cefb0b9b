"""One formula, decided in a process of its own: prints what that cost, as JSON.

    python bench/deciding.py MEANS MODEL PROPERTIES FORMULA [CONSTANT=VALUE ...]

MEANS is python or c; the model is searched by the compiled engine in the exact view. `search` and
`graph` are what came before, `cpu` the time of this process for the formula, in seconds; `growth`
what the formula added to the memory of the process, in bytes.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from searching import search_of, source_of

from rebsync.checker.deciding import refutation
from rebsync.checker.exploration import Limits
from rebsync.checker.look import unwatched
from rebsync.checker.lowering import lower
from rebsync.checker.memory import peak_memory, used_memory
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.source import Source
from rebsync.static import analyse

T = TypeVar("T")


def timed(work: Callable[[], T]) -> tuple[float, T]:
    """What some work gives, and its seconds of the processor."""
    start = time.process_time()
    done = work()
    return time.process_time() - start, done


def main() -> None:
    means, path, asked, name, *constants = sys.argv[1:]
    source = source_of(Path(path), dict(c.split("=", 1) for c in constants))
    properties = parse_properties(Source(asked, Path(asked).read_text(encoding="utf-8"))).properties
    program, formulas = lower(analyse(parse_model(source).model), properties)
    formula = next(each.formula for each in formulas if each.name == name)
    branching = name in {entry.name for entry in properties.tctl}
    search = search_of("compiled", program, "tts")
    searching, found = timed(lambda: search.run(Limits()))
    drawing, graph = timed(lambda: search.graph(unwatched))
    before = used_memory()
    cpu, _ = timed(
        lambda: refutation(graph, formula, branching, "none", unwatched, compiled=means == "c")
    )
    figures = {
        "states": found.states,
        "search": searching,
        "graph": drawing,
        "cpu": cpu,
        "growth": peak_memory() - before,
    }
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
