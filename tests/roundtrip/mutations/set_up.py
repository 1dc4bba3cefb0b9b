"""Changes of what constructors set up: parameters that are computed with, read elsewhere or written
over, so that a member has another value than the model says; constructors of the model that run
twice; members that objects share.
"""

from __future__ import annotations

from tests.roundtrip.mutations.package import Kind, in_files

_CONSTANT = {
    "cpp": r"^(  (\w+_) = )((?:global\.param|declare_parameter<int>)\(\"(?:env\.)?\w+\", .*\));$",
    "py": r"^(        (self\._\w+): int = )((?:rospy\.get_param|declared)\((?:self, )?\"(?!~).*\))",
}
_KNOWN = {
    "cpp": r"^(  (\w+_) = )((?:node\.param|declare_parameter)<std::string>\(\"knownrebecs.*\));$",
    "py": r"^(        (self\._\w+): Rebec\[\w+\] = )(Rebec\((?:.*\)$|\n.*\n +\)))",
}
_ARGUMENT = {  # with the type for which a default of 0 or false stands
    "ros1-cpp": (r"_node.cpp", r"node\.param\(\"\w+\", 0\)"),
    "ros2-cpp": (
        r".cpp",
        r"(?<=const int32_t )(\w+) = declare_parameter<int>\((?:.|\n)*?\)(?=;\n)",
    ),
    "ros1-py": (r"_node", r"rospy\.get_param\(\"~\w+\", 0\)"),
    "ros2-py": (r".py", r"(?<=: int = )declared\(self, \"(?!env)\w+\", 0, .*\)(?=\n)"),
}


def _kind(name: str, suffix: str, row: tuple[str, str]) -> Kind:
    return Kind(name, in_files(suffix, *row, comments=True))


def _of_members(language: str, suffix: str, end: str) -> tuple[Kind, ...]:
    constant, known = _CONSTANT[language], _KNOWN[language]
    again, two = rf"\1\3{end}\n", "  " if language == "cpp" else "        "
    other = '"x"' if language == "cpp" else 'Rebec("x")'
    return (
        _kind("constant computed with", suffix, (constant, rf"\1\3 + 1{end}")),
        _kind("constant written over", suffix, (constant, rf"{again}{two}\2 = 7{end}")),
        _kind("constant computed over", suffix, (constant, rf"{again}{two}\2 = abs(-7){end}")),
        _kind("known rebec written over", suffix, (known, rf"{again}{two}\2 = {other}{end}")),
    )


def _of_arguments(dialect: str) -> tuple[Kind, ...]:
    suffix, pattern = _ARGUMENT[dialect]
    return (_kind("argument computed with", suffix, (pattern, r"\g<0> + 1")),)


_READ = r"^(  (\w+_) = (?:global\.param|declare_parameter<int>)\(\"(?:env\.)?\w+\", "
_CPP = (
    _kind("constructed twice", ".cpp", (r"^(  mailbox_\.construct\(.*\);)$", r"\1\n\1")),
    _kind("no state shown", ".cpp", (r"^  mailbox_\.onServed\(.*\n", "")),
    Kind("member of all objects", in_files(".h", r"^  (int32_t \w+_)\{\};", r"  static \1;")),
    Kind("member of all objects", in_files(".hpp", r"^  (int32_t \w+_)\{\};", r"  static \1;")),
    _kind("state changed in a default", ".cpp", (rf"{_READ})(\d+)", r"\1id_ = \3")),
    _kind("state changed by a default", ".cpp", (rf"{_READ})(\d+)", r"\1next()")),
    _kind("state changed before a constant", ".cpp", (rf"{_READ})", r"  \2 = id_ = 4;\n\1")),
)
_LATE = _kind(
    "set up after the start",
    ".cpp",
    (
        r"^(  mailbox_\.onServed\(.*\n)((?:.*\n)*?)"
        r"(  mailbox_\.construct\(.*\);\n(?:  mailbox_\.start\(\);\n)?)",
        r"\2\3\1",
    ),
)
_EARLY = _kind(
    "started before it is constructed",
    ".cpp",
    (r"^(  mailbox_\.construct\(.*\n)(  mailbox_\.start\(\);\n)", r"\2\1"),
)
_SET_LATE = _kind(
    "state set after the constructor",
    ".py",
    (
        r"^(        self\.(_\w+): (?:int|bool) = (?:0|False)\b.*\n)((?:.*\n)*?)"
        r"(        self\._mailbox\.construct\(.*\n)",
        r"\3\4\1",
    ),
)
_COROUTINE = _kind(
    "server made a coroutine",
    ".py",
    (r"^(    # rebsync: msgsrv \w+\.\w+\n    )(?=def)", r"\1async "),
)
_STAR = _kind("names of a module beside", ".py", (r"^(?=_\w+ = Server)", "from math import *\n"))
_PY = (
    _SET_LATE,
    _COROUTINE,
    _STAR,
    _kind(
        "server made a property",
        ".py",
        (r"^(    # rebsync: msgsrv \w+\.\w+\n)(?=    def)", r"\1    @property\n"),
    ),
)
_VARIABLE = _kind(
    "macro given by a variable of CMake", "CMakeLists.txt", (r"-Wall\b", "-Wall -Dmailbox_=m_")
)
_DEFINITION = _kind(
    "macro given as a definition",
    "CMakeLists.txt",
    (r"\Z", "target_compile_definitions(${PROJECT_NAME}_nodes PRIVATE mailbox_=m_)\n"),
)

KINDS = {
    "ros1-cpp": (
        _LATE,
        *_CPP[:3],
        *_CPP[4:],
        _VARIABLE,
        _DEFINITION,
        *_of_members("cpp", ".cpp", ";"),
        *_of_arguments("ros1-cpp"),
        _kind(
            "constants of a namespace", ".cpp", (r"NodeHandle global;", 'NodeHandle global("a");')
        ),
        _kind(
            "argument of everybody",
            "_node.cpp",
            (r"node\.param\((\"\w+\", 0\))", r"ros::NodeHandle().param(\1"),
        ),
        _kind(
            "constant of one node", ".cpp", (r"global\.param\((\"\w+\", .*\));$", r"node.param(\1;")
        ),
    ),
    "ros2-cpp": (
        _LATE,
        _EARLY,
        *_CPP[:2],
        *_CPP[3:],
        _VARIABLE,
        _DEFINITION,
        *_of_members("cpp", ".cpp", ";"),
        *_of_arguments("ros2-cpp"),
        _kind("argument made a truth", ".cpp", (r"const int32_t (?=\w+ = decl)", "const bool ")),
        _kind("argument made small", ".cpp", (r"const int32_t (?=\w+ = decl)", "const int8_t ")),
    ),
    "ros1-py": (
        *_PY,
        *_of_members("py", ".py", ""),
        *_of_arguments("ros1-py"),
        _kind("argument of everybody", "_node", (r"get_param\(\"~(\w+\", 0\))", r'get_param("\1')),
        _kind(
            "constant of one node", ".py", (r"get_param\(\"(?!~)(\w+\", .*\))", r'get_param("~\1')
        ),
    ),
    "ros2-py": (*_PY, *_of_members("py", ".py", ""), *_of_arguments("ros2-py")),
}
