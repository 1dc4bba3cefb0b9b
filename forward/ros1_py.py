"""ROS 1 Python (rospy, Noetic): a package value as the files of a catkin package."""

from __future__ import annotations

from rebsync.forward.message_files import action_names, message_files, message_names, service_names
from rebsync.forward.py_class import PyClass
from rebsync.forward.py_classes import classes
from rebsync.forward.py_imports import imports, words_of
from rebsync.forward.py_module import VALUES, class_module, sensors_module
from rebsync.forward.py_types import from_message, plain_type, py_choices, py_format, py_value
from rebsync.forward.py_wiring import constructor_of
from rebsync.forward.readme import readme
from rebsync.forward.remarks import Remarks
from rebsync.forward.ros1_package import launch_file, parameters
from rebsync.forward.runtime_part import action_packages, message_packages, python_runtime
from rebsync.forward.sensors import played_sensors
from rebsync.forward.templating import fill
from rebsync.forward.topics import Topics
from rebsync.model import Type
from rebsync.package import GlobalParameter, NodeClass, Offer, Package
from rebsync.static import Analysis

_SENSORS = "src/{package}/{file}_sensors.py"
_FOLDER = "ros1_py"
_ROS: dict[str, tuple[str, ...]] = {"rospy": ()}


class Rospy:
    """The words of rospy."""

    def mailbox(self, arguments: str) -> str:
        return f"Mailbox({arguments})"

    def private(self, topic: str) -> str:
        return f"~{topic}"

    def drive(self) -> str:
        return "Drive(self._mailbox)"

    def sensor(self, topic: str, type_: str) -> str:
        return f'Sensor("~{topic}", {type_})'

    def known(self, key: str) -> str:
        return f'Rebec(rospy.get_param("~{key}", ""))'

    def env(self, env: GlobalParameter) -> str:
        value = py_value(env.value)
        if env.type.dimensions:
            lengths = ", ".join(map(str, env.type.dimensions))
            return f'read_array("{env.key}", {value}, {py_format(env.type)}, {lengths})'
        read = f'rospy.get_param("{env.key}", {value})'
        whole = env.type.name in ("int", "boolean")
        return read if whole else f"{py_format(env.type)}({read})"

    def state(self, type_: str) -> str:
        return f'rospy.Publisher("~state", {type_}, queue_size=QUEUE_SIZE, latch=True)'

    def messages(self, package: str) -> str:
        return f"{package}.msg"

    def base(self) -> str:
        return ""

    def offers(self, package: str, is_action: bool) -> str:
        return f"{package}.{'msg' if is_action else 'srv'}"

    def offer(self, offer: Offer) -> str:
        return f"{offer.type}{'Action' * offer.is_action}"

    def argument(self, key: str, type_: Type) -> None:
        return None


def render(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, model_name: str
) -> dict[str, str]:
    """The files of the package by path, relative to its folder."""
    source, words = f"src/{package.name}", Rospy()
    files: dict[str, str] = {
        "package.xml": fill(
            f"{_FOLDER}/package.xml.j2", package=package, depends=depends_of(package)
        ),
        "setup.py": fill(f"{_FOLDER}/setup.py.j2", package=package.name),
        "ruff.toml": fill("py/ruff.toml.j2", packages=[package.name]),
        "README.md": readme(package, model_name, _FOLDER, _SENSORS),
        f"launch/{package.name}.launch": launch_file(package),
        "config/params.yaml": parameters(package),
        f"{source}/__init__.py": f'"""The rebecs of {model_name} as ROS nodes."""\n',
    }
    files.update(message_files(package))
    files.update(python_runtime(package, _FOLDER, source))
    for c in classes(package, analysis, topics, remarks).values():
        files[f"{source}/{c.node.file}.py"] = class_module(c, words, model_name, _ROS)
        if c.node.executable:
            files[f"scripts/{c.node.file}_node"] = _node(c)
        if any(s.draws for s in c.node.sensors):
            files[f"{source}/{c.node.file}_sensors.py"] = sensors_module(c, words)
        if any(s.stands_in for s in c.node.sensors):
            files[f"scripts/{c.node.file}_stand_in"] = _stand_in(package, c.node)
    if package.monitored:
        from rebsync.forward.monitor import python_monitor

        files.update(python_monitor(package, analysis, _FOLDER, source, model_name))
    scripts = sorted(p for p in files if p.startswith("scripts/"))
    files["CMakeLists.txt"] = _cmake_lists(package, scripts)
    return dict(sorted(files.items()))


def depends_of(package: Package) -> list[str]:
    """The packages that the nodes need."""
    return sorted({"rosgraph_msgs", "rospy"} | message_packages(package) | action_packages(package))


def _cmake_lists(package: Package, scripts: list[str]) -> str:
    depends = depends_of(package)
    return fill(
        f"{_FOLDER}/CMakeLists.txt.j2",
        package=package.name,
        build_depends=sorted([*depends, "message_generation"]),
        run_depends=sorted([*depends, "message_runtime"]),
        messages=message_names(package),
        services=service_names(package),
        actions=action_names(package),
        scripts=scripts,
    )


def _node(c: PyClass) -> str:
    """`scripts/<class>_node`: reads the constructor's arguments and runs one rebec."""
    constructor = constructor_of(c)
    pairs = zip(constructor.keys, constructor.parameters, strict=True)
    arguments = [_argument(key, parameter.type) for key, parameter in pairs]
    return fill(
        f"{_FOLDER}/node.j2",
        c=c,
        package=c.package.name,
        arguments=arguments,
        formats=imports(words_of(arguments), {f"{c.package.name}.values": VALUES}),
    )


def _argument(key: str, type_: Type) -> str:
    """A private parameter as an argument of the constructor."""
    unset = '""' if plain_type(type_) == "Rebec" else "False" if type_.name == "boolean" else "0"
    read = f'rospy.get_param("~{key}", {unset})'
    if type_.name in ("int", "boolean"):
        return read
    if plain_type(type_) == "Rebec":
        return from_message(read, type_)
    return f"{py_format(type_)}({read})"


def _stand_in(package: Package, node: NodeClass) -> str:
    sensors = played_sensors(node, py_choices)
    types = {s.type for s in sensors}
    found = imports(types, {f"{package.name}.msg": types})
    return fill(f"{_FOLDER}/stand_in.j2", imports=found, node=node, sensors=sensors)
