"""Packages of drawn models with classes in two languages."""

from __future__ import annotations

from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rebsync import model as m
from rebsync.config import ClassTarget
from rebsync.static import analyse
from tests.strategies import models

LANGUAGES = ("ros1-cpp", "ros1-py")


def families(model: m.Model) -> list[list[str]]:
    """The classes of a model that must be in one language: those above and below each other."""
    found: dict[str, set[str]] = {}
    for name, info in analyse(model).classes.items():
        whole = {name}.union(*(found.get(n, {n}) for n in info.ancestors))
        whole = whole.union(*(known for known in found.values() if known & whole))
        found |= dict.fromkeys(whole, whole)
    return [list(each) for each in sorted({tuple(sorted(each)) for each in found.values()})]


@st.composite
def mixed(draw: DrawFn) -> tuple[m.Model, tuple[ClassTarget, ...]]:
    """A model with many overloads, and the language of each class: both occur."""
    model = draw(models(least=2, overloads=2))
    apart = families(model)
    nodes = {c.name for c in model.classes if isinstance(c, m.ReactiveClass)}
    of_nodes = [n for n, each in enumerate(apart) if nodes & set(each)]
    assume(len(of_nodes) > 1)
    chosen = [draw(st.sampled_from(LANGUAGES)) for _ in apart]
    if len({chosen[n] for n in of_nodes}) == 1:
        last = of_nodes[-1]
        chosen[last] = LANGUAGES[1 - LANGUAGES.index(chosen[last])]
    targets = [ClassTarget(n, t) for each, t in zip(apart, chosen, strict=True) for n in each]
    return model, tuple(targets)
