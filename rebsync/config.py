"""`rebsync.toml` beside a model: what the command line would otherwise repeat."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Literal, TypeAlias, cast

from rebsync.codes import CODES
from rebsync.diagnostics import Findings, RebsyncError, did_you_mean
from rebsync.files import read_source
from rebsync.records import dataclass
from rebsync.source import Source
from rebsync.terminal import one_line, printable
from rebsync.toml import Table, read_toml

FILE_NAME = "rebsync.toml"
TARGETS = ("ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py")
DRIVES = ("holonomic", "differential")
ALLOWED = ("deadlock",)
# Settings that no code depends on, and that are not recorded.
APART = frozenset({"allow", "cells", "ignore"})

Drive: TypeAlias = Literal["holonomic", "differential"]

_PACKAGE = re.compile(r"[a-z][a-z0-9_]*\Z")
_VERSION = re.compile(r"\d+\.\d+\.\d+\Z")
_EMAIL = re.compile(r"[^@\s<>&\"\x00-\x1f\x7f-\x9f]+@[^@\s<>&\"\x00-\x1f\x7f-\x9f]+\Z")
_SERVER = re.compile(r"[^\W\d][\w$]*\.[^\W\d][\w$]*\Z")
_TOPIC = re.compile(r"[~/]?[A-Za-z][\w/]*\Z")
_YEARS = r"\d{4}(?:-\d{4})?"
# The years and the holder, as ament_copyright reads them. A line of C++ that ends in a backslash
# goes on in the next one, and `coding:` at the beginning of a Python file is its encoding.
COPYRIGHT = re.compile(
    rf"{_YEARS}(?:, ?{_YEARS})*,? "
    r"(?P<holder>(?!.*coding[:=])[^\s\\,](?:[^\\]*[^\s\\])?)\Z"
)
_MESSAGE_TYPE = re.compile(r"[a-z]\w*/(?:msg/)?[A-Z]\w*\Z")


@dataclass(frozen=True, slots=True)
class Maintainer:
    """Who answers for the generated package."""

    name: str
    email: str


@dataclass(frozen=True, slots=True)
class SensorBinding:
    """The real sensor behind a `@Sensor` server; `seen` is an expression over its message `msg`."""

    server: str
    topic: str
    type: str
    seen: str | None = None


@dataclass(frozen=True, slots=True)
class ClassTarget:
    """The dialect of a class that is in another one than the rest of its package."""

    name: str
    target: str


@dataclass(frozen=True, slots=True)
class RobotCell:
    """The cell of a robot, or of all robots of a class: expressions over its state variables."""

    name: str
    x: str
    y: str


@dataclass(frozen=True, slots=True)
class Config:
    """The settings of one model; times in seconds, lengths in metres, angles in radians.

    `allow` is what is no mistake to a verification, `cells` where robots are drawn, `ignore` which
    warnings are not told; no code depends on them.
    """

    package: str | None = None
    target: str = "ros1-cpp"
    time_unit: float = 1.0
    slack: float = 0.5
    seed: int = 0
    cell_size: float = 1.0
    drive: Drive = "holonomic"
    heading: float = 0.0
    odometry: str | None = None
    lifecycle: bool = False
    monitor: bool = False
    shared_runtime: bool = False
    maintainers: tuple[Maintainer, ...] = ()
    license: str | None = None
    copyright: str | None = None
    version: str = "0.1.0"
    description: str | None = None
    sensors: tuple[SensorBinding, ...] = ()
    targets: tuple[ClassTarget, ...] = ()
    allow: tuple[str, ...] = ()
    cells: tuple[RobotCell, ...] = ()
    ignore: tuple[str, ...] = ()

    def target_of(self, class_name: str) -> str:
        """The dialect of a class."""
        own = (t.target for t in self.targets if t.name == class_name)
        return next(own, self.target)

    def sensor(self, class_name: str, server: str) -> SensorBinding | None:
        """The binding of the server `class_name.server`, if the user gave one."""
        wanted = f"{class_name}.{server}"
        return next((s for s in self.sensors if s.server == wanted), None)


def settings_beside(model: str) -> tuple[Source, Config]:
    """The settings beside a model, and their text; the usual ones where there are none.

    RebsyncError: they cannot be read, or are wrong.
    """
    path = Path(model).parent / FILE_NAME
    if not os.path.lexists(path):
        return Source(str(path), ""), Config()
    source = read_source(str(path))
    return source, parse_config(source)


def parse_config(source: Source) -> Config:
    """The settings in a text; a RebsyncError with all its mistakes when there are any."""
    table = read_toml(source)
    config = _config(table)
    table.finish()
    if table.diagnostics:
        found = tuple(sorted(table.diagnostics, key=lambda d: d.span.start))
        raise RebsyncError([Findings(source, found)])
    return config


def config_of_record(options: Mapping[str, Any]) -> Config | None:
    """The settings that a manifest has recorded; None where they are none that a text can have.

    They are as untrusted as a text: what is generated from them must not hold more.
    """
    known = {k: v for k, v in options.items() if v is not None and k in Config.__dataclass_fields__}
    if "odometry" in known:
        known["drive"] = {"kind": known.get("drive", DRIVES[0]), "odometry": known["odometry"]}
    known["ros2"] = {"lifecycle": known.get("lifecycle", False)}
    try:
        lists = {"sensors": "server", "targets": "name"}
        named = {k: {each[n]: each for each in known.get(k, ())} for k, n in lists.items()}
        sensors = {
            name: {k: v for k, v in each.items() if k != "server" and v is not None}
            for name, each in named["sensors"].items()
        }
        targets = {name: each["target"] for name, each in named["targets"].items()}
        table = Table(Source("", ""), (), {**known, "sensors": sensors, "targets": targets}, [])
        config = _config(table)
    except (AttributeError, KeyError, TypeError):  # of another shape than what is written
        return None
    return None if table.diagnostics else config


def _config(table: Table) -> Config:
    default = Config()
    drive, odometry = _drive(table)
    return Config(
        package=_matching(table, "package", None, _PACKAGE, "lower case, digits and `_`"),
        target=_one_of(table, "target", TARGETS, default.target),
        time_unit=_number(table, "time_unit", default.time_unit, _positive, "above 0"),
        slack=_number(table, "slack", default.slack, _not_negative, "0 or more"),
        seed=_seed(table, default.seed),
        cell_size=_number(table, "cell_size", default.cell_size, _positive, "above 0"),
        drive=drive,
        odometry=odometry,
        heading=_number(table, "heading", default.heading, _finite, "finite"),
        lifecycle=_lifecycle(table),
        monitor=table.flag("monitor"),
        shared_runtime=table.flag("shared_runtime"),
        maintainers=_maintainers(table),
        license=_one_line(table, "license"),
        copyright=_copyright(table),
        version=_matching(table, "version", default.version, _VERSION, "like 1.2.3")
        or default.version,
        description=_without_controls(table, "description"),
        sensors=_sensors(table),
        targets=_targets(table),
        allow=_allow(table),
        cells=_cells(table),
        ignore=_ignored(table),
    )


def _drive(table: Table) -> tuple[Drive, str | None]:
    """The kind of drive, and the topic of its odometry: `drive = "kind"`, or a table of both."""
    if not isinstance(table.raw("drive"), dict):
        return cast("Drive", _one_of(table, "drive", DRIVES, "holonomic")), None
    entry = table.table("drive")
    assert entry is not None
    kind = cast("Drive", _one_of(entry, "kind", DRIVES, "holonomic"))
    odometry = _matching(entry, "odometry", None, _TOPIC, "a topic such as /odom")
    entry.finish()
    return kind, odometry


def _lifecycle(table: Table) -> bool:
    """Whether nodes of ROS 2 have a life cycle: `lifecycle` of the table `[ros2]`."""
    entry = table.table("ros2")
    if entry is None:
        return False
    found = entry.flag("lifecycle")
    entry.finish()
    return found


def _maintainers(table: Table) -> tuple[Maintainer, ...]:
    people = []
    for entry in table.tables("maintainers"):
        for key in ("name", "email"):
            entry.require(key)
        name = _one_line(entry, "name") or ""
        email = _matching(entry, "email", "", _EMAIL, "an address such as ada@example.org") or ""
        entry.finish()
        people.append(Maintainer(name, email))
    return tuple(people)


def _copyright(table: Table) -> str | None:
    """The years and the holder of the copyright."""
    value = _one_line(table, "copyright")
    if value is None or COPYRIGHT.match(value):
        return value
    hint = 'it must be the years and the holder, such as "2026 ACME Robotics"'
    table.wrong("copyright", f'`copyright` cannot be "{value}"', hint)
    return None


def _sensors(table: Table) -> tuple[SensorBinding, ...]:
    bindings = []
    sensors = table.table("sensors")
    for server, entry in sensors.named_tables() if sensors else ():
        if not _SERVER.match(server):
            entry.report(
                "RS809",
                entry.place(),
                f'"{server}" does not name a server',
                'write [sensors."Class.server"], with the quotes',
            )
            continue
        for key in ("topic", "type"):
            entry.require(key)
        topic = _matching(entry, "topic", "", _TOPIC, "a topic such as /scan") or ""
        kind = _matching(entry, "type", "", _MESSAGE_TYPE, "like sensor_msgs/LaserScan") or ""
        bindings.append(SensorBinding(server, topic, kind, _one_line(entry, "seen")))
        entry.finish()
    return tuple(bindings)


def _one_line(table: Table, key: str) -> str | None:
    value = _without_controls(table, key)
    if value is not None and "\n" in value:
        table.wrong(key, f"`{key}` must be one line")
        return None
    return value


def _without_controls(table: Table, key: str) -> str | None:
    """A text that XML can hold and that no terminal obeys."""
    value = table.text(key)
    if value is not None and printable(value) != value:
        table.wrong(key, f"`{key}` holds control characters: {one_line(value)}")
        return None
    return value


def _targets(table: Table) -> tuple[ClassTarget, ...]:
    chosen = table.table("targets")
    if chosen is None:
        return ()
    found = [ClassTarget(n, _one_of(chosen, n, TARGETS, "ros1-cpp")) for n in list(chosen.values)]
    chosen.finish()
    return tuple(found)


def _allow(table: Table) -> tuple[str, ...]:
    """What is no mistake to a verification: `allow = ["deadlock"]`."""
    given = table.strings("allow")
    for each in given:
        if each not in ALLOWED:
            hint = did_you_mean(each, ALLOWED) or f"known: {', '.join(ALLOWED)}"
            table.wrong("allow", f'`allow` cannot have "{each}"', hint)
    return given


def _ignored(table: Table) -> tuple[str, ...]:
    """The codes of warnings and notes that are not told: `ignore` of the table `[lint]`."""
    entry = table.table("lint")
    if entry is None:
        return ()
    codes = entry.strings("ignore")
    for code in codes:
        if code not in CODES:
            hint = did_you_mean(code, CODES) or "codes are like RS501"
            entry.wrong("ignore", f'`ignore` cannot have "{code}"', hint)
    entry.finish()
    return codes


def _cells(table: Table) -> tuple[RobotCell, ...]:
    """The cells of robots: `[cells]`, `Carrier = ["cell % 4", 2]`."""
    entry = table.table("cells")
    found = []
    for name, value in entry.named() if entry else ():
        match value:
            case [int() | str() as x, int() | str() as y] if not {bool} & {type(x), type(y)}:
                found.append(RobotCell(name, str(x), str(y)))
            case _:
                hint = f'write {name} = ["x", "y"]: expressions over its state variables'
                assert entry is not None
                entry.wrong(name, f"`{name}` must have two coordinates", hint)
    return tuple(found)


def _matching(
    table: Table, key: str, default: str | None, pattern: re.Pattern[str], wanted: str
) -> str | None:
    value = table.text(key, default)
    if value and value != default and not pattern.match(value):
        table.wrong(key, f'`{key}` cannot be "{value}"', f"it must be {wanted}")
        return default
    return value


def _one_of(table: Table, key: str, known: tuple[str, ...], default: str) -> str:
    value = table.text(key, default) or default
    if value not in known:
        hint = did_you_mean(value, known) or f"known: {', '.join(known)}"
        table.wrong(key, f'`{key}` cannot be "{value}"', hint)
        return default
    return value


def _number(
    table: Table, key: str, default: float, accepts: Callable[[float], bool], wanted: str
) -> float:
    value = table.number(key, default)
    if value is None or not accepts(value):
        table.wrong(key, f"`{key}` must be {wanted}")
        return default
    return value


def _seed(table: Table, default: int) -> int:
    seed = table.integer("seed", default)
    if seed is None or not 0 <= seed < 2**31:
        table.wrong("seed", "`seed` must be a whole number from 0 to 2147483647")
        return default
    return seed


def _finite(value: float) -> bool:
    return abs(value) < float("inf")


def _positive(value: float) -> bool:
    return _finite(value) and value > 0


def _not_negative(value: float) -> bool:
    return _finite(value) and value >= 0
