"""Which modules of `reverse` name one of the client libraries in their code.

    python -m tests.reverse.libraries.naming

Strings and identifiers count, and the names of modules; comments and docstrings do not.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[3]
# Where the names may stand: the tables, launch files, and the checks of our own generated text.
ROOMS = ("libraries", "launch", "generated", "scaffold")
NAMES = re.compile(
    r"(?<![A-Za-z])ros::|(?i:roscpp|rospy|rclcpp|rclpy)|NodeHandle|(?<![A-Z])ROS_[A-Z]"
    r"|createTimer|create_publisher|create_subscription|create_wall_timer|advertiseService"
)


def naming(root: Path = ROOT) -> dict[str, list[str]]:
    """The modules by their paths, each with the words that name a library."""
    found = {}
    for path in sorted((root / "reverse").rglob("*.py")):
        inside = path.relative_to(root / "reverse")
        if inside.parts[0] in ROOMS:
            continue
        words = [path.stem] if NAMES.search(path.stem) else []
        words += words_in(path.read_text())
        if words:
            found[inside.as_posix()] = words
    return found


def words_in(text: str) -> Iterator[str]:
    """The identifiers and texts in some code that name a library."""
    tree = ast.parse(text)
    silent = {id(s.value) for s in ast.walk(tree) if isinstance(s, ast.Expr)}
    for node in ast.walk(tree):
        for word in _words(node) if id(node) not in silent else ():
            if NAMES.search(word):
                yield word


def _words(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.Constant(str() as value):
            yield value
        case ast.Constant(bytes() as value):
            yield value.decode("latin1")
        case ast.Name(name) | ast.Attribute(_, name) | ast.arg(name):
            yield name
        case ast.keyword(str() as name):
            yield name
        case ast.alias(name, other):
            yield name if "." not in name else ""
            yield other or ""
        case ast.FunctionDef(name) | ast.ClassDef(name):
            yield name


if __name__ == "__main__":
    for module, words in naming().items():
        print(module, words)
