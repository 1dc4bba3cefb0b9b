"""The page of all JSON outputs, made of the schemas beside this file when the site is built."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent

HEAD = """\
# JSON outputs

What commands print with `--format json`, field by field. Each object is described by a JSON Schema,
which is what counts; a field that is not marked is always there. A linked type is a table below.
"""


def schemas_page() -> str:
    """The text of the page, from the schemas beside it."""
    return HEAD + "".join(map(_section, sorted(FOLDER.glob("*.schema.json"))))


def _section(path: Path) -> str:
    schema = json.loads(path.read_text(encoding="utf-8"))
    command = path.name.partition(".")[0]
    parts = [f"\n## {schema['title']}\n\nSchema: [{path.name}]({path.name})\n"]
    parts += _table(command, schema)
    for name, part in sorted(schema.get("$defs", {}).items()):
        parts.append(f'\n<a id="{_anchor(command, name)}"></a>\n\n### {command}: {name}\n')
        parts += _table(command, part)
    return "".join(parts)


def _table(command: str, part: dict[str, Any]) -> Iterator[str]:
    """The description of a type and, of an object, a row for each field."""
    if "description" in part:
        yield f"\n{part['description']}\n"
    if "properties" not in part:
        yield f"\n{_type(command, part)}\n"
        return
    yield "\n| field | type | meaning |\n|---|---|---|\n"
    yield from _rows(command, part, "")


def _rows(command: str, part: dict[str, Any], above: str) -> Iterator[str]:
    """The fields of an object, those of objects without a name of their own as `field.inner`."""
    for name, value in part["properties"].items():
        optional = "" if name in part.get("required", ()) else " (optional)"
        kind = _type(command, value) + optional
        meaning = value.get("description", "").replace("|", "\\|")
        yield f"| `{above}{name}` | {kind} | {meaning} |\n"
        inner = value.get("items", value)
        if "properties" in inner:
            yield from _rows(command, inner, f"{above}{name}{'[]' * ('items' in value)}.")


def _type(command: str, value: dict[str, Any]) -> str:
    """A type in words."""
    match value:
        case {"$ref": reference}:
            name = reference.rpartition("/")[2]
            return f"[{name}](#{_anchor(command, name)})"
        case {"const": constant}:
            return f"`{json.dumps(constant)}`"
        case {"enum": values}:
            return ", ".join(f"`{json.dumps(each)}`" for each in values)
        case {"anyOf": parts} | {"oneOf": parts}:
            return " or ".join(_type(command, each) for each in parts)
        case {"items": items}:
            return f"list of {_type(command, items)}"
        case {"type": [*kinds]}:
            return " or ".join(kinds)
        case {"type": kind}:
            return str(kind)
        case _:
            return "anything"


def _anchor(command: str, name: str) -> str:
    return f"{command}-{name}".lower()
