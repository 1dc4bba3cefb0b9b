"""What `.rebsync/` in a package records: where it came from, and what was generated then."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync import __version__
from rebsync.diagnostics import RebsyncError
from rebsync.files import RECORDS, read_source

if TYPE_CHECKING:
    from rebsync.config import Config

FOLDER = RECORDS
MANIFEST = f"{FOLDER}/manifest.json"
BASE_MODEL = f"{FOLDER}/base.rebeca"
BASE = f"{FOLDER}/base/"
ACCEPTED = f"{FOLDER}/accepted.toml"
FORMAT = 1


def made_from(folder: Path) -> str | None:
    """The name of the model that a package was made from; None where nothing tells."""
    try:
        record = json.loads(read_source(f"{folder}/{MANIFEST}").text)
        return str(record["model"]["name"])
    except (RebsyncError, ValueError, KeyError, TypeError, RecursionError):
        return None


def recorded_files(folder: Path) -> dict[str, list[str]]:
    """The generated files of a package, each with the elements that it marks; none if damaged."""
    try:
        record = json.loads(read_source(f"{folder}/{MANIFEST}").text)
        return {name: [*record["elements"].get(name, ())] for name in record["files"]}
    except (RebsyncError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def _options(config: Config) -> dict[str, object]:
    """The settings as they are recorded; an option that is off is as if there were none."""
    from rebsync.config import APART

    told = asdict(config).items()
    return {key: value for key, value in told if value is not False and key not in APART}


def with_manifest(
    files: Mapping[str, str], model_name: str, model_text: str, config: Config, path: str = ""
) -> dict[str, str]:
    """The files of a package together with its `.rebsync/`: manifest, base model, base texts.

    `path` leads from the package's folder to the model, empty where it lies beside that folder.
    """
    from rebsync.roundtrip.package.markers import digest, elements
    from rebsync.roundtrip.package.shared_runtime import shared_runtime

    recorded = {**files, **shared_runtime(config)}
    model = {"name": model_name, "digest": digest(model_text)}
    record = {
        "format": FORMAT,
        "rebsync": __version__,
        "model": {**model, "path": path} if path else model,
        "target": config.target,
        "options": _options(config),
        "files": {path: digest(text) for path, text in sorted(recorded.items())},
        "elements": {
            path: {e.name: e.digest for e in found}
            for path, text in sorted(files.items())
            if (found := list(elements(text)))
        },
    }
    return {
        **files,
        MANIFEST: json.dumps(record, indent=2, ensure_ascii=False) + "\n",
        BASE_MODEL: model_text,
        **{BASE + path: text for path, text in recorded.items()},
    }
