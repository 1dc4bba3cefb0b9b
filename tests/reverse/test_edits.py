"""Edits by hand come back as the change of the model that they are (edits.toml), or are listed."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from tests.reverse.laws import assert_says, extracted
from tests.reverse.test_laws import EXAMPLES, package_of

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

HERE = Path(__file__).parent
EDITS: dict[str, Any] = tomllib.loads((HERE / "edits.toml").read_text(encoding="utf-8"))
LISTED: dict[str, Any] = tomllib.loads((HERE / "listed_edits.toml").read_text(encoding="utf-8"))
BY_NAME = {example.name: example for example in EXAMPLES}


@pytest.mark.parametrize("name", EDITS)
def test_edits_come_back(name: str) -> None:
    edit = EDITS[name]
    example = BY_NAME[edit["example"]]
    files = edited(edit)
    text = (example / f"{example.name}.rebeca").read_text(encoding="utf-8")
    for old, new in edit.get("copied", ()):
        _, head, rest = text.partition(f"@Robot\nreactiveclass {old}(")
        own, end, _ = rest.partition("\n}\n")
        text = text.replace("\nmain {", f"\n{head}{own}{end}".replace(old, new) + "\nmain {")
    for old, new, *within in edit["model"]:
        text = replaced_in(text, within[0], old, new) if within else replaced(text, old, new)
    assert_says(files, parse_model(Source("edited.rebeca", text)).model)


@pytest.mark.parametrize("name", LISTED)
def test_what_the_model_cannot_show_is_listed(name: str) -> None:
    edit = LISTED[name]
    found = extracted(edited(edit)).findings
    assert len(found) == len(edit["listed"]), [(f.text, f.why) for f in found]
    for finding, text in zip(found, edit["listed"], strict=True):
        assert finding.text.startswith(text), (finding.text, finding.why)


def edited(edit: dict[str, Any]) -> dict[str, str]:
    """The package with its copies, new files (replaced is nothing) and replaced texts."""
    files = package_of(BY_NAME[edit["example"]])
    for source, target, old, new in edit.get("copies", ()):
        files[target] = files[source].replace(old, new).replace(old.lower(), new.lower())
    for path, old, new in edit["code"]:
        files[path] = replaced(files[path], old, new) if old else new
    return files


def replaced(text: str, old: str, new: str) -> str:
    """The text with all of `old` replaced, which must be there."""
    assert old in text, old
    return text.replace(old, new)


def replaced_in(text: str, class_name: str, old: str, new: str) -> str:
    """The same within one class."""
    before, head, rest = text.partition(f"reactiveclass {class_name}(")
    own, end, after = rest.partition("\n}\n")
    return before + head + replaced(own, old, new) + end + after
