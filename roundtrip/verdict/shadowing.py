"""New files that Python imports in place of what generated code means by a name.

A package stands in place of a module beside it, and what lies in a folder that Python looks in
first stands in place of a library's module. `sitecustomize` is imported before any program.
"""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import dirname

from rebsync.diagnostics import Findings
from rebsync.files import read_source
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.verdict.missing_definitions import finding
from rebsync.source import NOWHERE

_SUFFIX, _INIT = ".py", "/__init__.py"
_MESSAGES = (".msg", ".srv", ".action")  # packages that are built of the messages
_ALWAYS = frozenset({"sitecustomize", "usercustomize"})


def shadowing(record: Record, now: PackageState) -> Iterator[Findings]:
    """The files that are imported in place of a generated module or of a library's."""
    paths = now.listing.files
    new = [n for n in now.changed if n not in record.files and n.endswith(_SUFFIX) and n in paths]
    if not new:
        return
    from rebsync.reverse.build.built_python import imported_by
    from rebsync.reverse.build.dependencies import is_of_libraries
    from rebsync.reverse.syntax.py_module import module_of

    code = [n for n in record.files if n in paths and _is_python(n)]
    roots = {dirname(n) for n in code if not n.endswith(_SUFFIX)}
    roots |= {dirname(dirname(n)) for n in code if n.endswith(_INIT)}
    trees = (module_of(read_source(paths[n]).text) for n in code)
    modules = {name for tree in trees if tree is not None for name in imported_by(tree)}
    imported = {module.partition(".")[0] for module in modules}
    of_messages = {
        f"{r}/{m}".lstrip("/").replace(".", "/")
        for r in roots
        for m in modules
        if m.endswith(_MESSAGES)
    }
    for name in new:
        module = name.removesuffix(_INIT).removesuffix(_SUFFIX)
        folder, _, stem = module.rpartition("/")
        is_instead = name.endswith(_INIT) and f"{module}{_SUFFIX}" in record.files
        own = {n.removesuffix(_INIT) for n in code}
        is_meant = stem in imported | _ALWAYS or is_of_libraries(stem)
        is_first = folder in roots and is_meant and module not in own
        if is_instead or is_first or module in of_messages:
            message = f'Python imports this in place of what generated code means by "{stem}"'
            yield finding(read_source(paths[name]), NOWHERE, message)


def _is_python(name: str) -> bool:
    return name.endswith(_SUFFIX) or name.partition("/")[0] == "scripts" or "/scripts/" in name
