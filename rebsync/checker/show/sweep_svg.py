"""A parameter sweep as SVG: verdicts and measures over the values of constants."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.checker.show import words
from rebsync.checker.show.chart_rows import width_of
from rebsync.checker.show.chart_style import STYLE
from rebsync.checker.show.markup import Markup, element, joined, number
from rebsync.records import dataclass

NARROW, WIDE, ALL = 2.0, 56.0, 720.0  # how wide columns are: the least, the most, and together
HEIGHT, BAND = 18.0, 60.0  # of a row of verdicts, and of a measure
TALL = {"satisfied": 5.0, "undetermined": 10.0, "violated": 15.0}  # not by colours alone
GAP, MARGIN, TOP = 8.0, 12.0, 40.0

_STYLE = """\
.sweep rect.satisfied{fill:#2e9e4f}
.sweep rect.violated{fill:#c62828}
.sweep rect.undetermined{fill:#b8860b}
.sweep rect.assumed{fill-opacity:.15;stroke:#767676}
"""


@dataclass(frozen=True, slots=True)
class Column:
    """What was found for some values: verdicts, and measures as their least and greatest value."""

    values: tuple[str, ...]
    verdicts: tuple[tuple[str, str], ...]
    measures: tuple[tuple[str, int | str | None, int | str | None], ...]
    assumed: bool = False  # not searched: taken from --monotone

    @property
    def label(self) -> str:
        return ", ".join(self.values)


def sweep_svg(model: str, names: Sequence[str], columns: Sequence[Column]) -> str:
    """A row for each verdict and a band for each measure; a column for each combination."""
    verdicts = list(dict.fromkeys(name for c in columns for name, _ in c.verdicts))
    measures = list(dict.fromkeys(text for c in columns for text, _, _ in c.measures))
    said = f"{model}: verdicts by the values of {', '.join(names)}"
    left = MARGIN + max(width_of(text) for text in (*verdicts, *measures)) + 6 * GAP
    wide = max(NARROW, min(WIDE, ALL / len(columns)))
    parts: list[Markup] = []
    y = TOP
    for name in verdicts:
        parts += [_text(name, MARGIN, y + 13), *_verdicts(name, columns, left, y, wide)]
        y += HEIGHT
    for text in measures:
        y += GAP
        parts += _measured(text, columns, left, y, wide)
        y += BAND
    parts += [
        *_axis(", ".join(names), columns, left, y, wide),
        *_legend(left, y + HEIGHT + GAP, columns),
    ]
    width = left + wide * len(columns) + 6 * MARGIN
    height = y + 4 * HEIGHT
    return (
        element(
            "svg",
            joined(
                element("title", said, id="sweep-title"),
                element("style", Markup(STYLE + _STYLE)),
                element("rect", class_="back", width="100%", height="100%"),
                _text(said, MARGIN, 20, "label"),
                *parts,
            ),
            xmlns="http://www.w3.org/2000/svg",
            class_="msc sweep",
            viewBox=f"0 0 {number(width)} {number(height)}",
            width=width,
            height=height,
            role="img",
            aria_labelledby="sweep-title",
        )
        + "\n"
    )


def _text(text: str, x: float, y: float, kind: str = "note") -> Markup:
    return element("text", text, class_=kind, x=x, y=y)


def _verdicts(
    name: str, columns: Sequence[Column], left: float, y: float, wide: float
) -> list[Markup]:
    """A row of cells; a value for which the name has no verdict has none."""
    cells = []
    for at, column in enumerate(columns):
        if verdict := dict(column.verdicts).get(name):
            remark, kind = (
                (", if monotone", f"{verdict} assumed") if column.assumed else ("", verdict)
            )
            told = element("title", f"{column.label}: {name} {verdict}{remark}")
            x, tall = left + wide * at, TALL[verdict]
            place = {"x": x, "y": y + HEIGHT - tall, "width": wide - 1, "height": tall}
            cells.append(element("rect", told, class_=kind, **place))
    return cells


def _measured(
    text: str, columns: Sequence[Column], left: float, y: float, wide: float
) -> list[Markup]:
    """The least and greatest values as two lines, with the ends of their scale.

    What is for ever, or has no value, is left out of the lines.
    """
    found = {
        at: (low, high) for at, c in enumerate(columns) for m, low, high in c.measures if m == text
    }
    numbers = [v for pair in found.values() for v in pair if isinstance(v, int)]
    parts = [_text(text, MARGIN, y + 13)]
    if not numbers:
        return [*parts, _text(words.NEVER, left, y + 13)]
    least, most = min(numbers), max(numbers)
    scale = (BAND - GAP) / ((most - least) or 1)
    for side, name in enumerate(("least", "greatest")):
        points = [
            (left + wide * (at + 0.5), y + (most - value) * scale, value, columns[at].label)
            for at, pair in found.items()
            if isinstance(value := pair[side], int)
        ]
        line = "L".join(f"{number(x)},{number(height)}" for x, height, _, _ in points)
        parts.append(element("path", class_="way", d=f"M{line}") if len(points) > 1 else Markup())
        parts += [
            element("circle", element("title", f"{label}: {name} {value}"), class_="open",
                    cx=x, cy=height, r=2.5)
            for x, height, value, label in points
        ]  # fmt: skip
    right = left + wide * len(columns) + GAP
    ends = dict.fromkeys(((most, y + 4), (least, y + BAND - GAP + 4 if most > least else y + 4)))
    return [*parts, *(_text(f"{value:,}", right, height, "label") for value, height in ends)]


def _axis(name: str, columns: Sequence[Column], left: float, y: float, wide: float) -> list[Markup]:
    """Values below the columns: as many as there is place for."""
    every = -(-(max(width_of(c.label) for c in columns) + GAP) // wide)
    labels = [
        _text(column.label, left + wide * at, y + 16)
        for at, column in enumerate(columns)
        if at % int(every) == 0
    ]
    return [_text(name, MARGIN, y + 16, "label"), *labels]


def _legend(left: float, y: float, columns: Sequence[Column]) -> Iterator[Markup]:
    kinds = {**TALL, **({"assumed": 15.0} if any(c.assumed for c in columns) else {})}
    for at, (verdict, tall) in enumerate(kinds.items()):
        x = left + 120 * at
        place = {"x": x, "y": y + 16 - tall, "width": 10.0, "height": tall}
        yield element("rect", class_=verdict, **place)
        yield _text("if monotone" if verdict == "assumed" else verdict, x + 16, y + 16)
