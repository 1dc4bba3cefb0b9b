"""`rebsync.toml`: what it may hold, and what is said about the rest."""

from __future__ import annotations

import json

import pytest

from rebsync.config import (
    ClassTarget,
    Config,
    Maintainer,
    SensorBinding,
    config_of_record,
    parse_config,
)
from rebsync.diagnostics import RebsyncError
from rebsync.roundtrip.package.manifest import MANIFEST, with_manifest
from rebsync.source import Source


def mistakes(text: str) -> list[tuple[str, int, str, str | None]]:
    """Code, line, message and hint of everything wrong in a text."""
    source = Source("rebsync.toml", text)
    with pytest.raises(RebsyncError) as caught:
        parse_config(source)
    (findings,) = caught.value.findings
    return [
        (d.code, source.position(d.span.start).line, d.message, d.hint)
        for d in findings.diagnostics
    ]


def test_nothing_written_means_the_defaults() -> None:
    assert parse_config(Source("rebsync.toml", "# only a comment\n")) == Config()


def test_everything_written() -> None:
    text = """\
package = "patrol"
target = "ros1-cpp"
time_unit = 0.5
slack = 0
seed = 7
cell_size = 2
drive = "differential"
heading = 1.57
license = "MIT"
copyright = "2024-2026, 2028 ACME Robotics"
version = "2.0.1"
description = "Two robots."
maintainers = [{ name = "Ada", email = "ada@example.org" }]

[sensors."Robot.lidar"]
topic = "/scan"
type = "sensor_msgs/LaserScan"
seen = "near"
"""
    assert parse_config(Source("rebsync.toml", text)) == Config(
        package="patrol",
        time_unit=0.5,
        slack=0.0,
        seed=7,
        cell_size=2.0,
        drive="differential",
        heading=1.57,
        maintainers=(Maintainer("Ada", "ada@example.org"),),
        license="MIT",
        copyright="2024-2026, 2028 ACME Robotics",
        version="2.0.1",
        description="Two robots.",
        sensors=(SensorBinding("Robot.lidar", "/scan", "sensor_msgs/LaserScan", "near"),),
    )


def test_a_binding_is_found_by_class_and_server() -> None:
    text = '[sensors."R.s"]\ntopic = "t"\ntype = "a_msgs/B"\n'
    config = parse_config(Source("rebsync.toml", text))
    assert config.sensor("R", "s") == SensorBinding("R.s", "t", "a_msgs/B")
    assert config.sensor("R", "other") is None


def test_a_class_may_have_a_dialect_of_its_own() -> None:
    config = parse_config(Source("rebsync.toml", '[targets]\nRobot = "ros1-py"\n'))
    assert config.targets == (ClassTarget("Robot", "ros1-py"),)
    assert [config.target_of(name) for name in ("Robot", "Other")] == ["ros1-py", "ros1-cpp"]
    (mistake,) = mistakes('[targets]\nRobot = "ros1-pi"\n')
    assert mistake[:2] == ("RS809", 2)


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_all_mistakes_in_one_run_each_with_its_line(newline: str) -> None:
    lines = (
        "packge = 'a'",
        "time_unit = 0",
        "drive = 'holonomc'",
        "seed = 1.5",
        "[[maintainers]]",
        "nam = 'Ada'",
        "email = 'nowhere'",
        "[sensors.'Robot.lidar']",
        "topic = 'two words'",
    )
    assert mistakes(newline.join(lines)) == [
        ("RS808", 1, "unknown key `packge`", 'did you mean "package"?'),
        ("RS809", 2, "`time_unit` must be above 0", None),
        ("RS809", 3, '`drive` cannot be "holonomc"', 'did you mean "holonomic"?'),
        ("RS809", 4, "`seed` must be a whole number", None),
        ("RS810", 5, "`name` is missing in [maintainers]", None),
        ("RS808", 6, "unknown key `nam`", 'did you mean "name"?'),
        (
            "RS809",
            7,
            '`email` cannot be "nowhere"',
            "it must be an address such as ada@example.org",
        ),
        ("RS810", 8, "`type` is missing in [sensors.Robot.lidar]", None),
        ("RS809", 9, '`topic` cannot be "two words"', "it must be a topic such as /scan"),
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time_unit = nan", "`time_unit` must be above 0"),
        ("slack = -0.1", "`slack` must be 0 or more"),
        ("heading = inf", "`heading` must be finite"),
        ("cell_size = true", "`cell_size` must be a number"),
        ("seed = -1", "`seed` must be a whole number from 0 to 2147483647"),
        ("package = 'Patrol'", '`package` cannot be "Patrol"'),
        ("version = '1'", '`version` cannot be "1"'),
        ("target = 'ros3'", '`target` cannot be "ros3"'),
        ("maintainers = 'Ada'", "`maintainers` must be an array of tables"),
        ("sensors = 1", "`sensors` must be a table"),
        *(
            (f"copyright = '{text}'", f'`copyright` cannot be "{text}"')
            for text in ("ACME", "2026", "2026 ", "(c) 2026 ACME", "Copyright 2026 ACME", "26 ACME")
        ),
        *(
            (f"copyright = '{text}'", f'`copyright` cannot be "{text}"')
            for text in ("2026 ACME\\", "2026 A coding: latin-1", "2026 encoding=x", "2026 A ")
        ),
        ("[sensors.lidar]\ntopic = 'a'", '"lidar" does not name a server'),
    ],
)
def test_a_value_that_cannot_be(text: str, message: str) -> None:
    assert [m[2] for m in mistakes(text)] == [message]


@pytest.mark.parametrize(
    ("text", "line"),
    [("a = \n", 1), ("x = 1\nx = 2\n", 2), ("[a\n", 1), ("a = '''", 1), ("a = " + "[" * 5000, 1)],
    ids=["no value", "twice", "open header", "open string", "deep"],
)
def test_what_is_no_toml(text: str, line: int) -> None:
    ((code, at, message, _),) = mistakes(text)
    assert (code, at) == ("RS807", line)
    assert "TOML" in message


def test_a_drive_is_a_word_or_a_table() -> None:
    def read(text: str) -> Config:
        return parse_config(Source("rebsync.toml", text))

    assert (read('drive = "differential"').drive, read("").odometry) == ("differential", None)
    both = read('[drive]\nkind = "differential"\nodometry = "~odom"\n')
    assert (both.drive, both.odometry) == ("differential", "~odom")
    with pytest.raises(RebsyncError) as error:
        read('[drive]\nodometry = "no topic"\nspeed = 3\n')
    messages = [d.message for d in error.value.findings[0].diagnostics]
    assert messages == ['`odometry` cannot be "no topic"', "unknown key `speed`"]


def test_a_life_cycle_is_asked_for_in_the_table_of_ros2() -> None:
    def read(text: str) -> Config:
        return parse_config(Source("rebsync.toml", text))

    assert (read("").lifecycle, read("[ros2]\n").lifecycle) == (False, False)
    assert read("[ros2]\nlifecycle = true\n").lifecycle
    assert mistakes('[ros2]\nlifecycle = "yes"\nlifecyle = true\n')[0][2:] == (
        "`lifecycle` must be true or false",
        None,
    )


@pytest.mark.parametrize(
    "text", ['[drive]\nkind = "differential"\nodometry = "/odom"', "[ros2]\nlifecycle = true", ""]
)
def test_recorded_settings_are_those_that_were_read(text: str) -> None:
    config = parse_config(Source("rebsync.toml", text))
    recorded = json.loads(with_manifest({}, "m.rebeca", "", config)[MANIFEST])["options"]
    assert config_of_record(recorded) == config
    assert ("lifecycle" in recorded) == config.lifecycle
