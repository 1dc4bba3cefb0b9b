"""Every example's package: what is read around the code is what the view of the model wrote."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import parse_config
from rebsync.forward.message_files import field_type
from rebsync.forward.view import view
from rebsync.grammars.parser import parse_model
from rebsync.package import Package
from rebsync.printing import print_line
from rebsync.reverse.build.build_files import BuildFiles
from rebsync.reverse.build.cmake import read_build
from rebsync.reverse.build.manifests import read_manifest
from rebsync.reverse.build.messages import read_message
from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch
from rebsync.source import Source
from rebsync.static import analyse
from tests.regenerate import EXAMPLES, models

NAMES = [m.stem for m in models()]


def source(path: Path) -> Source:
    return Source(str(path), path.read_text(encoding="utf-8"))


def package_of(name: str) -> Package:
    model = parse_model(source(EXAMPLES / name / f"{name}.rebeca")).model
    config = parse_config(source(EXAMPLES / name / "rebsync.toml"))
    return view(model, analyse(model), config, name)[0]


def launch_of(name: str) -> Launch:
    folder = EXAMPLES / name / name
    surroundings = Surroundings(
        load=lambda path: source(Path(path)),
        find=lambda found: str(folder) if found == name else None,
    )
    return read_launch(source(folder / "launch" / f"{name}.launch"), surroundings)


def build_of(name: str) -> BuildFiles:
    return read_build(source(EXAMPLES / name / name / "CMakeLists.txt"))


@pytest.mark.parametrize("name", NAMES)
def test_the_nodes_are_the_instances_of_main(name: str) -> None:
    package, launch = package_of(name), launch_of(name)
    assert not launch.unknowns
    assert all((n.namespace, n.package, n.only_if) == ("/", name, ()) for n in launch.nodes)
    rebecs = launch.nodes[: len(package.instances)]
    for node, instance in zip(rebecs, package.instances, strict=True):
        assert node.name == instance.name
        assert node.type == f"{package.node_class(instance.class_name).file}_node"
        assert node.markers[-1] == f"rebec {instance.rebec}"
        annotations = [f"annotation {print_line(a).strip()}" for a in instance.annotations]
        assert list(node.markers[:-1]) == annotations
        given = [(p.name, p.value, type(p.value)) for p in node.parameters]
        assert given == [(p.key, p.value, type(p.value)) for p in instance.parameters]
        remaps = [(r.private, r.target) for r in node.remaps]
        assert remaps == [(r.private, r.target) for r in instance.remaps]
    assert [(n.name, n.markers) for n in launch.nodes[len(rebecs) :]] == [
        (s.name, (f"stand-in {s.name}",)) for s in package.stand_ins
    ]


@pytest.mark.parametrize("name", NAMES)
def test_global_parameters_are_env_and_settings(name: str) -> None:
    package = package_of(name)
    found = {p.name: p.value for p in launch_of(name).parameters}
    assert {e.key: found[f"/{e.key}"] for e in package.env} == {e.key: e.value for e in package.env}
    assert found["/mailbox/time_unit"] == package.settings.time_unit
    assert found["/mailbox/seed"] == package.settings.seed
    assert found["/mailbox/rebecs"] == tuple(i.name for i in package.instances)


@pytest.mark.parametrize("name", NAMES)
def test_targets_are_the_classes(name: str) -> None:
    package, build = package_of(name), build_of(name)
    assert not build.unknowns
    assert build.project == name
    library = {c.file for c in package.classes if not c.interface}
    for node in package.classes:
        target = build.executable(f"{node.file}_node")
        assert (target is not None) is node.executable
        if target is not None:
            files = {*library, f"{node.file}_node"}
            assert set(build.sources_of(target)) == {f"src/{file}.cpp" for file in files}
    assert {n.type for n in launch_of(name).nodes} <= {t.file for t in build.targets}


@pytest.mark.parametrize("name", NAMES)
def test_messages_are_those_of_the_servers(name: str) -> None:
    package, build = package_of(name), build_of(name)
    folder = EXAMPLES / name / name
    read = {
        path: read_message(source(folder / path), name, Path(path).stem) for path in build.messages
    }
    assert set(build.messages) == {f"msg/{p.name}" for p in (folder / "msg").iterdir()}
    assert not any(message.unknowns for message in read.values())
    for message in package.messages:
        fields = [(f.type, f.name, f.length) for f in read[f"msg/{message.name}.msg"].fields]
        assert (f"{name}/Timing", "timing", None) in fields
        for field in message.fields:
            element, _, length = field_type(field.type).rstrip("]").partition("[")
            assert (element, field.name, int(length) if length else None) in fields


@pytest.mark.parametrize("name", NAMES)
def test_the_manifest_is_that_of_the_configuration(name: str) -> None:
    package = package_of(name)
    found = read_manifest(source(EXAMPLES / name / name / "package.xml"))
    assert not found.unknowns
    assert (found.name, found.version, found.format) == (name, package.version, 2)
    assert (found.description, found.license) == (package.description, package.license)
    assert found.maintainers == package.maintainers
    assert {"diagnostic_msgs", "roscpp", "message_runtime"} <= set(found.depends)
