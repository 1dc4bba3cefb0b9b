"""Values as JSON: what comes back is what was put in, and no text makes anything else."""

from __future__ import annotations

import os
import pickle
import re
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given

from rebsync import model as m
from rebsync.checker.trace import Change
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.difference import Place
from rebsync.roundtrip.package.cache import types as serialised_types
from rebsync.roundtrip.package.cache.serialisation import NotSerialisable, deserialised, serialised
from rebsync.source import NOWHERE, Source, SourceSpan, Span
from tests.strategies import models

EXAMPLES = sorted(Path(__file__, "../../../examples").resolve().glob("*/*.rebeca"))


@given(models())
def test_models_come_back(model: m.Model) -> None:
    assert deserialised(serialised(model)) == model


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_places_come_back(path: Path) -> None:
    model = parse_model(Source("a", path.read_text(encoding="utf-8"))).model
    found = deserialised(serialised(model))
    assert isinstance(found, m.Model)
    assert [n.span for n in m.walk(found)] == [n.span for n in m.walk(model)]


@pytest.mark.parametrize(
    "value",
    [
        *(1, 1.0, True, None, "", "\udc80\0\n", -0.0, 1e300, 2**200, (), ((), ("a", ()))),
        *([1, [2]], {1: "a", "b": (2,)}, {1, 2}, frozenset({"a", 1})),
        Place(Source("a.cpp", "a"), Span(1, 2)),
        Change("a", "b", "c", "d"),
    ],
)
def test_plain_values_come_back(value: object) -> None:
    found = deserialised(serialised(value))
    assert found == value
    assert repr(found) == repr(value)
    assert type(found) is type(value)


def test_what_is_one_value_stays_one() -> None:
    source = Source("a", "text " * 1000)
    spans = tuple(SourceSpan(i, i, source) for i in range(100))
    text = serialised((spans, NOWHERE, source))
    found: Any = deserialised(text)
    assert len(text) < 10_000
    assert all(span.source is found[2] for span in found[0])
    assert found[1] is NOWHERE


def test_texts_at_hand_are_not_in_it() -> None:
    source = Source("a", "text")
    text = serialised(Place(source, NOWHERE), {"a": source})
    assert "text" not in text
    found = deserialised(text, {"a": source})
    assert isinstance(found, Place)
    assert found.source is source
    with pytest.raises(NotSerialisable):
        deserialised(text)


def test_depth_does_not_matter() -> None:
    value: object = ()
    for _ in range(100_000):
        value = (value,)
    found: Any = deserialised(serialised(value))
    for _ in range(100_000):
        (found,) = found
    assert found == ()


class Evil:
    """Something that runs a command when it is unpickled."""

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return os.system, ("touch evil",)


@pytest.mark.parametrize("value", [Evil(), Path("a"), b"a", os.system, Source, range(3)])
def test_no_other_values_are_written(value: object) -> None:
    with pytest.raises(NotSerialisable):
        serialised(value)


@pytest.mark.parametrize(
    "text",
    [
        *("", "[", "[]", "{}", "null", "[[],[],[]]", "[[],[],[],1]", "[[],[],[[0]],1]"),
        '[["subprocess.Popen"],["touch evil"],[[0,0]],2]',
        '[["Popen"],["touch evil"],[[0,0]],2]',
        '[["subprocess"],[],[[0]],1]',
        '[["__import__"],["os"],[[0,0]],2]',
        '[["Model.__init__"],["os"],[[0,0]],2]',
        '[["MODULES"],["Model"],[[0,0]],2]',
        '[["Span"],[1],[[0,0]],2]',
        '[["Span"],[1],[[0,0,3]],2]',
        '[["Span"],[1],[["a",0,0]],2]',
        '[["Severity"],["__class__"],[[0,0]],2]',
        '[["dict"],[1],[[0,0]],2]',
        '[["set"],[1],[[0,1],[0,2]],3]',
        "[" * 100_000,
        pickle.dumps(Evil()),
        pickle.dumps((1, 2)),
        b"\xff\xfe",
    ],
)
def test_what_is_no_value_is_refused(
    text: str | bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(NotSerialisable):
        deserialised(text)
    assert not Path("evil").exists()


def test_the_table_has_only_plain_classes() -> None:
    for name, module in serialised_types.MODULES.items():
        found = serialised_types.type_of(name)
        assert module.startswith("rebsync.")
        assert (found.__module__, found.__name__) == (module, name)
        assert not hasattr(found, "__post_init__")
        if is_dataclass(found):
            assert all(f.init and not f.kw_only for f in fields(found)), found
        else:
            assert hasattr(found, "__members__")


@cache
def _all_names() -> dict[str, object]:
    modules = [found for key, found in sorted(sys.modules.items()) if key.startswith("rebsync.")]
    return {name: value for found in modules for name, value in vars(found).items()}


def _named_in(module: str, annotation: str, seen: set[str]) -> Iterator[type]:
    """The classes of rebsync that an annotation names, also through aliases."""
    for name in set(re.findall(r"(?<!typing\.)\b_?[A-Z]\w*", annotation)) - seen:
        seen.add(name)
        found = vars(sys.modules[module]).get(name, _all_names().get(name))
        if isinstance(found, type):
            yield from [found, *found.__subclasses__()]
        elif found is not None:
            text = found if isinstance(found, str) else str(found)
            yield from _named_in(module, text.replace("rebsync.", " "), seen)


def test_the_table_has_all_that_its_classes_hold() -> None:
    """Else values of them are not kept, and only time would tell."""
    for name, module in serialised_types.MODULES.items():
        found = serialised_types.type_of(name)
        if not is_dataclass(found):
            continue
        for field in fields(found):
            for held in _named_in(module, str(field.type), set()):
                if getattr(held, "_is_protocol", False):
                    continue  # what such a field has is None where the value is kept
                if held.__module__.startswith("rebsync.") and held.__name__[0].isupper():
                    assert serialised_types.MODULES.get(held.__name__) == held.__module__, held


def test_nothing_unpickles() -> None:
    """Only the spool uses pickle, whose file has no name and is its own, and only the module that
    looks at the seal marshal."""
    root = Path(__file__).parents[2]
    rooms = ("rebsync", "grammars", "forward", "reverse", "roundtrip")
    paths = [p for room in rooms for p in (root / room).rglob("*.py") if not p.is_symlink()]
    assert len(paths) > 300
    words = {name: {p.name for p in paths if f"import {name}" in p.read_text(encoding="utf-8")}
             for name in ("pickle", "marshal", "shelve", "dill")}  # fmt: skip
    assert words == {
        "pickle": {"spool.py"},
        "marshal": {"templating.py"},
        "shelve": set(),
        "dill": set(),
    }
