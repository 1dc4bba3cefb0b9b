"""Which files of a package its build makes programs of, and which files it names."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from rebsync.config import Config
from rebsync.reverse.build.built import unbuilt
from rebsync.reverse.build.cmake import read_build
from rebsync.reverse.build.named import named
from rebsync.source import Source
from tests.forward.compiling import generated

_SETUP = 'setup(entry_points={"console_scripts": ["robot = p.robot:main"]})\n'
_ROBOT = "class Robot {\n};\n"


def package(**texts: str) -> dict[str, Source]:
    """Files by their paths: `__` stands for a slash, `_dot_` for a dot."""
    names = {key.replace("__", "/").replace("_dot_", "."): text for key, text in texts.items()}
    return {name: Source(name, text) for name, text in names.items()}


def cmake(text: str) -> dict[str, Source]:
    """A package with sources, a header of each, and a second definition of each."""
    files = package(
        src__robot_dot_cpp='#include "p/robot.h"\n',
        src__old__robot_dot_cpp='#include "p/robot.h"\n',
        include__p__robot_dot_h=_ROBOT,
        include__p__robot_old_dot_h=_ROBOT,
        include__p__public_dot_h="class Offered {\n};\n",
    )
    return {**files, "CMakeLists.txt": Source("CMakeLists.txt", text)}


_LEFT = {"src/old/robot.cpp", "include/p/robot_old.h"}


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("add_executable(robot src/robot.cpp)", _LEFT),
        ("file(GLOB all src/*.cpp)\nadd_library(robot ${all})", _LEFT),
        ("file(GLOB_RECURSE all src/*.cpp)\nadd_library(robot ${all})", {"include/p/robot_old.h"}),
        ("ament_auto_add_library(robot DIRECTORY src)\nadd_executable(r src/robot.cpp)", set()),
        ("include(more.cmake)\nadd_executable(robot src/robot.cpp)", set()),
        ("find_package(x)\nadd_executable(robot src/robot.cpp ${x_SOURCES})", set()),
        ("set(CMAKE_MODULE_PATH cmake)\ninclude(more)\nadd_executable(r src/robot.cpp)", set()),
        (
            "add_executable(r src/robot.cpp)\n"
            "set_property(TARGET r PROPERTY SOURCES src/old/robot.cpp)",
            set(),
        ),
        ("add_executable(r ./src//robot.cpp)", _LEFT),
        ("add_executable(r ${CMAKE_CURRENT_SOURCE_DIR}/src/robot.cpp)", _LEFT),
        ("project(p)", set()),
    ],
)
def test_sources_that_no_target_compiles(text: str, left: set[str]) -> None:
    assert unbuilt(cmake(text)).left == left


def test_a_source_that_is_needed_and_not_built() -> None:
    files = cmake("add_executable(robot src/robot.cpp)")
    files["src/more.cpp"] = Source("src/more.cpp", "void Robot::go() {\n}\n")
    files["src/own.cpp"] = Source("src/own.cpp", "int main() {\n}\n")
    files["src/idle.cpp"] = Source("src/idle.cpp", "int main() {\n}\n")
    files["p.launch"] = Source("p.launch", '<node type="own"/>')
    assert unbuilt(files).left >= {"src/more.cpp", "src/own.cpp", "src/idle.cpp"}
    assert unbuilt(files).needed == {"src/more.cpp", "src/own.cpp"}


def test_an_include_that_a_macro_names_may_be_any() -> None:
    files = cmake("add_executable(robot src/robot.cpp)")
    files["src/robot.cpp"] = Source("src/robot.cpp", "#include HEADER\n")
    assert unbuilt(files).left == frozenset()


def test_a_source_that_is_included_counts() -> None:
    files = cmake("add_executable(robot src/robot.cpp)")
    files["src/robot.cpp"] = Source("src/robot.cpp", '#include "old/robot.cpp"\n')
    assert "src/old/robot.cpp" not in unbuilt(files).left


def python(robot: str = "", **others: str) -> dict[str, Source]:
    """A package whose program is `p/robot.py`, with a library and copies of it."""
    texts = {
        "p__robot_dot_py": robot or "from p.drive import Drive\n",
        "p__drive_dot_py": "class Drive:\n    pass\n",
        "p__old__drive_dot_py": "class Drive:\n    pass\n",
        "p__offered_dot_py": "class Offered:\n    pass\n",
    }
    return package(**{"setup_dot_py": _SETUP, **texts, **others})


@pytest.mark.parametrize(
    ("files", "left"),
    [
        (python(), {"p/old/drive.py"}),
        (python("from .drive import Drive\n"), {"p/old/drive.py"}),
        (python("from . import drive\n"), {"p/old/drive.py"}),
        (python("import drive\n"), set()),  # either, by where Python looks
        (python("from p.old import drive\nfrom p.drive import Drive\n"), set()),
        (python("import importlib\nfrom p.drive import Drive\n"), set()),
        (python("from p.drive import Drive\nexec(text)\n"), set()),
        (python("import builtins\nfrom p.drive import Drive\nbuiltins.exec(text)\n"), set()),
        (python(p_dot_launch_dot_py='cmd = ["python3", "-m", "p.old.drive"]\n'), set()),
        (python("from p.drive import Drive\nprint 1\n"), set()),  # Python 2
        (python(setup_dot_py="setup(**more)"), set()),  # no program is known
        (python(run_dot_launch='<node type="old.py"/>', old_dot_py="import p.old.drive\n"), set()),
    ],
)
def test_modules_that_no_program_imports(files: Mapping[str, Source], left: set[str]) -> None:
    assert unbuilt(files).left == left


def test_a_script_is_a_program_where_nothing_is_installed() -> None:
    guard = 'if __name__ == "__main__":\n    Robot()\n'
    files = package(
        scripts__node="#!/usr/bin/env python3\nfrom p.robot import Robot\n",
        src__p__robot_dot_py="class Robot:\n    pass\n",
        src__p__robot_old_dot_py="class Robot:\n    pass\n",
        src__p__robot_run_dot_py=f"class Robot:\n    pass\n{guard}",
    )
    assert unbuilt(files).left == {"src/p/robot_old.py"}


def test_the_files_that_a_build_names() -> None:
    text = (
        "project(p)\nadd_executable(robot src/robot.cpp)\n"
        "add_message_files(FILES Go.msg)\n"
        'rosidl_generate_interfaces(p "srv/Ask.srv" DEPENDENCIES x)\n'
        "catkin_install_python(PROGRAMS scripts/run DESTINATION bin)\n"
    )
    manifest = "<package><name>p</name></package>"
    files = package(
        CMakeLists_dot_txt=text,
        setup_dot_py='data_files=[("x", [f"resource/{name}"])]\n',
        package_dot_xml=manifest,
    )
    found = [(each.path, each.source.position(each.span.start).line) for each in named(files)]
    assert found == [
        ("src/robot.cpp", 2),
        ("msg/Go.msg", 3),
        ("srv/Ask.srv", 4),
        ("scripts/run", 5),
        ("resource/p", 1),
    ]


_SERVED = """
@Robot reactiveclass Robot(5) {
  @Sensor msgsrv scan(int range) { }
  msgsrv go() { @Move(X+1, Y); self.go() after(1); }
}
main { Robot r():(); }
"""


@pytest.mark.parametrize(
    ("target", "lifecycle"), [("ros1-cpp", False), ("ros2-cpp", False), ("ros2-cpp", True)]
)
def test_the_builds_of_generated_packages_are_wholly_known(target: str, lifecycle: bool) -> None:
    config = Config(target=target, lifecycle=lifecycle, copyright="2026 Ada")
    text = generated(_SERVED, "p", config)["CMakeLists.txt"]
    found = read_build(Source("CMakeLists.txt", text))
    assert found.foreign == frozenset() and found.unknowns == () and found.is_closed
