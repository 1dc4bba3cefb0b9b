"""CMakeLists.txt: which source files make which executable, and which messages a package has.

Only what decides that is carried out: variables, lists, targets and their names, subdirectories,
loops over known lists. No condition is decided, except constants: what is in its branches counts
under that condition, and variables set there are open afterwards.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span


@dataclass(frozen=True, slots=True)
class BuildTarget:
    """An executable or library.

    `file` is the name of the program that it makes (`OUTPUT_NAME`), by which `rosrun` and launch
    files call it. `sources` are relative to the package; `missing` says which others there are
    that cannot be known. `links` are the names of the targets that it is linked with, in the
    package or outside. `only_if` are the conditions around it.
    """

    name: str
    executable: bool
    file: Text
    sources: tuple[str, ...]
    missing: tuple[Open, ...]
    links: tuple[str, ...]
    only_if: tuple[str, ...]
    source: Source
    span: Span


@dataclass(frozen=True, slots=True)
class BuildMacro:
    """A macro that the build defines; `text` is None where what it stands for is not known."""

    name: str
    parameters: str = ""
    text: str | None = None

    @property
    def directives(self) -> Iterator[str]:
        """The lines that say the same in a header: two that disagree where nothing is known."""
        for text in ("0", "1") if self.text is None else (self.text,):
            yield f"#define {self.name}{self.parameters} {text}\n"


@dataclass(frozen=True, slots=True)
class BuildFiles:
    """What the CMake files of a package say.

    `messages`, `services` and `actions` are paths relative to the package, as are `programs`:
    scripts that are installed. `foreign` are commands that may make targets of their own,
    `packages` the packages that are looked for, `tests` the sources of what only tests. `macros`
    are defined for some source, in a way that is not known where something is `odd`; `written` are
    the headers that the build writes, by their names.
    """

    project: str | None
    targets: tuple[BuildTarget, ...]
    messages: tuple[str, ...]
    services: tuple[str, ...]
    actions: tuple[str, ...]
    programs: tuple[str, ...]
    unknowns: tuple[Unknown, ...]
    sources: tuple[Source, ...]
    foreign: frozenset[str] = frozenset()
    packages: frozenset[str] = frozenset()
    tests: frozenset[str] = frozenset()
    macros: tuple[BuildMacro, ...] = ()
    odd: tuple[Unknown, ...] = ()
    written: Mapping[str, Unknown] = field(default_factory=dict)

    @property
    def is_closed(self) -> bool:
        """Whether it is known of every source whether a target compiles it."""
        is_open = any(t.missing for t in self.targets)
        return bool(self.targets) and not (is_open or self.unknowns or self.foreign)

    def executable(self, file: str) -> BuildTarget | None:
        """The target that makes the program of this name."""
        return next((t for t in self.targets if t.executable and t.file == file), None)

    def target(self, name: str) -> BuildTarget | None:
        """The target of this name in CMake."""
        return next((t for t in self.targets if t.name == name), None)

    def sources_of(self, target: BuildTarget) -> tuple[str, ...]:
        """The sources of a target and of all targets of the package that it is linked with."""
        return tuple(dict.fromkeys(s for t in self._linked(target) for s in t.sources))

    def _linked(self, target: BuildTarget) -> tuple[BuildTarget, ...]:
        found = {target.name: target}
        waiting = [target]
        while waiting:
            for name in waiting.pop().links:
                linked = self.target(name)
                if linked is not None and name not in found:
                    found[name] = linked
                    waiting.append(linked)
        return tuple(found.values())
