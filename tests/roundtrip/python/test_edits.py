"""What somebody edits by hand in Python is told where it matters, and only there (edits.toml)."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rebsync.roundtrip.verdict.drift import Verdict
from tests.roundtrip.python.packages import checked, made, told

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_TARGETS = ("ros1-py", "ros2-py")
_EDITS: dict[str, dict[str, Any]] = tomllib.loads(
    Path(__file__).with_name("edits.toml").read_text(encoding="utf-8")
)


def cases(kind: str) -> list[tuple[str, str]]:
    """The edits of a kind, in one dialect after the other."""
    found = []
    for number, (name, edit) in enumerate(_EDITS[kind].items()):
        possible = [t for t in _TARGETS if "old" in edit or t[:4] in edit]
        found.append((name, possible[number % len(possible)]))
    return found


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Path]]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("REBSYNC_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield {t: made("running_example", t, tmp_path_factory.mktemp(t)) for t in _TARGETS}


@pytest.fixture
def edit(
    request: pytest.FixtureRequest, packages: dict[str, Path]
) -> Iterator[tuple[Path, Path, dict[str, Any]]]:
    """A package with an edit, the file that was edited, and the case; taken back afterwards."""
    kind, name, target = request.param
    case = {**_EDITS[kind][name], **_EDITS[kind][name].get(target[:4], {})}
    root = packages[target]
    path = min(p for p in _files(root) if p.as_posix().endswith(case["file"]))
    text = path.read_text(encoding="utf-8")
    assert case["old"] in text
    times = case.get("times", 1)
    path.write_text(text.replace(case["old"], case["new"], times), encoding="utf-8")
    yield root, path, case
    path.write_text(text, encoding="utf-8")


def _files(root: Path) -> Iterator[Path]:
    yield from (p for p in root.rglob("*") if p.is_file() and ".rebsync" not in p.parts)


def _named(kind: str) -> pytest.MarkDecorator:
    found = cases(kind)
    return pytest.mark.parametrize(
        "edit", [(kind, *c) for c in found], indirect=True, ids=[f"{n}-{t}" for n, t in found]
    )


@_named("semantics")
def test_what_a_model_shows_is_the_code_ahead(edit: tuple[Path, Path, dict[str, Any]]) -> None:
    root, path, case = edit
    drift = checked(root).drift
    assert drift is not None
    assert drift.verdict is Verdict.CODE_AHEAD
    of_element = [d for d, _ in drift.differences if str(d.element) == case["told"]]
    assert of_element, drift.differences
    places = [d.right.source.path for d in of_element if d.right is not None]
    assert any(Path(p).samefile(path) or path.suffix == ".yaml" for p in places)


@_named("unseen")
def test_what_no_model_shows_is_undetermined(edit: tuple[Path, Path, dict[str, Any]]) -> None:
    root, path, case = edit
    found = checked(root)
    assert found.drift is not None
    is_known = case.get("gets_elsewhere", False)
    assert found.drift.verdict is (Verdict.CODE_AHEAD if is_known else Verdict.UNDETERMINED)
    assert any(case["told"] in message for message in told(found)), told(found)
    assert any(path.name in f.source.path for f in found.findings)


@_named("neutral")
def test_what_means_the_same_is_in_step(edit: tuple[Path, Path, dict[str, Any]]) -> None:
    found = checked(edit[0])
    assert told(found) == []
    assert found.drift is None or found.drift.verdict is Verdict.IN_STEP, found.drift
