"""The pages of docs/ are current: codes, commands, settings, links, and what the tutorial shows."""

from __future__ import annotations

import json
import re
import runpy
from dataclasses import fields
from importlib import import_module
from pathlib import Path

import click
import pytest

from rebsync.cli.group import COMMANDS
from rebsync.codes import CODES
from rebsync.config import TARGETS, Config
from rebsync.grammars.formulas import OPERATORS
from rebsync.grammars.properties import parse_properties
from rebsync.source import Source
from tests.consoles import ROOT, play

DOCS = ROOT / "docs"
PAGES = (*sorted(DOCS.rglob("*.md")), *ROOT.glob("*.md"), *sorted(ROOT.glob("examples/*/*.md")))
REFERENCE = (DOCS / "commands.md").read_text(encoding="utf-8")


def test_the_page_of_codes_is_current() -> None:
    page = runpy.run_path(str(DOCS / "errors.py"))["errors_page"]()
    assert (DOCS / "errors.md").read_text(encoding="utf-8") == page, "run docs/errors.py"


def test_the_page_of_codes_has_every_code() -> None:
    page = (DOCS / "errors.md").read_text(encoding="utf-8")
    assert re.findall(r"^\| (RS\d+) ", page, re.MULTILINE) == sorted(CODES)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_is_described(name: str) -> None:
    command = import_module(f"rebsync.cli.{name}").command
    section = re.search(rf"^## rebsync {name}\b.*?(?=^## )", REFERENCE, re.MULTILINE | re.DOTALL)
    assert section is not None
    described = set(re.findall(r"^\| .*?\|", section[0], re.MULTILINE))
    shown = {
        option for row in described for option in re.findall(r"(?<!\w)--?[a-z]+(?:-[a-z]+)*", row)
    }
    options = [p for p in command.params if isinstance(p, click.Option)]
    assert shown == {o for option in options for o in (*option.opts, *option.secondary_opts)}


def test_every_setting_is_described_with_its_default() -> None:
    settings = REFERENCE.partition("\n## Settings")[2]
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*?) \|", settings, re.MULTILINE))
    assert set(rows) == {f.name for f in fields(Config)}
    for field in fields(Config):
        default = getattr(Config(), field.name)
        if isinstance(default, bool):
            assert rows[field.name] == f"`{str(default).lower()}`"
        elif isinstance(default, (int, float)):
            assert rows[field.name] == f"`{default}`"
        elif isinstance(default, str):
            assert rows[field.name] == f'`"{default}"`'


def test_every_target_is_described() -> None:
    assert all(f"--target {target}" in REFERENCE for target in TARGETS)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target


def test_the_page_of_properties_has_every_operator() -> None:
    page = (DOCS / "properties.md").read_text(encoding="utf-8")
    for operators in OPERATORS.values():
        assert all(f"`{name}(p" in page for name in operators)
    shown = re.findall(r"^```text\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert shown
    assert all(parse_properties(Source("shown.property", text)).ok for text in shown)


def test_the_table_has_each_command() -> None:
    named = re.findall(r"^\| \[`rebsync (\w+)", REFERENCE, re.MULTILINE)
    assert set(named) == set(COMMANDS)


@pytest.mark.parametrize("name", ["tutorial", "ros", "rebeca", "cookbook"])
def test_a_page_does_what_it_shows(name: str, tmp_path: Path) -> None:
    page = (DOCS / f"{name}.md").read_text(encoding="utf-8")
    for command, printed in play(page, tmp_path):
        assert printed == command.output, command.text
    for picture in re.findall(r"\]\((\w+\.svg)\)", page):
        assert (tmp_path / "home" / picture).read_text() == (DOCS / picture).read_text(), picture


def test_each_page_is_in_the_navigation_of_the_site() -> None:
    settings = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    listed = set(re.findall(r"(\w+\.md)$", settings, re.MULTILINE))
    assert {path.name for path in DOCS.glob("*.md")} <= listed


def test_the_page_of_json_outputs_has_every_field() -> None:
    page = runpy.run_path(str(DOCS / "schemas.py"))["schemas_page"]()
    for path in DOCS.glob("*.schema.json"):
        schema = json.loads(path.read_text(encoding="utf-8"))
        assert f"## {schema['title']}\n" in page
        assert all(f"| `{name}` | " in page for name in schema["properties"])
        assert all(
            f"### {path.name.partition('.')[0]}: {n}\n" in page for n in schema.get("$defs", ())
        )
