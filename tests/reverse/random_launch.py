"""Random launch files that say much in a small space, for comparisons with roslaunch itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import TypeVar

_T = TypeVar("_T")

_NAMES = ("a", "b", "c", "a/b", "~a", "~b/c", "/a", "/g/b", "b/", "c//a")
_PLAIN = ("a", "b", "c", "n1", "n2")
_VALUES = ("1", "-7", "2.5", "1e3", "1_0", " 3 ", "true", "False", "x y", "", "0", "nan", "1.e2")
_MAPPINGS = ("{a: 1, b: [1, x]}", "a: {b: 2, c: d}", "{b/c: 0x1F, c: 1:30}", "&x {a: *y}", "{}")
_YAML = ("1", "[1, 2.5, yes]", "'q'", "010", "1e3", "deg(90)", "rad(pi/2)", "[[1], {a: off}]")
_TYPED = {
    "auto": _VALUES,
    "str": _VALUES,
    "string": _VALUES,
    "int": ("1", "-7", "+3", " 12 ", "1_0"),
    "double": ("1", "2.5", "1e3", "nan", "-.5"),
    "bool": ("1", "0", "true", "False", " TRUE"),
    "yaml": (*_MAPPINGS[:2], *_YAML),
}
_SPACES = ("g", "h", "/g", "g/h", "/", "a")


class Writer:
    """Writes one random launch file and the files that it includes."""

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)
        self._arguments = 0
        self.included: dict[str, str] = {}

    def file(self, depth: int = 0) -> str:
        """The text of a launch file."""
        tags = [f'<arg name="x{i}" default="{self._pick(_VALUES)}"/>' for i in range(4)]
        tags += self._tags(depth)
        return "\n".join(["<launch>", *tags, "</launch>"]) + "\n"

    def _tags(self, depth: int) -> list[str]:
        kinds: list[Callable[[], str]] = [
            self._param,
            self._rosparam,
            self._remap,
            self._node,
            self._new_arg,
        ]
        if depth < 3:
            kinds += [lambda: self._group(depth), lambda: self._include(depth)]
        return [self._pick(kinds)() for _ in range(self._random.randint(1, 5))]

    def _pick(self, several: Sequence[_T]) -> _T:
        return self._random.choice(several)

    def _value(self) -> str:
        forms = (
            self._pick(_VALUES),
            f"$(arg x{self._random.randint(0, 3)})",
            f"p$(arg x{self._random.randint(0, 3)})$(optenv NO_SUCH q r)",
            f"$(eval {self._expression()})",
        )
        return self._pick(forms)

    def _expression(self) -> str:
        forms = (
            "1 + 2 * 3",
            "7 / 2",
            "7 // 2 ** 2",
            "arg('x0')",
            "x1 == 1",
            "'a' + str(x0)",
            "not x0",
            "sin(pi) < 1 and true",
            "x0 if x1 else x2",
            "-3 % 5",
            "1 < 2 < 3",
        )
        return self._pick(forms).replace("<", "&lt;")

    def _if(self) -> str:
        match self._random.randint(0, 9):
            case 0:
                return f' if="{self._pick(("1", "true", "$(arg x0)", "$(eval x1 != 5)"))}"'
            case 1:
                return f' unless="{self._pick(("0", "False", "$(arg x1)", "TRUE "))}"'
            case _:
                return ""

    def _new_arg(self) -> str:
        self._arguments += 1
        kind = self._pick(("value", "default"))
        return f'<arg name="y{self._arguments}" {kind}="{self._value()}"{self._if()}/>'

    def _param(self) -> str:
        name, type_ = self._pick(_NAMES), self._pick(tuple(_TYPED))
        value = self._pick(_TYPED[type_]) if self._random.random() < 0.95 else self._value()
        if type_ in ("auto", "str"):
            value = self._value()
        return f'<param name="{name}" value="{value}" type="{type_}"{self._if()}/>'

    def _rosparam(self) -> str:
        if self._random.random() < 0.5:
            return f"<rosparam{self._if()}>{self._pick(_MAPPINGS[:3])}</rosparam>"
        names = f'param="{self._pick(_NAMES)}"'
        if self._random.random() < 0.2:
            names += f' ns="{self._pick(_SPACES)}"'
        yaml = self._pick((*_MAPPINGS[:3], *_YAML))
        return f"<rosparam {names}{self._if()}>{yaml}</rosparam>"

    def _remap(self) -> str:
        names = (*_NAMES, "x-y") if self._random.random() < 0.02 else _NAMES
        return f'<remap from="{self._pick(names)}" to="{self._pick(names)}"{self._if()}/>'

    def _node(self) -> str:
        inner = [self._pick((self._param, self._rosparam, self._remap))() for _ in range(3)]
        space = f' ns="{self._pick(_SPACES)}"' if self._random.random() < 0.3 else ""
        name = self._pick(_PLAIN) + str(self._random.randint(0, 50))
        start = f'<node name="{name}" pkg="p" type="t"{space}{self._if()}>'
        return "\n".join([start, *inner[: self._random.randint(0, 3)], "</node>"])

    def _group(self, depth: int) -> str:
        space = f' ns="{self._pick(_SPACES)}"' if self._random.random() < 0.7 else ""
        return "\n".join([f"<group{space}{self._if()}>", *self._tags(depth + 1), "</group>"])

    def _include(self, depth: int) -> str:
        name = f"inner{len(self.included)}.launch"
        self.included[name] = ""
        self.included[name] = self.file(depth + 1)
        space = f' ns="{self._pick(_SPACES)}"' if self._random.random() < 0.4 else ""
        all_ = ' pass_all_args="true"' if self._random.random() < 0.3 else ""
        start = f'<include file="$(dirname)/{name}"{space}{all_}{self._if()}>'
        names = self._random.sample(range(4), self._random.randint(0, 3))
        inner = [f'<arg name="x{i}" value="{self._value()}"{self._if()}/>' for i in names]
        return "\n".join([start, *inner, "</include>"])
