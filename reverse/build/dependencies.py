"""The packages that build files ask for, and whether a file uses what a package offers."""

from __future__ import annotations

import re

from rebsync.reverse.build.cmake import BUILD, read_build
from rebsync.reverse.build.manifests import read_manifest
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import SUFFIX
from rebsync.reverse.libraries.cpp import including
from rebsync.source import Source

_CODE = (*sorted(CODE), SUFFIX)
_INTERFACES = (".msg", ".srv", ".action")
_OF_INTERFACES = re.compile(r"message_(?:generation|runtime)|rosidl_default_\w+")


def asked_for(path: str, source: Source) -> frozenset[str]:
    """The packages that a package.xml depends on, or that a CMakeLists.txt looks for."""
    if path.endswith(BUILD):
        return read_build(source).packages
    return frozenset(read_manifest(source).depends)


def uses(path: str, source: Source, package: str) -> bool:
    """Whether a file includes or imports what a package offers, or is made into code by it."""
    if _OF_INTERFACES.fullmatch(package):
        return path.endswith(_INTERFACES)
    if not path.endswith(_CODE):
        return False
    word = re.escape(including().get(package, package))
    asks = rf"(?:#\s*include\s*[<\"]|\bfrom\s+|\bimport\s+){word}\b"
    return re.search(asks, source.text) is not None
