"""Values in launch files: `$(...)` in attributes, and texts turned into values of parameters."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Mapping
from dataclasses import field

from rebsync.names import unique
from rebsync.records import dataclass
from rebsync.reverse.launch.arithmetic import Scalar, evaluate
from rebsync.reverse.launch.parameters import storable
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Source

_COMMAND = re.compile(r"\$+\(([^()$]+)\)")
_MALFORMED = re.compile(r"\$\([^()]*[($]")
_EVAL = re.compile(r"\$\(eval (.*)\)\Z", re.DOTALL)
_LONGEST = 1 << 16
_TRUE, _FALSE = ("true", "1"), ("false", "0")


def _nothing(_: str) -> None:
    return None


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a launch file takes from outside.

    `load` gives the text of a path, `find` the folder of a package; each None for what is not at
    hand. `arguments` are those of the command line. `$(optenv X y)` is `y` where `environment`
    has no X; `$(env X)` is then open. `any_way`: nodes that arguments leave out count, too.
    """

    load: Callable[[str], Source | None] = _nothing
    find: Callable[[str], str | None] = _nothing
    environment: Mapping[str, str] = field(default_factory=dict)
    arguments: Mapping[str, str] = field(default_factory=dict)
    any_way: bool = False


@dataclass(frozen=True, slots=True)
class Substitution:
    """What `$(...)` stands for in one place of a launch file.

    `$(anon x)`, another name in each run, is `x_anon`, or that with a number where it is taken.
    `anonymous` holds the names that stand for those that `$(anon)` makes, as far as this place
    knows them; `taken` those of the whole reading.
    """

    surroundings: Surroundings
    file: str
    arguments: Mapping[str, Text]
    anonymous: dict[str, str]
    taken: set[str]

    def of(self, text: str) -> Text:
        """The text with each `$(...)` replaced; open where one of them is."""
        if "$" not in text:
            return text
        if match := _EVAL.match(text):
            return self._evaluated(match[1])
        if _MALFORMED.search(text):
            return Open("`$(...)` inside another, or with parentheses, is an error of roslaunch")
        opens: list[Open] = []

        def replace(match: re.Match[str]) -> str:
            value = self._command(match[1])
            if isinstance(value, Open):
                opens.append(value)
                return ""
            return match[0][: match[0].index("(") - 1] + value

        replaced = _COMMAND.sub(replace, text)
        if len(replaced) > _LONGEST:
            return Open("a text of this length is not worked out")
        return opens[0] if opens else replaced

    def _command(self, text: str) -> Text:
        match [word for word in text.split(" ") if word]:
            case ["arg", name]:
                return self.argument(name)
            case ["find", package]:
                return self._find(package)
            case ["env", name]:
                return self._env(name)
            case ["optenv", name, *default]:
                return self.surroundings.environment.get(name, " ".join(default))
            case ["anon", name]:
                return self._anon(name)
            case ["dirname"]:
                return self._dirname()
            case _:
                return Open(f"roslaunch has no `$({text})`")

    def argument(self, name: str) -> Text:
        """The value of an `<arg>`."""
        value = self.arguments.get(name)
        return Open(f"the argument `{name}` has no value here") if value is None else value

    def _find(self, package: str) -> Text:
        folder = self.surroundings.find(package)
        return Open(f"the package `{package}` is not at hand") if folder is None else folder

    def _env(self, name: str) -> Text:
        value = self.surroundings.environment.get(name)
        return Open(f"the environment variable `{name}` is not known") if value is None else value

    def _anon(self, name: str) -> str:
        if name not in self.anonymous:
            self.anonymous[name] = unique(f"{name}_anon", self.taken, "")
        return self.anonymous[name]

    def _dirname(self, _: str = "") -> Text:
        return posixpath.dirname(self.file) or "."

    def _evaluated(self, expression: str) -> Text:
        if "__" in expression:
            return Open("roslaunch takes no `__` in `$(eval ...)`")
        expression = expression.replace("dirname()", "dirname('')")
        names = {name: _auto(value) for name, value in self.arguments.items()}
        functions: dict[str, Callable[[str], Scalar | Open]] = {
            "arg": lambda name: _auto(self.argument(name)),
            "find": self._find,
            "env": self._env,
            "optenv": lambda name: self.surroundings.environment.get(name, ""),
            "anon": self._anon,
            "dirname": self._dirname,
        }
        value = evaluate(expression, names, functions)
        return value if isinstance(value, Open) else str(value)


def _auto(text: Text) -> Scalar | Open:
    return text if isinstance(text, Open) else convert(text, "auto")


def convert(text: str, kind: str) -> Scalar | Open:
    """The value that a text stands for, by the `type` of a `<param>` other than `yaml`."""
    kind = kind.lower().strip()
    try:
        match kind:
            case "auto":
                return _guessed(text)
            case "str" | "string":
                return text
            case "int":
                return int(text)
            case "double":
                return float(text)
            case "bool" | "boolean":
                return _truth(text)
            case _:
                return Open(f"roslaunch has no type `{kind}`")
    except ValueError:
        return Open(f"`{text}` is no {kind}")


def stored(text: str, kind: str) -> Scalar | Open:
    """The value as the parameter server has it."""
    value = convert(text, kind)
    return value if isinstance(value, Open) else storable(value)


def truth(text: Text) -> bool | Open:
    """The value of a condition, `if` or `unless`."""
    if isinstance(text, Open):
        return text
    try:
        return _truth(text)
    except ValueError:
        return Open(f"`{text}` is no bool")


def _truth(text: str) -> bool:
    word = text.lower().strip()
    if word not in _TRUE + _FALSE:
        raise ValueError(word)
    return word in _TRUE


def _guessed(text: str) -> Scalar:
    try:
        if "." in text:
            return float(text)
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    word = text.lower()
    return word == "true" if word in ("true", "false") else text
