"""Features of product lines: `featurevar F;` and `@feature(!F)`, as the official compiler has them.

There every feature is true, and a part whose `@feature` is false is no part of the model. So it is
for who verifies; a model that code is made of has no features, as its parts all have a place there.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace

from rebsync.model import (
    Annotation,
    Binary,
    BoolLiteral,
    Declarator,
    Expression,
    Head,
    Model,
    Name,
    Parameter,
    Paren,
    Refused,
    Unary,
    walk,
)


def with_features(model: Model) -> Model:
    """The parts that the features leave; those that cannot be decided stay as they are."""
    features = {h.text.strip() for h in model.heads if isinstance(h, Refused) and _is_feature(h)}
    if any(isinstance(n, (Declarator, Parameter)) and n.name in features for n in walk(model)):
        return model
    heads = tuple(h for h in model.heads if not _is_feature(h))
    selected = _selected(replace(model, heads=heads), features)
    assert isinstance(selected, Model)
    return selected


def _is_feature(head: Head) -> bool:
    return isinstance(head, Refused) and head.keyword == "featurevar"


def _selected(node: object, features: set[str]) -> object:
    """A node without what is absent in it, and without the annotations that say so."""
    if isinstance(node, tuple):
        present = (each for each in node if not _is_absent(each, features))
        return tuple(_selected(n, features) for n in present if _value(n, features) is not True)
    if isinstance(node, Name) and node.name in features:
        return BoolLiteral(True, span=node.span)
    if not is_dataclass(node):
        return node
    parts = {f.name: getattr(node, f.name) for f in fields(node) if f.compare}
    changed = {name: _selected(part, features) for name, part in parts.items()}
    return replace(node, **changed) if changed != parts else node  # type: ignore[type-var]


def _is_absent(node: object, features: set[str]) -> bool:
    """Whether an annotation of a node says that it is no part of the model."""
    return any(_value(each, features) is False for each in getattr(node, "annotations", ()))


def _value(annotation: object, features: set[str]) -> bool | None:
    """What `@feature` says; None if that is not known, or it is something else."""
    match annotation:
        case Annotation("feature", (expression,)):
            return _truth(expression, features)
        case _:
            return None


def _truth(expression: Expression, features: set[str]) -> bool | None:
    match expression:
        case BoolLiteral(value):
            return value
        case Name(name) if name in features:
            return True
        case Paren(inner):
            return _truth(inner, features)
        case Unary("!", operand):
            known = _truth(operand, features)
            return None if known is None else not known
        case Binary("&&" | "||" as operator, left, right):
            sides = _truth(left, features), _truth(right, features)
            return None if None in sides else (all if operator == "&&" else any)(sides)
        case _:
            return None
