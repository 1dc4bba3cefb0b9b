"""Which modules and names Python's own library has, where none of its modules is run for that."""

from __future__ import annotations

import importlib
import sys
import sysconfig
from pathlib import Path

from rebsync.reverse.syntax.py_module import bound_in

# Compiled modules have their names in a file of the interpreter, or are part of it.
_FOLDERS = tuple(dict.fromkeys(map(sysconfig.get_path, ("stdlib", "platstdlib"))))
_COMPILED = "lib-dynload"


def is_standard(module: str) -> bool:
    """Whether the outermost package of a module is one of Python's library."""
    return module.partition(".")[0] in sys.stdlib_module_names


def has_module(module: str) -> bool:
    """Whether this Python has a module of its library."""
    if module in sys.modules or module in sys.builtin_module_names:
        return True
    return _source_of(module) is not None or _is_compiled(module)


def gives(module: str, name: str) -> bool:
    """Whether this Python's library gives a name in a module; true where that is made at run time.

    Modules that run already are asked; of others the text is read, as a folder may have files of
    the same names.
    """
    if has_module(f"{module}.{name}"):
        return True
    if module in sys.builtin_module_names:
        return hasattr(importlib.import_module(module), name)
    if (loaded := sys.modules.get(module)) is not None:
        return hasattr(loaded, name)
    source = _source_of(module)
    if source is None:
        return _is_compiled(module)
    bound = bound_in(source)
    return bound is None or name in bound


def _source_of(module: str) -> str | None:
    inside = module.replace(".", "/")
    for folder in filter(None, _FOLDERS):
        for path in (Path(folder, f"{inside}.py"), Path(folder, inside, "__init__.py")):
            if path.is_file():
                return path.read_text(encoding="utf-8")
    return None


def _is_compiled(module: str) -> bool:
    folders = (Path(folder, _COMPILED) for folder in _FOLDERS if folder)
    return any(True for folder in folders for _ in folder.glob(f"{module}.*"))
