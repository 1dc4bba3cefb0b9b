"""Merges of edited code: cases, and laws on drawn edits of drawn files."""

from __future__ import annotations

import re
import sys
from collections import Counter
from itertools import permutations, product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.reverse.python.values.py_units import py_units
from rebsync.reverse.syntax.code_units import CodeUnit
from rebsync.reverse.syntax.cpp_units import cpp_units
from rebsync.roundtrip.merge.source import merged_source
from rebsync.roundtrip.merge.text import MergedText, agreed_lines, decided, merged_text

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

LABELS = ("as edited", "as generated now")
CASES = tomllib.loads(Path(__file__).with_name("code_merges.toml").read_text(encoding="utf-8"))
NAMED = [(language, name) for language, data in CASES.items() for name in data["cases"]]
UNITS = {"python": py_units, "cpp": cpp_units}


def changed(text: str, pairs: list[list[str]]) -> str:
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["unix", "dos"])
@pytest.mark.parametrize(("language", "name"), NAMED)
def test_merges(language: str, name: str, end: str) -> None:
    data = CASES[language]
    base, case = data["base"].lstrip("\n"), data["cases"][name]
    texts = [changed(base, case.get(side, [])) for side in ("ours", "theirs", "merged")]
    ours, theirs, wanted = (text.replace("\n", end) for text in texts)
    sides = (ours, base.replace("\n", end), theirs)
    merged = merged_source(data["path"], sides, LABELS)
    if "merged" in case:
        assert (merged.text, merged.conflicts) == (wanted, 0)
        return
    assert merged.conflicts
    for favour in ("ours", "theirs"):
        decision = merged_source(data["path"], sides, LABELS, favour)
        assert not decision.conflicts
        assert set(decision.text.split(end)) < set(merged.text.split(end))


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("a.py", "x = " + "a + " * 900 + "a\n"),
        ("a.py", "if a:\n    pass\n" + "elif b:\n    pass\n" * 1500),
        ("a.cpp", "namespace a {\n" * 2000 + "}\n" * 2000),
    ],
    ids=["sum", "elif", "namespaces"],
)
def test_what_nests_deep_is_merged_line_by_line(path: str, text: str) -> None:
    texts = (f"a = 1;\n{text}", f"\n{text}", f"a = 2;\n{text}")
    assert merged_source(path, texts, LABELS) == merged_text(*texts, LABELS)


_ORDERED = {
    "python": "class C:\n    def run(self) -> None:\n        {}()\n        {}()\n        {}()\n",
    "cpp": "void C::run() {{\n  {}();\n  {}();\n  {}();\n}}\n",
}


@pytest.mark.parametrize("language", _ORDERED)
def test_what_both_sides_have_moved_stands_once(language: str) -> None:
    """Of a statement that each side has moved elsewhere git makes two, without a conflict."""
    orders = [_ORDERED[language].format(*order) for order in permutations("xyz")]
    for ours, theirs in product(orders, repeat=2):
        found = merged(language, ours, orders[0], theirs)
        assert found.conflicts or all(found.text.count(f"{name}()") == 1 for name in "xyz")


# --- laws ---------------------------------------------------------------------------------------

NAMES = st.sampled_from([f"n{i}" for i in range(9)])
KINDS = {
    "python": {
        "import": "import {0}\n",
        "method": "    def {0}(self) -> None:\n        first({1})\n        same()\n\n",
        "member": "        self.{0} = {1}\n",
        "import from": "from far import {0}\n",
        "statement": "        {0}({1})\n",
    },
    "cpp": {
        "import": "#include <{0}>\n",
        "method": "void C::{0}() {{\n  first({1});\n  same();\n}}\n\n",
        "member": "  {0}_ = {1};\n",
        "declaration": "  int {0}_{{{1}}};  // {1}\n",
        "statement": "  {0}({1});\n",
    },
}
PARTS = {
    "python": "{import}{import from}\n\nclass C:\n    def __init__(self) -> None:\n{member}"
    "        start()\n\n    def run(self) -> None:\n        pass\n{statement}\n"
    "{method}    # the end\n",
    "cpp": "{import}\nclass C {{\n public:\n{declaration}}};\n\n"
    "C::C() {{\n{member}  start();\n}}\n\nvoid C::run() {{\n{statement}}}\n\n{method}// the end\n",
}
File = dict[str, list[tuple[str, int]]]


def text_of(language: str, file: File) -> str:
    kinds = KINDS[language]
    parts = {k: "".join(kinds[k].format(*each) for each in file[k]) for k in kinds}
    if language == "python" and file["import from"]:
        names = ", ".join(name for name, _ in file["import from"])
        parts["import from"] = kinds["import from"].format(names)
    return PARTS[language].format(**parts)


@st.composite
def edited(draw: st.DrawFn, file: File) -> File:
    """The same after some units were added, removed, moved or changed."""
    found = {kind: list(units) for kind, units in file.items()}
    for _ in range(draw(st.integers(0, 4))):
        units = found[draw(st.sampled_from(sorted(found)))]
        place = draw(st.integers(0, len(units)))
        what = draw(st.sampled_from(["add", "add", "remove", "change", "move"]))
        name = draw(NAMES)
        if what == "add":
            if name not in {n for n, _ in units}:
                units.insert(place, (name, draw(st.integers(0, 3))))
        elif place < len(units):
            old = units.pop(place)
            if what == "change":
                units.insert(place, (old[0], draw(st.integers(0, 9))))
            elif what == "move":
                units.insert(draw(st.integers(0, len(units))), old)
    return found


@st.composite
def sides(draw: st.DrawFn) -> tuple[str, tuple[str, str, str]]:
    """A language, and a file of it as edited by one, as it was, and as edited by another."""
    language = draw(st.sampled_from(sorted(KINDS)))
    unit = st.tuples(NAMES, st.integers(0, 3))
    units = st.lists(unit, max_size=5, unique_by=lambda u: u[0])
    base = {kind: draw(units) for kind in KINDS[language]}
    files = draw(edited(base)), base, draw(edited(base))
    ours, old, theirs = (text_of(language, file) for file in files)
    return language, (ours, old, theirs)


def merged(language: str, ours: str, base: str, theirs: str) -> MergedText:
    return merged_source(CASES[language]["path"], (ours, base, theirs), LABELS)


def contents(language: str, text: str) -> Counter[str]:
    """All lines of a text, and all that it imports."""
    unit = UNITS[language](text)
    assert unit is not None

    def said(unit: CodeUnit) -> list[str]:
        if unit.inside:
            return [line for each in unit.inside for line in said(each)]
        return sorted(unit.names) or [line for line in unit.text.split("\n") if line.strip()]

    return Counter(said(unit))


@given(drawn=sides())
def test_what_one_side_has_changed_is_taken(drawn: tuple[str, tuple[str, str, str]]) -> None:
    language, (ours, base, theirs) = drawn
    assert merged(language, ours, base, base) == MergedText(ours)
    assert merged(language, base, base, theirs) == MergedText(theirs)
    assert merged(language, ours, base, ours) == MergedText(ours)


@settings(max_examples=settings().max_examples * 2)
@given(drawn=sides())
def test_nothing_is_lost_or_doubled(drawn: tuple[str, tuple[str, str, str]]) -> None:
    language, texts = drawn
    found = merged(language, *texts)
    if found.conflicts:
        said = set(found.text.split("\n"))
        for text in (texts[0], texts[2]):
            added = {*text.split("\n")} - {*texts[1].split("\n")}
            assert {line for line in added if " import " not in line} <= said
        return
    ours, base, theirs = (contents(language, text) for text in texts)
    have = contents(language, found.text)
    for line in {*ours, *base, *theirs, *have}:
        if ours[line] >= base[line] <= theirs[line]:
            assert have[line] >= max(ours[line], theirs[line])
        assert have[line] <= max(base[line], ours[line]) + max(0, theirs[line] - base[line])


@given(drawn=sides())
def test_sides_are_alike(drawn: tuple[str, tuple[str, str, str]]) -> None:
    language, (ours, base, theirs) = drawn
    one, other = merged(language, ours, base, theirs), merged(language, theirs, base, ours)
    assert bool(one.conflicts) == bool(other.conflicts)
    if not one.conflicts:
        assert contents(language, one.text) == contents(language, other.text)


@given(drawn=sides())
def test_lines_that_merge_stay_so(drawn: tuple[str, tuple[str, str, str]]) -> None:
    language, texts = drawn
    by_lines, found = merged_text(*texts, LABELS), merged(language, *texts)
    if by_lines.conflicts:
        agreed = [agreed_lines(each, LABELS) for each in (found, by_lines)]
        assert found.conflicts <= by_lines.conflicts or agreed[0] > agreed[1]
    elif not doubled(by_lines.text) - doubled(texts[0]) - doubled(texts[2]):
        assert found == by_lines or more_than_both_say(by_lines.text, texts)


def more_than_both_say(merged: str, texts: tuple[str, str, str]) -> set[str]:
    """The lines that stand more often in a merged text than both changes together make them."""
    ours, base, theirs = (Counter(text.split("\n")) for text in texts)
    return {
        line
        for line, number in Counter(merged.split("\n")).items()
        if number > max(0, ours[line] + theirs[line] - base[line])
    }


def doubled(text: str) -> set[str]:
    """The declarations, imports and assigned members that stand twice in a drawn file."""
    signs = ("import ", "include ", "def ", "void ", "int ", " = ")
    declared = (line for line in text.split("\n") if any(s in line for s in signs))
    found = Counter(re.split(r" = |_\{", line)[0] for line in declared)
    return {line for line, number in found.items() if number > 1}


@pytest.mark.parametrize("sign", ["\x0c", "\x0b", "\x85", "\u2028"])
def test_a_line_in_conflict_ends_where_the_language_ends_it(sign: str) -> None:
    ours = f"a\nx = 1  # of{sign}b\nc\n"
    merged = merged_text(ours, "a\nx = 1\nc\n", "a\nc\n", LABELS)
    assert merged.conflicts == 1
    assert decided(merged.text, LABELS, True) == ours
