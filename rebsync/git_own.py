"""Whether a repository is that of the files that lie in it, and not another one of the user."""

from __future__ import annotations

import re
from pathlib import Path

from rebsync.git_files import named_in
from rebsync.trees import GIT

_WORK_TREE = re.compile(r"^\s*worktree\s*=\s*(\S.*?)\s*$", re.MULTILINE)


def is_own_repository(folder: Path) -> bool:
    """Whether the repository that a directory belongs to keeps what it has in its own directory.

    A `.git` that somebody brings can name another repository, where nothing must change: that one
    does not name it in turn, as the repository of a work tree or of a submodule does.
    """
    real = folder.resolve()
    for above in (real, *real.parents):
        git = above / GIT
        if git.is_symlink():
            return False
        if git.is_dir():
            return not any(_leads_elsewhere(git, n) for n in ("commondir", "index", "objects"))
        if git.exists():
            named = named_in(str(git), b"gitdir:")
            return named is not None and _names_in_turn(Path(named), git)
    return False


def _leads_elsewhere(git: Path, name: str) -> bool:
    path = git / name
    return path.is_symlink() or (name == "commondir" and path.exists())


def _names_in_turn(named: Path, git: Path) -> bool:
    """Whether a directory of git is that of the work tree or submodule with this `.git`."""
    if (tree := named_in(str(named / "gitdir"))) is not None:
        return Path(tree).resolve() == git.resolve()
    try:
        text = (named / "config").read_text(encoding="utf-8", errors="surrogateescape")
    except OSError:
        return False
    trees = [(named / tree).resolve() for tree in _WORK_TREE.findall(text)]
    return trees == [git.parent.resolve()]
