"""The looks of charts and drawn state spaces, for light and dark backgrounds."""

from __future__ import annotations

_SHAPES = """\
.msc text{font:12px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,'Liberation Mono',monospace;\
font-size:11.2px;paint-order:stroke;stroke-width:3px;stroke-linejoin:round}
.msc path,.msc line{fill:none;stroke-width:1.2px}
.msc text.head{text-anchor:middle;font-weight:bold;stroke:none}
.msc text.time,.msc text.number{text-anchor:end}
.msc text.time,.msc text.label,.msc text.failure{font-weight:bold}
.msc line.time{stroke-dasharray:2 4}
.msc path.waits{stroke-dasharray:1.5 3}
.msc text.loop{text-anchor:middle}
.msc text.note,.msc .on text{stroke:none}
.msc .row{fill-opacity:0}
.msc .row.wrong,.msc .row.on{fill-opacity:1}
.msc .flight.on path{stroke-width:2.6px}
.msc path.passing{stroke-dasharray:4 3}
"""

_COLOURS = {
    "back": ("#ffffff", "#15191e"),
    "ink": ("#1b1f24", "#e6e8eb"),
    "quiet": ("#5f6871", "#9aa4ae"),
    "rule": ("#c3c9d0", "#414a54"),
    "way": ("#0b5cad", "#7db7ff"),
    "body": ("#6f9bd1", "#4a7ab5"),
    "busy": ("#dce8f6", "#24374e"),
    "paper": ("#fdf6d3", "#37331d"),
    "wrong": ("#b71c1c", "#ff8a80"),
    "alarm": ("#fdeceb", "#3d2020"),
    "chosen": ("#e3eefc", "#1f3450"),
    "loop": ("#7b3fb0", "#c79bf2"),
}

_RULES = """\
.msc .back{fill:BACK}
.msc text{fill:INK;stroke:BACK}
.msc text.time,.msc text.label{fill:INK}
.msc text.number,.msc text.legend,.msc text.choice{fill:QUIET}
.msc text.send{fill:WAY}
.msc line.life,.msc line.time{stroke:RULE}
.msc rect.head{fill:BACK;stroke:QUIET}
.msc rect.body{fill:BODY;stroke:WAY}
.msc rect.busy{fill:BUSY;stroke:RULE}
.msc rect.paper{fill:PAPER}
.msc path.way,.msc path.waits,.msc circle.open{stroke:WAY}
.msc circle.open{fill:BACK}
.msc path.tip{fill:WAY;stroke:none}
.msc .row.on{fill:CHOSEN}
.msc .row.wrong{fill:ALARM}
.msc .wrong rect.body{fill:WRONG;stroke:WRONG}
.msc text.failure,.msc .wrong text.label{fill:WRONG}
.msc .wrong rect.head,.msc path.failing{stroke:WRONG}
.msc path.loop{stroke:LOOP}
.msc text.loop{fill:LOOP}
"""


def _coloured(dark: bool) -> str:
    rules = _RULES
    for name, colours in _COLOURS.items():
        rules = rules.replace(name.upper(), colours[dark])
    return rules


_DARK = "@media screen and (prefers-color-scheme:dark)"
STYLE = f"{_SHAPES}{_coloured(False)}{_DARK}{{\n{_coloured(True)}}}\n"
