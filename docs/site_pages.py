"""Hooks of mkdocs: pages that stand elsewhere, and what GitHub shows in another way."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parents[1]
ELSEWHERE = {"contributing.md": "CONTRIBUTING.md", "changes.md": "CHANGELOG.md"}
_OUTSIDE = re.compile(r"\[([^\]]*)\]\((?:\.\./)+(?!decisions)(?:bench|examples|tests)/[^)]*\)")
_NAMED_FENCE = re.compile(r"^```(\w+) (\S+)$", re.MULTILINE)
_ROW = re.compile(r"^\|.*$", re.MULTILINE)
_CODE = re.compile(r"`[^`\n]+`")
_MODEL_FENCE = re.compile(r"^```rebeca\b", re.MULTILINE)


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Lists all decisions."""
    paths = sorted(Path(config.docs_dir, "decisions").glob("*.md"))
    assert config.nav is not None
    config.nav[-1]["Architecture"][-1]["Decisions"] = [f"decisions/{path.name}" for path in paths]
    return config


def on_files(files: Files, /, config: MkDocsConfig) -> Files:
    """Adds the pages that stand outside of docs/, and the one that is made of the schemas."""
    for name, path in ELSEWHERE.items():
        text = (ROOT / path).read_text(encoding="utf-8").replace("](docs/", "](")
        files.append(File.generated(config, name, content=text))
    page = runpy.run_path(str(ROOT / "docs/schemas.py"))["schemas_page"]()
    files.append(File.generated(config, "schemas.md", content=page))
    return files


def on_page_markdown(markdown: str, /, **_: object) -> str:
    """Gives fences titles and colours; leaves out escapes in tables, and links out of the site."""
    text = _NAMED_FENCE.sub(r'```\1 title="\2"', _OUTSIDE.sub(r"\1", markdown))
    text = _ROW.sub(lambda row: _CODE.sub(lambda code: code[0].replace("\\|", "|"), row[0]), text)
    return _MODEL_FENCE.sub("```java", text)
