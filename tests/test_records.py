"""Records behave as dataclasses of the standard library do."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from collections.abc import Callable, Hashable
from dataclasses import FrozenInstanceError, field, fields, replace
from typing import Any, TypeAlias

import pytest

from rebsync import records

Maker: TypeAlias = Callable[..., Any]


def _shapes(dataclass: Maker) -> dict[str, Any]:
    """The same classes by either decorator."""

    @dataclass(frozen=True, slots=True)
    class Point:
        """A place."""

        x: int
        y: int = 3

    @dataclass(frozen=True, slots=True)
    class Named(Point):
        seen: list[int] = field(default_factory=list, repr=False, compare=False)
        made: str = field(default="now", init=False)
        name: str = field(default="", kw_only=True)

    @dataclass(slots=True)
    class Counter:
        count: int

        def __repr__(self) -> str:
            return "a counter"

    @dataclass(frozen=True, slots=True, eq=False)
    class Alone:
        pass

    @dataclass
    class Sum:
        left: int
        total: int = field(init=False)

        def __post_init__(self) -> None:
            self.total = self.left + 1

        def __hash__(self) -> int:
            return 5

    return {made.__name__: made for made in (Point, Named, Counter, Alone, Sum)}


OURS, THEIRS = _shapes(records._dataclass), _shapes(dataclasses.dataclass)
Point = OURS["Point"]
MADE: dict[str, tuple[tuple[Any, ...], dict[str, Any]]] = {
    "Point": ((1,), {}),
    "Named": ((1, 2), {"name": "n"}),
    "Counter": ((4,), {}),
    "Alone": ((), {}),
    "Sum": ((7,), {}),
}


@pytest.fixture(params=MADE)
def pair(request: pytest.FixtureRequest) -> tuple[Any, Any]:
    places, names = MADE[request.param]
    ours, theirs = (shapes[request.param](*places, **names) for shapes in (OURS, THEIRS))
    return ours, theirs


def test_they_look_the_same(pair: tuple[Any, Any]) -> None:
    ours, theirs = pair
    assert repr(ours).partition("object at")[0] == repr(theirs).partition("object at")[0]
    assert [(f.name, getattr(ours, f.name)) for f in fields(ours)] == [
        (f.name, getattr(theirs, f.name)) for f in fields(theirs)
    ]
    assert type(ours).__match_args__ == type(theirs).__match_args__
    assert hasattr(ours, "__dict__") == hasattr(theirs, "__dict__")


def test_they_are_equal_when_the_same_things_are(pair: tuple[Any, Any]) -> None:
    for one in pair:
        assert (copy.copy(one) == one) == (type(one).__name__ != "Alone")
        assert one != 1
    hashable = [isinstance(one, Hashable) for one in pair]
    assert hashable[0] == hashable[1]
    if all(hashable) and type(pair[0]).__name__ != "Alone":
        assert all(hash(one) == hash(copy.copy(one)) for one in pair)


@pytest.mark.parametrize("shapes", [OURS, THEIRS])
def test_changing(shapes: dict[str, Any]) -> None:
    point = shapes["Point"](1)
    with pytest.raises(FrozenInstanceError, match="cannot assign"):
        point.x = 2
    with pytest.raises(FrozenInstanceError, match="cannot delete"):
        del point.y
    assert replace(point, y=5) == shapes["Point"](1, 5) != point
    counter = shapes["Counter"](1)
    counter.count = 2
    assert counter == shapes["Counter"](2)
    assert shapes["Named"](1).seen is not shapes["Named"](1).seen
    assert point != shapes["Named"](1)


@pytest.mark.parametrize("shapes", [OURS, THEIRS])
def test_wrong_calls(shapes: dict[str, Any]) -> None:
    for places, names in [((), {}), ((1, 2, 3), {}), ((1,), {"z": 2})]:
        with pytest.raises(TypeError, match=r"Point\.__init__\(\)"):
            shapes["Point"](*places, **names)
    with pytest.raises(TypeError):
        shapes["Named"](1, 2, [], "a name")


@records._dataclass(frozen=True, slots=True)
class Kept:
    value: int
    more: tuple[int, ...] = ()


def test_copies() -> None:
    kept: Any = Kept
    assert pickle.loads(pickle.dumps(kept(1, (2,)))) == kept(1, (2,))
    assert copy.deepcopy(kept(1)) == kept(1)
