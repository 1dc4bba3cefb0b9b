#!/usr/bin/env python3
"""Stands for a node: writes down what the launch file tells it, and ends."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

import yaml


def flat(table: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, object]]:
    """Parameters by their full names."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


def main() -> None:
    """The arguments are pairs of an option and its value, behind --ros-args."""
    words = [word for word in sys.argv[1:] if word != "--ros-args"]
    options = list(zip(words[::2], words[1::2], strict=True))
    parameters: dict[str, object] = {}
    for option, file in options:
        if option == "--params-file":
            for table in yaml.full_load(Path(file).read_text()).values():
                parameters |= flat(table["ros__parameters"])
    remaps = [value.split(":=") for option, value in options if option == "-r"]
    own = {before: after for before, after in remaps if before in ("__node", "__ns")}
    name = own["__node"]
    facts = {
        "executable": Path(sys.argv[0]).name,
        "namespace": own.get("__ns", "/").strip("/"),
        "parameters": parameters,
        "remaps": [pair for pair in remaps if pair[0] not in own],
        "log_level": dict(options).get("--log-level"),
    }
    Path(os.environ["REBSYNC_TOLD"], f"{name}.json").write_text(json.dumps(facts))


if __name__ == "__main__":
    main()
