"""The facts of a CMakeLists.txt: programs and their sources, options, what is installed."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence

from rebsync.reverse.build.cmake_targets import EXECUTABLE, LIBRARY, TARGETLESS
from rebsync.reverse.build.cmake_text import Command, CommandBlock, Item, read_cmake
from rebsync.reverse.scaffold.build_lists import ConstantLists
from rebsync.reverse.scaffold.fact import OWN, Fact
from rebsync.reverse.scaffold.installs import installed
from rebsync.reverse.scaffold.texts import squeezed
from rebsync.source import Source, Span

# Options stand alone, in a list, or in a generator expression: `$<$<CONFIG:Debug>:-DX>`.
_OPTION = re.compile(
    r"(?:^|[\s\";:])((?:-D|-U|-f|-include|-I|-isystem|-iquote|-Wp,|-x(?=\s)|-Ofast|-specs=|-m(?:16|32|x32)\b"
    r"|--(?:define-macro|undefine-macro|include)|@(?=[\w./$]))\s*[^\s\";]*)"
)
# What finds mistakes, measures, or says where code is laid: what the code means stays.
_CALM = re.compile(
    r"--coverage|-f(?:no-)?sanitize=(?:(?:address|undefined|thread|leak),?)+|-fno-omit-frame-pointer"
    r"|-fdiagnostics-\S+|-fPIC|-fstack-protector(?:-strong|-all)?|-fstack-clash-protection"
    r"|-fcf-protection|-fprofile-arcs|-ftest-coverage|-flto(?:=\w+)?|-pthread"
    r"|-Wl,--(?:as-needed|no-undefined)|-Wl,-z,(?:relro|now|defs)"
)
_LINKS = frozenset({"add_link_options", "target_link_options"})
_COMMAND = "COMMAND"
_CHANGING = frozenset(
    {"configure_file", "add_custom_command", "link_libraries", "add_link_options"}
    | {"target_precompile_headers", "link_directories", "target_link_directories"}
    | {"target_link_options", "cmake_language", "write_file", "exec_program"}
    | {"ament_environment_hooks", "catkin_add_env_hooks"}
)
_LINKING = frozenset(
    {"CMAKE_EXE_LINKER_FLAGS", "CMAKE_SHARED_LINKER_FLAGS", "CMAKE_CXX_STANDARD_LIBRARIES"}
    | {"CMAKE_CXX_COMPILER", "CMAKE_TOOLCHAIN_FILE", "CMAKE_PROJECT_INCLUDE"}
)
# Variables and properties by which something else is run or compiled than the file says.
_STEERING = re.compile(
    r".*_LAUNCHER|RULE_LAUNCH_\w+|CMAKE_\w+_COMPILE(?:R|_OBJECT)|LANGUAGE|HEADER_FILE_ONLY"
    r"|EXTERNAL_OBJECT|GENERATED|EXCLUDE_FROM_ALL|(?:\w+_)?INCLUDE_DIRECTORIES"
    r"|CMAKE_(?:UNITY_BUILD\w*|PRECOMPILE_HEADERS|LINK_\w+|MODULE_PATH|PREFIX_PATH|FIND_\w+|AUTO\w+)"
    r"|PROJECT_NAME|CATKIN_\w+_DESTINATION|CMAKE_(?:EXECUTABLE_SUFFIX\w*|INSTALL_PREFIX)"
    r"|(?:catkin|ros(?:cpp|idl_\w+)|rcl\w+|ament_\w+|message_\w+|\w+_msgs|\w+_interfaces)_(?:DIR|ROOT)"
)
# Properties of targets, and variables that these get them from, that change nothing of what is run.
_CALM_PROPERTY = re.compile(
    r"(?:CMAKE_)?(?:OUTPUT_NAME|PREFIX|SUFFIX|(?:SO)?VERSION|POSITION_INDEPENDENT_CODE|\w*_POSTFIX|FOLDER"
    r"|(?:ARCHIVE|LIBRARY|RUNTIME|PDB)_OUTPUT_(?:DIRECTORY|NAME)(?:_\w+)?|\w*RPATH\w*|LABELS"
    r"|EXPORT_(?:NAME|COMPILE_COMMANDS)|CXX_(?:CLANG_TIDY|CPPCHECK|CPPLINT|INCLUDE_WHAT_YOU_USE)"
    r"|LINK_WHAT_YOU_USE|INTERPROCEDURAL_OPTIMIZATION(?:_\w+)?|CXX_(?:STANDARD|STANDARD_REQUIRED"
    r"|EXTENSIONS)|COMPILE_(?:OPTIONS|FLAGS|DEFINITIONS|WARNING_AS_ERROR)|USE_FOLDERS|TIMEOUT"
    r"|ENVIRONMENT|WORKING_DIRECTORY|DEPENDS|DISABLED|WILL_FAIL|RUN_SERIAL|PROCESSORS)"
)
_WITH_PROPERTIES = frozenset(
    {"set_target_properties", "set_source_files_properties", "set_directory_properties"}
    | {"set_property"}
)
# Options that are set in this way stand in place of those that were given before.
_REPLACING = frozenset({"COMPILE_OPTIONS"})
_NAMING = re.compile(r"(?:RUNTIME_)?OUTPUT_NAME(?:_\w+)?|PREFIX|SUFFIX|\w+_POSTFIX")
_LAUNCHING = re.compile(r"CMAKE_C(?:XX)?_COMPILER_LAUNCHER|RULE_LAUNCH_COMPILE")
_CACHES = frozenset({"ccache", "sccache"})
_SETTING = ("set", "list", "string", "find_", "option", "foreach")
# What others' modules call is theirs as well: with another meaning they do something else.
_COMMANDS = (TARGETLESS | EXECUTABLE | LIBRARY | _CHANGING).union(
    ("add_action_files", "add_custom_target", "add_message_files", "add_service_files"),
    ("add_subdirectory", "cmake_parse_arguments", "file", "find_package", "include", "install"),
    ("get_filename_component", "list", "project", "set", "target_link_libraries"),
    ("target_sources", "try_compile", "try_run", "unset"),
)
_OTHERS = re.compile(r"_*(?:catkin|ament|rosidl|rclcpp|genmsg)_\w+")
_OWN_FOLDER = re.compile(
    r"\$\{(?:CMAKE_CURRENT_SOURCE_DIR|PROJECT_SOURCE_DIR|CMAKE_SOURCE_DIR)\}/?"
)
_WRAPPED = re.compile(r"\$<(BUILD|INSTALL)_INTERFACE:([^>]*)>")
_OF_PACKAGE = re.compile(r"\$\{(\w+_INCLUDE_DIRS?)\}")
_ONLY_LOOKS = frozenset(
    {"GLOB", "GLOB_RECURSE", "READ", "STRINGS", "RELATIVE_PATH", "TO_CMAKE_PATH"}
)
_SCOPES = frozenset({"PRIVATE", "PUBLIC", "INTERFACE"})
_ORDERS = _SCOPES | {"AFTER", "BEFORE", "SYSTEM"}
_DEFINING = "COMPILE_DEFINITIONS"
_DEFAULT_LANGUAGES = frozenset({"C", "CXX"})
_ABOUT_PROJECT = frozenset(
    {"VERSION", "DESCRIPTION", "HOMEPAGE_URL", "COMPAT_VERSION", "SPDX_LICENSE"}
)
_MESSAGES = frozenset({"rosidl_generate_interfaces", "add_message_files"})
_MESSAGE = re.compile(r"(?:.*/)?(\w+)\.msg")


def facts_of_build(source: Source, package: str) -> Iterator[Fact]:
    """The facts of a file; values say under which conditions the commands are.

    `package` is the name of the package of the nodes.
    """
    items = read_cmake(source).items
    as_written = list(_commands(items))
    commands = list(_commands(items, ConstantLists(as_written, _sets_what_it_names)))
    names = dict(name for command, _ in commands for name in _named(command))
    adding = (c for c, _ in commands if c.name == "add_library" and c.arguments)
    libraries = frozenset(command.arguments[0].text for command in adding)
    own = {argument.text for command, _ in commands for argument in command.arguments}
    projects = (c.arguments[0].text for c, _ in commands if c.name == "project" and c.arguments)
    project = next(projects, "")
    for span, language in _not_enabled(commands):
        yield Fact("step of the build", "", f"project without {language}", "given", source, span)
    lists = ConstantLists(as_written, _sets_what_it_names)
    caches = {*_CACHES, *_found_caches(commands)}
    for command, condition in commands:
        lists.passed(command, condition)
        words = [argument.text for argument in command.arguments]
        found = (
            *_compiled(command, words, libraries),
            *(() if _only_remembers(words, caches) else _steps(command, words, condition)),
            *_included(command, words, own),
        )
        made = lists.written_out(command)
        built = (*_made(made, names, project, package), *_joined(made, names, libraries))
        for fact in (*found, *built):
            kind, owner, name, value, span = fact
            yield Fact(kind, owner, name, f"{value}{condition}", source, span)


_Told = tuple[str, str, str, str, Span]


def _commands(
    items: Iterable[Item], lists: ConstantLists | None = None, condition: str = ""
) -> Iterator[tuple[Command, str]]:
    """The commands, each with the blocks around it; with `lists` those of loops in each round."""
    for item in items:
        if lists is not None:
            lists.passed(item.head if isinstance(item, CommandBlock) else item, condition)
        match item:
            case CommandBlock(head, body, others):
                yield head, condition
                rounds = lists.rounds(item) if lists is not None else None
                if rounds is not None:
                    for commands in rounds:
                        yield from _commands(commands, lists, condition)
                    continue
                inside = _commands(body, lists, condition + _condition(head))
                is_function = head.name == "function"
                yield from (c for c in inside if not is_function or c[0].name != "return")
                for branch, other in others:
                    yield branch, condition
                    beside = f"{_condition(head)}, {branch.name}" if branch.name == "else" else ""
                    said = condition + (beside or _condition(branch))
                    yield from _commands(other, lists, said)
            case Command():
                yield item, condition


def _condition(head: Command) -> str:
    """What a block says of the commands in it; nothing where it always holds."""
    words = " ".join(argument.text for argument in head.arguments)
    is_true = head.name == "if" and words.upper() in ("TRUE", "ON", "YES", "1")
    return "" if is_true else f" only under {head.name}({squeezed(words)})"


def _sets_what_it_names(name: str) -> bool:
    """Whether a command leaves all variables of the file as they are that it does not name."""
    if name in ("add_subdirectory", "include"):
        return False
    is_block = name in ("if", "elseif", "else", "foreach", "while")
    return is_block or name in _COMMANDS or _OTHERS.fullmatch(name) is not None


def _named(command: Command) -> Iterator[tuple[str, str]]:
    """The targets, each with the name that its program gets."""
    words = [argument.text for argument in command.arguments]
    if command.name == "set_target_properties" and "OUTPUT_NAME" in words[:-1]:
        yield words[0], words[words.index("OUTPUT_NAME") + 1]


def _names_files(command: str, words: Sequence[str]) -> bool:
    return any(map(_NAMING.fullmatch, _properties(command, words)))


def _compiled(
    command: Command, words: Sequence[str], libraries: Collection[str]
) -> Iterator[_Told]:
    """The options of the compiler that change what code means; the nodes' code is in libraries."""
    text = " ".join(words)
    is_of_target = command.name.startswith("target_")
    for found in _OPTION.finditer(text):
        option, before = squeezed(found[1]), text[: found.start()].split()
        if _CALM.fullmatch(option):
            continue
        scope = next((word for word in reversed(before) if word in _SCOPES), "")
        is_whole = not is_of_target or (words[0] in libraries and scope != "INTERFACE")
        value = "given" if is_whole else f"given to {words[0]} {scope}".rstrip()
        yield "compiler option", "", option, value, command.span
    defined: Sequence[str] = ()
    match command.name:
        case "add_compile_definitions":
            defined = words
        case "target_compile_definitions":
            defined = words[1:]
        case _ if _DEFINING in words:
            defined = words[words.index(_DEFINING) + 1 :]
    for word in sorted({*defined} - _SCOPES):
        option = f"-D{word.removeprefix('-D')}"
        yield "compiler option", "", option, "given", command.span


def _steps(command: Command, words: Sequence[str], condition: str) -> Iterator[_Told]:
    """What may change the files of the package, or what programs are linked to and made of."""
    is_step = command.name in _CHANGING or (command.name == "set" and _LINKING & {*words[:1]})
    match command.name, words:
        case "include", [module, *_]:
            is_step = "/" in module or module.endswith(".cmake")
        case "file", [action, *_]:
            is_step = action not in _ONLY_LOOKS
        case "include_directories" | "target_include_directories", _:
            is_step = "BEFORE" in words
        case "execute_process", _:
            is_step = _COMMAND not in words or not _asks(words)
        case "add_custom_target", _:
            is_step = _COMMAND in words
        case "install", ["CODE" | "SCRIPT", *_]:
            is_step = True
        case "return", _:
            is_step = True
        case "message", ["FATAL_ERROR" | "SEND_ERROR", *_]:
            is_step = not condition
        case name, [*options] if name in _LINKS:
            options = options[name.startswith("target") :]
            is_step = not all(o in _ORDERS or _CALM.fullmatch(o) for o in options)
        case "function" | "macro", [name, *_]:
            is_step = _is_redefined(name.lower())
        case "set", [variable, *flags] if variable in _LINKING:
            said = " ".join(flags).replace(f"${{{variable}}}", "").split()
            is_step = not all(map(_CALM.fullmatch, said))
        case name, _ if name in _WITH_PROPERTIES:
            is_step = not all(map(_CALM_PROPERTY.fullmatch, _properties(name, words)))
            is_step = is_step or any(map(_STEERING.fullmatch, words)) or _replaces(name, words)
        case name, _ if name.startswith(_SETTING):
            is_step = is_step or any(map(_STEERING.fullmatch, words))
        case _:
            pass
    if is_step:
        yield (
            "step of the build",
            "",
            squeezed(" ".join((command.name, *words))),
            "given",
            command.span,
        )


def _properties(command: str, words: Sequence[str]) -> Sequence[str]:
    """The names of the properties that a command sets."""
    if command == "set_property":
        return words[words.index("PROPERTY") + 1 :][:1] if "PROPERTY" in words else words
    return words[words.index("PROPERTIES") + 1 :: 2] if "PROPERTIES" in words else words


def _replaces(command: str, words: Sequence[str]) -> bool:
    """Whether options of a target or folder are set in place of those that it has."""
    of_files = command == "set_source_files_properties" or words[:1] == ["SOURCE"]
    is_added = not {"APPEND", "APPEND_STRING"}.isdisjoint(words)
    return not (of_files or is_added) and not _REPLACING.isdisjoint(_properties(command, words))


def _found_caches(commands: Iterable[tuple[Command, str]]) -> Iterator[str]:
    """The variables, as they are used, that only ever hold a compiler's cache that was found."""
    found: dict[str, list[Command]] = {}
    for command, _ in commands:
        for word in (a.text for a in command.arguments[:1]):
            found.setdefault(word, []).append(command)
    for name, of in found.items():
        setting = [c for c in of if c.name.startswith(("set", "find_", "unset", "option", "list"))]
        given = [a.text for c in setting for a in c.arguments[1:]]
        if len(setting) == 1 and setting[0].name == "find_program" and {*given} <= _CACHES:
            yield f"${{{name}}}"


def _only_remembers(words: Sequence[str], caches: Collection[str]) -> bool:
    """Whether the compiler is only run by way of a cache of what it made: `ccache`."""
    return len(words) > 1 and _LAUNCHING.fullmatch(words[-2]) is not None and words[-1] in caches


def _is_redefined(name: str) -> bool:
    """Whether a function of this name may stand in place of a command that has a meaning."""
    is_known = name.lstrip("_") in _COMMANDS or _OTHERS.fullmatch(name) is not None
    return is_known or "$" in name


def _included(command: Command, words: Sequence[str], own: Collection[str]) -> Iterator[_Told]:
    """The folders of which headers are included, but for those that a found package names."""
    if command.name not in ("include_directories", "target_include_directories"):
        return
    listed = words[command.name.startswith("target") :]
    for word in (w for text in listed for w in text.split(";") if w not in _ORDERS):
        wrapped = _WRAPPED.fullmatch(word)
        if wrapped is not None and wrapped[1] == "INSTALL":
            continue
        of_package = _OF_PACKAGE.fullmatch(word)
        if of_package is not None and of_package[1] not in own:
            continue
        folder = _OWN_FOLDER.sub("", wrapped[2] if wrapped is not None else word).rstrip("/")
        yield "step of the build", "", f"include {folder or '.'}", "given", command.span


def _not_enabled(commands: Sequence[tuple[Command, str]]) -> Iterator[tuple[Span, str]]:
    """The languages without which what is built is not compiled, and that no command enables."""
    needed, enabled = set[str](), set[str]()
    for command, condition in commands:
        words = [argument.text for argument in command.arguments]
        match command.name:
            case "add_library" | "add_executable":
                needed.add("CXX")
            case "rosidl_generate_interfaces":
                needed |= _DEFAULT_LANGUAGES
            case "project":
                enabled |= _languages(words[1:])
            case "enable_language" if not condition:
                enabled.update(words)
    projects = [c.span for c, _ in commands if c.name == "project"]
    yield from ((projects[0], language) for language in sorted(needed - enabled) if projects)


def _languages(options: Sequence[str]) -> frozenset[str]:
    """The languages that `project` enables by what follows its name."""
    if "LANGUAGES" in options:
        return frozenset(options[options.index("LANGUAGES") + 1 :]) - _ABOUT_PROJECT
    is_plain = bool(options) and _ABOUT_PROJECT.isdisjoint(options)
    return frozenset(options) if is_plain else _DEFAULT_LANGUAGES


def _asks(words: Sequence[str]) -> bool:
    """Whether the commands that are run only tell of the version of the package."""
    runs = [words[at + 1 : at + 3] for at, word in enumerate(words) if word == _COMMAND]
    return all(run in (["git", "describe"], ["git", "rev-parse"], ["git", "log"]) for run in runs)


def _made(command: Command, names: dict[str, str], project: str, package: str) -> Iterator[_Told]:
    """What is built, and what is installed."""
    span, words = command.span, [argument.text for argument in command.arguments]
    match command.name:
        case "project" if words:
            called = words[0].replace(package, OWN) if package else words[0]
            yield "project of the build", "", "", called, span
        case "add_executable" if words:
            target = names.get(words[0], words[0])
            for path in words[1:]:
                at = command.arguments[0].span
                yield "source of a program", target, path.rpartition("/")[2], "there", at
        case "add_library" if words:
            for path in (w.rpartition("/")[2] for w in words[1:]):
                if "." in path:
                    at = command.arguments[0].span
                    yield "source of a program", words[0], path, "there", at
        case "set_property" if words[:1] == ["TARGET"] and _names_files(command.name, words):
            for target in words[1 : words.index("PROPERTY")]:
                shown = squeezed(" ".join(words))
                yield "name of a program", names.get(target, target), "", shown, span
        case "set_target_properties" if words:
            target = names.get(words[0], words[0])
            told = (f'"{w}"' if w == "" else w for w in words[1:])
            yield "name of a program", target, "", squeezed(" ".join(told)), span
        case "ament_package" | "catkin_package":
            yield "project of the build", "", "package", "there", span
        case "install" | "catkin_install_python":
            yield from installed(command.arguments, names, project)
        case "generate_messages":
            yield "code of the messages", "", "", "generated", span
        case "catkin_python_setup":
            yield "Python package", "", "", "built", span
        case "rclcpp_components_register_nodes":
            for name in (w.rpartition("::")[2] for w in words[1:]):
                yield "component in the build", name, "", "there", span
        case name if name in _MESSAGES:
            for found in filter(None, map(_MESSAGE.fullmatch, words)):
                yield "message", "", found[1], "generated", span
        case _:
            pass


def _joined(command: Command, names: dict[str, str], libraries: frozenset[str]) -> Iterator[_Told]:
    """That a program has more of the package's code than the source with its `main`."""
    words = [argument.text for argument in command.arguments]
    is_program = command.name == "add_executable" and len(words) > 2
    is_linked = command.name == "target_link_libraries" and not libraries.isdisjoint(words[1:])
    if is_program or (is_linked and words[0] not in libraries):
        yield "own code of a program", names.get(words[0], words[0]), "", "there", command.span
