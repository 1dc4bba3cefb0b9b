"""The same node as people write it: a class, header and source, a base class, only functions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

SHAPES = ("class", "class", "header", "base", "functions")


@dataclass(frozen=True)
class Function:
    """A function, its parameters and body as text."""

    result: str
    name: str
    parameters: str
    lines: tuple[str, ...]

    def text(self, owner: str = "") -> list[str]:
        scope = f"{owner}::" if owner else ""
        return [f"{self.result} {scope}{self.name}({self.parameters}) {{", *self.lines, "}"]

    @property
    def declared(self) -> str:
        return f"{self.result} {self.name}({self.parameters});"


@dataclass(frozen=True)
class Subscription:
    """What takes the messages of a topic; `style` says how the callback is written."""

    topic: str
    message: str
    callback: Function
    style: str

    def made(self, owner: str) -> str:
        """The call that subscribes; without an owner the callback is a free function."""
        name, given = self.callback.name, f'"{self.topic}", 10'
        if not owner:
            return f"nh_.subscribe({given}, {name})"
        match self.style:
            case "bind":
                bound = f"boost::bind(&{owner}::{name}, this, _1)"
                return f"nh_.subscribe<{self.message}>({given}, {bound})"
            case "lambda":
                body = " ".join(f"{line}\n" for line in self.callback.lines)
                return (
                    f"nh_.subscribe<{self.message}>({given}, "
                    f"[this]({self.callback.parameters}) {{\n{body}}})"
                )
            case _:
                return f"nh_.subscribe({given}, &{owner}::{name}, this)"


@dataclass(frozen=True)
class Parts:
    """What a node consists of. `members` are declarations, `initial` statements of its set-up."""

    name: str
    includes: tuple[str, ...]
    before: tuple[str, ...]
    helpers: tuple[Function, ...]
    timers: tuple[Function, ...]
    subscriptions: tuple[Subscription, ...]
    members: tuple[str, ...]
    initial: tuple[str, ...]
    period: int
    advertised: tuple[str, ...]

    @property
    def callbacks(self) -> list[Function]:
        """The callbacks that have a name."""
        plain = [s.callback for s in self.subscriptions if s.style != "lambda"]
        return [*plain, *self.timers]

    def set_up(self, owner: str) -> list[str]:
        """The statements of a constructor, or of `main`."""
        lines = [f"{s.callback.name}_ = {s.made(owner)};" for s in self.subscriptions]
        if any(t.name == "tick" for t in self.timers):
            given = f"&{owner}::tick, this" if owner else "tick"
            lines.append(f"timer_ = nh_.createTimer(ros::Duration({self.period}), {given});")
        return [*lines, *self.advertised, *self.initial]


def files_of(parts: Parts, shape: str, random: Random) -> dict[str, str]:
    """The sources of a node by their names."""
    low = parts.name.lower()
    match shape:
        case "header":
            head, source = _header(parts, random)
            return {f"{low}.h": head, f"{low}.cpp": source}
        case "base":
            return {f"{low}.cpp": _based(parts)}
        case "functions":
            return {f"{low}.cpp": _functions(parts)}
        case _:
            return {f"{low}.cpp": _class(parts, random)}


def _text(*groups: Sequence[str]) -> str:
    return "\n".join(line for group in groups for line in group) + "\n"


def _constructor(parts: Parts, random: Random) -> list[str]:
    """A constructor, which may leave the work to a function."""
    lines = parts.set_up(parts.name)
    if random.random() < 0.3:
        made = Function("void", "init", "", tuple(lines)).text()
        return [f"{parts.name}() {{ init(); }}", *made]
    return [f"{parts.name}() {{", *lines, "}"]


def _main(parts: Parts) -> list[str]:
    low = parts.name.lower()
    return [
        "int main(int argc, char** argv) {",
        f'  ros::init(argc, argv, "{low}");',
        f"  {parts.name} node;",
        "  ros::spin();",
        "  return 0;",
        "}",
    ]


def _class(parts: Parts, random: Random) -> str:
    functions = [line for f in (*parts.helpers, *parts.callbacks) for line in f.text()]
    inside = [*_constructor(parts, random), "", " private:", *functions, *parts.members]
    head = [*parts.includes, *parts.before, f"class {parts.name} {{", " public:"]
    return _text(head, inside, ["};", ""], _main(parts))


def _header(parts: Parts, random: Random) -> tuple[str, str]:
    """Declarations in one file, definitions in another."""
    functions = [*parts.helpers, *parts.callbacks]
    declared = [f.declared for f in functions]
    head = [*parts.includes, *parts.before, f"class {parts.name} {{", " public:"]
    head += [f"{parts.name}();", " private:", *declared, *parts.members, "};"]
    made = [f"{parts.name}::{parts.name}() {{", *parts.set_up(parts.name), "}"]
    random.shuffle(functions)
    defined = [line for f in functions for line in f.text(parts.name)]
    include = [f'#include "{parts.name.lower()}.h"']
    return _text(["#pragma once"], head), _text(include, made, defined, _main(parts))


def _based(parts: Parts) -> str:
    """Members and helpers in a base class."""
    base = f"{parts.name}Base"
    helpers = [line for f in parts.helpers for line in f.text()]
    callbacks = [line for f in parts.callbacks for line in f.text()]
    return _text(
        [*parts.includes, *parts.before, f"class {base} {{", " protected:"],
        [*helpers, *parts.members, "};", "", f"class {parts.name} : public {base} {{"],
        [" public:", f"{parts.name}() {{", *parts.set_up(parts.name), "}", " private:"],
        [*callbacks, "};", ""],
        _main(parts),
    )


def _functions(parts: Parts) -> str:
    """Functions and variables of the file."""
    functions = [line for f in (*parts.helpers, *parts.callbacks) for line in f.text()]
    low = parts.name.lower()
    members = [m for m in parts.members if "NodeHandle" not in m]
    return _text(
        [*parts.includes, *parts.before, *members],
        [*(f.declared for f in parts.timers), *functions],
        ["int main(int argc, char** argv) {", f'  ros::init(argc, argv, "{low}");'],
        ["  ros::NodeHandle nh_;", *parts.set_up(""), "  ros::spin();", "  return 0;", "}"],
    )
