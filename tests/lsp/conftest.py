"""One editor with a running server for the tests of a module."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Iterator
from typing import TypeAlias

import pytest

from tests.lsp.client import Editor, editor

InEditor: TypeAlias = Callable[[Callable[[Editor], Coroutine[None, None, None]]], None]


@pytest.fixture(scope="module")
def in_editor(tmp_path_factory: pytest.TempPathFactory) -> Iterator[InEditor]:
    """Plays something in an editor."""
    loop = asyncio.new_event_loop()
    opened = editor(tmp_path_factory.mktemp("editor"))
    client = loop.run_until_complete(opened.__aenter__())
    yield lambda play: loop.run_until_complete(play(client))
    loop.run_until_complete(opened.__aexit__(None, None, None))
    loop.close()
