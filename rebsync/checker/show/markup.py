"""Elements of SVG and HTML as text in which everything is escaped."""

from __future__ import annotations

import base64
import hashlib

from rebsync.terminal import printable

_VOID = frozenset({"br", "input", "meta"})
_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;"})


class Markup(str):
    """Text that is escaped already."""

    __slots__ = ()


def escaped(text: str) -> Markup:
    """A text as it stands in an element or attribute; what XML cannot hold is replaced."""
    return text if isinstance(text, Markup) else Markup(printable(text).translate(_ESCAPES))


def element(name: str, /, *children: str | None, **attributes: str | float | bool | None) -> Markup:
    """An element. `class_` stands for `class`, `data_step` for `data-step`.

    An attribute that is None or False is left out, True stands for itself; None is no child.
    """
    head = name + "".join(_attribute(key, value) for key, value in attributes.items())
    if name in _VOID:
        return Markup(f"<{head}>")
    inner = "".join(escaped(child) for child in children if child is not None)
    return Markup(f"<{head}>{inner}</{name}>")


def joined(*parts: str, between: str = "\n") -> Markup:
    """Elements one after the other."""
    return Markup(between.join(escaped(part) for part in parts))


def number(value: float) -> str:
    """A coordinate: one digit behind the point, if it tells anything."""
    text = f"{value:.1f}"
    return text.removesuffix(".0")


def _attribute(key: str, value: str | float | bool | None) -> str:
    name = key.rstrip("_").replace("_", "-")
    match value:
        case None | False:
            return ""
        case True:
            return f' {name}="{name}"'
        case str():
            return f' {name}="{escaped(value)}"'
        case _:
            return f' {name}="{number(value)}"'


def metadata(script: str, *, is_live: bool = False) -> list[Markup]:
    """What stands in the head of a page that may load nothing and run nothing but its script.

    A live page may ask the program that serves it.
    """
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = f"default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    if is_live:
        policy += "; connect-src 'self'"
    return [
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content=policy),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
    ]
