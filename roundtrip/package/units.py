"""The files that are kept in step with one model: a package, or two, as of Python for ROS 2.

Only a package of CMake can have messages, so that nodes in Python for ROS 2 come with one of their
own for these. Files go by their paths from the folder of both.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from itertools import islice

from rebsync.reverse.files.packages import MANIFEST, Listing, listings
from rebsync.reverse.files.reading import all_listings
from rebsync.reverse.files.stores import Store

_MESSAGES = "_interfaces"


def listing_of(
    root: str, tree: str | None, generated: Iterable[str], store: Store | None = None
) -> Listing:
    """The files of a package; `generated` are the paths of those that were generated.

    RebsyncError: there is no such directory, or it may not be read.
    """
    folders = folders_of(generated)
    if not folders:
        return next(listings(root, tree, store), Listing(root, {}))
    whole = Listing(root, {}, tree=os.path.realpath(tree or root), store=store)
    for listing in listings(root, tree, store):
        inside = listing.root.removeprefix(root).strip("/")
        if inside and inside not in folders:
            continue  # of somebody else
        prefix = f"{inside}/" if inside else ""
        found = {f"{prefix}{name}": path for name, path in listing.files.items()}
        whole.files |= {n: p for n, p in found.items() if n.partition("/")[0] in folders}
        odd = {f"{prefix}{name}": why for name, why in listing.odd.items()}
        whole.odd |= {n: w for n, w in odd.items() if n.partition("/")[0] in folders}
        linked = {f"{prefix}{name}": path for name, path in listing.linked.items()}
        whole.linked |= {n: p for n, p in linked.items() if n in whole.files}
        whole.programs |= {f"{prefix}{n}" for n in listing.programs} & whole.files.keys()
        whole.size += listing.size
    return whole


def units(paths: Iterable[str]) -> Iterator[Listing]:
    """The packages that paths stand for, not yet read; a folder of nodes and messages is one.

    RebsyncError: there is no such path, or it may not be read.
    """
    for path in paths:
        both = both_at(path)
        yield from all_listings([path]) if both is None else (both,)


def both_at(path: str, store: Store | None = None) -> Listing | None:
    """The nodes and the messages that are all packages below a path, read as one; else None.

    RebsyncError: there is no such path, or it may not be read.
    """
    found = [each.root for each in islice(listings(path, store=store), 4) if each.is_package]
    if len(found) != 2 or found[1] != f"{found[0]}{_MESSAGES}":
        return None
    folder = found[0].rpartition("/")[0] or path
    names = [f"{root.removeprefix(folder).strip('/')}/{MANIFEST}" for root in found]
    return as_one(listing_of(folder, folder if store is None else None, names, store))


def folders_of(names: Iterable[str]) -> tuple[str, ...]:
    """The folders of several packages, the one with the nodes first; none where it is only one."""
    found = [n.rpartition("/")[0] for n in names if n.rpartition("/")[2] == MANIFEST]
    if not found or "" in found:
        return ()
    return tuple(sorted(found, key=lambda f: (f.endswith(_MESSAGES), f)))


def manifest_of(names: Collection[str]) -> str:
    """The path of the manifest of the package with the nodes."""
    folders = folders_of(names)
    return f"{folders[0]}/{MANIFEST}" if folders else MANIFEST


def name_as_one(name: str, folders: Iterable[str]) -> str | None:
    """The name that a file has where both are read as one package; None where it has no part."""
    for number, folder in enumerate(folders):
        if name.startswith(f"{folder}/"):
            inside = name.removeprefix(f"{folder}/")
            return inside if number == 0 or inside.endswith(".msg") else None
    return name


def as_one(listing: Listing) -> Listing:
    """The files of two packages as those of one: the nodes, and the messages of the other."""
    folders = folders_of(listing.files)
    if not folders:
        return listing
    named = {name: name_as_one(name, folders) for name in listing.files}
    files = {n: listing.files[name] for name, n in named.items() if n is not None}
    linked = {n: p for name, p in listing.linked.items() if (n := named[name]) is not None}
    return replace(listing, files=files, linked=linked, only=None, is_package=True)
