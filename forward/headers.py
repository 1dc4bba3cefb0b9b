"""Headers of generated sources: who holds the copyright, and under which licence.

The texts are those by which ament_copyright knows a licence.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from rebsync.config import COPYRIGHT
from rebsync.forward.templating import fill

# By their SPDX identifiers. The texts of GPL-3.0 and LGPL-3.0 allow later versions.
LICENSES = (
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "GPL-3.0-or-later",
    "LGPL-3.0-or-later",
    "MIT",
    "MIT-0",
)
_COMMENTS = {".cpp": "//", ".h": "//", ".hpp": "//", ".py": "#"}


class Owned(Protocol):
    """What has a licence and, if its owner is known, a copyright such as `2026 ACME Robotics`."""

    @property
    def copyright(self) -> str | None: ...
    @property
    def license(self) -> str | None: ...


def unchecked(owned: Owned) -> str | None:
    """Why ament_copyright cannot check the files; None where it can."""
    if owned.copyright is None:
        return "no copyright is known: `copyright` in rebsync.toml has ament_copyright run"
    if owned.license not in LICENSES:
        return "ament_copyright knows no header of the licence that package.xml has"
    return None


def headed(files: Mapping[str, str], owned: Owned) -> dict[str, str]:
    """The files of a package, each source with a header where a copyright is known."""
    lines = _lines(owned)
    if not lines:
        return dict(files)
    return {path: _headed(path, text, lines) for path, text in files.items()}


def _lines(owned: Owned) -> list[str]:
    if owned.copyright is None:
        return []
    said = COPYRIGHT.match(owned.copyright)
    assert said is not None
    line = f"Copyright {owned.copyright}"
    if owned.license not in LICENSES:
        return [line, "", "The licence is in package.xml."]
    return fill(f"headers/{owned.license}.j2", line=line, holder=said["holder"]).splitlines()


def _headed(path: str, text: str, lines: list[str]) -> str:
    """A file with the header, which stands behind the line that says what runs it."""
    if path.endswith(".launch"):
        # Two hyphens cannot stand in a comment of XML.
        inner = "".join(f"  {line}".rstrip() + "\n" for line in lines).replace("--", "-&#45;")
        return f"<!--\n{inner}-->\n{text}"
    first = text[: text.index("\n") + 1] if text.startswith("#!") else ""
    token = "#" if first else next((t for e, t in _COMMENTS.items() if path.endswith(e)), None)
    if token is None:
        return text
    header = "".join(f"{token} {line}".rstrip() + "\n" for line in lines)
    return f"{first}{header}\n{text.removeprefix(first)}"
