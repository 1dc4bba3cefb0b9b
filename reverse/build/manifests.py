"""package.xml of ROS packages, in the formats 1 to 3."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from rebsync.package import Maintainer
from rebsync.records import dataclass
from rebsync.reverse.launch.xml_tree import XmlElement, read_xml, text_below
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source, Span

_DEPENDS = frozenset(
    {
        *("depend", "build_depend", "build_export_depend", "exec_depend", "run_depend"),
        *("buildtool_depend", "buildtool_export_depend", "test_depend", "doc_depend"),
    }
)
_FORMATS = (1, 2, 3)
_MANIFEST = "package.xml"


@dataclass(frozen=True, slots=True)
class Manifest:
    """What a package.xml says; a part that it lacks is None, and in `unknowns` if it must be there.

    Several licences are joined with commas. `depends` are the packages that it needs for
    anything. White space in texts is that of one line.
    """

    name: str | None
    version: str | None
    description: str | None
    license: str | None
    maintainers: tuple[Maintainer, ...]
    depends: tuple[str, ...]
    format: int
    unknowns: tuple[Unknown, ...]
    source: Source
    span: Span


def read_manifest(source: Source) -> Manifest:
    """What a package.xml says."""
    root = read_xml(source)
    if isinstance(root, Unknown):
        return Manifest(None, None, None, None, (), (), 1, (root,), source, Span(0, 0))
    unknowns: list[Unknown] = []
    if root.name != "package":
        unknowns.append(Unknown("package.xml", "its root is no <package>", source, root.span))
    form = (root.get("format") or "1").strip()
    if form not in map(str, _FORMATS):
        why = f"the format `{form}` is not known"
        unknowns.append(Unknown("package.xml", why, source, root.place_of("format")))
        form = str(_FORMATS[-1])
    texts: dict[str, list[str]] = {}
    for element in root.elements():
        texts.setdefault(element.name, []).append(_line(element))
    for name in ("name", "version", "description", "license", "maintainer"):
        if not any(texts.get(name, ())):
            unknowns.append(Unknown("package.xml", f"it has no <{name}>", source, root.span))
    return Manifest(
        name=_only(texts, "name"),
        version=_only(texts, "version"),
        description=_only(texts, "description"),
        license=", ".join(texts.get("license", ())) or None,
        maintainers=tuple(
            Maintainer(_line(e), e.get("email") or "")
            for e in root.elements()
            if e.name == "maintainer"
        ),
        depends=tuple(sorted({t for n in _DEPENDS for t in texts.get(n, ()) if t})),
        format=int(form),
        unknowns=tuple(unknowns),
        source=source,
        span=root.span,
    )


def package_name(files: Mapping[str, Source]) -> str:
    """The name that the manifest among some files gives their package; empty where none does."""
    return name_in(files[_MANIFEST]) or "" if _MANIFEST in files else ""


@lru_cache(maxsize=4)  # several ask for that of a package while it is read
def name_in(source: Source) -> str | None:
    """The name alone that a package.xml says, in a fraction of the time of all of it."""
    text = text_below(source, "name")
    return " ".join(text.split()) or None if text is not None else read_manifest(source).name


def _only(texts: dict[str, list[str]], name: str) -> str | None:
    return next(iter(texts.get(name, ())), None) or None


def _line(element: XmlElement) -> str:
    """All text in an element, on one line: a description may hold tags of HTML."""
    return " ".join(_all_text(element).split())


def _all_text(element: XmlElement) -> str:
    if not element.elements():
        return element.text
    return " ".join([element.text, *map(_all_text, element.elements())])
