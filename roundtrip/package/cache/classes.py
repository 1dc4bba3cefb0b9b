"""Keeps in the user's cache what single classes of generated code say."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

from rebsync.records import dataclass
from rebsync.reverse.generated.cpp_kept import ClassRead
from rebsync.roundtrip.package.cache.serialisation import NotSerialisable, serialised
from rebsync.roundtrip.package.cache.store import decoded, key_of, load, save
from rebsync.source import Source


@dataclass(frozen=True, slots=True)
class CachedClass:
    """What a class says, and the digests of the texts in which that has places, by their paths."""

    body: str
    places: tuple[tuple[str, str], ...]


class ClassCache:
    """What classes said before, in the user's cache."""

    def recall(self, key: str, sources: Mapping[str, Source]) -> ClassRead | None:
        """What is known under a key, if all texts that it has places in are as they were."""
        entry = load(key_of("class", key), CachedClass)
        if entry is None:
            return None
        for path, digest in entry.places:
            if path not in sources or _digest(sources[path]) != digest:
                return None
        return decoded(entry.body, ClassRead, sources)

    def keep(self, key: str, read: ClassRead, sources: Mapping[str, Source]) -> None:
        """Keeps this for later, if that can be done."""
        used = _Used(sources)
        try:
            body = serialised(read, used)
        except NotSerialisable:
            return
        places = tuple((path, _digest(sources[path])) for path in sorted(used.paths))
        save(key_of("class", key), CachedClass(body, places))


class _Used(dict[str, Source]):
    """Texts by their paths, with a note of those that were looked up."""

    def __init__(self, sources: Mapping[str, Source]) -> None:
        super().__init__(sources)
        self.paths: set[str] = set()

    def get(self, path: str, default: Source | None = None) -> Source | None:  # type: ignore[override]
        """The text of a path, which is noted."""
        if path in self:
            self.paths.add(path)
        return super().get(path, default)


def _digest(source: Source) -> str:
    return hashlib.sha256(source.text.encode("utf-8", "surrogatepass")).hexdigest()
