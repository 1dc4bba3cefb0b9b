"""What verification costs: time and memory for each state, against SPIN, and whole commands.

    python bench/verify.py [PART ...] [--plot FILE]

The parts are below; without one, all of them. `--plot` draws the family: docs/cost-per-state.svg. A
machine that has other work to do makes all figures worse, so its load is printed as well.

family   cost of a state from 10^4 to 10^7 states of models that grow with one parameter
engines  the compiled engine and the interpreter on the same searches
prints   whole states and fingerprints on the same searches
threads  one and two threads on the same searches, by the clock
temporal formulas of LTL and TCTL, in Python and in C
spin     an untimed model against SPIN on its twin (needs spin and gcc)
first    whole commands on the models of the thesis: nothing is compiled
actors   whole commands on large models: built before, and with an empty cache
reduced  whole commands that reduce states where that pays, and that do not
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from plot import Series, plot
from running import HEADING, MODELS, ROOT, Runs, run, verified
from spin import spin

FAMILIES = (
    ("laps", "laps", (1, 2, 3, 4, 6), "four workers, one controller"),
    ("crowd", "longest", (1, 4, 10, 20, 38), "all messages in one bag"),
)


@dataclass(frozen=True, slots=True)
class Searched:
    """A search alone, without the start of Python, in seconds; `growth` is in bytes."""

    states: int
    transitions: int
    cpu: float
    clock: float
    growth: int

    @property
    def cost(self) -> float:
        """Microseconds for each state."""
        return self.cpu / self.states * 1e6


def searched(engine: str, language: str, model: Path, *constants: str) -> Searched:
    script = ROOT / "bench" / "searching.py"
    output = run([sys.executable, script, engine, language, model, *constants]).output
    return Searched(**json.loads(output))


def family() -> tuple[Series, ...]:
    """The cost of a state must not grow with their number."""
    return tuple(_one_family(*each) for each in FAMILIES)


def _one_family(name: str, parameter: str, values: tuple[int, ...], title: str) -> Series:
    print(f"{name}.rebeca: {title}")
    print(f"{parameter:>9}     states  steps/state  us/state  us/step  bytes/state")
    points = []
    for value in values:
        it = searched("compiled", "timed", MODELS / f"{name}.rebeca", f"{parameter}={value}")
        per_state = it.transitions / it.states
        print(
            f"{value:9}{it.states:11,}{per_state:13.2f}{it.cost:10.3f}"
            f"{it.cost / per_state:9.3f}{it.growth / it.states:13.0f}"
        )
        points.append((it.states, it.cost))
    costs = [cost for _, cost in points]
    print(f"dearest state / cheapest: {max(costs) / min(costs):.2f}\n")
    return Series(title, tuple(points))


def engines() -> None:
    """The same searches with both engines."""
    print("engine        model         states   states/s  bytes/state")
    for name, constant in (("laps", "laps=2"), ("crowd", "longest=4"), ("untimed", "laps=1")):
        language = "core" if name == "untimed" else "timed"
        model = MODELS / f"{name}.rebeca"
        both = [searched(e, language, model, constant) for e in ("interpreted", "compiled")]
        for engine, it in zip(("interpreted", "compiled"), both, strict=True):
            rate, size = it.states / it.cpu, it.growth / it.states
            print(f"{engine:12}  {name:8}{it.states:12,}{rate:11,.0f}{size:13.0f}")
        print(f"{'faster':12}  {name:8}{both[0].cpu / both[1].cpu:12.0f} times")
    print()


FINGERPRINTED = (
    ("laps", "laps=4"),
    ("crowd", "longest=20"),
    ("crowd", "longest=38"),
    ("ttc", "rounds=11"),
)


def prints() -> None:
    """What states take of which fingerprints are kept, and nothing else."""
    print("model                     states   exact: bytes    us  prints: bytes    us   (a state)")
    for name, constant in FINGERPRINTED:
        model = MODELS / f"{name}.rebeca"
        exact, compacted = (
            searched(e, "timed", model, constant) for e in ("compiled", "compacted")
        )
        assert exact.states == compacted.states
        print(
            f"{name + ', ' + constant:20}{exact.states:12,}{exact.growth / exact.states:15.1f}"
            f"{exact.cost:6.2f}{compacted.growth / compacted.states:15.1f}{compacted.cost:6.2f}"
        )
    print()


PAIRED = (
    ("laps", "timed", "laps=4"),
    ("laps", "timed", "laps=6"),
    ("carts", "timed"),
    ("untimed", "core", "laps=1"),
    ("crowd", "timed", "longest=20"),
    ("ttc", "timed", "rounds=11"),
)


def threads() -> None:
    """Two threads against one, three times in turns: seconds by the clock, and of processors."""
    print("model                     states   one: clock, cpu   two: clock, cpu   faster")
    for name, language, *constants in PAIRED:
        model, turns = MODELS / f"{name}.rebeca", ("compiled", "paired") * 3
        found = [(engine, searched(engine, language, model, *constants)) for engine in turns]
        one, two = (
            min((it for engine, it in found if engine == wanted), key=lambda it: it.clock)
            for wanted in turns[:2]
        )
        print(
            f"{' '.join((name, *constants)):20}{one.states:12,}{one.clock:12.2f}{one.cpu:6.2f}"
            f"{two.clock:12.2f}{two.cpu:6.2f}{one.clock / two.clock:9.2f}"
        )
    print()


FORMULAS = ("freed", "earliest", "latest", "longest", "surest", "violated")


def temporal() -> None:
    """What is computed once a search is over, for each formula in a process of its own."""
    print("laps      states formula   Python: us, bytes   C: us, bytes   search, graph: us")
    script, model = ROOT / "bench" / "deciding.py", MODELS / "laps.rebeca"
    asked = MODELS / "temporal.property"
    for laps in (3, 4):
        for name in FORMULAS:
            both = []
            for means in ("python", "c"):
                known = means, model, asked, name, f"laps={laps}"
                found = json.loads(run([sys.executable, script, *known]).output)
                states = found.pop("states")
                both.append({key: value / states for key, value in found.items()})
            one, other = both
            print(
                f"{laps:4}{states:12,} {name:9}{one['cpu'] * 1e6:11.2f}{one['growth']:7.0f}"
                f"{other['cpu'] * 1e6:10.2f}{other['growth']:7.0f}"
                f"{other['search'] * 1e6:13.2f}{other['graph'] * 1e6:7.2f}"
            )
    print()


ALL = "--no-reduce"
KINDS = (("", 0), ("_unsafe", 3))  # with the exit status of the verdict
THESIS = tuple((f"experiment{n}{kind}", s) for n in (1, 2, 3) for kind, s in KINDS)


def first() -> None:
    """The first verdict on a small model: what rebsync keeps of its grammar is there, no more."""
    print(HEADING)
    with tempfile.TemporaryDirectory() as folder:
        for name, status in THESIS:
            model, cache = ROOT / "examples" / name / f"{name}.rebeca", Path(folder)
            verified(model, 1, "--engine", "interpreted", cache=cache, status=status)
            it = verified(model, 7, cache=cache, status=status)
            print(it.line(f"{name}, {it.engine}"))
    print()


def actors() -> None:
    """A large model, from the start of Python to the verdict."""
    print(HEADING)
    for name, times in (("actors4", 5), ("actors5", 1)):
        model = MODELS / f"{name}.rebeca"
        with tempfile.TemporaryDirectory() as folder:
            caches = [Path(folder, str(n)) for n in range(3 if times > 1 else 0)]
            cold = [verified(model, 1, ALL, cache=cache) for cache in caches]
            if cold:
                runs = tuple(it.runs.runs[0] for it in cold)
                print(replace(cold[0], runs=Runs(runs)).line(f"{name}, empty cache"))
            verified(model, 1, ALL, cache=Path(folder, "0"))
        print(verified(model, times, ALL).line(f"{name}, built before"))
    print()


REDUCED = ("carts", "actors4", "crowd", "laps", "ttc")


def reduced() -> None:
    """Large models, whose engine was built before; the last one has nothing to be reduced by."""
    print(HEADING)
    for name in REDUCED:
        for options in ((ALL,), ()):
            model = MODELS / f"{name}.rebeca"
            verified(model, 1, *options)
            print(verified(model, 5, *options).line(" ".join((name, *options))))
    print()


PARTS: dict[str, Callable[[], object]] = {
    "engines": engines,
    "prints": prints,
    "threads": threads,
    "temporal": temporal,
    "spin": spin,
    "first": first,
    "actors": actors,
    "reduced": reduced,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("parts", nargs="*", metavar="PART", help=" ".join(("family", *PARTS)))
    parser.add_argument("--plot", type=Path, metavar="FILE", help="draw the family as SVG")
    given = parser.parse_args()
    parts = given.parts or ["family", *PARTS]
    if unknown := set(parts) - {"family", *PARTS}:
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    for part in parts:
        load = os.getloadavg()[0]
        print(f"# python bench/verify.py {part}    (load of the machine: {load:.1f})", flush=True)
        if part != "family":
            PARTS[part]()
            continue
        drawn = family()
        if given.plot:
            title = "Cost of a state, by the number of states"
            picture = plot(drawn, title, "states", "microseconds for each state")
            given.plot.write_text(picture, encoding="utf-8")


if __name__ == "__main__":
    main()
