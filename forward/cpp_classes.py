"""The classes of a package with all that their C++ needs to know."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.forward.cpp_class import CppClass
from rebsync.forward.cpp_expressions import CppExpressions
from rebsync.forward.cpp_names import class_names
from rebsync.forward.cpp_statements import CppStatements
from rebsync.forward.cpp_words import CppWords
from rebsync.forward.hoisting import hoisted, read_declarations
from rebsync.forward.remarks import Remarks
from rebsync.forward.sends import bodies
from rebsync.forward.sensors import samplers
from rebsync.forward.topics import Topics
from rebsync.model import ReactiveClass
from rebsync.package import Package
from rebsync.static import Analysis


def classes(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, words: CppWords
) -> Mapping[str, CppClass]:
    """Every class by its name in the model, in the words of one generation of ROS."""
    names = class_names(package, topics.class_types)
    found: dict[str, CppClass] = {}
    for node in package.classes:
        declaration = analysis.classes[node.name].declaration
        reactive = declaration if isinstance(declaration, ReactiveClass) else None
        expressions = CppExpressions(
            analysis,
            topics,
            names[node.name],
            topics.class_types,
            samplers(node, reactive, names[node.name], "{}.seen(&{})".format),
        )
        own = list(bodies(reactive)) if reactive else []
        found[node.name] = CppClass(
            package,
            node,
            topics.class_types[node.name],
            tuple(topics.class_types[b] for b in node.bases),
            names[node.name],
            CppStatements(
                expressions, remarks, read_declarations(own, analysis), hoisted(own, analysis)
            ),
            remarks.above(reactive),
            words,
        )
    return found
