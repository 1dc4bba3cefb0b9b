"""A share of the mutations of generated code; `python -m tests.roundtrip.mutations` does all."""

from __future__ import annotations

import pytest

from tests.roundtrip.mutations.harness import Result, Said, Task, results
from tests.roundtrip.mutations.kinds import BEHAVIOUR, NEUTRAL
from tests.roundtrip.mutations.package import Kind, Package

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
# How many kinds there are that change behaviour, and that do not.
_AT_LEAST = {
    "ros1-cpp": (175, 135),
    "ros2-cpp": (205, 150),
    "ros1-py": (205, 90),
    "ros2-py": (225, 95),
}


def share(dialect: str, kinds: tuple[Kind, ...]) -> list[Task]:
    """A share of the kinds, others in each dialect, each on the first example with a place."""
    packages = [Package(name, dialect) for name in _PACKAGES]
    tasks = []
    for kind in kinds[list(BEHAVIOUR).index(dialect) :: _SHARE[dialect.partition("-")[2]]]:
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
    task = Task("experiment1", _ONCE_MISSED, 2, 1, dialect)
    assert wrong(list(results([task], 1)), Said.AT_ELEMENT, Said.AT_FILE) == []


@pytest.mark.parametrize("dialect", ["ros1-py", "ros2-py"])
def test_what_was_reported_for_nothing_is_not(dialect: str) -> None:
    kinds = ("times by position", "is for == of a truth")
    tasks = [Task(name, kinds, 2, 1, dialect) for name in ("hello", "experiment1")]
    found = [result for task in tasks for result in results([task], 1)]
    assert wrong(found, Said.IN_STEP) == []


@pytest.mark.parametrize("dialect", BEHAVIOUR)
def test_what_changes_nothing_is_not(dialect: str) -> None:
    assert wrong(list(results(share(dialect, NEUTRAL[dialect]), 1)), Said.IN_STEP) == []


def wrong(found: list[Result], *fine: Said) -> list[str]:
    """What should have been told otherwise."""
    assert len(found) > 2
    return [str(result) for result in found if result.said not in fine]
