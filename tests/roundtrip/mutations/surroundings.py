"""Changes of what is around classes: launch files, parameters, programs, builds, run-time part."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.package import Edit, Kind, Maker, Mutant, Package, in_files

_NODE = re.compile(r'^  <node name="(\w+)"(?:[^>]*/>|.*?</node>)\n', re.MULTILINE | re.DOTALL)


def _nodes(package: Package) -> Iterator[tuple[str, re.Match[str]]]:
    """The nodes of launch files that are rebecs."""
    for path in package.paths(".launch"):
        for found in _NODE.finditer(package.files[path]):
            if not found[1].endswith("_stand_in"):
                yield path, found


def _in_nodes(pattern: str, text: str) -> Maker:
    """In the nodes of launch files; what changes is the rebec."""

    def make(package: Package) -> Iterator[Edit]:
        for path, node in _nodes(package):
            for found in re.compile(pattern, re.MULTILINE).finditer(
                package.files[path], node.start(), node.end()
            ):
                yield Edit(path, *found.span(), found.expand(text), node[1])

    return make


def _whole_nodes(text: str) -> Maker:
    """Puts a text in place of whole nodes; `\\g<0>` is the node."""

    def make(package: Package) -> Iterator[Edit]:
        for path, node in _nodes(package):
            yield Edit(path, *node.span(), node.expand(text), node[1])

    return make


def _copied_node(package: Package) -> Iterator[Edit]:
    for path, node in _nodes(package):
        copy = node[0].replace(f'name="{node[1]}"', f'name="{node[1]}_2"')
        yield Edit(path, node.end(), node.end(), copy, f"{node[1]}_2")


def _greater(package: Package) -> Iterator[Edit]:
    """An argument of a rebec that is one greater."""
    for path, node in _nodes(package):
        for found in re.finditer(r'value="(-?\d+)"', node[0]):
            start = node.start() + found.start(1)
            yield Edit(path, start, start + len(found[1]), str(int(found[1]) + 1), node[1])


def _other_rebec(package: Package) -> Iterator[Edit]:
    """A known rebec that is another."""
    names = [node[1] for _, node in _nodes(package)]
    for path, node in _nodes(package):
        for found in re.finditer(r'value="(\w+)" type="str"', node[0]):
            others = [n for n in names if n != found[1] and "stand_in" not in n]
            start = node.start() + found.start(1)
            if others:
                yield Edit(path, start, start + len(found[1]), others[-1], node[1])


def _other_program(package: Package) -> Iterator[Edit]:
    types = sorted({m[1] for _, n in _nodes(package) if (m := re.search(r'type="(\w+)"', n[0]))})
    for path, node in _nodes(package):
        found = re.search(r'type="(\w+)"', node[0])
        others = [t for t in types if found is not None and t != found[1]]
        if found is not None and others:
            start = node.start() + found.start(1)
            yield Edit(path, start, start + len(found[1]), others[0])


def _swapped_arguments(package: Package) -> Iterator[Edit]:
    pattern = r'(value=")(-?\d+)(" type="int"/>\n.*value=")(-?\d+)"'
    for edit in _in_nodes(pattern, r'\1\4\3\2"')(package):
        if isinstance(edit, Edit) and len(set(re.findall(r'value="(-?\d+)"', edit.text))) > 1:
            yield edit


def _constants(package: Package) -> Iterator[re.Match[str]]:
    """The constants of the model among the parameters."""
    for path in package.paths("params.yaml"):
        yield from re.finditer(r"^(\w+): (\d+)$", package.files[path], re.MULTILINE)


def _greater_constant(package: Package) -> Iterator[Edit]:
    for path in package.paths("params.yaml"):
        for found in _constants(package):
            text = f"{found[1]}: {int(found[2]) + 1}"
            yield Edit(path, *found.span(), text, found[1])


def _by_default(package: Package) -> Iterator[list[Edit]]:
    """A constant that is no longer given, with another default."""
    for path in package.paths("params.yaml"):
        for found in _constants(package):
            edits = [Edit(path, found.start(), found.end() + 1, "", found[1])]
            for source in package.paths(".cpp"):
                pattern = rf'(global\.param\("{found[1]}", )(\d+)'
                for m in re.finditer(pattern, package.files[source]):
                    edits.append(Edit(source, *m.span(), f"{m[1]}{int(m[2]) + 3}", found[1]))
            if len(edits) > 1:
                yield edits


def _run_time(pattern: str, text: str) -> Maker:
    """In the headers of the run-time part."""

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(".h"):
            if path.rpartition("/")[2] in ("mailbox.h", "startup.h", "values.h", "drive.h"):
                code = package.code(path, strings=False)
                for found in re.compile(pattern, re.MULTILINE).finditer(code):
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


def _program(pattern: str, text: str) -> Maker:
    return in_files("_node.cpp", pattern, text)


def _gone(suffix: str) -> Maker:
    """A file that is no longer there."""

    def make(package: Package) -> Iterator[Mutant]:
        for path in package.paths(suffix):
            yield Mutant({path: None}, path)

    return make


def _other_drive(package: Package) -> Iterator[Edit]:
    kinds = {"holonomic": "differential", "differential": "holonomic"}
    for path in package.paths("params.yaml"):
        for found in re.finditer(r"holonomic|differential", package.files[path]):
            yield Edit(path, *found.span(), kinds[found[0]])


_ENTRY = r"^(  {}: ).*$"

KINDS = (
    Kind("argument in the launch file", _greater),
    Kind("arguments in the launch file swapped", _swapped_arguments),
    Kind("argument not given", _in_nodes(r'^ *<param name="(?!known)(?!.*value="0").*\n', "")),
    Kind("known rebec is another", _other_rebec),
    Kind("known rebec not given", _in_nodes(r'^ *<param name="known.*\n', "")),
    Kind("remap removed", _in_nodes(r"^ *<remap .*\n", "")),
    Kind("remap to another topic", _in_nodes(r'(<remap .* to=")', r"\1other/")),
    Kind("remap from another topic", _in_nodes(r'(<remap from="~)', r"\1other/")),
    Kind("node not launched", _whole_nodes("")),
    Kind("node only if", _whole_nodes(r'  <group if="false">\n\g<0>  </group>\n')),
    Kind("node in a namespace", _whole_nodes(r'  <group ns="other">\n\g<0>  </group>\n')),
    Kind("node launched twice", _copied_node),
    Kind("node of another name", _in_nodes(r'(<node name="\w+)"', r'\1_b"')),
    Kind("node of another program", _other_program),
    Kind("node started again", _in_nodes(r'(<node name="\w+")', r'\1 respawn="true"')),
    Kind("rebecs to wait for", in_files(".launch", r"(mailbox/rebecs\">\[)(\w+, )", r"\1")),
    Kind("instances of a class", in_files(".launch", r"(: \[\w+), \w+", r"\1")),
    Kind("parameters not loaded", in_files(".launch", r"^ *<rosparam command=.*\n", "")),
    Kind(
        "parameter set in the launch file",
        in_files(
            ".launch", r"(<launch>\n)", r'\1  <param name="mailbox/time_unit" value="2.0"/>\n'
        ),
    ),
    Kind("constant in the parameters", _greater_constant),
    Kind("constant by default", _by_default),
    Kind("unit of time", in_files("params.yaml", _ENTRY.format("time_unit"), r"\g<1>2.0")),
    Kind("settling time", in_files("params.yaml", _ENTRY.format("settle"), r"\g<1>0.0")),
    Kind("size of a cell", in_files("params.yaml", _ENTRY.format("cell_size"), r"\g<1>2.0")),
    Kind("kind of drive", _other_drive),
    Kind("heading", in_files("params.yaml", _ENTRY.format("heading"), r"\g<1>1.57")),
    Kind("time of a move", in_files("params.yaml", _ENTRY.format("move_time"), r"\g<1>3.0")),
    Kind("program reads another parameter", _program(r'(node\.param\("\w+)"', r'\1_b"')),
    Kind(
        "program exchanges parameters",
        _program(r'(param\(")(\w+)(", 0\),\s+node\.param\(")(\w+)"', r'\1\4\3\2"'),
    ),
    Kind("program does not start", _program(r"^ *rebec\.mailbox\(\)\.start.*\n", "")),
    Kind("program does not receive", _program(r"^ *reception\.start.*\n", "")),
    Kind("program ends at once", _program(r"^ *ros::waitForShutdown.*\n", "")),
    Kind("program of another node", _program(r'NodeHandle node\("~"\)', 'NodeHandle node("~b")')),
    Kind("run-time part: comparison", _run_time(r" < ", " <= ")),
    Kind("run-time part: negation", _run_time(r"if \(!", "if (")),
    Kind("run-time part: number", _run_time(r"= 0;", "= 1;")),
    Kind("run-time part: statement removed", _run_time(r"^ +\w+\.\w+\([^;\n]*\);\n", "")),
    Kind("run-time part: file gone", _gone("/mailbox.h")),
    Kind(
        "stand-in publishes something else",
        in_files("_stand_in.cpp", r"\{false, true\}|\{0, 1\}", "{}"),
    ),
    Kind("source not built", in_files("CMakeLists.txt", r"^  src/(?!.*_node).*\.cpp\n", "")),
    Kind("program not built", in_files("CMakeLists.txt", r"^add_executable\([^)]*\)\n", "")),
    Kind(
        "program of another name",
        in_files("CMakeLists.txt", r"OUTPUT_NAME (\w+)", r"OUTPUT_NAME \1_b"),
    ),
    Kind("integers no longer wrap", in_files("CMakeLists.txt", r"(?<=pedantic) -fwrapv", "")),
    Kind(
        "another name for a call",
        in_files("CMakeLists.txt", r"(?<=pedantic) (-fwrapv)", r" \1 -Dafter=deadline"),
    ),
    Kind("field of a message narrowed", _field("int8")),
    Kind("field of a message truth", _field("bool")),
    Kind("source gone", _gone("_node.cpp")),
    Kind("launch file gone", _gone(".launch")),
)
