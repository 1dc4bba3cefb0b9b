"""The monitor of a package: a node that compares a run of the system with the model."""

from __future__ import annotations

from rebsync.forward.cpp_words import CppWords
from rebsync.forward.monitor_model import MonitorModel, cpp_tables, monitor_model, python_tables
from rebsync.forward.runtime_part import is_timed
from rebsync.forward.templating import fill
from rebsync.package import Package
from rebsync.static import Analysis

_CORE = ("monitor_machine", "monitor_run")


def cpp_monitor(
    package: Package, analysis: Analysis, words: CppWords, model_name: str
) -> dict[str, str]:
    """Its files in C++ by path: three headers without ROS, the node, the launch file."""
    model = monitor_model(package, analysis)
    include, header, name = f"include/{package.name}", words.HEADER, package.name
    files = {
        f"{include}/{stem}.{header}": fill(
            f"cpp/{stem}.h.j2", package=name, guard=words.guard(name, stem), header=header
        )
        for stem in _CORE
    }
    guard = words.guard(name, "monitor_model")
    tables = cpp_tables(model, name, model_name, guard, header)
    files[f"{include}/monitor_model.{header}"] = tables
    files["src/monitor_node.cpp"] = fill(
        f"{words.TEMPLATES}/monitor_node.cpp.j2",
        **_about(package, model, model_name),
        states=[(i, r, words.message(r.state_type)) for i, r in enumerate(model.rebecs)],
        includes=sorted({words.message_header(name, r.state_type) for r in model.rebecs}),
        fields={r.state_type: [v.name for v in r.state] for r in model.rebecs},
    )
    is_ros2 = words.TEMPLATES.startswith("ros2")
    return files | _launch(package, model_name, is_ros2)


def python_monitor(
    package: Package, analysis: Analysis, dialect: str, folder: str, model_name: str
) -> dict[str, str]:
    """Its files in Python by path: three modules without ROS in a folder, node and launch file.

    In ROS 2 the launch file is beside that folder.
    """
    model = monitor_model(package, analysis)
    files = {f"{folder}/{s}.py": fill(f"py/{s}.py.j2", package=package.name) for s in _CORE}
    files[f"{folder}/monitor_model.py"] = python_tables(model, package.name, model_name)
    is_ros2 = dialect.startswith("ros2")
    node = fill(
        f"{dialect}/monitor_node.py.j2",
        **_about(package, model, model_name),
        types=sorted({r.state_type for r in model.rebecs}),
        states=[r.state_type for r in model.rebecs],
    )
    files[f"{folder}/monitor_node.py" if is_ros2 else "scripts/monitor_node"] = node
    launch = _launch(package, model_name, is_ros2)
    return files | {f"{package.name}/{p}" if is_ros2 else p: t for p, t in launch.items()}


def _about(package: Package, model: MonitorModel, model_name: str) -> dict[str, object]:
    unheralded = [i for i, r in enumerate(model.rebecs) if r.rebec.constructor < 0]
    return {
        "package": package.name,
        "name": model_name,
        "node": package.monitor_node,
        "timed": is_timed(package),
        "unheralded": unheralded,
    }


def _launch(package: Package, model_name: str, is_ros2: bool) -> dict[str, str]:
    """The launch file, which is one of its own: a robot runs without a monitor as well."""
    name = "monitor.launch.py" if is_ros2 else "monitor.launch"
    folder = "ros2_cpp" if is_ros2 else "ros1_cpp"
    text = fill(
        f"{folder}/{name}.j2", package=package.name, name=model_name, node=package.monitor_node
    )
    return {f"launch/{name}": text}
