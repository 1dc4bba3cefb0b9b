"""The cells of robots that `rebsync.toml` gives, as expressions of the model."""

from __future__ import annotations

from rebsync.config import Config, RobotCell
from rebsync.diagnostics import Findings, RebsyncError, did_you_mean
from rebsync.grammars.parser import parse_expression
from rebsync.model import Expression, Name, walk
from rebsync.source import Source
from rebsync.static import Analysis
from rebsync.static.cells import CellOf, flat, variables_of
from rebsync.toml import Table, read_toml


def parse_cells(settings: Source, config: Config, analysis: Analysis) -> dict[str, CellOf]:
    """What gives the cells of robots and classes, by their names; RebsyncError: it is wrong."""
    if not config.cells:
        return {}
    table = read_toml(settings).table("cells")
    assert table is not None
    found = {each.name: _cell(each, table, analysis) for each in config.cells}
    if table.diagnostics:
        raise RebsyncError([Findings(settings, tuple(table.diagnostics))])
    return found


def _cell(given: RobotCell, table: Table, analysis: Analysis) -> CellOf:
    main = analysis.model.main
    classes = {r.name: r.type.name for r in main.rebecs} if main is not None else {}
    name = classes.get(given.name, given.name)
    if name not in analysis.classes:
        hint = did_you_mean(given.name, [*classes, *analysis.classes])
        table.wrong(given.name, f'there is no rebec or class "{given.name}" in the model', hint)
        return CellOf()
    names = {*variables_of(analysis.classes[name]), *analysis.env}
    x, y = (_coordinate(text, given.name, table, names) for text in (given.x, given.y))
    return CellOf(x, y, (given.x, given.y))


def _coordinate(text: str, key: str, table: Table, names: set[str]) -> Expression | None:
    try:
        expression = parse_expression(text)
    except ValueError:
        table.wrong(key, f'"{text}" is no expression', "write it as in the model")
        return None
    for node in walk(flat(expression)):
        if isinstance(node, Name) and node.name not in names:
            hint = did_you_mean(node.name, names) or "it may have state variables and constants"
            table.wrong(key, f'"{node.name}" is no state variable of "{key}"', hint)
            return None
    return expression
