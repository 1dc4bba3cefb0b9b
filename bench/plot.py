"""Draws costs over sizes as SVG: the sizes as powers of ten, the costs from 0 up."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, log10
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 640, 320
LEFT, RIGHT, TOP, BOTTOM = 56, 24, 44, 48
STYLE = """
.back{fill:#fff}text{font:12px sans-serif;fill:#1b1f24}
.quiet{fill:#5f6871}.rule{stroke:#d5dae0}
path{fill:none;stroke-width:2px}
.s0{stroke:#0b5cad}.s1{stroke:#b34700;stroke-dasharray:6 4}
.d0{fill:#0b5cad}.d1{fill:#b34700}
@media(prefers-color-scheme:dark){
.back{fill:#15191e}text{fill:#e6e8eb}
.quiet{fill:#9aa4ae}.rule{stroke:#333b44}
.s0{stroke:#7db7ff}.s1{stroke:#ffb07a}
.d0{fill:#7db7ff}.d1{fill:#ffb07a}
}
"""


@dataclass(frozen=True, slots=True)
class Series:
    """Points (size, cost) that belong together."""

    title: str
    points: tuple[tuple[int, float], ...]


@dataclass(frozen=True, slots=True)
class Axes:
    """Where sizes and costs lie: powers of ten `least` to `most`, costs 0 to `top`."""

    least: int
    most: int
    top: float

    def x(self, size: float) -> float:
        return LEFT + (log10(size) - self.least) / (self.most - self.least) * (WIDTH - LEFT - RIGHT)

    def y(self, cost: float) -> float:
        return HEIGHT - BOTTOM - cost / self.top * (HEIGHT - TOP - BOTTOM)


def plot(drawn: tuple[Series, ...], title: str, size: str, cost: str) -> str:
    """The picture, with the words for its axes."""
    sizes = [x for each in drawn for x, _ in each.points]
    step = _step(max(y for each in drawn for _, y in each.points))
    most = max(y for each in drawn for _, y in each.points)
    axes = Axes(floor(log10(min(sizes))), ceil(log10(max(sizes))), step * ceil(most / step))
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">',
        f"<title>{escape(title)}</title>",
        f"<style>{STYLE}</style>",
        '<rect class="back" width="100%" height="100%"/>',
        *_grid(axes, step),
        f'<text class="quiet" x="{LEFT}" y="18">{escape(cost)}</text>',
        f'<text class="quiet" x="{WIDTH - RIGHT}" y="{HEIGHT - 8}" text-anchor="end">'
        f"{escape(size)}</text>",
    ]
    for number, each in enumerate(drawn):
        lines += _line(axes, number, each)
    return "\n".join([*lines, "</svg>", ""])


def _step(most: float) -> float:
    """A round step that makes about five of `most`."""
    power = 10.0 ** floor(log10(most / 5))
    return next(power * n for n in (1.0, 2.0, 5.0, 10.0) if power * n * 6 >= most)


def _grid(axes: Axes, step: float) -> list[str]:
    lines = []
    for n in range(round(axes.top / step) + 1):
        y = axes.y(n * step)
        lines.append(f'<path class="rule" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>')
        lines.append(
            f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{n * step:.3g}</text>'
        )
    for power in range(axes.least, axes.most + 1):
        x = axes.x(10**power)
        lines.append(f'<path class="rule" d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        lines.append(
            f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">10'
            f'<tspan dy="-5" font-size="9">{power}</tspan></text>'
        )
    return lines


def _line(axes: Axes, number: int, drawn: Series) -> list[str]:
    places = [(axes.x(size), axes.y(cost)) for size, cost in drawn.points]
    way = "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
    left, top = LEFT + 200 * (number + 1), 14
    return [
        f'<path class="s{number}" d="M{way}"/>',
        *(f'<circle class="d{number}" cx="{x:.1f}" cy="{y:.1f}" r="3.5"/>' for x, y in places),
        f'<path class="s{number}" d="M{left} {top}h24"/>',
        f'<text x="{left + 30}" y="{top + 4}">{escape(drawn.title)}</text>',
    ]
