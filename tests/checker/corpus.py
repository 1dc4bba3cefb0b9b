"""Compares `rebsync verify` with the counts of RMC 2.14 on public models.

    python -m tests.checker.corpus DIRECTORY [--engine compiled] [--large]

The models are public, but not ours: DIRECTORY holds a checkout of each repository under its name,
as `owner+name` (that of the site with MobileRobots.zip unpacked). Prints one line for each model;
ends with status 1 when any figure differs.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

_TRANSFORMER = "rebeca-lang+org.rebecalang.modeltransformer"
_OLD = f"{_TRANSFORMER}/src/test/resources/org/rebecalang/modeltransformer/old"
_AFRA = "{}+org.rebecalang.afra/org.rebecalang.afra.ideplugin/samples"
_RELICO = "sarmadiali98+ReLico/verifier-benchmarks/TR/src"
_JAVA = "sh1234567+rebeca_to_java/org.rebecalang.modeltransformer"
_CHECKER = "rebeca-lang+org.rebecalang.modelchecker/src/test/resources/org/rebecalang/modelchecker"
_SITE = "rebeca-lang+rebeca-lang.github.io/assets/projects/RoboRebeca"


@dataclass(frozen=True)
class Row:
    """A model with what RMC says: states and transitions where it is satisfied, else a kind."""

    path: str
    states: int = 0
    transitions: int = 0
    violation: str = ""
    view: str = "ftts"
    large: bool = False
    property_file: str = ""


def _relico(
    name: str, states: int = 0, transitions: int = 0, *, violation: str = "", view: str = "ftts"
) -> Row:
    path = f"{_RELICO}/{name}/{name}"
    return Row(f"{path}.rebeca", states, transitions, violation, view)


ROWS = (
    Row(f"{_CHECKER}/timedrebeca/ping_pong.rebeca", 3, 3),
    Row(f"{_CHECKER}/timedrebeca/ping_pong.rebeca", 12, 15, view="tts"),
    Row(f"{_JAVA}/TestCase1.rebeca", 4, 4),
    Row(f"{_JAVA}/TestCase2.rebeca", 3, 3),
    Row(f"{_JAVA}/TestCase3.rebeca", violation="overflow"),
    Row(f"{_JAVA}/TestCase4.rebeca", violation="overflow"),
    Row(f"{_JAVA}/TestCase5.rebeca", 6, 8),
    Row(f"{_AFRA.format('rebeca-lang')}/TicketService.rebeca", 51, 76),
    Row(f"{_AFRA.format('rebeca-lang')}/ToxicGasLevel.rebeca", 1367, 2148),
    Row(f"{_AFRA.format('ehsankhamespanah')}/TinyOS-MACB.rebeca", 342, 405),
    Row(f"{_OLD}/thermostat.rebeca", 645, 1127),
    Row(f"{_OLD}/sensornetwork2.rebeca", 303, 582),
    _relico("AircraftDoor", 7, 7),
    _relico("Election", 8, 8),
    _relico("Pipe", 7, 7),
    _relico("PingPong", 9, 9),
    _relico("Ring", 7, 7),
    _relico("ProcessMsg", 6, 6),
    _relico("SafeSend", 6, 6),
    _relico("Fibonacci", 6, 6),
    _relico("Factorial", 7, 7),
    _relico("Thermostat", 5, 5),
    _relico("CheckpointBarrier2", 30, 40),
    _relico("CheckpointBarrier2", 48, 58, view="tts"),
    _relico("TrainDoorFeedback", 15, 20),
    _relico("WideBarrier24", 1006, 12048),
    _relico("WideBarrier24", 1088, 12130, view="tts"),
    _relico("Alarm", violation="property"),
    _relico("TrafficLight", violation="property"),
    _relico("UnsafeSend", violation="property"),
    _relico("TrainDoor", violation="property"),
    Row(
        f"{_RELICO}/Subway/Subway.rebeca",
        violation="property",
        property_file=f"{_RELICO}/Subway/subway.property",
    ),
    Row(f"{_SITE}/MovementRobotNaive.rebeca", violation="assertion"),
    Row(f"{_AFRA.format('ehsankhamespanah')}/TicketService.rebeca", 408_404, 650_699, large=True),
    Row(f"{_OLD}/ieee.rebeca", 528_179, 1_730_592, large=True),
)


def main() -> int:
    """Runs every row."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--engine", default="auto", choices=("auto", "interpreted", "compiled"))
    parser.add_argument("--large", action="store_true", help="the large models too")
    options = parser.parse_args()
    different = 0
    for row in ROWS:
        if row.large and not options.large:
            continue
        verdict = _compare(row, options.directory, options.engine)
        different += verdict.startswith("DIFFERENT")
        print(f"{Path(row.path).stem:20} {row.view:4} {verdict}", flush=True)
    return 1 if different else 0


def _compare(row: Row, directory: Path, engine: str) -> str:
    path = directory / row.path
    if not path.exists():
        return "missing"
    command = [sys.executable, "-m", "rebsync", "verify", "--format", "json"]
    command += ["--semantics", row.view, "--engine", engine, str(path)]
    if row.property_file:
        command += ["--property", str(directory / row.property_file)]
    started = time.perf_counter()
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    seconds = time.perf_counter() - started
    if run.returncode not in (0, 3):
        return f"DIFFERENT: status {run.returncode}: {run.stdout[-300:]} {run.stderr[-300:]}"
    found = json.loads(run.stdout)
    kinds = {violation["kind"] for violation in found["violations"]}
    figures = f"{found['states']} / {found['transitions']}, {found['verdict']} {sorted(kinds)}"
    took = f"{seconds:.2f} s, {found['engine']}"
    if row.violation:
        same = row.violation in kinds
    else:
        same = (found["states"], found["transitions"]) == (row.states, row.transitions)
        same = same and found["verdict"] == "satisfied"
    return f"{'same' if same else 'DIFFERENT'}: {figures}; {took}"


if __name__ == "__main__":
    sys.exit(main())
