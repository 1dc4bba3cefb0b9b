"""Which classes of a package inherit from which."""

from __future__ import annotations

from collections import Counter

from rebsync.package import NodeClass, Package


def base_of(package: Package, node: NodeClass) -> NodeClass | None:
    """The reactive class that this one extends."""
    bases = map(package.node_class, node.bases)
    return next((b for b in bases if not b.interface), None)


def ancestors(package: Package, node: NodeClass) -> list[NodeClass]:
    """The reactive classes that this one descends from, nearest first."""
    found, base = [], base_of(package, node)
    while base is not None:
        found.append(base)
        base = base_of(package, base)
    return found


def descendants(package: Package, node: NodeClass) -> list[NodeClass]:
    """The reactive classes that descend from this one."""
    return [c for c in package.classes if node in ancestors(package, c)]


def interfaces(package: Package, node: NodeClass) -> list[NodeClass]:
    """The interfaces that a class or interface has, once for each way that leads to them."""
    found = []
    for base in map(package.node_class, node.bases):
        found += [base] if base.interface else []
        found += interfaces(package, base)
    return found


def shared_interfaces(package: Package) -> set[str]:
    """The interfaces that some class has in more than one way."""
    return {
        name
        for node in package.classes
        for name, count in Counter(i.name for i in interfaces(package, node)).items()
        if count > 1
    }
