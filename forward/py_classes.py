"""The classes of a package with all that their Python needs to know."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.forward.hoisting import hoisted
from rebsync.forward.py_class import PyClass
from rebsync.forward.py_expressions import PyExpressions
from rebsync.forward.py_names import class_names
from rebsync.forward.py_statements import PyStatements
from rebsync.forward.py_types import class_type
from rebsync.forward.remarks import Remarks
from rebsync.forward.sends import bodies
from rebsync.forward.sensors import samplers
from rebsync.forward.topics import Topics
from rebsync.model import ReactiveClass
from rebsync.package import NodeClass, Package
from rebsync.static import Analysis


def classes(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks
) -> Mapping[str, PyClass]:
    """Every class by its name in the model."""
    types = {name: class_type(name) for name in topics.class_types}
    names = class_names(package, types)
    found: dict[str, PyClass] = {}
    for node in package.classes:
        declaration = analysis.classes[node.name].declaration
        reactive = declaration if isinstance(declaration, ReactiveClass) else None
        own = names[node.name]
        seen = samplers(node, reactive, own, "self.{}.seen({})".format)
        expressions = PyExpressions(analysis, topics, own, types, seen)
        inside = list(bodies(reactive)) if reactive else []
        found[node.name] = PyClass(
            package,
            node,
            types[node.name],
            tuple(types[b] for b in _bases(package, node)),
            own,
            PyStatements(expressions, remarks, hoisted(inside, analysis)),
            remarks.above(reactive),
        )
    return found


def _bases(package: Package, node: NodeClass) -> tuple[str, ...]:
    """The bases, in an order in which no class stands before one that descends from it."""
    above = {b: _above(package, b) for b in node.bases}
    return tuple(sorted(node.bases, key=lambda b: sum(b in a for a in above.values())))


def _above(package: Package, name: str) -> set[str]:
    bases = package.node_class(name).bases
    return set(bases).union(*(_above(package, b) for b in bases))
