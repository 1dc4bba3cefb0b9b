"""Generates packages and lets the compiler check their sources against real ROS headers."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

from rebsync.config import Config, parse_config
from rebsync.diagnostics import Diagnostic, Severity
from rebsync.forward.generate import generate, package_name
from rebsync.forward.limits import limits
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.ros1.workspace import SYSTEM_PATH, SYSTEM_PYTHON

CASES = Path(__file__).parent / "cases"
_WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror")
_STANDARD = ("-std=gnu++14", "-fwrapv")
_MESSAGES = """
import subprocess
import sys
from pathlib import Path
import genmsg.template_tools as tools
out = Path(sys.argv[1])
for package in map(Path, sys.argv[2:]):
    headers = out / package.name
    headers.mkdir(parents=True, exist_ok=True)
    search = [f"{package.name}:{package / 'msg'}", f"{package.name}:{headers / 'msg'}"]
    search += [f"{other}:/usr/share/{other}/msg" for other in ("actionlib_msgs", "std_msgs")]
    for action in sorted(package.glob("action/*.action")):
        genaction = "/usr/lib/actionlib_msgs/genaction.py"
        subprocess.run([genaction, str(action), "-o", str(headers / "msg")], check=True)
    for message in sorted([*package.glob("msg/*.msg"), *headers.glob("msg/*.msg")]):
        tools.generate_from_file(
            str(message), package.name, str(headers), "/usr/share/gencpp", search,
            {"msg.h.template": "@NAME@.h"}, {},
        )
    for service in sorted(package.glob("srv/*.srv")):
        tools.generate_from_file(
            str(service), package.name, str(headers), "/usr/share/gencpp", search,
            {"msg.h.template": "@NAME@.h"}, {"srv.h.template": "@NAME@.h"},
        )
"""


def generated(text: str, stem: str, config: Config | None = None) -> dict[str, str]:
    """The package of a model that has no errors."""
    parsed = parse_model(Source(f"{stem}.rebeca", text))
    analysis = analyse(parsed.model)
    used = config or Config()
    _accept((*parsed.diagnostics, *analysis.diagnostics))
    _accept(limits(parsed.model, analysis, used, stem))
    return generate(parsed.model, parsed.comments, analysis, used, stem)


def _accept(found: Sequence[Diagnostic]) -> None:
    errors = [d for d in found if d.severity is Severity.ERROR]
    assert not errors, errors


def case_files(case: Path, target: str = "ros1-cpp") -> dict[str, str]:
    """The package of a case: a model, and its settings where it has some."""
    config = replace(case_config(case), target=target)
    return generated(case.read_text(encoding="utf-8"), case.stem, config)


def case_config(case: Path) -> Config:
    """The settings beside a case."""
    settings = case.with_suffix(".toml")
    return (
        parse_config(Source(settings.name, settings.read_text())) if settings.exists() else Config()
    )


def written(files: dict[str, str], directory: Path, stem: str, config: Config) -> Path:
    """The package as a directory, named as the package."""
    package = directory / package_name(stem, config)
    for name, text in files.items():
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return package


def complaints(packages: Sequence[Path], directory: Path, common: Path) -> list[str]:
    """What compilers say about the sources of packages; nothing, that is the goal.

    `common` is what `precompiled` gave.
    """
    headers = directory / "headers"
    environment = {"PATH": SYSTEM_PATH, "LANG": "C.UTF-8"}
    command = [SYSTEM_PYTHON, "-c", _MESSAGES, str(headers), *map(str, packages)]
    subprocess.run(command, check=True, env=environment)
    jobs = [(p, s) for p in packages for s in _sources(p)]
    with ThreadPoolExecutor(2) as pool:
        found = pool.map(lambda job: _complaint(job[0], job[1], headers, common), jobs)
        return [text for text in found if text]


def _sources(package: Path) -> Iterable[Path]:
    found = sorted((package / "src").glob("*.cpp"))
    return [s for s in found if not s.stem.endswith("_node") or "param" in s.read_text()]


def precompiled(directory: Path) -> Path:
    """What every source begins with, compiled once: that takes as long as six sources."""
    common = directory / "common.h"
    common.write_text("#include <ros/ros.h>\n#include <std_msgs/Header.h>\n#include <random>\n")
    _compile(["-x", "c++-header", str(common), "-o", f"{common}.gch"])
    return common


def _complaint(package: Path, source: Path, headers: Path, common: Path) -> str:
    includes = [f"-I{headers}", f"-I{package / 'include'}"]
    return _compile(["-fsyntax-only", "-include", str(common), *includes, str(source)])


def _compile(arguments: Sequence[str]) -> str:
    done = subprocess.run(
        ["g++", *_STANDARD, *_WARNINGS, *arguments],
        env={"PATH": SYSTEM_PATH, "LANG": "C.UTF-8"},
        capture_output=True,
        text=True,
    )
    return done.stdout + done.stderr
