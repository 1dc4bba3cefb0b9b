"""Bags of real runs on a roscore (recordings/): they conform, and with faults they do not.

`python -m tests.conform.record DIR` makes the bags anew, of logs of the ROS 1 tests.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
import yaml

from rebsync.conform.conformance import Conformance
from rebsync.conform.matching import Subject, conform
from rebsync.conform.reading import recordings
from rebsync.conform.recording import Served
from rebsync.conform.topics import Topics
from rebsync.diagnostics import RebsyncError
from tests.conform.bagging import Storage, write_bag
from tests.conform.faults import (
    Fault,
    dropped,
    late,
    repeated,
    second_publisher,
    swapped,
    wrong_state,
)
from tests.conform.oracle import is_run
from tests.conform.simulated import Given, Recorded
from tests.forward.compiling import CASES, case_config
from tests.ros1.fidelity import subject

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"
BAGS = sorted((HERE / "recordings").glob("*.bag"))
# Where the model itself breaks a rule, which nodes report and models do not go on from.
VIOLATED = {"inheritance", "rebecs"}
FAULTS: dict[str, tuple[Fault, set[str]]] = {
    "dropped": (dropped, {"lost state", "lost message", "wrong state", "unexpected", "silent"}),
    "late": (late, {"late"}),
    "wrong state": (wrong_state, {"wrong state", "no start"}),
    "swapped": (swapped, {"swapped", "lost state", "lost message", "unexpected", "wrong state"}),
    "second publisher": (second_publisher, {"second publisher"}),
    "repeated": (repeated, {"repeated"}),
}
SIMPLE = [b for b in BAGS if b.stem.rsplit("-", 1)[0] not in {*VIOLATED, "warehouse"}]


@cache
def of_bag(bag: Path) -> Subject:
    """The model of a recording."""
    name = bag.stem.rsplit("-", 1)[0]
    example = EXAMPLES / name / f"{name}.rebeca"
    if example.exists():
        return subject(example)
    case = CASES / f"{name}.rebeca"
    return subject(case, case_config(case))


def read(bag: Path) -> Conformance:
    """What is said of a bag."""
    of = of_bag(bag)
    opened = recordings([str(bag)], Topics.of(of.observable), of.observable.package, None)
    return conform(of, opened)


@cache
def steps(bag: Path) -> tuple[Served, ...]:
    """The steps of a recording."""
    of = of_bag(bag)
    opened = recordings([str(bag)], Topics.of(of.observable), of.observable.package, None)
    found = (event for event in opened.events() if isinstance(event, Served))
    return tuple(e._replace(stamp=e.stamp - 100.0) for e in found)


def test_there_are_recordings_of_both_languages() -> None:
    assert len(BAGS) >= 10
    assert {b.stem.rsplit("-", 1)[1] for b in BAGS} == {"cpp", "py"}


@pytest.mark.parametrize("bag", BAGS, ids=lambda b: b.stem)
def test_good_recordings_are_not_accused(bag: Path) -> None:
    found = read(bag)
    if bag.stem.rsplit("-", 1)[0] in VIOLATED:
        assert found.verdict == "violated"
        assert found.deviation is not None
        assert found.deviation.message.startswith("a message goes to nobody")
    else:
        assert (found.verdict, found.compared) == ("conforms", found.recorded), found.deviation


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("bag", SIMPLE, ids=lambda b: b.stem)
def test_faults_are_found_at_their_steps(bag: Path, fault: str) -> None:
    of, run = of_bag(bag), steps(bag)
    make, kinds = FAULTS[fault]
    given = Given(of.program, of.observable)
    tried = 0
    for at in _places(run):
        if fault == "wrong state" and not run[at].cells:
            continue
        faulty = make(run, at)
        found = conform(of, Recorded(tuple(faulty)))
        if is_run(given, faulty, 20_000):  # two messages of one moment may be served in any order
            assert found.verdict == "conforms", at
            continue
        tried += 1
        assert found.verdict == "deviates", (at, found.reason)
        assert found.deviation is not None
        if sum(step[:4] == run[at][:4] for step in run) == 1:  # else any of these may be it
            assert found.deviation.kind in kinds, (at, found.deviation)
        assert _is_near(run, at, found), (at, found.deviation)
    assert tried > 0


def _places(run: tuple[Served, ...]) -> list[int]:
    """Steps in the first third, in the middle, and in the last third, no constructors."""
    count = len(run)
    served = [n for n, s in enumerate(run) if s.server != "constructor"]
    return [min(served, key=lambda n: abs(n - count * part // 6)) for part in (1, 2, 3, 4)]


def _is_near(run: tuple[Served, ...], at: int, found: Conformance) -> bool:
    """Whether the step that is told is the faulty one, or the first that shows the fault."""
    assert found.deviation is not None
    told = found.deviation
    own = [s for s in run[at + 1 :] if s.rebec == run[at].rebec]
    until = own[0].start if own else run[-1].now
    return run[at].start <= told.time <= until


@pytest.mark.parametrize("storage", ["ros1", "sqlite3", "mcap"])
def test_a_bag_with_a_fault_says_where_it_is(storage: Storage, tmp_path: Path) -> None:
    bag = HERE / "recordings" / "running_example-cpp.bag"
    of, run = of_bag(bag), steps(bag)
    at = len(run) // 2
    path = tmp_path / ("faulty.bag" if storage == "ros1" else "faulty")
    write_bag(path, of.observable, wrong_state(run, at), storage)
    opened = recordings([str(path)], Topics.of(of.observable), of.observable.package, None)
    found = conform(of, opened)
    assert found.deviation is not None
    assert found.deviation.kind == "wrong state"
    assert found.deviation.place is not None
    assert found.deviation.place.number == at + 1  # messages of a bag are counted from 1


def test_a_database_that_is_cut_off_never_conforms(tmp_path: Path) -> None:
    bag = HERE / "recordings" / "warehouse-cpp.bag"
    of, run = of_bag(bag), steps(bag)
    folder = write_bag(tmp_path / "run", of.observable, run, "sqlite3")
    data = next(folder.glob("*.db3")).read_bytes()
    for part in range(1, 10):
        path = tmp_path / f"cut{part}.db3"
        path.write_bytes(data[: len(data) * part // 10])
        opened = recordings([str(path)], Topics.of(of.observable), of.observable.package, None)
        try:
            assert conform(of, opened).verdict == "undetermined"
        except RebsyncError as error:
            assert "RS982" in str(error.findings)


@pytest.mark.parametrize(
    ("storage", "compression"),
    [
        ("ros1", "bz2"),
        ("ros1", "lz4"),
        ("sqlite3", "file"),
        ("sqlite3", "message"),
        ("mcap", "file"),
        ("mcap", "message"),
        ("mcap", "storage"),
    ],
)
def test_compressed_bags_are_read(storage: Storage, compression: str, tmp_path: Path) -> None:
    bag = HERE / "recordings" / "running_example-cpp.bag"
    of, run = of_bag(bag), steps(bag)
    path = tmp_path / ("run.bag" if storage == "ros1" else "run")
    write_bag(path, of.observable, run, storage, compression)
    opened = recordings([str(path)], Topics.of(of.observable), of.observable.package, None)
    found = conform(of, opened)
    assert (found.verdict, found.compared) == ("conforms", len(run)), found.reason


@pytest.mark.parametrize("storage", ["sqlite3", "mcap"])
def test_split_bags_are_read(storage: Storage, tmp_path: Path) -> None:
    bag = HERE / "recordings" / "running_example-cpp.bag"
    of, run = of_bag(bag), steps(bag)
    parts = [run[: len(run) // 2], run[len(run) // 2 :]]
    folders = [tmp_path / f"run_{number}" for number in (0, 1)]
    for folder, part in zip(folders, parts, strict=True):
        write_bag(folder, of.observable, part, storage)
    files = [next(p for p in folder.iterdir() if p.suffix != ".yaml") for folder in folders]
    files[1].rename(folders[0] / files[1].name)
    metadata = folders[0] / "metadata.yaml"
    told = yaml.safe_load(metadata.read_text())
    told["rosbag2_bagfile_information"]["relative_file_paths"] = [file.name for file in files]
    metadata.write_text(yaml.safe_dump(told))
    opened = recordings([str(folders[0])], Topics.of(of.observable), of.observable.package, None)
    found = conform(of, opened)
    assert (found.verdict, found.compared) == ("conforms", len(run)), found.reason
