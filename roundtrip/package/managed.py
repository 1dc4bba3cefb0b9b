"""A package that is kept in step with a model, and how far its paths may lead."""

from __future__ import annotations

import os

from rebsync.files import leading_out
from rebsync.records import dataclass
from rebsync.trees import is_within, leads_out, repository, repository_of_link, tree_of_code

SUFFIX = ".rebeca"
SKIPPED = frozenset({"node_modules", "__pycache__"})


@dataclass(frozen=True, slots=True)
class ManagedPackage:
    """A package with a model; `model` is its path where a user or settings say it.

    `tree` is the real directory that holds all that belongs together: a repository, or else what
    is around the package. `named` is the directory that a user named, or that of the file.
    """

    root: str
    tree: str
    model: str | None = None
    named: str | None = None

    def holds(self, real: str) -> bool:
        """Whether a real path is of what belongs together, so that the package may speak of it."""
        if is_within(real, self.tree):
            return True
        if repository(self.tree) is not None:
            return False
        # Without a repository the user says what belongs together: by name, or by going there.
        chosen = (self.named or os.curdir, os.curdir)
        return any(is_within(real, os.path.realpath(path)) for path in chosen)

    @property
    def tree_of_code(self) -> str:
        """The real directory in which its code may be behind links."""
        return tree_of_code(self.root, self.named or self.root)

    def to_write(self) -> str:
        """The real directory of the package, to write to.

        RebsyncError: it is a link, and leads out of where the user has said that packages are.
        """
        real = os.path.realpath(self.root)
        link = self.root.rstrip(os.sep)
        chosen = {self.named or os.curdir, os.curdir}
        is_out = os.path.islink(link) and all(  # noqa: PTH114
            leads_out(link, real, path) and not self._is_around(link, path) for path in chosen
        )
        if is_out:
            raise leading_out(link, f"`rebsync sync {real}` writes there")
        return real

    def _is_around(self, link: str, path: str) -> bool:
        """Whether a user has named what is in the package itself, where there is no repository."""
        is_free = repository_of_link(link) is None
        return is_free and is_within(os.path.realpath(path), os.path.realpath(link))
