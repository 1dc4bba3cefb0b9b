"""The user's cache: where what is costly to make is kept between runs."""

from __future__ import annotations

import os
import stat
from pathlib import Path


def cache_directory() -> Path | None:
    """Where things are kept: `$REBSYNC_CACHE`, else the user's cache; None if not writable."""
    try:
        folder = _chosen_directory()
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    except (OSError, RuntimeError, ValueError):  # RuntimeError: a user without a home
        return None
    return folder if os.access(folder, os.W_OK) else None


def _chosen_directory() -> Path:
    if chosen := os.environ.get("REBSYNC_CACHE"):
        return Path(chosen)
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (base if base.is_absolute() else Path.home() / ".cache") / "rebsync"


def is_ours(found: os.stat_result) -> bool:
    """Whether a file or folder is this user's, and nobody else can write to it."""
    ours = not hasattr(os, "geteuid") or found.st_uid == os.geteuid()
    return ours and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
