"""A share of the mutations of generated code; `python -m tests.roundtrip.mutations` does all."""

from __future__ import annotations

import pytest

from tests.roundtrip.mutations.harness import Result, Said, Task, results
from tests.roundtrip.mutations.kinds import BEHAVIOUR, NEUTRAL
from tests.roundtrip.mutations.package import Kind, Package

_SHARE = 6  # one kind in so many
_PACKAGES = ("experiment3", "experiment2", "warehouse", "experiment1")


def share(kinds: tuple[Kind, ...]) -> list[Task]:
    """Every sixth kind, each on the first example that has a place for it."""
    packages = [Package(name) for name in _PACKAGES]
    tasks = []
    for kind in kinds[::_SHARE]:
        name = next((p.name for p in packages if any(True for _ in kind.mutants(p))), None)
        if name is not None:
            tasks.append(Task(name, (kind.name,), 1, 1))
    return tasks


def test_there_are_enough_kinds() -> None:
    assert len(BEHAVIOUR) >= 150
    assert len(NEUTRAL) >= 100
    names = [kind.name for kind in (*BEHAVIOUR, *NEUTRAL)]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("package", [Package(name) for name in _PACKAGES], ids=lambda p: p.name)
def test_every_mutant_is_another_package(package: Package) -> None:
    for kind in (*BEHAVIOUR, *NEUTRAL):
        if kind.name.startswith("clang-format"):
            continue
        for mutant in kind.mutants(package):
            assert any(package.files.get(p) != text for p, text in mutant.files.items())


def test_what_changes_behaviour_is_reported() -> None:
    found = list(results(share(BEHAVIOUR), 1))
    assert wrong(found, Said.AT_ELEMENT, Said.AT_FILE) == []


def test_what_changes_nothing_is_not() -> None:
    assert wrong(list(results(share(NEUTRAL), 1)), Said.IN_STEP) == []


def wrong(found: list[Result], *fine: Said) -> list[str]:
    """What should have been told otherwise."""
    assert len(found) > 10
    return [str(result) for result in found if result.said not in fine]
