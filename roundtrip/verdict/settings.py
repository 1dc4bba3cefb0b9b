"""Whether the settings are those with which the code of a package was generated."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import asdict, fields, replace
from pathlib import Path

from rebsync.config import APART, Config, config_of_record, settings_beside
from rebsync.diagnostics import Diagnostic, Findings
from rebsync.roundtrip.package.record import Record
from rebsync.source import NOWHERE, Source, Span

_HINT = "`rebsync sync` takes the setting into the code"
_NAME_HINT = "`rebsync generate` writes the new package beside the old one"
_OFF = {
    "lifecycle": False,
    "monitor": False,
    "copyright": None,
}  # what is recorded only where it is on
_APART = APART | {"monitor", "shared_runtime", "target"}  # what the command line may say otherwise


def changed_settings(model: str, record: Record) -> tuple[Findings, ...]:
    """The settings beside a model that are not as recorded. RebsyncError: they are wrong."""
    source, config = settings_beside(model)
    options = {**_OFF, **record.options}
    now = dict(_recorded(config))
    last = options.get("package", config.package)
    if last != config.package and _name(record, last) == _name(record, config.package):
        now["package"] = last  # said, or after the model: it is the same
    found = tuple(
        Diagnostic(
            "RS955",
            _place(source, key),
            _message(key, options[key], value),
            _NAME_HINT if key == "package" else _HINT,
        )
        for key, value in now.items()
        if key in options and options[key] != value
    )
    return (Findings(source, found),) if found else ()


def _name(record: Record, package: str | None) -> str:
    """The name that a package has by a setting."""
    from rebsync.forward.generate import package_name

    config = config_of_record(record.options) or Config()
    return package_name(Path(record.model).stem, replace(config, package=package))


def _recorded(config: Config) -> Iterator[tuple[str, object]]:
    """The settings as a manifest has them."""
    for each in fields(config):
        if each.name in _APART:
            continue
        value: object = getattr(config, each.name)
        yield each.name, [asdict(x) for x in value] if isinstance(value, tuple) else value


def _message(key: str, old: object, new: object) -> str:
    if isinstance(new, list):
        return f"`{key}` is not as it was when the code was generated"
    before, now = ("not set" if v is None else json.dumps(v) for v in (old, new))
    return f"`{key}` was {before} when the code was generated, and is {now} now"


def _place(source: Source, key: str) -> Span:
    found = re.search(rf"^\s*\[*\s*({key})\b", source.text, re.MULTILINE)
    return Span(found.start(1), found.end(1)) if found is not None else NOWHERE
