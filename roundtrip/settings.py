"""Whether the settings are those with which the code of a package was generated."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import asdict, fields

from rebsync.config import Config, settings_beside
from rebsync.diagnostics import Diagnostic, Findings
from rebsync.roundtrip.recorded import Record
from rebsync.source import NOWHERE, Source, Span

_HINT = "`rebsync generate` takes the setting into the code"
_OFF = {"lifecycle": False, "copyright": None}  # what is recorded only where it is on
_APART = frozenset({"target"})  # what the command line may say otherwise


def changed_settings(model: str, record: Record) -> tuple[Findings, ...]:
    """The settings beside a model that are not as recorded. RebsyncError: they are wrong."""
    source, config = settings_beside(model)
    options = {**_OFF, **record.options}
    found = tuple(
        Diagnostic("RS955", _place(source, key), _message(key, options[key], value), _HINT)
        for key, value in _recorded(config)
        if key not in _APART and key in options and options[key] != value
    )
    return (Findings(source, found),) if found else ()


def _recorded(config: Config) -> Iterator[tuple[str, object]]:
    """The settings as a manifest has them."""
    for each in fields(config):
        value: object = getattr(config, each.name)
        yield each.name, [asdict(x) for x in value] if isinstance(value, tuple) else value


def _message(key: str, old: object, new: object) -> str:
    if isinstance(new, list):
        return f"`{key}` is not as it was when the code was generated"
    return (
        f"`{key}` was {json.dumps(old)} when the code was generated, and is {json.dumps(new)} now"
    )


def _place(source: Source, key: str) -> Span:
    found = re.search(rf"^\s*\[*\s*({key})\b", source.text, re.MULTILINE)
    return Span(found.start(1), found.end(1)) if found is not None else NOWHERE
