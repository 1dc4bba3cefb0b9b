"""Files that nobody has edited, and that are generated otherwise for what others say now."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rebsync.diagnostics import RebsyncError
from rebsync.files import source_below
from rebsync.reverse.scaffold.stand_ins import STAND_IN
from rebsync.roundtrip.merge.code import LABELS, as_here
from rebsync.roundtrip.merge.source import merged_source
from rebsync.roundtrip.package.state import is_of_model
from rebsync.source import Source


def consequent_files(
    root: str, recorded: Mapping[str, str], before: Mapping[str, str], now: Mapping[str, str]
) -> tuple[str, ...]:
    """The unedited files whose generated text follows a change of the code, as a default does.

    `recorded` was generated last time, `before` is today's generation of the model of last time,
    `now` that of the model with the changes of the code. There are none unless the edited files
    have all of what changes in them, and some does: where a class does not publish its new
    variable, the message is to have no field for it; and what people say in another way stays so.
    """
    found, is_written = [], False
    for path in _changing(before, now):
        old, new, source = before.get(path), now.get(path), _source(root, path)
        if old is None or new is None or source is None or recorded.get(path) != old:
            return ()
        ours = source.text
        last, text = as_here(old, ours), as_here(new, ours)
        if ours == last:
            found.append(path)
        elif merged_source(path, (ours, last, text), LABELS).text != ours:
            return ()
        else:
            is_written = True
    return tuple(found) if is_written else ()


def _source(root: str, path: str) -> Source | None:
    """A file of the package; None for one that is kept elsewhere, behind a link, or unreadable."""
    try:
        return source_below(root, path)
    except RebsyncError:
        return None


def _changing(before: Mapping[str, str], now: Mapping[str, str]) -> Iterator[str]:
    """The files of the model that are generated otherwise."""
    for path in sorted({*before, *now}):
        is_played = STAND_IN.fullmatch(path) is not None
        if before.get(path) != now.get(path) and is_of_model(path) and not is_played:
            yield path
