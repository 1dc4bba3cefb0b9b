"""Changes of launch files in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.layout import gone, rewritten, swapped_lines
from tests.roundtrip.mutations.package import Edit, Kind, Maker, Package, in_files

_FILE = ".launch.py"
_NODE = re.compile(r"^ {12}Node\(\n(?: {13}.*\n)*? {12}\),\n", re.MULTILINE)
_NAME = re.compile(r'^ +name="(\w+)",$', re.MULTILINE)
_PROGRAM = re.compile(r'^ +executable="(\w+)",$', re.MULTILINE)


def rebecs(package: Package) -> Iterator[tuple[str, str, re.Match[str]]]:
    """The files and names of the rebecs that launch files start, and their extents."""
    for path in package.paths(_FILE):
        for found in _NODE.finditer(package.files[path]):
            name = _NAME.search(found[0])
            if name is not None and not name[1].endswith("_stand_in"):
                yield path, name[1], found


def _in_nodes(pattern: str, text: str) -> Maker:
    """In the nodes of launch files; what changes is the rebec."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path, name, node in rebecs(package):
            for found in compiled.finditer(package.files[path], node.start(), node.end()):
                yield Edit(path, *found.span(), found.expand(text), name)

    return make


def _whole_nodes(text: str) -> Maker:
    """Puts a text in place of whole nodes."""

    def make(package: Package) -> Iterator[Edit]:
        for path, name, node in rebecs(package):
            yield Edit(path, *node.span(), text, name)

    return make


def _copied_node(package: Package) -> Iterator[Edit]:
    for path, name, node in rebecs(package):
        copy = node[0].replace(f'name="{name}"', f'name="{name}_2"')
        yield Edit(path, node.end(), node.end(), copy, f"{name}_2")


def _greater(package: Package) -> Iterator[Edit]:
    """An argument of a rebec that is one greater."""
    for path, name, node in rebecs(package):
        for found in re.finditer(r'"\w+": (-?\d+),', node[0]):
            start = node.start() + found.start(1)
            yield Edit(path, start, start + len(found[1]), str(int(found[1]) + 1), name)


def _swapped_arguments(package: Package) -> Iterator[Edit]:
    pattern = re.compile(r'("\w+": )(-?\d+)(,\n *"\w+": )(-?\d+),')
    for path, name, node in rebecs(package):
        for found in pattern.finditer(node[0]):
            if found[2] != found[4]:
                start = node.start() + found.start()
                text = f"{found[1]}{found[4]}{found[3]}{found[2]},"
                yield Edit(path, start, start + len(found[0]), text, name)


def _other_rebec(package: Package) -> Iterator[Edit]:
    """A known rebec that is another."""
    names = [name for _, name, _ in rebecs(package)]
    for path, name, node in rebecs(package):
        for found in re.finditer(r'"knownrebecs\.\w+": "(\w+)"', node[0]):
            others = [n for n in names if n != found[1]]
            start = node.start() + found.start(1)
            if others:
                yield Edit(path, start, start + len(found[1]), others[-1], name)


def _other_program(package: Package) -> Iterator[Edit]:
    types = sorted({m[1] for _, _, node in rebecs(package) for m in _PROGRAM.finditer(node[0])})
    for path, _, node in rebecs(package):
        for found in _PROGRAM.finditer(node[0]):
            others = [t for t in types if t != found[1]]
            start = node.start() + found.start(1)
            if others:
                yield Edit(path, start, start + len(found[1]), others[0])


def _condition(package: Package) -> Iterator[list[Edit]]:
    """A node that a condition keeps from being started."""
    for path, name, node in rebecs(package):
        found = re.search(r"^from launch\.sub", package.files[path], re.MULTILINE)
        if found is not None:
            line = "from launch.conditions import IfCondition\n"
            at = node.start() + node[0].index("\n") + 1
            text = f'{" " * 16}condition=IfCondition("false"),\n'
            yield [
                Edit(path, at, at, text, name),
                Edit(path, found.start(), found.start(), line),
            ]


def _extracted(package: Package) -> Iterator[list[Edit]]:
    """An argument that is named before."""
    for path, name, node in rebecs(package):
        head = re.search(r"^    return LaunchDescription", package.files[path], re.MULTILINE)
        for found in re.finditer(r'"\w+": (-?\d+),', node[0]):
            start = node.start() + found.start(1)
            if head is not None:
                yield [
                    Edit(path, head.start(), head.start(), f"    own = {found[1]}\n"),
                    Edit(path, start, start + len(found[1]), "own", name),
                ]


def _single(text: str) -> str:
    """The text with other quotes, but for what says what functions are for."""
    return re.sub(r'(?<!")"([^"\n]*)"(?!")', r"'\1'", text)


_END = r"^( {16}output=.*\n)"

KINDS = (
    Kind("argument in the launch file", _greater),
    Kind("arguments in the launch file swapped", _swapped_arguments),
    Kind("argument not given", _in_nodes(r'^ *"\w+": (?!0,)-?\d+,\n', "")),
    Kind("known rebec is another", _other_rebec),
    Kind("known rebec not given", _in_nodes(r'^ *"knownrebecs\..*\n', "")),
    Kind("clock of one node", _in_nodes(r"^ *clock,\n", "")),
    Kind(
        "remap before another",
        _in_nodes(r'^( *)\("(~/.*)", "(.*)"\),\n', r'\1("\2", "other"),\n\g<0>'),
    ),
    Kind(
        "remap among the arguments",
        in_files(_FILE, r"^(    logging = \[)", r'\1"-r", "~/state:=other", '),
    ),
    Kind("remap removed", _in_nodes(r'^ *\("~/.*"\),\n', "")),
    Kind("remap to another topic", _in_nodes(r'(\("~/[^"]*", ")', r"\1other/")),
    Kind("remap from another topic", _in_nodes(r'(\("~/)', r"\1other/")),
    Kind("all remaps removed", _in_nodes(r"^ *remappings=\[\n(?: {17}.*\n)* {16}\],\n", "")),
    Kind("node not launched", _whole_nodes("")),
    Kind("node only if", _condition),
    Kind("node in a namespace", _in_nodes(_END, r'\1                namespace="other",\n')),
    Kind("node launched twice", _copied_node),
    Kind("node of another name", _in_nodes(r'^( +name="\w+)"', r'\1_b"')),
    Kind("node without a name", _in_nodes(r'^ +name="\w+",\n', "")),
    Kind("node of another program", _other_program),
    Kind("node of another package", _in_nodes(r'^( +package="\w+)"', r'\1_b"')),
    Kind("node started again", _in_nodes(_END, r"\1                respawn=True,\n")),
    Kind(
        "node with arguments",
        _in_nodes(_END, r'\1                arguments=["--ros-args", "-r", "~/state:=other"],\n'),
    ),
    Kind("rebecs to wait for", in_files(_FILE, r'("mailbox\.rebecs": \[\s*)"\w+",\s*', r"\1")),
    Kind(
        "instances of a class",
        in_files(_FILE, r'("mailbox\.instances\.\w+": \["\w+"), "\w+"', r"\1"),
    ),
    Kind("parameters not loaded", _in_nodes(r"^ +params,\n", "")),
    Kind("parameters of the system not given", _in_nodes(r"^ +system,\n", "")),
    Kind("other parameters loaded", in_files(_FILE, r'"params\.yaml"', '"other.yaml"')),
    Kind(
        "parameter set in the launch file",
        in_files(_FILE, r"^(    system = \{\n)", r'\1        "mailbox.time_unit": 2.0,\n'),
    ),
    Kind("launch file gone", gone(_FILE)),
)

NEUTRAL = (
    Kind("comment in the launch file", in_files(_FILE, r"^( +)(Node\()", r"\1# a node\n\1\2")),
    Kind(
        "attributes reordered",
        in_files(_FILE, r"^( +package=.*\n)( +executable=.*\n)", r"\2\1"),
    ),
    Kind("log instead of the screen", in_files(_FILE, r'output="screen"', 'output="log"')),
    Kind("clock of a simulation", in_files(_FILE, r"(\"use_sim_time\": ).*(?=\})", r"\1True")),
    Kind("single quotes in the launch file", rewritten((_FILE,), _single)),
    Kind("remaps reordered", swapped_lines(r'                    \("~/[^\n]*', _FILE)),
    Kind("arguments reordered", swapped_lines(r'                        "\w+": \d+,', _FILE)),
    Kind("argument named before", _extracted),
    Kind("no types in the launch file", in_files(_FILE, r" -> LaunchDescription:", ":")),
    Kind(
        "names of the launch file imported otherwise",
        in_files(_FILE, r"^(from launch import LaunchDescription)$", r"import sys\n\1"),
    ),
    Kind(
        "names of the launch file renamed",
        rewritten(
            (_FILE,), lambda t: re.sub(r"\b(?<!mailbox\.)system\b(?=[], ])", "all_of_them", t)
        ),
    ),
)
