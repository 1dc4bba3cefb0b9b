"""SPIN as a yardstick: pan on a twin of an untimed model, for safety and without reductions."""

from __future__ import annotations

import re
import shutil
import tempfile
from pathlib import Path

from running import HEADING, MODELS, Run, Whole, repeat, run, verified

MODEL, TWIN = MODELS / "untimed.rebeca", MODELS / "untimed.pml"
COMPILE = "gcc -O2 -DSAFETY -DNOREDUCE -w"
DEPTH, TABLE = "-m600000", "-w22"  # enough, and not much more, for this model
VARIANTS = {"pan": "", "pan -DCOLLAPSE": "-DCOLLAPSE"}  # flags of the C compiler


def spin() -> None:
    """Both search the same states: SPIN has one more, before its first step."""
    if not (shutil.which("spin") and shutil.which("gcc")):
        print("spin: not here\n")
        return
    print(HEADING)
    options = ("--language", "core", "--engine", "compiled", "--no-reduce")
    ours = verified(MODEL, 3, *options)
    print(ours.line("rebsync"))
    theirs = []
    for name, flags in VARIANTS.items():
        theirs.append(_pan(flags))
        print(theirs[-1].line(name))
        assert theirs[-1].states == ours.states + 1
    fastest = min(theirs, key=lambda it: it.search)
    smallest = min(theirs, key=lambda it: it.runs.peak)
    print(f"searching, the fastest pan / rebsync: {fastest.search / ours.search:.2f}")
    faster = min(it.runs.seconds for it in theirs) / ours.runs.seconds
    print(f"whole command, the quickest pan with its build / rebsync: {faster:.2f}")
    print(f"memory, the smallest pan / rebsync: {smallest.runs.peak / ours.runs.peak:.2f}\n")


def _pan(flags: str) -> Whole:
    """SPIN on the twin: the time is that of making, compiling and running the verifier."""
    with tempfile.TemporaryDirectory() as folder:
        pan = Path(folder, "pan")
        make = f"spin -a {TWIN} >/dev/null && {COMPILE} {flags} -o pan pan.c"

        def once() -> Run:
            made = run(["sh", "-c", f"cd {folder} && {make}"])
            ran = run([pan, DEPTH, TABLE])
            seconds, cpu = made.seconds + ran.seconds, made.cpu + ran.cpu
            return Run(ran.output, seconds, cpu, ran.peak)

        runs = repeat(3, once)
    assert "errors: 0" in runs.output, runs.output
    states, transitions, search = (
        float(*re.findall(pattern, runs.output))
        for pattern in (r"(\d+) states, stored", r"(\d+) transitions", r"elapsed time (\S+)")
    )
    return Whole("pan", int(states), int(transitions), search, runs)
