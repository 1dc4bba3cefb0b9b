"""CMakeLists.txt: which sources make which program."""

from __future__ import annotations

from collections.abc import Mapping
from fnmatch import fnmatchcase

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.reverse.build.build_files import BuildFiles
from rebsync.reverse.build.cmake import read_build
from rebsync.reverse.build.cmake_targets import Folder
from rebsync.reverse.unknowns import Open
from rebsync.source import Source


def build(text: str, files: Mapping[str, str] | None = None) -> BuildFiles:
    """The build files of a package `p`; with `files`, its folder is at hand."""
    texts = files or {}
    folder = Folder(
        load=lambda path: Source(path, texts[path]) if path in texts else None,
        glob=lambda pattern: [f for f in texts if fnmatchcase(f, pattern)] if texts else None,
    )
    return read_build(Source("CMakeLists.txt", f"project(p)\n{text}"), folder)


def sources(found: BuildFiles) -> dict[str | Open, tuple[str, ...]]:
    return {t.file: found.sources_of(t) for t in found.targets if t.executable}


def lines(found: BuildFiles) -> list[tuple[str, int]]:
    return [(u.source.path, u.source.position(u.span.start).line) for u in found.unknowns]


def test_the_name_of_a_program() -> None:
    found = build(
        """
        add_executable(${PROJECT_NAME}_a src/a.cpp  # a comment
          "src/b.cpp" #[[ another ]] )
        SET_TARGET_PROPERTIES(${PROJECT_NAME}_a PROPERTIES OUTPUT_NAME a PREFIX "")
        add_executable(c EXCLUDE_FROM_ALL c.cpp)
        set_property(TARGET c PROPERTY OUTPUT_NAME d)
        """
    )
    assert found.project == "p"
    assert sources(found) == {"a": ("src/a.cpp", "src/b.cpp"), "d": ("c.cpp",)}
    assert found.executable("a") is found.target("p_a")
    assert found.executable("c") is None
    assert not found.unknowns


def test_libraries_of_the_package_count() -> None:
    found = build(
        """
        add_library(base STATIC src/base.cpp)
        add_library(core SHARED src/core.cpp)
        target_link_libraries(core PUBLIC base ${catkin_LIBRARIES} core)
        add_executable(node src/node.cpp)
        target_link_libraries(node core ${catkin_LIBRARIES})
        target_sources(node PRIVATE src/more.cpp)
        """
    )
    node = found.executable("node")
    assert node is not None
    assert found.sources_of(node) == (
        *("src/node.cpp", "src/more.cpp", "src/core.cpp", "src/base.cpp"),
    )
    assert node.missing == ()


def test_variables_and_lists() -> None:
    found = build(
        """
        set(DIR src)
        set(ALL ${DIR}/a.cpp;${DIR}/b.cpp)
        list(APPEND ALL ${PROJECT_SOURCE_DIR}/c.cpp ${CMAKE_CURRENT_SOURCE_DIR}/d.cpp)
        set(WHICH ALL)
        add_executable(n ${${WHICH}} [[e.cpp]] "f\\;g.cpp")
        unset(DIR)
        add_executable(m ${DIR} /elsewhere/x.cpp ../y.cpp $ENV{X} $<1:z.cpp>)
        """
    )
    assert sources(found)["n"] == (
        *("src/a.cpp", "src/b.cpp", "c.cpp", "d.cpp", "e.cpp", "f;g.cpp"),
    )
    missing = found.targets[1].missing
    assert (found.targets[1].sources, len(missing)) == ((), 5)
    assert missing[0].why == "`${DIR}` is not set in the package"


def test_what_a_command_may_have_changed_is_open() -> None:
    found = build("set(A a.cpp)\nstring(REPLACE a b A ${A})\nadd_executable(n ${A})")
    assert found.targets[0].missing == (Open("`string(...)` may have set it"),)


def test_conditions() -> None:
    found = build(
        """
        set(SRC a.cpp)
        if(WITH_B)
          list(APPEND SRC b.cpp)
          add_executable(only b.cpp)
        elseif(X AND (Y OR Z))
          add_executable(other b.cpp)
        else()
          add_executable(last b.cpp)
        endif()
        if(TRUE)
          add_executable(sure a.cpp)
        else()
          add_executable(never a.cpp)
        endif()
        if(WIN32)
          add_executable(windows a.cpp)
        endif()
        set(OFF_ OFF)
        if(NOT OFF_)
          add_executable(too a.cpp)
        endif()
        add_executable(n ${SRC})
        """
    )
    assert {t.name: t.only_if for t in found.targets} == {
        "only": ("if(WITH_B)",),
        "other": ("if(WITH_B) ... elseif(X AND (Y OR Z))",),
        "last": ("if(WITH_B) ... else()",),
        "sure": (),
        "too": (),
        "n": (),
    }
    n = found.target("n")
    assert n is not None
    assert n.missing == (Open("`${SRC}` is set only `if(WITH_B)`"),)


def test_loops_and_macros() -> None:
    found = build(
        """
        macro(node NAME)
          add_executable(${NAME} ${NAME}/${NAME}.cpp ${ARGN})
          set(LAST ${NAME}.h)
        endmacro()
        function(other N)
          set(S ${N}.cpp)
          add_executable(${N} ${S})
          set(BACK back.cpp PARENT_SCOPE)
        endfunction()
        foreach(f a b)
          node(${f} extra.cpp)
        endforeach()
        set(L c d)
        foreach(f IN LISTS L ITEMS e)
          other(${f})
        endforeach()
        add_executable(z ${BACK} ${S})
        add_executable(y ${LAST})
        """
    )
    assert sources(found) == {
        "a": ("a/a.cpp", "extra.cpp"),
        "b": ("b/b.cpp", "extra.cpp"),
        "c": ("c.cpp",),
        "d": ("d.cpp",),
        "e": ("e.cpp",),
        "z": ("back.cpp",),
        "y": ("b.h",),
    }
    assert len(found.targets[-2].missing) == 1
    assert not found.unknowns


def test_globs() -> None:
    text = """
        file(GLOB NODES nodes/*.cpp)
        foreach(file ${NODES})
          get_filename_component(name ${file} NAME_WE)
          add_executable(${name} ${file})
        endforeach()
        """
    files = {"nodes/b.cpp": "", "nodes/a.cpp": "", "src/c.cpp": ""}
    assert sources(build(text, files)) == {"a": ("nodes/a.cpp",), "b": ("nodes/b.cpp",)}
    away = build(text)
    assert not away.targets
    assert [u.why for u in away.unknowns] == ["which files `nodes/*.cpp` finds is not known"]


def test_a_source_without_an_ending() -> None:
    files = {"src/a.h": "", "src/a.cpp": "", "src/b.h": ""}
    assert sources(build("add_executable(n src/a src/b)", files)) == {"n": ("src/a.cpp", "src/b")}


def test_subdirectories() -> None:
    files = {
        "src/CMakeLists.txt": "add_subdirectory(lib)\nadd_executable(n main.cpp)\n"
        "target_link_libraries(n l)\nset(X 1 PARENT_SCOPE)",
        "src/lib/CMakeLists.txt": "add_library(l ../l.cpp ${CMAKE_CURRENT_LIST_DIR}/m.cpp)",
    }
    found = build("add_subdirectory(src)\nadd_executable(${X} a.cpp)", files)
    assert sources(found) == {
        "n": ("src/main.cpp", "src/l.cpp", "src/lib/m.cpp"),
        "1": ("a.cpp",),
    }
    assert [s.path for s in found.sources] == ["CMakeLists.txt", *files]


def test_messages_and_scripts() -> None:
    found = build(
        """
        add_message_files(FILES A.msg B.msg)
        add_service_files(DIRECTORY services FILES C.srv)
        install(TARGETS x RUNTIME DESTINATION bin)
        install(PROGRAMS scripts/a scripts/b DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
        catkin_install_python(PROGRAMS c.py DESTINATION bin)
        """
    )
    assert found.messages == ("msg/A.msg", "msg/B.msg")
    assert found.services == ("services/C.srv",)
    assert found.programs == ("scripts/a", "scripts/b", "c.py")
    every = "add_message_files()"
    assert build(every, {"msg/B.msg": "", "msg/A.msg": ""}).messages == ("msg/A.msg", "msg/B.msg")
    assert lines(build(every)) == [("CMakeLists.txt", 2)]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("add_executable(a a.cpp", 2),
        ('\nadd_executable(a "a.cpp)', 3),
        ("\n\n)", 4),
        ("if(A)\nadd_executable(a)", 3),
        ("endif()", 2),
        ("else()", 2),
        ("foreach(x a)\nendif()", 3),
        ("if(A)\n" * 60 + "endif()\n" * 60, 52),
        ("add_subdirectory(absent)", 2),
        ("add_subdirectory(/absent)", 2),
        ("include(more.cmake)", 2),
        ("add_executable(${X} a.cpp)", 2),
        ("add_executable(a b)\nadd_executable(a c)", 3),
        ("macro(m)\nm()\nendmacro()\nm()", 3),
        ("add_executable(a b)\nset_target_properties(a PROPERTIES OUTPUT_NAME ${X})", 3),
        (
            "add_executable(a b)\nif(X)\n"
            "set_target_properties(a PROPERTIES OUTPUT_NAME c)\nendif()",
            4,
        ),
    ],
)
def test_what_cannot_be_read_has_a_place(text: str, line: int) -> None:
    assert lines(build(text)) == [("CMakeLists.txt", line)]


def test_loops_that_multiply_end() -> None:
    items = " ".join(map(str, range(50)))
    loop = f"foreach(x {items})\n" * 4 + "set(y z)\n" + "endforeach()\n" * 4
    assert lines(build(loop)) == [("CMakeLists.txt", 1)]
    doubled = "".join(f"set(L{i + 1} ${{L{i}}} ${{L{i}}})\n" for i in range(60))
    assert not build(f"set(L0 a b)\n{doubled}").unknowns
    texts = "".join(f'set(T{i + 1} "${{T{i}}}${{T{i}}}")\n' for i in range(60))
    assert not build(f"set(T0 ab)\n{texts}").unknowns


_COMMANDS = st.sampled_from(
    (
        *("set", "list", "add_executable", "add_library", "if", "endif", "else", "foreach"),
        *("endforeach", "macro", "endmacro", "m", "file", "set_target_properties", "install"),
        *("add_message_files", "add_subdirectory", "get_filename_component", "set_property"),
        *("target_link_libraries", "unset", "include", "project", "while", "endwhile"),
    )
)
_WORDS = st.sampled_from(
    (
        *("a", "b", "m", "${a}", "${${b}}", '"x;y"', "PROPERTIES", "OUTPUT_NAME", "APPEND"),
        *("GLOB", "FILES", "PROGRAMS", "IN", "LISTS", "TARGET", "PROPERTY", "NOT", "RANGE"),
        *("PARENT_SCOPE", "DIRECTORY", "NAME_WE", "../..", "/", "", "$<1:a>", "RELATIVE"),
    )
)


@given(st.lists(st.tuples(_COMMANDS, st.lists(_WORDS, max_size=4)), max_size=12))
def test_any_commands_are_carried_out(commands: list[tuple[str, list[str]]]) -> None:
    text = "\n".join(f"{name}({' '.join(words)})" for name, words in commands)
    found = build(text, {"a/CMakeLists.txt": text, "a.msg": ""})
    assert all(str(u) for u in found.unknowns)
    for target in found.targets:
        found.sources_of(target)


@given(st.text() | st.text('ab()[]="\\#${};\n '))
def test_any_text_is_read(text: str) -> None:
    assert all(str(u) for u in build(text).unknowns)
