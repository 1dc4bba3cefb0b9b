"""The one jinja environment of the renderers."""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined


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
    )


def fill(template: str, **context: object) -> str:
    """A template with its blanks filled; exactly one line end closes the text."""
    return environment().get_template(template).render(**context).rstrip("\n") + "\n"
