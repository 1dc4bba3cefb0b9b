"""Changes by which files act on each other, beside what launch files do.

Parameters that hide others, names exchanged, a message and what uses it, a build and its sources,
what a package of Python does when it is imported.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from tests.roundtrip.mutations.interplay_launch import hidden, rebecs
from tests.roundtrip.mutations.package import (
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    anywhere,
    in_files,
    kinds_in,
)
from tests.roundtrip.mutations.surroundings import constants, run_time

_XML, _PY = ".launch", ".launch.py"


def _for_one_node(package: Package) -> Iterator[Edit]:
    """A constant that one of the rebecs that use it has otherwise."""
    for path, found in constants(package):
        for source in package.sources:
            program = f"{source.rpartition('/')[2].partition('.')[0]}_node"
            users = [n for _, n, node in rebecs(package) if f'"{program}"' in node[0]]
            if f'"env.{found[2]}"' in package.files[source] and users:
                own = f"    env:\n      {found[2]}: {int(found[3]) + 3}\n"
                end = len(package.files[path])
                yield Edit(path, end, end, f"/{users[-1]}:\n  ros__parameters:\n{own}")


def _from_another_file(package: Package) -> Iterator[Mutant]:
    """A constant that a second file of parameters gives again, which is loaded after the first."""
    for path, found in constants(package):
        own = f"{found[1]}{found[2]}: {int(found[3]) + 3}\n"
        head = "/**:\n  ros__parameters:\n    env:\n" if found[1] else ""
        for launch in (p for p in package.files if p.endswith((_XML, _PY))):
            text = package.files[launch]
            text = re.sub(
                r"( *<rosparam command.*/config/)params(.yaml.*\n)(.*params_file.*\n)",
                r"\g<0>\1more\2",
                text,
            )
            text = re.sub(r"( *)params( = .*\")params(.yaml.*\n)", r"\g<0>\1more\2more\3", text)
            text = re.sub(r"( +)system,\n", r"\g<0>\1more,\n", text).replace(
                "system]", "system, more]"
            )
            files = {path.replace("params.yaml", "more.yaml"): head + own, launch: text}
            yield Mutant(files, launch)


def _exchanged(package: Package) -> Iterator[list[Edit]]:
    """Two nodes that have each other's names, and nothing else of each other."""
    every = rebecs(package)
    for (path, first, one), (_, second, two) in pairwise(every):
        if one[0].replace(first, "") != two[0].replace(second, ""):
            yield [
                Edit(path, node.start() + at.start(1), node.start() + at.end(1), new)
                for node, new in ((one, second), (two, first))
                if (at := re.search(r'\bname="(\w+)"', node[0])) is not None
            ]


def _fields(package: Package) -> Iterator[tuple[str, re.Match[str]]]:
    for path in package.paths(".msg"):
        if not path.endswith(("State.msg", "Timing.msg", "Data.msg")):
            for found in re.finditer(r"^(?:int32|bool) (\w+)$", package.files[path], re.MULTILINE):
                yield path, found


def _renamed_in_definition(package: Package) -> Iterator[Mutant]:
    """A field that its senders and its receivers know by another name."""
    for path, found in _fields(package):
        text = package.files[path]
        text = f"{text[: found.end(1)]}_b{text[found.end(1) :]}"
        yield Mutant({path: text}, path, tuple(package.classes))


def _renamed_everywhere(package: Package) -> Iterator[list[Edit]]:
    """A field of a message with another name, in all that fills it or takes from it."""
    for path, found in _fields(package):
        message = path.rpartition("/")[2].removesuffix(".msg")
        edits = [Edit(path, *found.span(1), f"{found[1]}_b")]
        for source in package.sources:
            pattern = rf"\b{message}(?:\(\)|(?:::ConstPtr|::ConstSharedPtr)?&? \w+|\) -> None:)"
            for use in re.finditer(pattern, package.files[source]):
                end = re.compile(r"\n\}|\n\n|\Z").search(package.files[source], use.end())
                assert end is not None
                field = re.compile(rf"\bmsg_?(?:\.|->){found[1]}\b(?! *\()")
                for at in field.finditer(package.files[source], use.end(), end.start()):
                    new = at.end() - len(found[1])
                    edits.append(Edit(source, new, at.end(), f"{found[1]}_b"))
        yield edits


def _other_source(package: Package) -> Iterator[Edit]:
    """A program built of the source of another one."""
    for path in package.paths("CMakeLists.txt"):
        found = re.findall(r"\bsrc/\w+_node\.cpp", package.files[path])
        for one, other in pairwise(found):
            at = package.files[path].index(one)
            yield Edit(path, at, at + len(one), other)


def _at_import(text: str) -> Maker:
    """A statement in the file that makes the modules a package."""

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths("__init__.py"):
            if "launch" not in path:
                end = len(package.files[path])
                yield Edit(path, end, end, text.replace("NAME", package.name))

    return make


ALL = (
    Kind("constant hidden by another file", _from_another_file),
    Kind("two nodes exchange names", _exchanged),
    Kind("field renamed where it is defined", _renamed_in_definition),
    Kind(
        "launch file not installed by CMake", in_files("CMakeLists.txt", r"config launch", "config")
    ),
    *kinds_in("Timing.msg", {"times narrowed": (r"^int64 ", "int16 ")}),
)

ALL_NEUTRAL = (
    *kinds_in(
        ".msg",
        {
            "constant in a message": (r"\A", "int32 LIMIT=3\n"),
        },
    ),
)

ROS2 = (
    Kind("constant hidden for one node", anywhere(_for_one_node)),
    Kind(
        "constant twice",
        anywhere(hidden("\\1      NAME: VALUE\n", "params.yaml", r"^((?: {6}\w+: \d+\n)+)(?=\n)")),
    ),
)

ROS2_NEUTRAL = kinds_in(
    "params.yaml",
    {"time of a simulation": (r"^(    mailbox:\n)", r"    use_sim_time: true\n\1")},
)

ROS1 = kinds_in(
    "params.yaml", {"constant twice": (r"^((\w+): (\d+)\n)(?!.*\n\w+: \d)", r"\1\2: 9\3\n")}
)

CPP = (
    Kind("program of another source", _other_source),
    Kind(
        "program not installed",
        in_files("CMakeLists.txt", r"^    \$\{PROJECT_NAME\}_\w+_node\n", ""),
    ),
    Kind("another constant of a literal", run_time(r"kNoPriority = [^;]*;", "kNoPriority = 0;")),
    Kind("no room in a topic", run_time(r"kQueueSize = \d+", "kQueueSize = 0")),
)

CPP_NEUTRAL = (
    Kind("field renamed everywhere", _renamed_everywhere),
    Kind(
        "targets of other names",
        lambda package: iter(
            [
                Mutant({p: re.sub(r"(\}_\w+)_node\b", r"\1_program", package.files[p])}, p)
                for p in package.paths("CMakeLists.txt")
            ]
        ),
    ),
    Kind(
        "literal of the run-time part in two",
        in_files("mailbox.h", r'"(\w+) (\w+)', r'"\1 "\n"\2'),
    ),
)

PYTHON = (
    Kind(
        "package changes a class of its own",
        _at_import("\nfrom NAME import mailbox\n\nmailbox.Mailbox.delay = print\n"),
    ),
    Kind(
        "package changes the run-time part",
        _at_import("\nimport NAME.values\n\nNAME.values.remainder = max\n"),
    ),
    Kind("no room in a topic", run_time(r"^QUEUE_SIZE = \d+", "QUEUE_SIZE = 0")),
)

PYTHON_NEUTRAL = (Kind("package says its version", _at_import('\n__version__ = "0.1.0"\n')),)
