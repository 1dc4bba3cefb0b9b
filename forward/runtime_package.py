"""The run-time part as a package of its own, which the packages of a workspace share.

It is the same for every model of a dialect: what depends on the model (services, actions,
odometry, lifecycle) packages have only beside their nodes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from rebsync import __version__
from rebsync.config import Config
from rebsync.forward.message_files import ANNOUNCEMENT, TIMING, text_of
from rebsync.forward.runtime_part import is_timed
from rebsync.forward.templating import fill
from rebsync.package import Package

NAME = "rebsync_runtime"
MESSAGES = ("Announcement", "Timing")
STEMS = ("drive", "mailbox", "sensor", "startup", "values", "watchdog")
_STEM = "|".join(STEMS)
_DEPENDS = {
    "ros1-cpp": ("diagnostic_msgs", "geometry_msgs", "roscpp"),
    "ros1-py": ("diagnostic_msgs", "geometry_msgs", "rosgraph_msgs", "rospy"),
    "ros2-cpp": ("diagnostic_msgs", "geometry_msgs", "rcl_interfaces", "rclcpp"),
    "ros2-py": ("diagnostic_msgs", "geometry_msgs", "rcl_interfaces", "rclpy"),
}


def needs_own(package: Package, config: Config) -> str:
    """What of a model the package that is shared does not have; empty if it has all."""
    needs = {
        "services": package.services,
        "actions": package.actions,
        "odometry": config.odometry is not None,
        "lifecycle": config.lifecycle,
        "nodes in two languages": config.targets,
        "a monitor": config.monitor,
        "a model without time": not is_timed(package),
    }
    return next((what for what, asked in needs.items() if asked), "")


def packages_of(target: str) -> tuple[str, ...]:
    """The names of the packages that are the run-time part of a dialect."""
    return (NAME, f"{NAME}_interfaces") if target == "ros2-py" else (NAME,)


def runtime_packages(target: str) -> dict[str, str]:
    """The files of these packages, by their paths from the workspace's folder of sources."""
    dialect = target.replace("-", "_")
    is_python, is_ros2 = target.endswith("-py"), target.startswith("ros2")
    files = _modules(dialect) if is_python else _headers(dialect, is_ros2)
    of_messages = f"{NAME}_interfaces" if is_python and is_ros2 else NAME
    files |= {f"{of_messages}/msg/Announcement.msg": text_of(ANNOUNCEMENT)}
    files |= {f"{of_messages}/msg/Timing.msg": text_of(TIMING)}
    files |= _layout(dialect, is_python)
    depends = _DEPENDS[target]
    given: dict[str, object] = {"name": NAME, "version": __version__, "python": is_python}
    if not is_ros2:
        files[f"{NAME}/package.xml"] = fill("runtime/ros1_package.xml.j2", depends=depends, **given)
        files[f"{NAME}/CMakeLists.txt"] = fill(
            "runtime/ros1_CMakeLists.txt.j2",
            build_depends=sorted((*depends, "message_generation")),
            run_depends=sorted((*depends, "message_runtime")),
            **given,
        )
        if is_python:
            files[f"{NAME}/setup.py"] = fill("ros1_py/setup.py.j2", package=NAME)
        return files
    if not is_python:
        files |= _ros2(NAME, depends, messages=True)
        return files
    files |= _ros2(of_messages, (), messages=True)
    files |= _ros2(NAME, tuple(sorted((*depends, of_messages))), messages=False)
    files[f"{NAME}/setup.py"] = fill("runtime/ros2_setup.py.j2", **given)
    files[f"{NAME}/setup.cfg"] = fill("ros2_py/setup.cfg.j2", package=NAME)
    files[f"{NAME}/resource/{NAME}"] = ""
    return files


def _layout(dialect: str, is_python: bool) -> dict[str, str]:
    """What formatters are told, as in the packages that depend on this one."""
    if is_python:
        return {f"{NAME}/ruff.toml": fill("py/ruff.toml.j2", packages=packages_of("ros2-py"))}
    return {f"{NAME}/.clang-format": fill(f"{dialect}/clang-format.j2")}


def _ros2(name: str, depends: tuple[str, ...], *, messages: bool) -> dict[str, str]:
    given = {"name": name, "version": __version__, "depends": depends, "messages": messages}
    files = {f"{name}/package.xml": fill("runtime/ros2_package.xml.j2", **given)}
    if messages:
        files[f"{name}/CMakeLists.txt"] = fill("runtime/ros2_CMakeLists.txt.j2", **given)
    return files


_FEATURES: dict[str, object] = {
    **{"package": NAME, "services": (), "actions": (), "odometry": "", "timed": True},
    **{"lifecycle": False, "includes": (), "node": "rclcpp::Node"},
}


def _headers(dialect: str, is_ros2: bool) -> dict[str, str]:
    ending = "hpp" if is_ros2 else "h"
    return {
        f"{NAME}/include/{NAME}/{stem}.{ending}": fill(f"{dialect}/{stem}.{ending}.j2", **_FEATURES)
        for stem in STEMS
    }


def _modules(dialect: str) -> dict[str, str]:
    folder = f"{NAME}/src/{NAME}" if dialect == "ros1_py" else f"{NAME}/{NAME}"
    modules = {f"{folder}/__init__.py": '"""The run-time part of generated nodes."""\n'}
    for stem in STEMS:
        template = f"{'py' if stem == 'values' else dialect}/{stem}.py.j2"
        modules[f"{folder}/{stem}.py"] = fill(template, **_FEATURES)
    return modules


# --- packages that depend on it -----------------------------------------------------------------


def without_runtime(files: Mapping[str, str], name: str, target: str) -> dict[str, str]:
    """The files of a package that has the run-time part from the package that is shared."""
    own = re.compile(
        rf"include/{name}/(?:{_STEM})\.h(?:pp)?|(?:.*/)?{name}/(?:{_STEM})\.py"
        rf"|(?:.*/)?msg/(?:{'|'.join(MESSAGES)})\.msg"
    )
    return {p: _text(p, t, name, target) for p, t in files.items() if own.fullmatch(p) is None}


def _text(path: str, text: str, name: str, target: str) -> str:
    last = path.rpartition("/")[2]
    of_messages = packages_of(target)[-1]
    if last.endswith(".msg"):
        return re.sub(rf"^{name}(?:_interfaces)?/Timing ", f"{of_messages}/Timing ", text)
    if last == "package.xml":
        return _with_depend(text, _needed(text, name, target))
    if last == "CMakeLists.txt":
        return _cmake(text, _needed(text, name, target), target)
    if last == "ruff.toml":
        return text.replace(
            f'known-first-party = ["{name}"', f'known-first-party = ["{name}", "{NAME}"'
        )
    if path.endswith((".h", ".hpp", ".cpp")):
        return _cpp(text, name, is_header=not path.endswith(".cpp"))
    is_module = path.endswith(".py") or text.startswith("#!")
    return _python(text, name) if is_module else text


def _needed(text: str, name: str, target: str) -> str:
    """Which package of the run-time part a package needs, by its manifest or build file."""
    is_of_messages = f"{name}_interfaces</name>" in text or f"project({name}_interfaces)" in text
    return packages_of(target)[-1] if is_of_messages else NAME


def _with_depend(text: str, needed: str) -> str:
    line = f"  <depend>{needed}</depend>\n"
    depends = re.findall(r"  <depend>.*</depend>\n", text)
    after = [d for d in depends if d > line]
    if after:
        return text.replace(after[0], line + after[0], 1)
    last = depends[-1] if depends else re.findall(r"  <buildtool_depend>.*\n", text)[-1]
    return text.replace(last, last + line, 1)


def _cmake(text: str, needed: str, target: str) -> str:
    text = re.sub(rf'^  "?(?:msg/)?(?:{"|".join(MESSAGES)})\.msg"?\n', "", text, flags=re.MULTILINE)
    if target.startswith("ros1"):
        text = text.replace("generate_messages()", f"generate_messages(DEPENDENCIES {needed})")
        for head in ("find_package(catkin REQUIRED COMPONENTS\n", "  CATKIN_DEPENDS\n"):
            text = _sorted_in(text, head, needed)
        return text
    text = re.sub(
        r"(rosidl_generate_interfaces\([^)]*)\)", rf"\1  DEPENDENCIES {needed}\n)", text, count=1
    )
    threads = "find_package(Threads REQUIRED)\n"
    found = f"find_package({needed} REQUIRED)\n"
    before = threads if threads in text else "\nrosidl_generate_interfaces("
    text = text.replace(before, found + before, 1)
    text = text.replace(
        '  "${own_messages}"\n', f'  ${{{needed}_TARGETS}}\n  "${{own_messages}}"\n'
    )
    if "ament_export_dependencies(\n" in text:
        return _sorted_in(text, "ament_export_dependencies(\n", needed)
    return text.replace("ament_export_dependencies(", f"ament_export_dependencies({needed} ", 1)


def _sorted_in(text: str, head: str, name: str) -> str:
    """A list of CMake, one name a line behind `head`, with one name more."""
    start = text.index(head) + len(head)
    end = text.index(")", start)
    lines = [line for line in text[start:end].split("\n") if line.strip()]
    indent = re.match(r" *", lines[0])
    wanted = f"{indent[0] if indent else ''}{name}"
    at = next((i for i, line in enumerate(lines) if line.lower() > wanted), len(lines))
    lines.insert(at, wanted)
    tail = text[start:end].rpartition("\n")[2]
    return text[:start] + "\n".join(lines) + "\n" + tail + text[end:]


_INCLUDES = re.compile(r'(?:#include "[^"]+"\n)+')
_IMPORTS = re.compile(r"(?:from \S+ import (?:\([^)]*\)|[^\n(]*)\n)+")
_FROM = re.compile(r"from (\S+) import (?:\([^)]*\)|[^\n(]*)\n")


def _cpp(text: str, name: str, *, is_header: bool) -> str:
    text = re.sub(rf'#include "{name}/({_STEM})\.(hp?p?)"', rf'#include "{NAME}/\1.\2"', text)
    text = _INCLUDES.sub(_in_order, text) if NAME in text else text
    text = text.replace(f"{name}::detail::", f"{NAME}::detail::")
    if not is_header or f'"{NAME}/' not in text:
        return text
    opened = f"namespace {name} {{\n"
    using = f"using namespace {NAME};  // NOLINT(build/namespaces)"
    return text.replace(opened, f"{opened}\n{using}\n", 1)


def _in_order(found: re.Match[str]) -> str:
    return "".join(sorted(found[0].splitlines(keepends=True)))


def _python(text: str, name: str) -> str:
    text = re.sub(
        rf"^from {name}\.({_STEM}) import", rf"from {NAME}.\1 import", text, flags=re.MULTILINE
    )
    return _IMPORTS.sub(_modules_in_order, text) if NAME in text else text


def _modules_in_order(found: re.Match[str]) -> str:
    each = list(_FROM.finditer(found[0]))
    return "".join(m[0] for m in sorted(each, key=lambda m: m[1].replace(".", "\0")))
