"""Names in the ROS 1 graph: joined with namespaces, tidied, resolved as a node resolves them.

A namespace here is absolute and ends with a slash. What is made from something open is open.
"""

from __future__ import annotations

import re

from rebsync.reverse.unknowns import Open, Text

_LEGAL = re.compile(r"[~/A-Za-z][\w/]*\Z", re.ASCII)


def is_legal(name: str) -> bool:
    """Whether ROS takes this as a name; the empty name stands for the namespace."""
    return not name or (_LEGAL.match(name) is not None and "//" not in name)


def join(namespace: Text, name: Text) -> Text:
    """The name within a namespace; a name with `/` or `~` in front stays what it is."""
    if isinstance(name, Open) or (name and name[0] in "/~"):
        return name
    if isinstance(namespace, Open) or not namespace:
        return namespace or name
    return namespace + name if namespace.endswith("/") else f"{namespace}/{name}"


def canonical(name: str) -> str:
    """The name without doubled slashes and without one at its end."""
    if not name or name == "/":
        return name
    parts = "/".join(part for part in name.split("/") if part)
    return f"/{parts}" if name.startswith("/") else parts


def as_namespace(name: Text) -> Text:
    """The name as a namespace: absolute, with a slash at its end."""
    if isinstance(name, Open):
        return name
    if name.startswith("~"):
        return Open("roslaunch takes no private name as a namespace")
    return re.sub("//+", "/", f"/{name}/")


def resolve(name: str, namespace: Text, node: Text) -> Text:
    """The absolute name that a node means, before remapping; `~` stands for the node itself."""
    private = name.startswith("~")
    if private:
        namespace = as_namespace(join(namespace, node))
    inner = name[1:] if private else name
    if inner.startswith("/") and not private:
        return canonical(inner)
    joined = namespace if isinstance(namespace, Open) else namespace + inner
    return joined if isinstance(joined, Open) else canonical(joined)
