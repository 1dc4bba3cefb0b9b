"""Which program a node of a launch file is, and what one file of a package says alone."""

from __future__ import annotations

from pathlib import Path

from rebsync import model as m
from rebsync.reverse.files.reading import chosen
from rebsync.reverse.recovery import Extracted, extract
from tests.reverse.laws import assert_says
from tests.reverse.nodes.cases import CASES
from tests.reverse.test_laws import EXAMPLES, model_of, package_of

BY_NAME = {case.name: case / "package" for case in CASES}


def of_file(case: str, path: str) -> Extracted:
    """What one file of a case is read as."""
    given = chosen(str(BY_NAME[case] / path))
    return extract(given.files, given.only)


def test_cmake_says_which_source_makes_a_generated_program() -> None:
    example: Path = EXAMPLES[0]
    files = package_of(example)
    (path,) = [p for p in files if p.endswith("_node.cpp")][:1]
    files["src/starter.cpp"] = files.pop(path)
    build = files["CMakeLists.txt"]
    assert path in build
    files["CMakeLists.txt"] = build.replace(path, "src/starter.cpp")
    assert_says(files, model_of(example))


def test_one_file_gives_its_classes() -> None:
    found = of_file("talker_listener", "src/talker.cpp")
    assert [c.name for c in found.model.classes] == ["Talker"]
    assert found.model.main is None


def test_one_file_is_wired_as_the_launch_file_says() -> None:
    found = of_file("remapped", "src/speaker.h")
    known = [
        section.declarations[0].declarators[0].name
        for c in found.model.classes
        if isinstance(c, m.ReactiveClass)
        for section in c.members
        if isinstance(section, m.KnownRebecs)
    ]
    assert known == ["hearer", "hearer"]


def test_a_launch_file_gives_its_system() -> None:
    found = of_file("remapped", "launch/all.launch")
    assert found.model.main is not None
    assert [r.name for r in found.model.main.rebecs] == ["left_speaker", "right_speaker", "hearer"]


def test_the_graph_comes_with_the_model() -> None:
    kinds = [type(f).__name__ for f in of_file("talker_listener", "src/talker.cpp").graph.facts]
    assert {"PublisherFact", "TimerFact", "SubscriptionFact", "NodeFact"} <= set(kinds)
