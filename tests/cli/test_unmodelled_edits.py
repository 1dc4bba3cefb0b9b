"""Code that no model describes is edited: nothing that reads the code alone looks over it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main

QUEUE = ("kQueueSize = 1000", "kQueueSize = 9")
# A file, and an edit of it; a harmless one of the same file.
EDITS = {
    "ros1-cpp": ("hello/include/hello/mailbox.h", QUEUE, "// mine\n"),
    "ros2-cpp": ("hello/include/hello/mailbox.hpp", QUEUE, "// mine\n"),
    "ros1-py": ("hello/src/hello/mailbox.py", ("QUEUE_SIZE = 1000", "QUEUE_SIZE = 9"), "# mine\n"),
    "ros2-py": (
        "hello/hello/hello/mailbox.py",
        ("QUEUE_SIZE = 1000", "QUEUE_SIZE = 9"),
        "# mine\n",
    ),
}
ASKED = (
    ["extract", "hello"],
    ["extract", "--format", "json", "hello"],
    ["diff", "hello.rebeca", "hello"],
    ["diff", "hello", "hello.rebeca"],
    ["verify", "hello", "--property", "hello.property"],
)


@pytest.mark.parametrize("target", EDITS)
def test_it_is_undetermined(
    target: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    assert main(["examples", str(tmp_path), "hello"]) == 0
    monkeypatch.chdir(tmp_path / "hello")
    assert main(["generate", "--target", target, "hello.rebeca", "-o", "made"]) == 0
    name, (old, new), remark = EDITS[target]
    path = Path("made", name)
    text = path.read_text()
    path.write_text(text + remark)
    before = [main(_in_made(asked)) for asked in ASKED]
    assert 4 not in before
    path.write_text(text.replace(old, new, 1))
    assert path.read_text() != text
    for asked in ASKED:
        capsys.readouterr()
        assert main(_in_made(asked)) == 4, asked
        assert f"{path}:" in "".join(capsys.readouterr())


def _in_made(asked: list[str]) -> list[str]:
    return [f"made/{a}" if a == "hello" else a for a in asked]
