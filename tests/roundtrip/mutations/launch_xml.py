"""Changes of launch files in XML."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.layout import gone, rewritten, swapped_lines
from tests.roundtrip.mutations.package import Edit, Kind, Maker, Package, in_files

_NODE = re.compile(r'^  <node name="(\w+)"(?:[^>]*/>|.*?</node>)\n', re.MULTILINE | re.DOTALL)


def rebecs(package: Package) -> Iterator[tuple[str, re.Match[str]]]:
    """The nodes of launch files that are rebecs."""
    for path in package.paths(".launch"):
        for found in _NODE.finditer(package.files[path]):
            if not found[1].endswith("_stand_in"):
                yield path, found


def _in_nodes(pattern: str, text: str) -> Maker:
    """In the nodes of launch files; what changes is the rebec."""

    def make(package: Package) -> Iterator[Edit]:
        for path, node in rebecs(package):
            for found in re.compile(pattern, re.MULTILINE).finditer(
                package.files[path], node.start(), node.end()
            ):
                yield Edit(path, *found.span(), found.expand(text), node[1])

    return make


def _whole_nodes(text: str) -> Maker:
    """Puts a text in place of whole nodes; `\\g<0>` is the node."""

    def make(package: Package) -> Iterator[Edit]:
        for path, node in rebecs(package):
            yield Edit(path, *node.span(), node.expand(text), node[1])

    return make


def _copied_node(package: Package) -> Iterator[Edit]:
    for path, node in rebecs(package):
        copy = node[0].replace(f'name="{node[1]}"', f'name="{node[1]}_2"')
        yield Edit(path, node.end(), node.end(), copy, f"{node[1]}_2")


def _greater(package: Package) -> Iterator[Edit]:
    """An argument of a rebec that is one greater."""
    for path, node in rebecs(package):
        for found in re.finditer(r'value="(-?\d+)"', node[0]):
            start = node.start() + found.start(1)
            yield Edit(path, start, start + len(found[1]), str(int(found[1]) + 1), node[1])


def _other_rebec(package: Package) -> Iterator[Edit]:
    """A known rebec that is another."""
    names = [node[1] for _, node in rebecs(package)]
    for path, node in rebecs(package):
        for found in re.finditer(r'value="(\w+)" type="str"', node[0]):
            others = [n for n in names if n != found[1] and "stand_in" not in n]
            start = node.start() + found.start(1)
            if others:
                yield Edit(path, start, start + len(found[1]), others[-1], node[1])


def _other_program(package: Package) -> Iterator[Edit]:
    types = sorted({m[1] for _, n in rebecs(package) if (m := re.search(r'type="(\w+)"', n[0]))})
    for path, node in rebecs(package):
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
            ".launch",
            r'(  <rosparam param="mailbox/rebecs">)',
            r'  <param name="mailbox/time_unit" value="2.0"/>\n\1',
        ),
    ),
    Kind("launch file gone", gone(".launch")),
)

NEUTRAL = (
    Kind(
        "comment in the launch file", in_files(".launch", r"^(  <node )", r"  <!-- a node -->\n\1")
    ),
    Kind(
        "attributes reordered",
        in_files(".launch", r'(<node) (name="\w+") (pkg="\w+")', r"\1 \3 \2"),
    ),
    Kind("log instead of the screen", in_files(".launch", r'output="screen"', 'output="log"')),
    Kind(
        "single quotes in the launch file", rewritten((".launch",), lambda t: t.replace('"', "'"))
    ),
    Kind("remaps reordered", swapped_lines(r"    <remap [^\n]*", ".launch")),
    Kind("arguments reordered", swapped_lines(r"    <param [^\n]*", ".launch")),
    Kind(
        "argument by an arg",
        in_files(
            ".launch",
            r'(<launch>\n)((?:.*\n)*?.*value=")(\d+)" type="int"',
            r'\1  <arg name="own" default="\3"/>\n\2$(arg own)" type="int"',
        ),
    ),
)
