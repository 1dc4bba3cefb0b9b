"""A share of the mutations of generated code; `python -m tests.roundtrip.mutations` does all."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from tests.roundtrip.mutations.harness import Result, Said, Task, results
from tests.roundtrip.mutations.kinds import BEHAVIOUR, NEUTRAL, made_by
from tests.roundtrip.mutations.package import BY_NAME, Kind, Package
from tests.roundtrip.mutations.set_up import KINDS

_SHARE = {"cpp": 12, "py": 24}  # one kind in so many
_PACKAGES = ("experiment3", "experiment2", "warehouse", "experiment1")
# Kinds of which each was missed at first.
_ONCE_MISSED = (
    "constant made a text",
    "constant made a fraction",
    "no messages",
    "parameters not installed by CMake",
    "package of another name",
)
# And by which files act on each other.
_ONCE_MISSED_BETWEEN = {
    "xml": (
        "another launch file included",
        "node with arguments",
        "node in a namespace by the environment",
        "remap to the same topic",
    ),
    "py": (
        "another launch file included",
        "a function that makes more",
        "constant hidden by the launch file",
        "constant hidden for one node",
    ),
}
_ONCE_TOLD = {
    "cpp": ("literal of the run-time part in two", "targets of other names"),
    "py": ("package says its version", "times by position", "is for == of a truth"),
}
# How many kinds there are that change behaviour, and that do not.
_AT_LEAST = {
    "ros1-cpp": (200, 147),
    "ros2-cpp": (228, 154),
    "ros1-py": (235, 102),
    "ros2-py": (249, 104),
}
# Kinds of both releases or languages that one dialect has no place for.
_NOWHERE = {
    "ros1-cpp": set[str](),
    "ros2-cpp": {"destructor"},  # its classes have one
    "ros1-py": {"object as another base"},
    "ros2-py": {
        "object as base",
        "program exchanges parameters",  # the class reads them
        "parameters not installed by CMake",  # setup.py does
        "launch file not installed by CMake",
    },
}


def share(dialect: str, kinds: tuple[Kind, ...]) -> list[Task]:
    """A share of the kinds, others in each dialect, each on the first example with a place."""
    chosen = kinds[list(BEHAVIOUR).index(dialect) :: _SHARE[dialect.partition("-")[2]]]
    return placed(dialect, chosen)


def placed(dialect: str, kinds: Iterable[Kind]) -> list[Task]:
    """One of each kind, on the first example that has a place for it."""
    packages = [Package(name, dialect) for name in _PACKAGES]
    tasks = []
    for kind in kinds:
        name = next((p.name for p in packages if any(True for _ in kind.mutants(p))), None)
        if name is not None:
            tasks.append(Task(name, (kind.name,), 1, 1, dialect))
    return tasks


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_there_are_enough_kinds(dialect: str) -> None:
    changing, quiet = BEHAVIOUR[dialect], NEUTRAL[dialect]
    assert len(changing) >= _AT_LEAST[dialect][0] and len(quiet) >= _AT_LEAST[dialect][1]
    names = [kind.name for kind in (*changing, *quiet)]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_every_kind_has_a_place(dialect: str) -> None:
    packages = [Package(name, dialect) for name in BY_NAME]
    placed_nowhere = {
        kind.name
        for kind in (*BEHAVIOUR[dialect], *NEUTRAL[dialect])
        if not any(True for package in packages for _ in kind.mutants(package))
    }
    assert placed_nowhere == _NOWHERE[dialect]


@pytest.mark.parametrize("name", _PACKAGES)
@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_every_mutant_is_another_package(dialect: str, name: str) -> None:
    package = Package(name, dialect)
    for kind in (*BEHAVIOUR[dialect], *NEUTRAL[dialect]):
        if kind.name.startswith(("clang-format", "ruff format")):
            continue
        for mutant in kind.mutants(package):
            assert any(package.files.get(p) != text for p, text in mutant.files.items())


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_what_changes_behaviour_is_reported(dialect: str) -> None:
    found = list(results(share(dialect, BEHAVIOUR[dialect]), 1))
    assert wrong(found, Said.AT_ELEMENT, Said.AT_FILE) == []


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_what_was_missed_is_reported(dialect: str) -> None:
    between = _ONCE_MISSED_BETWEEN["xml" if dialect.startswith("ros1") else "py"]
    installed = ("program not installed",) if dialect != "ros2-py" else ()
    task = Task("experiment1", (*_ONCE_MISSED, *between, *installed), 2, 1, dialect)
    assert wrong(list(results([task], 1)), Said.AT_ELEMENT, Said.AT_FILE) == []


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_what_was_reported_for_nothing_is_not(dialect: str) -> None:
    kinds = _ONCE_TOLD[dialect.partition("-")[2]]
    tasks = [Task(name, kinds, 2, 1, dialect) for name in ("hello", "experiment1")]
    found = [result for task in tasks for result in results([task], 1)]
    assert wrong(found, Said.IN_STEP) == []


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_the_build_decides_what_is_code(dialect: str) -> None:
    kinds = made_by("built")
    tasks = placed(dialect, (k for k in kinds if k in BEHAVIOUR[dialect]))
    assert len(tasks) == len([k for k in kinds if k in BEHAVIOUR[dialect]])
    assert wrong(list(results(tasks, 1)), Said.AT_ELEMENT, Said.AT_FILE) == []
    task = Task("experiment2", tuple(k.name for k in kinds if k in NEUTRAL[dialect]), 3, 1, dialect)
    assert wrong(list(results([task], 1)), Said.IN_STEP) == []


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_what_is_set_up_otherwise(dialect: str) -> None:
    tasks = placed(dialect, KINDS[dialect])
    assert len(tasks) == len(KINDS[dialect])
    assert wrong(list(results(tasks, 1)), Said.AT_ELEMENT, Said.AT_FILE) == []


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_what_changes_nothing_is_not(dialect: str) -> None:
    assert wrong(list(results(share(dialect, NEUTRAL[dialect]), 1)), Said.IN_STEP) == []


def wrong(found: list[Result], *fine: Said) -> list[str]:
    """What should have been told otherwise."""
    assert len(found) > 2
    return [str(result) for result in found if result.said not in (*fine, Said.ALIKE)]
