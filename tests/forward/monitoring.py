"""The core of generated monitors without ROS, runs of a model to feed it, and an oracle for both.

The oracle asks the checker's exact view: it looks for a run that has all observations, whatever
order the steps of one moment have.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any, TypeAlias

from rebsync.checker.lowering.system import lower
from rebsync.checker.program import Program
from rebsync.checker.state import Message, State
from rebsync.checker.steps import TIME, Failure, Step
from rebsync.checker.views import Exact, view_of
from rebsync.config import Config
from rebsync.forward.monitor_model import MonitorModel, monitor_model, python_tables
from rebsync.forward.templating import fill
from rebsync.forward.view import view
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse

# rebec, server, arguments, arrival, start, now, variables
Seen: TypeAlias = tuple[int, str, str, int, int, int, tuple[int, ...]]
_PACKAGE = "monitored"


@dataclass(frozen=True)
class Monitored:
    """A model with what the generated monitor of it has."""

    program: Program
    tables: MonitorModel
    core: ModuleType
    model: Any

    def describe(self, message: Message) -> tuple[str, str]:
        """A message as the state messages tell it: server and arguments."""
        run = self.core.Run(self.model)
        arrival, server, sender, deadline, arguments = message
        name, _, rest = run._described(
            self.core.Message(arrival, server, sender, deadline, arguments)
        ).partition("(")
        return name, rest[:-1]


def monitored(text: str) -> Monitored:
    """The monitor of a model: its tables, and the modules of the core."""
    parsed = parse_model(Source("drawn.rebeca", text))
    analysis = analyse(parsed.model)
    package, _ = view(parsed.model, analysis, Config(), _PACKAGE)
    tables = monitor_model(package, analysis)
    core = _core()
    model = _module("monitor_model", python_tables(tables, _PACKAGE, "drawn.rebeca")).MODEL
    return Monitored(lower(analysis)[0], tables, core, model)


@cache
def _core() -> ModuleType:
    sys.modules[_PACKAGE] = ModuleType(_PACKAGE)
    names = ("monitor_machine", "monitor_run")
    return [_module(name, fill(f"py/{name}.py.j2", package=_PACKAGE)) for name in names][-1]


def _module(name: str, text: str) -> ModuleType:
    module = ModuleType(f"{_PACKAGE}.{name}")
    sys.modules[module.__name__] = module
    exec(compile(text, f"{name}.py", "exec"), module.__dict__)
    return module


# --- runs ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Served:
    server: str
    arguments: str
    arrival: int
    start: int


_CONSTRUCTOR = _Served("constructor", "", 0, 0)
_Running: TypeAlias = tuple[_Served | None, ...]


def _after(
    m: Monitored, state: State, time: int, running: _Running, step: Step
) -> tuple[_Running, list[Seen]]:
    """What is being served after a step, and the observations that come of it."""
    assert not isinstance(step.result, Failure)
    now = list(running)
    if not state:  # the constructors
        acting: Sequence[int] = [i for i, r in enumerate(m.program.rebecs) if r.constructor >= 0]
        now = [_CONSTRUCTOR for _ in now]
    elif step.action.actor == TIME:
        return running, []
    else:
        actor = step.action.actor
        acting = [actor]
        if step.action.slot >= 0:
            message = state[actor].bag[step.action.slot]
            now[actor] = _Served(*m.describe(message), time + message.arrival, time)
    seen: list[Seen] = []
    for i in acting:
        local, served = step.result[i], now[i]
        assert served is not None
        if local.point is None:
            body = (served.server, served.arguments, served.arrival, served.start)
            seen.append((i, *body, time, local.variables))
            now[i] = None
    return tuple(now), seen


def simulated(m: Monitored, seed: int, steps: int) -> list[Seen]:
    """The observations of a run by chance, up to a failure or so many steps."""
    random, exact = Random(seed), view_of(m.program, "tts")
    state: State = ()
    running: _Running = (None,) * len(m.program.rebecs)
    time = 0
    seen: list[Seen] = []
    for number in range(steps):
        possible = exact.steps(state) if number else exact.initial_states()
        allowed = [s for s in possible if not isinstance(s.result, Failure)]
        if not allowed:
            break
        step = random.choice(allowed)
        running, new = _after(m, state, time, running, step)
        assert not isinstance(step.result, Failure)
        state, time = step.result, time + step.time
        seen += new
    return seen


def shuffled(seen: Sequence[Seen], seed: int) -> list[Seen]:
    """The observations in another order, those of one rebec in theirs."""
    random = Random(seed)
    queues: dict[int, list[Seen]] = {}
    for each in seen:
        queues.setdefault(each[0], []).append(each)
    order = [each[0] for each in seen]
    random.shuffle(order)
    return [queues[rebec].pop(0) for rebec in order]


class TooLarge(Exception):
    """The oracle has looked at too many states."""


def is_run(
    m: Monitored, seen: Sequence[Seen], missed: Sequence[int] = (), most: int = 20000
) -> bool:
    """Whether some run of the checker's exact view has all observations.

    Before the first observation of a rebec in `missed` there may have been others.
    """
    queues = [[s for s in seen if s[0] == i] for i in range(len(m.program.rebecs))]
    exact = view_of(m.program, "tts")
    assert isinstance(exact, Exact)
    first = ((), 0, (None,) * len(queues), (0,) * len(queues))
    waiting: list[Any] = [first]
    known = {first}
    while waiting:
        state, time, running, used = waiting.pop()
        if all(u == len(q) for u, q in zip(used, queues, strict=True)):
            return True
        for following in _following(m, exact, queues, missed, state, time, running, used):
            if following not in known:
                known.add(following)
                waiting.append(following)
        if len(known) > most:
            raise TooLarge
    return False


def _following(
    m: Monitored,
    exact: Exact,
    queues: list[list[Seen]],
    missed: Sequence[int],
    state: State,
    time: int,
    running: _Running,
    used: tuple[int, ...],
) -> Iterator[Any]:
    for step in exact.steps(state) if state else exact.initial_states():
        if isinstance(step.result, Failure):
            continue
        after, new = _after(m, state, time, running, step)
        later = time + step.time
        for now in _matched(queues, missed, used, new):
            if all(
                u == len(q) or q[u][5] >= later or later == time
                for u, q in zip(now, queues, strict=True)
            ):
                yield step.result, later, after, now


def _matched(
    queues: list[list[Seen]], missed: Sequence[int], used: tuple[int, ...], new: Sequence[Seen]
) -> list[tuple[int, ...]]:
    """The ways in which what a step shows may be among the observations; none: it is not."""
    found = [used]
    for each in new:
        rebec = each[0]
        ways = []
        for before in found:
            position, queue = before[rebec], queues[rebec]
            if position == len(queue) or (position == 0 and rebec in missed):
                ways.append(before)
            if position < len(queue) and queue[position] == each:
                ways.append((*before[:rebec], position + 1, *before[rebec + 1 :]))
        found = ways
    return found


def without_beginning(m: Monitored, seen: Sequence[Seen], random: Random) -> list[Seen]:
    """The observations without the first up to three of each rebec that has a constructor."""
    left = [random.randrange(4) if r.constructor >= 0 else 0 for r in m.program.rebecs]
    found = []
    for each in seen:
        if left[each[0]] > 0:
            left[each[0]] -= 1
        else:
            found.append(each)
    return found


def mutated(seen: Sequence[Seen], random: Random) -> list[Seen]:
    """The observations with one change: another value or time, one lost, repeated or swapped."""
    found = list(seen)
    if not found:
        return found
    place = random.randrange(len(found))
    rebec, server, arguments, arrival, start, now, variables = found[place]
    later = random.choice((-1, 1))
    match random.randrange(6):
        case 0 if variables:
            cell = random.randrange(len(variables))
            changed = (*variables[:cell], variables[cell] + 1, *variables[cell + 1 :])
            found[place] = (rebec, server, arguments, arrival, start, now, changed)
        case 1:
            found[place] = (rebec, server, f"{arguments}1", arrival, start, now, variables)
        case 2:
            times = (arrival + later, start + later, now + later)
            found[place] = (rebec, server, arguments, *times, variables)
        case 3:
            found[place] = (rebec, server, arguments, arrival, start, now + later, variables)
        case 4:
            del found[place]
        case _:
            other = random.randrange(len(found))
            found[place], found[other] = found[other], found[place]
    return found


# --- the core in C++ ----------------------------------------------------------------------------

_DRIVER = Path(__file__).with_name("monitor_driver.cpp")
_STRICT = ("-std=c++14", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror")
_KINDS = ("byte", "short", "int", "float", "double", "boolean", "rebec")


def built_driver(folder: Path) -> Path:
    """The program that reads models and observations, compiled."""
    include = folder / _PACKAGE
    include.mkdir()
    for name in ("monitor_machine", "monitor_run"):
        guard = f"{_PACKAGE}_{name}_H".upper()
        text = fill(f"cpp/{name}.h.j2", package=_PACKAGE, guard=guard, header="h")
        (include / f"{name}.h").write_text(text)
    program = folder / "driver"
    command = ["g++", *_STRICT, f"-I{folder}", "-o", str(program), str(_DRIVER)]
    subprocess.run(command, check=True, timeout=300)
    return program


def operations() -> list[str]:
    """The operations of the C++ core, in its order."""
    text = fill("cpp/monitor_machine.h.j2", package="x", guard="x", header="h")
    return re.findall(r"k(\w+)", text.partition("enum class Op {")[2].partition("}")[0])


def as_text(m: Monitored, runs: Sequence[Sequence[Seen]]) -> str:
    """A model and runs of it, as the driver reads them."""
    return "\n".join(str(word) for word in _words(m, runs)) + "\n"


def _words(m: Monitored, runs: Sequence[Sequence[Seen]]) -> Iterator[object]:
    numbers = {op.upper(): n for n, op in enumerate(operations())}
    yield len(m.model.code)
    for op, a, b, table in m.model.code:
        yield from (numbers[op], a, b, *_cells(table))
    yield from (len(m.model.texts), *(f":{text}" for text in m.model.texts))
    yield len(m.model.bodies)
    for body in m.model.bodies:
        yield from body
    yield len(m.model.servers)
    for s in m.model.servers:
        yield from (f":{s.name}", s.body, s.priority, int(s.reads_sender))
        yield from _variables(s.parameters)
    yield len(m.model.rebecs)
    for r in m.model.rebecs:
        yield from (f":{r.name}", f":{r.node}", r.class_number, r.capacity, r.priority)
        yield from (r.constructor, *_cells(r.known), *_variables(r.state))
        yield from (*_cells(r.arguments), *_cells(r.dispatch))
    yield int(m.model.global_ranks)
    yield len(runs)
    for seen in runs:
        yield len(seen)
        for rebec, server, arguments, arrival, start, now, variables in seen:
            yield from (rebec, f":{server}", f":{arguments}", arrival, start, now)
            yield from _cells(variables)


def _cells(cells: Sequence[int]) -> tuple[int, ...]:
    return len(cells), *cells


def _variables(variables: Sequence[Any]) -> Iterator[object]:
    yield len(variables)
    for v in variables:
        yield from (f":{v.name}", _KINDS.index(v.kind), *_cells(v.lengths))
