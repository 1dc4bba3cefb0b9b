"""The commands of CMake that make and name targets, list messages, and install scripts."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Sequence
from dataclasses import field, replace

from rebsync.records import dataclass
from rebsync.reverse.build.build_files import BuildTarget
from rebsync.reverse.build.cmake_text import Command
from rebsync.reverse.build.cmake_values import CmakeVariables, Unset, known, sections
from rebsync.reverse.libraries.cpp import registering_in_builds
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source

EXECUTABLE = frozenset({"add_executable", "cuda_add_executable", "rosbuild_add_executable"})
LIBRARY = frozenset({"add_library", "cuda_add_library", "rosbuild_add_library"})
_ENDINGS = (".c", ".C", ".c++", ".cc", ".cpp", ".cxx", ".cu")
_INTERFACES = {
    "add_message_files": "msg",
    "add_service_files": "srv",
    "add_action_files": "action",
}
_OF_INTERFACES = ("FILES", "DIRECTORY", "PACKAGE", "NOINSTALL", "BASE_DIR")
_OF_ROSIDL = (
    *("DEPENDENCIES", "LIBRARY_NAME", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK"),
    "ADD_LINTER_TESTS",
)
_LIKE_LIBRARY = frozenset({"IMPORTED", "ALIAS"})
_KINDS = frozenset(
    {
        *("WIN32", "MACOSX_BUNDLE", "EXCLUDE_FROM_ALL"),
        *("STATIC", "SHARED", "MODULE", "OBJECT", "INTERFACE"),
    }
)
_VISIBILITY = frozenset(
    {
        *("PRIVATE", "PUBLIC", "INTERFACE", "LINK_PRIVATE", "LINK_PUBLIC"),
        *("debug", "optimized", "general"),
    }
)
_INSTALL = frozenset(
    {
        *("TARGETS", "FILES", "PROGRAMS", "DIRECTORY", "DESTINATION", "TYPE", "PERMISSIONS"),
        *("COMPONENT", "RENAME", "OPTIONAL", "CONFIGURATIONS", "PATTERN", "SCRIPT", "CODE"),
        *("EXPORT", "EXCLUDE_FROM_ALL"),
    }
)
# Commands that make no program of a package and name no source of one.
TARGETLESS = frozenset(
    {
        *("cmake_minimum_required", "cmake_policy", "enable_language", "enable_testing"),
        *("find_file", "find_library", "find_path", "find_program", "include_directories"),
        *("add_compile_definitions", "add_compile_options", "add_definitions", "add_dependencies"),
        *("add_link_options", "add_test", "link_directories", "link_libraries", "message"),
        *("option", "math", "string", "separate_arguments", "mark_as_advanced", "return"),
        *("set_property", "set_source_files_properties", "set_directory_properties"),
        *("set_target_properties", "set_tests_properties", "get_property", "get_target_property"),
        *("target_compile_definitions", "target_compile_features", "target_compile_options"),
        *("target_include_directories", "target_link_directories", "target_link_options"),
        *("configure_file", "export", "pkg_check_modules"),
        *("execute_process", "include_guard", "site_name", "variable_watch", "break", "continue"),
        *("catkin_package", "catkin_metapackage", "catkin_python_setup", "catkin_install_python"),
        *("catkin_add_env_hooks", "catkin_add_gtest", "catkin_add_gmock", "catkin_add_nosetests"),
        *("catkin_add_executable_with_gtest", "catkin_add_executable_with_gmock"),
        *("add_rostest", "add_rostest_gtest", "add_rostest_gmock", "roslaunch_add_file_check"),
        *("roslint_cpp", "roslint_python", "roslint_add_test", "roslint_custom"),
        *("generate_messages", "generate_dynamic_reconfigure_options"),
        *("ament_package", "ament_target_dependencies", "ament_environment_hooks"),
        *(
            "ament_export_dependencies",
            "ament_export_include_directories",
            "ament_export_libraries",
        ),
        *("ament_export_targets", "ament_export_interfaces", "ament_export_definitions"),
        *("ament_export_link_flags", "ament_python_install_package", "ament_python_install_module"),
        *("ament_lint_auto_find_test_dependencies", "ament_copyright", "ament_cpplint"),
        *("ament_clang_format", "ament_cppcheck", "ament_flake8", "ament_lint_cmake"),
        *("ament_pep257", "ament_uncrustify", "ament_xmllint", "ament_find_gtest"),
        *("ament_add_gtest", "ament_add_gtest_test", "ament_add_gmock", "ament_add_pytest_test"),
        *("ament_add_test", "ament_index_register_resource", "ament_register_extension"),
        *("rosidl_target_interfaces", "rosidl_get_typesupport_target"),
        *("pluginlib_export_plugin_description_file",),
        *registering_in_builds(),
    }
)


# Those of them that make programs which only test, of the sources that they name.
TESTING = frozenset(
    {
        *("catkin_add_gtest", "catkin_add_gmock", "add_rostest_gtest", "add_rostest_gmock"),
        *("catkin_add_executable_with_gtest", "catkin_add_executable_with_gmock"),
        *("ament_add_gtest", "ament_add_gmock"),
    }
)


def _nothing(_: str) -> None:
    return None


@dataclass(frozen=True, slots=True)
class Folder:
    """The folder of a package: `load` gives the text of a path in it, `glob` what a pattern finds.

    Each gives None for what is not at hand; paths are relative to the folder.
    """

    load: Callable[[str], Source | None] = _nothing
    glob: Callable[[str], Sequence[str] | None] = _nothing


@dataclass(frozen=True, slots=True)
class Invocation:
    """A command with its words, and the variables and the file it stands in."""

    command: Command
    words: list[Text]
    variables: CmakeVariables
    source: Source


@dataclass(slots=True)
class Maker:
    """Collects what the commands of a package make, in the order of the commands.

    `only_if` are the conditions around the command at hand.
    """

    folder: Folder
    targets: dict[str, BuildTarget] = field(default_factory=dict)
    programs: list[str] = field(default_factory=list)
    interfaces: dict[str, list[str]] = field(
        default_factory=lambda: {"msg": [], "srv": [], "action": []}
    )
    unknowns: list[Unknown] = field(default_factory=list)
    foreign: set[str] = field(default_factory=set)
    packages: set[str] = field(default_factory=set)
    tests: set[str] = field(default_factory=set)
    only_if: tuple[str, ...] = ()

    def unknown(self, what: str, why: str, call: Invocation) -> None:
        """Notes something that cannot be known or read."""
        self.unknowns.append(Unknown(what, why, call.source, call.command.span))

    # --- targets ----------------------------------------------------------------------------------

    def target(self, call: Invocation) -> None:
        """Takes an executable or library in."""
        name = call.words[0] if call.words else Open("it has no name")
        if isinstance(name, Open):
            self.unknown("a target", name.why, call)
            return
        if _LIKE_LIBRARY & set(known(call.words)):
            return
        executable, span = call.command.name in EXECUTABLE, call.command.span
        target = BuildTarget(name, executable, name, (), (), (), self.only_if, call.source, span)
        rest = [word for word in call.words[1:] if word not in _KINDS]
        target = _with_sources(target, rest, call.variables, self.folder)
        earlier = self.targets.get(name)
        if earlier is not None:
            why = "two targets have this name; their sources are taken together"
            self.unknown(f"the target `{name}`", why, call)
            target = replace(
                earlier,
                sources=tuple(dict.fromkeys((*earlier.sources, *target.sources))),
                missing=(*earlier.missing, *target.missing),
            )
        self.targets[name] = target

    def extend(self, call: Invocation) -> None:
        """Gives a target more sources (`target_sources`) or libraries."""
        words = call.words
        target = self.targets.get(words[0]) if words and isinstance(words[0], str) else None
        if target is None:
            return
        rest = [word for word in words[1:] if word not in _VISIBILITY]
        if call.command.name == "target_sources":
            self.targets[target.name] = _with_sources(target, rest, call.variables, self.folder)
        else:
            # what is set outside of the package names no target of it
            opens = (w for w in rest if isinstance(w, Open) and not isinstance(w, Unset))
            self.targets[target.name] = replace(
                target,
                links=(*target.links, *known(rest)),
                missing=(*target.missing, *opens),
            )

    def rename(self, call: Invocation, names: Sequence[Text], properties: Sequence[Text]) -> None:
        """Takes in the properties that name the program of a target."""
        if "SOURCES" in properties or "INTERFACE_SOURCES" in properties:
            self.foreign.add(call.command.name)
        values = dict(zip(properties[::2], properties[1::2], strict=False))
        output = values.get("RUNTIME_OUTPUT_NAME", values.get("OUTPUT_NAME"))
        prefix = values.get("PREFIX", "")
        if output is None and not prefix:
            return
        for target in filter(None, map(self.targets.get, known(names))):
            name = target.file if output is None else output
            opens = [text for text in (prefix, name) if isinstance(text, Open)]
            if self.only_if != target.only_if:
                where = " ".join(self.only_if) or "in other cases"
                opens.append(Open(f"its name is changed only `{where}`"))
            if opens:
                self.unknown(f"the program of `{target.name}`", opens[0].why, call)
            file: Text = opens[0] if opens else "".join(known((prefix, name)))
            self.targets[target.name] = replace(target, file=file)

    # --- messages and scripts ---------------------------------------------------------------------

    def interface(self, call: Invocation) -> None:
        """Takes the files of `add_message_files` and its like in."""
        kind = _INTERFACES[call.command.name]
        parts = sections(call.words, _OF_INTERFACES)
        folder = (parts.get("DIRECTORY") or [kind])[0]
        for path in self._interface_paths(kind, folder, parts.get("FILES"), call):
            if isinstance(path, Open):
                self.unknown(f"a .{kind} file of the package", path.why, call)
            else:
                self.interfaces[kind].append(path)

    def rosidl(self, call: Invocation) -> None:
        """Takes the files of `rosidl_generate_interfaces` in."""
        for word in sections(call.words[1:], _OF_ROSIDL).get("", []):
            path = word if isinstance(word, Open) else call.variables.path(word)
            if isinstance(path, Open):
                self.unknown("an interface of the package", path.why, call)
            elif (kind := path.rpartition(".")[2]) in self.interfaces:
                self.interfaces[kind].append(path)

    def _interface_paths(
        self, kind: str, folder: Text, names: list[Text] | None, call: Invocation
    ) -> list[Text]:
        if isinstance(folder, Open):
            return [folder]
        if names is None:
            pattern = posixpath.join(folder, f"*.{kind}")
            found = self.folder.glob(posixpath.join(call.variables.folder, pattern))
            unknown = Open(f"which files `{pattern}` finds is not known")
            return [unknown] if found is None else [*sorted(found)]
        return [
            name if isinstance(name, Open) else call.variables.path(posixpath.join(folder, name))
            for name in names
        ]

    def install(self, call: Invocation) -> None:
        """Takes the scripts that are installed in."""
        for word in sections(call.words, _INSTALL).get("PROGRAMS", []):
            path = word if isinstance(word, Open) else call.variables.path(word)
            if isinstance(path, Open):
                self.unknown("a script of the package", path.why, call)
            else:
                self.programs.append(path)


def _with_sources(
    target: BuildTarget, words: list[Text], variables: CmakeVariables, folder: Folder
) -> BuildTarget:
    paths = [word if isinstance(word, Open) else variables.path(word) for word in words]
    paths = [path if isinstance(path, Open) else _with_ending(path, folder) for path in paths]
    return replace(
        target,
        sources=(*target.sources, *known(paths)),
        missing=(*target.missing, *(path for path in paths if isinstance(path, Open))),
    )


def _with_ending(path: str, folder: Folder) -> str:
    """The file that CMake takes for a source without an ending: the first that is there."""
    if "." in posixpath.basename(path):
        return path
    found = folder.glob(f"{path}.*") or ()
    return next((path + ending for ending in _ENDINGS if path + ending in found), path)
