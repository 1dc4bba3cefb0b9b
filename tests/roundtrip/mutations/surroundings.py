"""Changes of parameters, messages and the run-time part, in whatever language that is."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.layout import swapped_lines
from tests.roundtrip.mutations.package import Edit, Kind, Maker, Mutant, Package, in_files

_RUN_TIME = ("mailbox", "startup", "values", "drive")


def constants(package: Package) -> Iterator[tuple[str, re.Match[str]]]:
    """The constants of the model among the parameters, with the indent in the first group."""
    for path in package.paths("params.yaml"):
        text = package.files[path]
        own = re.search(r"^    env:\n((?:      .*\n)+)", text, re.MULTILINE)
        start, end = own.span(1) if own is not None else (0, len(text))
        entry = r"^( {6})(\w+): (\d+)$" if own is not None else r"^()(\w+): (\d+)$"
        for found in re.compile(entry, re.MULTILINE).finditer(text, start, end):
            yield path, found


def _greater_constant(package: Package) -> Iterator[Edit]:
    for path, found in constants(package):
        text = f"{found[1]}{found[2]}: {int(found[3]) + 1}"
        yield Edit(path, *found.span(), text, found[2])


def _by_default(package: Package) -> Iterator[list[Edit]]:
    """A constant that is no longer given, with another default."""
    for path, found in constants(package):
        edits = [Edit(path, found.start(), found.end() + 1, "", found[2])]
        pattern = rf'("(?:env\.)?{found[2]}", )(\d+)'
        for source in package.sources:
            for m in re.finditer(pattern, package.files[source]):
                edits.append(Edit(source, *m.span(), f"{m[1]}{int(m[2]) + 3}", found[2]))
        if len(edits) > 1:
            yield edits


def run_time(pattern: str, text: str) -> Maker:
    """In the files of the run-time part."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(".py" if package.is_python else ".h"):
            if path.rpartition("/")[2].partition(".")[0] in _RUN_TIME:
                code = package.code(path, strings=False)
                for found in compiled.finditer(code):
                    yield Edit(path, *found.span(), found.expand(text))

    return make


def _field(type_: str) -> Maker:
    """Fields of messages that nodes take, with another type."""

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(".msg"):
            if not path.endswith("State.msg"):
                for found in re.finditer(r"^int32 ", package.files[path], re.MULTILINE):
                    element = package.owners.get(path, "")
                    yield Edit(path, *found.span(), f"{type_} ", element)

    return make


def _other_drive(package: Package) -> Iterator[Edit]:
    kinds = {"holonomic": "differential", "differential": "holonomic"}
    for path in package.paths("params.yaml"):
        for found in re.finditer(r"holonomic|differential", package.files[path]):
            yield Edit(path, *found.span(), kinds[found[0]])


_ENTRY = r"^( +{}: ).*$"

KINDS = (
    Kind("constant in the parameters", _greater_constant),
    Kind("constant by default", _by_default),
    Kind("unit of time", in_files("params.yaml", _ENTRY.format("time_unit"), r"\g<1>2.0")),
    Kind("settling time", in_files("params.yaml", _ENTRY.format("settle"), r"\g<1>0.0")),
    Kind("no size of a cell", in_files("params.yaml", _ENTRY.format("cell_size"), r"\g<1>0.0")),
    Kind("kind of drive", _other_drive),
    Kind("heading", in_files("params.yaml", _ENTRY.format("heading"), r"\g<1>1.57")),
    Kind("time of a move", in_files("params.yaml", _ENTRY.format("move_time"), r"\g<1>3.0")),
    Kind("run-time part: comparison", run_time(r" < ", " <= ")),
    Kind("field of a message narrowed", _field("int8")),
    Kind("field of a message truth", _field("bool")),
)

NEUTRAL = (
    Kind(
        "comment in the parameters",
        in_files("params.yaml", r"^( *\w+: [\w.]+)$", r"\1  # so it is"),
    ),
    Kind("parameters reordered", swapped_lines(r" *(?!seed)\w+: \d+", "params.yaml")),
    Kind("slack", in_files("params.yaml", _ENTRY.format("slack"), r"\g<1>0.9")),
    Kind("size of a cell", in_files("params.yaml", _ENTRY.format("cell_size"), r"\g<1>2.0")),
    Kind("seed", in_files("params.yaml", _ENTRY.format("seed"), r"\g<1>7")),
    Kind("comment in a message", in_files(".msg", r"\A", "# what is told\n")),
    Kind(
        "version of the package",
        in_files("package.xml", r"<version>.*</version>", "<version>9.9.9</version>"),
    ),
    Kind("README", in_files("README.md", r"\A", "Mine.\n")),
    Kind(
        "new file",
        lambda package: iter([Mutant({"scripts/plot.py": "print(1)\n"}, "scripts/plot.py")]),
    ),
)
