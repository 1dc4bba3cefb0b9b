"""The one jinja environment of the renderers."""

from __future__ import annotations

import hashlib
import marshal
import re
import sys
from functools import cache
from types import CodeType

import jinja2
from jinja2 import BytecodeCache, Environment, PackageLoader, StrictUndefined
from jinja2.bccache import Bucket

from rebsync.cache import Cache, open_cache

_MOST = 500  # templates, of a few versions

_MARKUP = re.compile(r"[&<>\[\]\\]")
_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;"}


class _Compiled(BytecodeCache):
    """Compiled templates in the user's cache: code, which is run only under the user's seal."""

    def __init__(self, cache: Cache) -> None:
        self._cache = cache

    def load_bytecode(self, bucket: Bucket) -> None:
        content = self._cache.load(_name(bucket))
        if content is not None:
            bucket.code = _code(content)

    def dump_bytecode(self, bucket: Bucket) -> None:
        if bucket.code is not None:
            self._cache.store(_name(bucket), marshal.dumps(bucket.code))
            self._cache.tidy(_MOST)


def _name(bucket: Bucket) -> str:
    """What the code depends on: the template's text, and what compiles and runs it."""
    made_for = (bucket.key, bucket.checksum, jinja2.__version__, sys.version)
    return hashlib.sha256("\0".join(made_for).encode()).hexdigest()


def _code(content: bytes) -> CodeType:
    code = marshal.loads(content)
    assert isinstance(code, CodeType)
    return code


def _compiled() -> _Compiled | None:
    cache = open_cache("templates")
    return _Compiled(cache) if cache is not None else None


@cache
def environment() -> Environment:
    """Templates of `forward/templates`; an unknown name in one is an error of ours."""
    made = Environment(
        loader=PackageLoader("rebsync.forward"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        bytecode_cache=_compiled(),
    )
    made.filters["prose"] = _prose
    return made


def _prose(text: str) -> str:
    """A text that stands in Markdown as it is: no HTML, no links and no pictures come of it."""
    return _MARKUP.sub(lambda m: _ESCAPES.get(m[0], rf"\{m[0]}"), text)


def fill(template: str, **context: object) -> str:
    """A template with its blanks filled; exactly one line end closes the text."""
    return environment().get_template(template).render(**context).rstrip("\n") + "\n"
