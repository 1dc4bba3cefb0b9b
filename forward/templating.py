"""The one jinja environment of the renderers."""

from __future__ import annotations

from contextlib import suppress
from functools import cache

from jinja2 import Environment, FileSystemBytecodeCache, PackageLoader, StrictUndefined
from jinja2.bccache import Bucket

from rebsync.cache import cache_directory, is_ours


class _Compiled(FileSystemBytecodeCache):
    """Compiled templates in the user's cache; that it cannot be written does not matter."""

    def dump_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            super().dump_bytecode(bucket)


def _compiled() -> _Compiled | None:
    """Compiled templates are code: they are kept only where nobody else can write."""
    folder = cache_directory()
    if folder is None or not is_ours(folder.stat()):
        return None
    return _Compiled(str(folder), "%s.template")


@cache
def environment() -> Environment:
    """Templates of `forward/templates`; an unknown name in one is an error of ours."""
    return Environment(
        loader=PackageLoader("rebsync.forward"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        bytecode_cache=_compiled(),
    )


def fill(template: str, **context: object) -> str:
    """A template with its blanks filled; exactly one line end closes the text."""
    return environment().get_template(template).render(**context).rstrip("\n") + "\n"
