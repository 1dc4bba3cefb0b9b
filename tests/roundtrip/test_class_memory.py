"""What one class of generated code says is kept, and known again only where that is sure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NoReturn, cast

import pytest
from tree_sitter import Node

from rebsync.reverse.findings import Findings
from rebsync.reverse.generated.cpp_classes import Classes
from rebsync.reverse.generated.messages import own_messages
from rebsync.reverse.recovery import extract
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source
from tests.roundtrip.incremental import EXAMPLES, Counting, differing, package, told

NAMES = sorted(path.name for path in EXAMPLES.iterdir())
BODY = "src/carrier.cpp"
COMMENT = "// rebsync: msgsrv Carrier.begin"


@pytest.fixture(autouse=True)
def _cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path))


def changed(name: str, change: Callable[[str], str]) -> dict[str, Source]:
    files = package("warehouse")
    text = change(files[name].text)
    assert text != files[name].text
    return {**files, name: Source(name, text)}


def more(text: str) -> str:
    return text + "// once more\n"


@pytest.mark.parametrize(
    ("name", "change", "read"),
    [
        (BODY, more, 1),
        (BODY, lambda text: text.replace("= false;", "= true;"), 1),
        (BODY, lambda text: text.replace(COMMENT, ""), 3),
        (
            "include/warehouse/carrier.h",
            lambda text: text.replace("int32_t bay_", "int8_t bay_"),
            3,
        ),
        ("launch/warehouse.launch", lambda text: text.replace("<launch>", "<launch>\n"), 0),
        ("config/params.yaml", lambda text: text + "# more\n", 0),
        ("msg/CarrierBegin.msg", lambda text: text + "# more\n", 0),
    ],
)
def test_only_what_an_edit_touches_is_read_again(
    name: str, change: Callable[[str], str], read: int
) -> None:
    memory = Counting()
    extract(package("warehouse"), memory=memory)
    assert memory.read == 3
    files = changed(name, change)
    again = extract(files, memory=memory)
    assert memory.read - 3 == read
    assert told(again) == told(extract(files))


def test_an_order_that_is_open_is_told_again() -> None:
    files = changed(BODY, lambda text: text.replace("bay_ = load_bay;", "bay_ = cell_++ + cell_;"))
    memory = Counting()
    first = extract(files, memory=memory)
    assert ["order" in f.why for f in first.findings] == [True]
    assert told(extract(files, memory=memory)) == told(first)
    assert memory.read == 3


@pytest.mark.parametrize("example", ["warehouse", "experiment2"])
def test_random_edits_are_read_as_without_a_memory(example: str) -> None:
    assert list(differing(example, 12, 1)) == []


class Poison:
    """A body that nobody may look at."""

    def __getattr__(self, name: str) -> NoReturn:
        raise AssertionError(f"{name} of a body that is not in the key")


@pytest.mark.parametrize("example", NAMES)
def test_no_class_is_read_from_bodies_of_others(example: str) -> None:
    """But for what was found in them for all classes together, which is in the key."""
    files = package(example)
    code = Code.of(parse(s) for p, s in sorted(files.items()) if p.endswith((".cpp", ".h")))
    classes = Classes(code, Findings(), own_messages(files).fields)
    plain = dict(code.definitions)
    for owner in list(classes.chosen()):
        code.definitions = plain
        wanted = classes.read_one(owner)
        above = {c.name for c in code.lineage(owner.name)}
        code.definitions = {
            (of, name): several
            if not of or of in above
            else [replace(f, body=cast("Node", Poison())) for f in several]
            for (of, name), several in plain.items()
        }
        classes._scopes.clear()
        assert classes.read_one(owner) == wanted


def test_without_a_cache_all_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", "/dev/null/none")
    memory = Counting()
    files = package("warehouse")
    for count in (3, 6):
        assert told(extract(files, memory=memory)) == told(extract(files))
        assert memory.read == count
