"""The law of extraction: what a package says is the model that it was generated from."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from rebsync import model as m
from rebsync.config import Config
from rebsync.forward.generate import generate
from rebsync.printing import print_model
from rebsync.reverse.recovery import Extracted, extract
from rebsync.roundtrip.diff.normal_form import normal, rewrite
from rebsync.source import Source
from rebsync.static import analyse

_MARKER = re.compile(r"[ \t]*(?://|#|<!--)\s*rebsync:[^\n]*")
_WIDE = {"byte": "int", "short": "int", "float": "double"}


def generated(model: m.Model) -> dict[str, str]:
    """The package of a model that has no errors."""
    return generate(model, (), analyse(model), Config(), "drawn")


def extracted(files: Mapping[str, str]) -> Extracted:
    """What the texts of a package say, the order of classes apart, which they do not tell."""
    found = extract({path: Source(path, text) for path, text in files.items()})
    classes = tuple(sorted(found.model.classes, key=lambda c: c.name))
    return replace(found, model=replace(found.model, classes=classes))


def assert_says(files: Mapping[str, str], model: m.Model) -> None:
    """The law."""
    found = extracted(files)
    assert [(f.text, f.why) for f in found.findings] == []
    assert_same(found.model, normal(model))


def assert_same(found: m.Model, wanted: m.Model) -> None:
    """Compares as text first, which is easier to read where it fails."""
    assert print_model(found) == print_model(wanted)
    assert found == wanted


def without_markers(files: Mapping[str, str]) -> dict[str, str]:
    """A package whose markers somebody has deleted."""
    return {path: _MARKER.sub("", text) for path, text in files.items()}


def told_without_markers(model: m.Model) -> m.Model:
    """A model without what needs a marker (docs/mapping.md, "What needs a marker")."""
    return m.Model(
        tuple(_wide(h) for h in model.heads),
        tuple(_unmarked(c) for c in rewrite(model, _noted).classes),
        m.Main(tuple(replace(r, annotations=()) for r in model.main.rebecs))
        if model.main is not None
        else None,
    )


def _wide(head: m.Head) -> m.Head:
    """The type of an `env` that no class reads is that of its value."""
    if not isinstance(head, m.Env):
        return head
    type_ = head.declaration.type
    wide = m.Type(_WIDE.get(type_.name, type_.name), type_.dimensions)
    return m.Env(replace(head.declaration, type=wide))


def _noted(node: object) -> object:
    """Annotations without a meaning, which `models()` puts on empty statements."""
    if isinstance(node, m.Empty):
        return replace(node, annotations=tuple(a for a in node.annotations if a.name == "Move"))
    return node


def _unmarked(
    declaration: m.ReactiveClass | m.Interface,
) -> m.ReactiveClass | m.Interface:
    """Whether a class is a robot or a controller, which shows only in some classes."""
    if isinstance(declaration, m.Interface):
        return declaration
    kept = tuple(a for a in declaration.annotations if a.name not in ("Robot", "Controller"))
    return replace(declaration, annotations=kept)
