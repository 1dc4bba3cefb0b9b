"""Amounts of memory and time as options take them: `500M`, `90s`."""

from __future__ import annotations

import re

import click

_MOST = 2**63 - 1  # bytes
_BYTES = {"": 1, "K": 2**10, "M": 2**20, "G": 2**30, "T": 2**40}
_SECONDS = {"": 1.0, "ms": 0.001, "s": 1.0, "m": 60.0, "h": 3600.0}


def amount(_: click.Context, __: click.Parameter, given: str | None) -> int | None:
    """A number of bytes, with K, M, G or T for powers of 1024."""
    if given is None:
        return None
    match = re.fullmatch(r"(\d+(?:\.\d+)?)\s*([KMGT]?)(?:i?B)?", given.strip(), re.IGNORECASE)
    if match is None or float(match[1]) == 0:
        raise click.BadParameter(f'"{given}" is not a size such as 500M or 2G')
    return int(min(float(match[1]) * _BYTES[match[2].upper()], _MOST))


def duration(_: click.Context, __: click.Parameter, given: str | None) -> float | None:
    """A number of seconds, with ms, s, m or h as units."""
    if given is None:
        return None
    match = re.fullmatch(r"(\d+(?:\.\d+)?)\s*(ms|s|m|h)?", given.strip())
    if match is None or float(match[1]) == 0:
        raise click.BadParameter(f'"{given}" is not a time such as 90s or 5m')
    return float(match[1]) * _SECONDS[match[2] or ""]
