"""python -m tests.reverse.soundness.generated [FIRST LAST]: tries edits of generated Python.

Packages are generated, drawn bodies put into them, and these played in Python; the model that is
extracted has to do the same, wherever nothing is listed.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from types import ModuleType

from rebsync.checker.lowering import lower
from rebsync.checker.machine import Coverage
from rebsync.checker.outcomes import Actor
from rebsync.checker.program import NO_DEADLINE
from rebsync.checker.state import Local, Message
from rebsync.config import Config
from rebsync.properties import Properties
from rebsync.reverse.recovery import Extracted
from rebsync.static import analyse
from tests.forward.compiling import generated, written
from tests.forward.python_packages import imported
from tests.reverse.laws import extracted
from tests.reverse.soundness.generated_drawing import SERVERS, edited, server_model

CALLS = 10
CLASS = "src/calc/calc.py"
_LARGEST = 2**31 - 1
State = dict[str, list[int]]
_NUMBERS, _TRUTHS, _ARRAYS = ("a", "b", "c"), ("f", "g"), ("xs", "ys")


@dataclass
class Tally:
    """How many calls were compared, how many were listed, and what is wrong."""

    exact: int = 0
    listed: int = 0
    refused: list[str] = field(default_factory=list)
    unsound: list[str] = field(default_factory=list)


@dataclass
class Call:
    """A server that is called, with the state before it, what it leaves (if it ends) and sends."""

    server: int
    given: tuple[int, int, bool]
    before: State
    after: State | None = None
    sent: list[tuple[str, int]] = field(default_factory=list)


def tallied(folder: Path, seeds: Iterable[int]) -> Tally:
    """What the packages of these seeds show."""
    tally, files = Tally(), generated(server_model(), "calc", Config(target="ros1-py"))
    for seed in seeds:
        own = {**files, CLASS: edited(files[CLASS], seed)}
        package = written(own, folder / str(seed), "calc", Config(target="ros1-py"))
        calls = drawn_calls(Random(seed))
        with imported(package, "calc") as module:
            for call in calls:
                play(module, call)
        compare(extracted(own), calls, f"{seed}", tally)
    return tally


def drawn_calls(random: Random) -> list[Call]:
    """Calls of every server from any state."""
    found = []
    for server in range(SERVERS):
        for _ in range(CALLS):
            state = {name: [random.randint(-3, 6)] for name in _NUMBERS}
            state |= {name: [int(random.random() < 0.5)] for name in _TRUTHS}
            state |= {name: [random.randint(-3, 6) for _ in range(3)] for name in _ARRAYS}
            state["fs"] = [int(random.random() < 0.5) for _ in range(3)]
            given = random.randint(0, 2), random.randint(-2, 5), random.random() < 0.5
            found.append(Call(server, given, state))
    return found


def play(module: ModuleType, call: Call) -> None:
    """Has Python do it. A violation leaves nothing to compare."""
    array = sys.modules["calc.values"].Array
    rebec = module.Calc()
    for name, (first, *rest) in call.before.items():
        numbers = [bool(n) for n in (first, *rest)] if name in (*_TRUTHS, "fs") else [first, *rest]
        setattr(rebec, f"_{name}", array(numbers) if rest else numbers[0])
    for name in ("got", "said"):
        setattr(rebec, f"send_sink_{name}", lambda v, name=name: call.sent.append((name, int(v))))
    try:
        getattr(rebec, f"m{call.server}")(*call.given)
    except (
        NameError,
        IndexError,
        ArithmeticError,
        ValueError,
        sys.modules["calc.values"].Violation,
    ):
        return
    held = {name: getattr(rebec, f"_{name}") for name in call.before}
    call.after = {n: [int(v)] if isinstance(v, int) else [*map(int, v)] for n, v in held.items()}


def compare(found: Extracted, calls: Iterable[Call], name: str, tally: Tally) -> None:
    """Looks whether the model does what was seen."""
    analysis = analyse(found.model)
    if analysis.errors:
        tally.refused += [f"{name}: {d.message}" for d in analysis.errors]
        return
    program = lower(analysis, Properties())[0]
    index = next(n for n, r in enumerate(program.rebecs) if r.class_name == "Calc")
    actor = Actor(program, index, "ftts", Coverage())
    slots = {s.name: s for s in program.rebecs[index].state}
    cells = next(iter(actor.construct(()))).result
    assert isinstance(cells, Local)
    # Drawn bodies cut nothing, and stay small: what else they do is looked at.
    listed = {f.within for f in found.findings if not f.why.startswith("not the number")}
    elsewhere = {w for w in listed if not w.startswith("Calc.m")}
    for call in calls:
        if elsewhere or f"Calc.m{call.server}" in listed:
            tally.listed += 1
            continue
        if call.after is None or any(abs(n) > _LARGEST for v in call.after.values() for n in v):
            continue
        state = list(cells.variables)
        for variable, values in call.before.items():
            if variable in slots:
                offset = slots[variable].offset
                state[offset : offset + len(values)] = values
        server = next(n for n, s in enumerate(program.servers) if s.name == f"m{call.server}")
        message = Message(0, server, index, NO_DEADLINE, tuple(map(int, call.given)))
        ways = []
        for outcome in actor.outcomes(Local(tuple(state), (message,))):
            sent = [
                (program.servers[s.message.server].name, int(s.message.arguments[0]))
                for s in outcome.sends
            ]
            end = outcome.result
            variables = end.variables if isinstance(end, Local) else ()
            kept = {
                n: [int(c) for c in variables[slots[n].offset : slots[n].offset + len(v)]]
                for n, v in call.after.items()
                if n in slots
            }
            ways.append((kept, sent))
        wanted = {n: v for n, v in call.after.items() if n in slots}
        if ways != [(wanted, call.sent)]:
            tally.unsound.append(
                f"{name} m{call.server}{call.given} of {call.before}:\n"
                f"    {wanted}, {call.sent}\n    not {ways}"
            )
        tally.exact += 1


def main(arguments: list[str]) -> int:
    """0 where every model does what its code does."""
    first, last = map(int, arguments) if arguments else (0, 19)
    with tempfile.TemporaryDirectory() as folder:
        tally = tallied(Path(folder), range(first, last + 1))
    print(f"calls compared: {tally.exact}; of what is listed: {tally.listed}")
    for title, places in (("refused", tally.refused), ("unsound", tally.unsound)):
        print(f"{title}: {len(places)}")
        for place in places[:8]:
            print(f"  {place}")
    return int(bool(tally.refused or tally.unsound))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
