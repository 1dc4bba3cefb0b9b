"""What a package says with some of its files changed, before any of them is written."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from rebsync.diagnostics import Findings
from rebsync.reverse.files.packages import Listing, is_read
from rebsync.roundtrip.diff.difference import Comparison, Element, explain, finding
from rebsync.roundtrip.merge.models import whole
from rebsync.roundtrip.package.models import CodeModel, code_model
from rebsync.roundtrip.package.units import as_one, folders_of, name_as_one
from rebsync.source import Source


def read_with(listing: Listing, texts: Mapping[str, str | None]) -> CodeModel:
    """What the code of a package says with other texts (None: without that file)."""
    from rebsync.reverse.files.reading import read
    from rebsync.reverse.recovery import extract
    from rebsync.roundtrip.package.cache.classes import ClassCache

    chosen, folders = read(as_one(listing)), folders_of(listing.files)
    files = dict(chosen.files)
    for whole_path, text in texts.items():
        path = name_as_one(whole_path, folders)
        if path is None:
            continue
        folder, _, name = path.rpartition("/")
        if text is None:
            files.pop(path, None)
        elif is_read(name, f"{folder}/" if folder else ""):
            files[path] = Source(f"{listing.root}/{whole_path}", text)
    extracted = extract(files, memory=ClassCache())
    return code_model(listing.root, extracted.model, (*chosen.findings, *extracted.findings))


def wrongly_merged(
    proof: Comparison, known: Collection[Element], way_out: str
) -> Iterator[Findings]:
    """The elements that would not say in the code what they say in the model, and what to do.

    `known` are those of which that was so before, or which could not be read then.
    """
    for difference in proof.differences:
        if whole(difference.element) in known or difference.element in known:
            continue
        message = (
            f"merged, {difference.element} of the code would not say what the model says:"
            f" {explain(difference)}"
        )
        hint = f"bring this element in step by hand, or {way_out}"
        yield finding(difference.right or difference.left, "RS968", message, hint)
