"""Compiles generated ROS 2 packages: real messages by rosidl, and the stub of rclcpp."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).parent
STUB = HERE / "stub"
INTERFACES = HERE / "interfaces"
_PATH = "/usr/bin:/bin"
_WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror")
_STANDARD = ("-std=c++17", "-fwrapv")
_KINDS = ("msg", "srv", "action")
_RUNTIME = ("rosidl_runtime_cpp", "rosidl_runtime_c", "rosidl_typesupport_interface")


class BuildError(Exception):
    """A tool failed; the text is what it said."""


def missing_rosidl() -> str | None:
    """Why messages cannot be made here, or None."""
    for tool in ("rosidl", "g++"):
        if shutil.which(tool, path=_PATH) is None:
            return f"no {tool}"
    return None if Path("/usr/include/rosidl_runtime_cpp").exists() else "no rosidl_runtime_cpp"


def _tool(command: Sequence[str], directory: Path | None = None) -> str:
    done = subprocess.run(
        command,
        cwd=directory,
        env={"PATH": _PATH, "LANG": "C.UTF-8", "HOME": os.environ.get("HOME", "/")},
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        raise BuildError(done.stdout + done.stderr)
    return done.stdout


def make_messages(packages: Iterable[Path], out: Path) -> None:
    """The C++ headers of what packages say, each in a folder of its own below `out`."""
    for package in packages:
        found = [p for kind in _KINDS for p in sorted(package.glob(f"{kind}/*.{kind}"))]
        files, name = [str(p.relative_to(package)) for p in found], package.name
        _tool(["rosidl", "generate", "-o", str(out / name), "-t", "cpp", name, *files], package)


def interfaces() -> list[Path]:
    """The messages of other packages that generated ones use."""
    return sorted(p for p in INTERFACES.iterdir() if p.is_dir())


def _flags(package: Path, headers: Path) -> list[str]:
    system = [f"/usr/include/{name}" for name in _RUNTIME]
    found = [f"-I{package / 'include'}"]
    for folder in [STUB / "include", headers, *map(Path, system)]:
        found += ["-isystem", str(folder)]
    return [*_STANDARD, *_WARNINGS, *found]


def _common(headers: Path, options: Sequence[str] = ()) -> list[str]:
    """Options that have what every source includes compiled once for all with the same options."""
    common = headers / "".join(("common", *options, ".hpp"))
    if not common.with_name(f"{common.name}.gch").exists():
        common.write_text("#include <random>\n#include <rclcpp/rclcpp.hpp>\n")
        flags = [*_flags(headers, headers), *options, "-x", "c++-header"]
        _tool(["g++", *flags, str(common), "-o", f"{common}.gch"])
    return ["-include", str(common)]


def complaints(package: Path, headers: Path) -> list[str]:
    """What the compiler says about the classes of a package; their programs are all alike."""
    common = _common(headers)

    def check(source: Path) -> str:
        try:
            return _tool(["g++", "-fsyntax-only", *common, *_flags(package, headers), str(source)])
        except BuildError as error:
            return str(error)

    sources = [s for s in sorted(package.glob("src/*.cpp")) if not s.stem.endswith("_node")]
    with ThreadPoolExecutor(2) as pool:
        return [text for text in pool.map(check, sources) if text]


def build_driver(package: Path, headers: Path, out: Path, options: Sequence[str] = ()) -> Path:
    """One program of all executables of a package, which runs a whole system."""
    out.mkdir(parents=True, exist_ok=True)
    mains = [p.stem for p in sorted(package.glob("src/*.cpp")) if "int main(" in p.read_text()]
    table = out / "mains.cpp"
    table.write_text(_table(mains))
    sources = [*sorted(package.glob("src/*.cpp")), table, STUB / "driver.cpp"]
    common = [*_common(headers, options), *_reading(package, headers, out)]

    def compile_(source: Path) -> str:
        renamed = [f"-Dmain=main_of_{source.stem}"] if source.stem in mains else []
        target = out / f"{source.stem}.o"
        flags = [*common, *_flags(package, headers), *renamed, *options]
        _tool(["g++", "-c", *flags, str(source), "-o", str(target)])
        return str(target)

    with ThreadPoolExecutor(2) as pool:
        objects = list(pool.map(compile_, sources))
    program = out / "driver"
    _tool(["g++", *objects, *options, "-pthread", "-o", str(program)])
    return program


def _reading(package: Path, headers: Path, out: Path) -> list[str]:
    """Options that have each source know how to read what clients ask, as far as it is no array."""
    kinds = {"srv": "Request", "action": "Goal"}
    asked = [(k, p) for k in kinds for p in sorted(package.glob(f"{k}/*.{k}"))]
    if not asked:
        return []
    own = headers / package.name
    includes = [p.relative_to(headers) for k in kinds for p in sorted(own.glob(f"{k}/*.hpp"))]
    lines = ["#include <rclcpp/asking.hpp>", *(f'#include "{path}"' for path in includes)]
    for kind, path in asked:
        lines += [f"namespace {package.name}::{kind} {{", f"inline void fake_read({path.stem}::"]
        lines[-1] += f"{kinds[kind]}& to, const rclcpp::fake::Fields& from) {{"
        for line in path.read_text().split("---")[0].splitlines():
            type_, name = line.split()
            read = f'to.{name} = rclcpp::fake::value<decltype(to.{name})>(from.at("{name}"));'
            lines += [] if "[" in type_ else [f'  if (from.count("{name}") > 0) {read}']
        lines += ["  static_cast<void>(to);", "  static_cast<void>(from);", "}", "}"]
    reading = out / "reading.hpp"
    reading.write_text("\n".join(lines) + "\n")
    return ["-include", str(reading)]


def _table(mains: Sequence[str]) -> str:
    declared = "".join(f"int main_of_{name}(int, char**);\n" for name in mains)
    entries = ", ".join(f'{{"{name}", main_of_{name}}}' for name in mains)
    return (
        "#include <map>\n#include <string>\n"
        f"{declared}using Main = int (*)(int, char**);\n"
        "const std::map<std::string, Main>& mains();\n"
        "const std::map<std::string, Main>& mains() {\n"
        f"  static const std::map<std::string, Main> all{{{entries}}};\n  return all;\n}}\n"
    )
