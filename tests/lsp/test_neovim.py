"""The set-up of docs/editors.md, in a real Neovim without a screen."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.run import environment

ROOT = Path(__file__).parents[2]
PROBE = """
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end)
local found = {}
for _, d in ipairs(vim.diagnostic.get(0)) do
  table.insert(found, d.lnum + 1 .. ": " .. d.code)
end
vim.fn.writefile(found, "found")
"""


@pytest.mark.skipif(shutil.which("nvim") is None, reason="Neovim is not installed")
def test_neovim_shows_what_is_wrong(tmp_path: Path) -> None:
    page = (ROOT / "docs/editors.md").read_text(encoding="utf-8")
    (script,) = re.findall(r"^```lua\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    model = (ROOT / "examples/hello/hello.rebeca").read_text(encoding="utf-8")
    files = {
        "init.lua": script,
        "probe.lua": PROBE,
        "hello.rebeca": model.replace("steps = 0;", "stepz = 0;"),
        "rebsync": f'#!/bin/sh\nexec {sys.executable} -m rebsync "$@"\n',
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "rebsync").chmod(0o755)
    folders = {name: str(tmp_path) for name in ("HOME", "XDG_STATE_HOME", "XDG_DATA_HOME")}
    subprocess.run(
        ["nvim", "--headless", "-u", "init.lua", "hello.rebeca", "+luafile probe.lua", "+qa!"],
        cwd=tmp_path,
        env=environment() | folders | {"PATH": f"{tmp_path}:{os.environ['PATH']}"},
        capture_output=True,
        timeout=60,
        check=True,
    )
    assert (tmp_path / "found").read_text(encoding="utf-8") == "8: RS203\n"
