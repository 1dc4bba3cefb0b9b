"""Laws of merging, on drawn models and drawn changes of both sides."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.cli import main
from rebsync.diagnostics import RebsyncError
from rebsync.printing import print_model
from rebsync.roundtrip.diff import equivalence as rewritten
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.models import Favour, MergedModel, merged_model
from rebsync.roundtrip.package.models import parsed
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.laws import generated
from tests.roundtrip.differences.mutations import DIFFERENT
from tests.strategies import models

FEW = settings(max_examples=settings().max_examples // 5)  # each is read several times


def given_of(text: str) -> SourcedModel:
    source = Source("drawn.rebeca", text)
    return SourcedModel(parsed(source), source)


def _merged(
    base: SourcedModel, today: SourcedModel, code: SourcedModel, favour: Favour
) -> MergedModel:
    """The merge of all that is written, whether or not it is proved to do the same."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rewritten, "_proved_elements", lambda *_: frozenset())
        return merged_model(base, today, code, favour)


def printed(model: m.Model) -> SourcedModel:
    """A model as if it stood in a file, with a remark on each line."""
    lines = print_model(model).split("\n")
    return given_of("\n".join(f"{line}  // {i}" if line else line for i, line in enumerate(lines)))


@st.composite
def changed(draw: st.DrawFn, sides: int) -> tuple[m.Model, list[m.Model]]:
    """A model, and as many changes of it as there are sides."""
    model = draw(models())
    news = [draw(st.sampled_from(DIFFERENT))(draw, model).model for _ in range(sides)]
    assume(not any(analyse(new).errors for new in news))
    return model, news


@FEW
@given(drawn=changed(1))
def test_a_change_of_the_code_comes_into_the_text(drawn: tuple[m.Model, list[m.Model]]) -> None:
    model, (new,) = drawn
    base, code = printed(model), given_of(print_model(new))
    merged = _merged(base, base, code, Favour.MARKERS)
    assert not merged.conflicts
    assert compare(given_of(merged.text), code).is_empty


@FEW
@given(drawn=changed(1))
def test_a_change_of_the_model_stays(drawn: tuple[m.Model, list[m.Model]]) -> None:
    model, (new,) = drawn
    base, today = given_of(print_model(model)), printed(new)
    assert _merged(base, today, base, Favour.MARKERS).text == today.source.text


@FEW
@given(drawn=changed(1))
def test_the_same_change_of_both_is_no_conflict(drawn: tuple[m.Model, list[m.Model]]) -> None:
    model, (new,) = drawn
    base, today, code = given_of(print_model(model)), printed(new), given_of(print_model(new))
    merged = _merged(base, today, code, Favour.MARKERS)
    assert not merged.conflicts
    assert merged.text == today.source.text


@FEW
@given(drawn=changed(2))
def test_it_does_not_matter_who_has_changed_what(drawn: tuple[m.Model, list[m.Model]]) -> None:
    model, news = drawn
    base = given_of(print_model(model))
    one, other = (given_of(print_model(new)) for new in news)
    first = _merged(base, one, other, Favour.MARKERS)
    second = _merged(base, other, one, Favour.MARKERS)
    assert bool(first.conflicts) == bool(second.conflicts)
    if not first.conflicts:
        assert compare(given_of(first.text), given_of(second.text)).is_empty


@pytest.mark.parametrize("favour", [Favour.MODEL, Favour.CODE])
@FEW
@given(drawn=changed(2))
def test_with_one_side_in_favour_all_is_decided(
    favour: Favour, drawn: tuple[m.Model, list[m.Model]]
) -> None:
    model, news = drawn
    base = given_of(print_model(model))
    one, other = (given_of(print_model(new)) for new in news)
    merged = _merged(base, one, other, favour)
    assert not merged.conflicts
    try:
        result = given_of(merged.text)
    except RebsyncError:
        assert _merged(base, one, other, Favour.MARKERS).conflicts
        return
    assert not analyse(result.model).errors


@settings(max_examples=settings().max_examples // 10)
@given(drawn=changed(2))
def test_packages_of_drawn_models_come_in_step(drawn: tuple[m.Model, list[m.Model]]) -> None:
    model, (mine, theirs) = drawn
    with TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setenv("REBSYNC_CACHE", f"{folder}/.cache")
        patch.chdir(folder)
        text = Path("drawn.rebeca")
        text.write_text(print_model(model))
        assume(main(["generate", "drawn.rebeca"]) == 0)
        for path, content in generated(theirs).items():
            Path("drawn", path).parent.mkdir(parents=True, exist_ok=True)
            Path("drawn", path).write_text(content)
        text.write_text(print_model(mine))
        status = main(["sync"])
        if status == 1:
            assert "<<<<<<< " in text.read_text() + "".join(_code(Path("drawn")))
            assert main(["sync"]) == 2
            return
        assert status == 0
        assert main(["check"]) == 0
        before = [text.read_text(), *_code(Path("drawn"))]
        assert main(["sync"]) == 0
        assert [text.read_text(), *_code(Path("drawn"))] == before


def _code(root: Path) -> list[str]:
    return [p.read_text() for p in sorted(root.rglob("*")) if p.is_file()]
