"""ROS 2 Python (rclpy, Humble and later): a package of nodes, and one of their messages."""

from __future__ import annotations

from dataclasses import replace

from rebsync.forward.headers import unchecked
from rebsync.forward.message_files import action_names, message_files, message_names, service_names
from rebsync.forward.py_class import PyClass
from rebsync.forward.py_classes import classes
from rebsync.forward.py_imports import imports
from rebsync.forward.py_module import class_module, sensors_module
from rebsync.forward.py_types import plain_type, py_choices, py_format, py_value
from rebsync.forward.readme import readme
from rebsync.forward.remarks import Remarks
from rebsync.forward.ros2_package import launch_file, parameters
from rebsync.forward.runtime_part import message_packages, python_runtime
from rebsync.forward.sensors import played_sensors
from rebsync.forward.templating import fill
from rebsync.forward.topics import Topics
from rebsync.model import Type
from rebsync.package import GlobalParameter, NodeClass, Offer, Package
from rebsync.static import Analysis

_SENSORS = "{package}/{package}/{file}_sensors.py"
_FOLDER = "ros2_py"
_ROS = {"rclpy.node": ("Node",)}
_ENV = "constant of the model"


def interfaces(package: str) -> str:
    """The package of the messages."""
    return f"{package}_interfaces"


class Rclpy:
    """The words of rclpy; `node` is the class that those of rebecs derive from."""

    def __init__(self, node: str = "Node") -> None:
        self._node = node

    def messages(self, package: str) -> str:
        return f"{interfaces(package)}.msg"

    def base(self) -> str:
        return self._node

    def offers(self, package: str, is_action: bool) -> str:
        return f"{interfaces(package)}.{'action' if is_action else 'srv'}"

    def offer(self, offer: Offer) -> str:
        return offer.type

    def argument(self, key: str, type_: Type) -> tuple[str, list[str]]:
        kind = plain_type(type_)
        unset = {"Rebec": '""', "bool": "False", "Float": "0.0", "float": "0.0"}.get(kind, "0")
        given = ["self", f'"{_dotted(key)}"', unset, '"argument of the constructor"']
        read = f"declared({', '.join(given)})"
        if kind in ("int", "bool", "float"):
            return "declared", given
        return ("Rebec" if kind == "Rebec" else py_format(type_)), [read]

    def mailbox(self, arguments: str) -> str:
        return f"Mailbox(self, {arguments})"

    def private(self, topic: str) -> str:
        return f"~/{topic}"

    def drive(self) -> str:
        return "Drive(self, self._mailbox)"

    def sensor(self, topic: str, type_: str) -> str:
        return f'Sensor(self, "~/{topic}", {type_})'

    def known(self, key: str) -> str:
        return f'Rebec(declared(self, "{_dotted(key)}", "", "known rebec"))'

    def env(self, env: GlobalParameter) -> str:
        value, key = py_value(env.value), f"env.{env.key}"
        if env.type.dimensions:
            lengths = ", ".join(map(str, env.type.dimensions))
            return f'declare_array(self, "{key}", {value}, {py_format(env.type)}, {lengths})'
        read = f'declared(self, "{key}", {value}, "{_ENV}")'
        whole = env.type.name in ("int", "boolean", "double")
        return read if whole else f"{py_format(env.type)}({read})"

    def state(self, type_: str) -> str:
        return f'self.create_publisher({type_}, "~/state", KEPT)'


def _dotted(key: str) -> str:
    return key.replace("/", ".")


def render(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, model_name: str
) -> dict[str, str]:
    """The files of the two packages by path, relative to the folder that holds them."""
    name = package.name
    words = Rclpy("RebecNode" if package.settings.lifecycle else "Node")
    files: dict[str, str] = {
        "README.md": readme(package, model_name, _FOLDER, _SENSORS),
        f"{name}/package.xml": fill(
            f"{_FOLDER}/package.xml.j2", package=package, depends=_depends(package)
        ),
        f"{name}/setup.cfg": fill(f"{_FOLDER}/setup.cfg.j2", package=name),
        f"{name}/.flake8": fill("py/flake8.j2"),
        f"{name}/test/test_style.py": fill(
            f"{_FOLDER}/test_style.py.j2", unchecked=unchecked(package)
        ),
        f"{name}/ruff.toml": fill("py/ruff.toml.j2", packages=[name, interfaces(name)]),
        f"{name}/resource/{name}": "\n",
        f"{name}/launch/{name}.launch.py": launch_file(package),
        f"{name}/config/params.yaml": parameters(package),
        f"{name}/{name}/__init__.py": f'"""The rebecs of {model_name} as ROS nodes."""\n',
    }
    files.update(_interfaces(package))
    files.update(python_runtime(package, _FOLDER, f"{name}/{name}"))
    for c in classes(package, analysis, topics, remarks).values():
        module = f"{name}/{name}/{c.node.file}"
        files[f"{module}.py"] = class_module(c, words, model_name, _ROS)
        if c.node.executable:
            files[f"{module}_node.py"] = _node(c)
        if any(s.draws for s in c.node.sensors):
            files[f"{module}_sensors.py"] = sensors_module(c, words)
        if any(s.stands_in for s in c.node.sensors):
            files[f"{module}_stand_in.py"] = _stand_in(package, c.node)
    if package.monitored:
        from rebsync.forward.monitor import python_monitor

        files.update(python_monitor(package, analysis, _FOLDER, f"{name}/{name}", model_name))
    files[f"{name}/setup.py"] = _setup(package)
    return dict(sorted(files.items()))


def _interfaces(package: Package) -> dict[str, str]:
    """The package of the messages, for ament_cmake: rosidl has no other way."""
    own = replace(package, name=interfaces(package.name))
    files = {
        "package.xml": fill(f"{_FOLDER}/interfaces.xml.j2", package=own, actions=package.actions),
        "CMakeLists.txt": fill(
            f"{_FOLDER}/CMakeLists.txt.j2",
            package=own.name,
            messages=message_names(package),
            services=service_names(package),
            actions=action_names(package),
        ),
        **message_files(own),
    }
    return {f"{own.name}/{path}": text for path, text in files.items()}


def _depends(package: Package) -> list[str]:
    own = {"rcl_interfaces", "rclpy", interfaces(package.name)}
    own |= {"lifecycle_msgs"} if package.settings.lifecycle else set()
    return sorted(own | message_packages(package))


def _setup(package: Package) -> str:
    return fill(f"{_FOLDER}/setup.py.j2", package=package, executables=package.executables)


def _node(c: PyClass) -> str:
    """`<class>_node.py`: runs one rebec."""
    package = c.package.name
    modules: dict[str, tuple[str, ...]] = {
        f"{package}.{c.node.file}": (c.type_name,),
        f"{package}.startup": ("stoppable",),
    }
    if lifecycle := c.package.settings.lifecycle:
        modules[f"{package}.lifecycle"] = ("Managed",)
    used = {c.type_name, "stoppable", "Managed"}
    found = imports(used, dict(sorted(modules.items())))
    return fill(f"{_FOLDER}/node.py.j2", c=c, imports=found, lifecycle=lifecycle)


def _stand_in(package: Package, node: NodeClass) -> str:
    sensors = played_sensors(node, py_choices)
    types = {s.type for s in sensors}
    found = imports(types, {f"{interfaces(package.name)}.msg": types})
    return fill(
        f"{_FOLDER}/stand_in.py.j2",
        package=package.name,
        imports=found,
        node=node,
        sensors=sensors,
    )
