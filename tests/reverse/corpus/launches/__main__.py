"""Launch files of ROS 2 against facts: `python -m tests.reverse.corpus.launches DIR`.

`facts.json` says, one node per line in the order of their start, what people's launch files start:
`package`, `type`, `name` (null: not given), `namespace`; `parameters` written in the launch file
(null: not to be known), parameter `files` of which a section is for the node, `remaps`, and
whether it is started only `if` something holds that the file does not tell. All of a fact counts:
a node is right or wrong as a whole.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from pathlib import Path

from rebsync.reverse.build.manifests import read_manifest
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.unknowns import Open
from rebsync.source import Source
from tests.reverse.corpus.values import Json

FACTS = Path(__file__).parent / "facts.json"


def read(root: Path, file: str) -> Launch:
    """What a launch file of a checkout starts."""
    path = root / file
    package = next(d for d in path.parents if (d / "package.xml").is_file())

    def load(inner: str) -> Source | None:
        there = package / inner
        return Source(inner, there.read_text(encoding="utf-8")) if there.is_file() else None

    manifest = Source("package.xml", (package / "package.xml").read_text(encoding="utf-8"))
    source = load(path.relative_to(package).as_posix())
    assert source is not None
    return read_ros2_launch(source, load, read_manifest(manifest).name or "")


def said(node: LaunchedNode, file: str) -> Json:
    """A node as the facts say it."""
    own = [p for p in node.parameters if not p.source.path.endswith((".yaml", ".yml"))]
    others = [p.source.path for p in node.parameters if p not in own]
    return {
        "file": file,
        "package": _plain(node.package),
        "type": _plain(node.type),
        "name": _plain(node.name),
        "namespace": _plain(node.namespace),
        "parameters": {p.name: _plain(p.value) for p in own},
        "files": list(dict.fromkeys(others)),
        "remaps": {r.private: _plain(r.target) for r in node.remaps},
        "if": bool(node.only_if),
    }


def _plain(value: Json) -> Json:
    return None if isinstance(value, Open) else value


def compared(root: Path, facts: Sequence[Json]) -> Iterator[tuple[Json, Json]]:
    """Each fact with the answer at its place in its file; None where there is none."""
    for file in dict.fromkeys(fact["file"] for fact in facts):
        if (root / file).is_file():
            wanted = [fact for fact in facts if fact["file"] == file]
            given = [said(node, file) for node in read(root, file).nodes]
            yield from zip_longest(wanted, given)


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the figures and what differs; 1 where nothing can be compared."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.reverse.corpus.launches", description=__doc__
    )
    parser.add_argument("folder", type=Path, metavar="DIR")
    given = parser.parse_args(arguments)
    facts: list[Json] = json.loads(FACTS.read_text(encoding="utf-8"))
    found = list(compared(given.folder, facts))
    if not found:
        print(f"{given.folder}: none of the launch files is here", file=sys.stderr)
        return 1
    right = sum(fact == answer for fact, answer in found)
    wanted, answered = (sum(p[i] is not None for p in found) for i in (0, 1))
    print(f"nodes {wanted}, found {answered}, right {right}")
    for fact, answer in found:
        if fact != answer:
            print(f"fact   {json.dumps(fact)}\nanswer {json.dumps(answer)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
