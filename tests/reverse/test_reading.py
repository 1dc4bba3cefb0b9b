"""Files in: which belong to a package, and what stands in them whatever their bytes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import pytest

from rebsync.diagnostics import RebsyncError
from rebsync.reverse.files import reading
from rebsync.reverse.files.reading import Chosen, chosen, packages
from rebsync.reverse.findings import Grade

NODE = '#include <ros/ros.h>\nint main() { ros::init("x"); }\n'
PLAIN = "int twice(int x) { return 2 * x; }\n"


def make(root: Path, files: Mapping[str, str | bytes]) -> Path:
    for name, content in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
    return root


def read(root: Path) -> list[Chosen]:
    return list(packages([str(root)]))


def test_files_belong_to_the_nearest_package(tmp_path: Path) -> None:
    make(
        tmp_path,
        {
            "b/package.xml": "<package/>",
            "b/src/node.cpp": NODE,
            "b/plugins/inner/package.xml": "<package/>",
            "b/plugins/inner/inner.cpp": NODE,
            "a/package.xml": "<package/>",
            "a/launch/a.launch": "<launch/>",
            "loose/tool.cpp": NODE,
        },
    )
    found = [
        (Path(c.root).relative_to(tmp_path).as_posix(), sorted(c.files)) for c in read(tmp_path)
    ]
    assert found == [
        (".", ["loose/tool.cpp"]),
        ("a", ["launch/a.launch", "package.xml"]),
        ("b", ["package.xml", "src/node.cpp"]),
        ("b/plugins/inner", ["inner.cpp", "package.xml"]),
    ]


def test_one_directory_without_a_package_is_read_as_one(tmp_path: Path) -> None:
    make(tmp_path, {"src/node.cpp": NODE, "node.launch": "<launch/>"})
    assert [sorted(c.files) for c in read(tmp_path)] == [["node.launch", "src/node.cpp"]]


def test_files_outside_of_packages_are_left_out_if_none_is_code(tmp_path: Path) -> None:
    make(tmp_path, {"a/package.xml": "<package/>", "a/n.cpp": NODE, "ci.yaml": "x: 1"})
    assert [Path(c.root).name for c in read(tmp_path)] == ["a"]


@pytest.mark.parametrize(
    ("files", "wanted"),
    [
        ({"x/CATKIN_IGNORE": "", "x/n.cpp": NODE, "m.cpp": NODE}, ["m.cpp"]),
        ({"x/COLCON_IGNORE": "", "x/y/n.cpp": NODE, "m.cpp": NODE}, ["m.cpp"]),
        ({"build/CMakeCache.txt": "", "build/n.cpp": NODE, "m.cpp": NODE}, ["m.cpp"]),
        ({"src/log/n.cpp": NODE, "install/m.cpp": NODE}, ["install/m.cpp", "src/log/n.cpp"]),
        ({".hidden/n.cpp": NODE, ".n.cpp": NODE, "m.cpp": NODE}, ["m.cpp"]),
        ({"test/n.cpp": NODE, "test/n.launch": "<launch/>"}, ["test/n.cpp"]),
        (
            {"k.cu": NODE, "k.cuh": NODE, "i.ipp": NODE, "c.C": NODE},
            ["c.C", "i.ipp", "k.cu", "k.cuh"],
        ),
        ({"n.cpp": NODE, "notes.txt": "", "CMakeLists.txt": ""}, ["CMakeLists.txt", "n.cpp"]),
    ],
)
def test_what_is_read(tmp_path: Path, files: dict[str, str], wanted: list[str]) -> None:
    (only,) = read(make(tmp_path, files))
    assert sorted(only.files) == wanted


def test_an_ignored_directory_that_is_asked_for_is_read(tmp_path: Path) -> None:
    make(tmp_path, {"CATKIN_IGNORE": "", "n.cpp": NODE})
    assert list(chosen(str(tmp_path)).files) == ["n.cpp"]


def test_a_link_to_a_directory_above_ends(tmp_path: Path) -> None:
    make(tmp_path, {"a/package.xml": "<package/>", "a/n.cpp": NODE})
    (tmp_path / "a" / "again").symlink_to(tmp_path / "a", target_is_directory=True)
    (tmp_path / "b").symlink_to(tmp_path / "a", target_is_directory=True)
    assert [sorted(c.files) for c in read(tmp_path)] == [["n.cpp", "package.xml"]]


def test_a_linked_package_is_read(tmp_path: Path) -> None:
    make(tmp_path / "elsewhere", {"package.xml": "<package/>", "n.cpp": NODE})
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "a").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    assert [sorted(c.files) for c in read(tmp_path / "src")] == [["n.cpp", "package.xml"]]


def test_what_is_no_file_is_listed(tmp_path: Path) -> None:
    make(tmp_path, {"n.cpp": NODE})
    os.mkfifo(tmp_path / "pipe.cpp")
    (tmp_path / "gone.h").symlink_to(tmp_path / "nowhere")
    (tmp_path / "round.h").symlink_to(tmp_path / "round.h")
    (only,) = read(tmp_path)
    assert list(only.files) == ["n.cpp"]
    reasons = {Path(f.source.path).name: f.why for f in only.findings}
    assert reasons["pipe.cpp"] == "this is no regular file"
    assert reasons["gone.h"] == "no such file or directory"
    assert "round.h" in reasons


def test_names_that_are_no_text_can_be_printed(tmp_path: Path) -> None:
    make(tmp_path, {"n.cpp": NODE})
    Path(os.fsdecode(os.fsencode(tmp_path) + b"/caf\xe9.cpp")).write_text(NODE)
    (only,) = read(tmp_path)
    assert sorted(only.files) == ["caf\\xe9.cpp", "n.cpp"]
    assert all(s.path.encode("utf-8") for s in only.files.values())


def test_a_file_comes_with_the_package_around_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make(tmp_path, {"package.xml": "<package/>", "src/n.cpp": NODE, "inc/plain.h": PLAIN})
    found = chosen(str(tmp_path / "src" / "n.cpp"))
    assert (found.only, sorted(found.files)) == ("src/n.cpp", ["package.xml", "src/n.cpp"])
    assert found.skipped == 1
    (tmp_path / "inc" / "sub").mkdir()
    monkeypatch.chdir(tmp_path / "inc" / "sub")
    for name in ("../../src/n.cpp", "../../inc/../src/n.cpp", str(tmp_path / "src" / "n.cpp")):
        assert chosen(name).only == "src/n.cpp"
    monkeypatch.chdir(tmp_path)
    assert chosen("src/n.cpp").files["src/n.cpp"].path == "src/n.cpp"


def test_a_file_alone(tmp_path: Path) -> None:
    make(tmp_path, {"plain.cpp": PLAIN, "other.cpp": NODE})
    found = chosen(str(tmp_path / "plain.cpp"))
    assert (found.only, list(found.files)) == ("plain.cpp", ["plain.cpp"])


def test_there_must_be_something(tmp_path: Path) -> None:
    with pytest.raises(RebsyncError) as error:
        read(tmp_path / "none")
    assert error.value.findings[0].diagnostics[0].code == "RS801"
    assert chosen(str(tmp_path)).files == {}


# --- text ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("data", "text", "grade", "why"),
    [
        (b"", "", None, ""),
        (b"\xef\xbb\xbfint x;", "int x;", None, ""),
        (b"int x;\r\nint y;\r\n", "int x;\r\nint y;\r\n", None, ""),
        (b"// caf\xe9\nint x;", "// caf\xe9\nint x;", None, ""),
        (b'auto s = "caf\xe9";', 'auto s = "caf\xe9";', Grade.APPROXIMATED, "not UTF-8"),
        (b'/* \xe9 */ auto s = "\xe9\xc3\xa9";', None, Grade.APPROXIMATED, "not UTF-8"),
        (b"int x = 1;\0int y = 2;", "int x = 1; int y = 2;", Grade.APPROXIMATED, "NUL"),
        ("int x;".encode("utf-16"), None, Grade.UNREADABLE, "UTF-16"),
        ("int x;".encode("utf-16-le"), None, Grade.UNREADABLE, "no text"),
        (b"\x7fELF\0\0\0\0\0\0", None, Grade.UNREADABLE, "no text"),
    ],
)
def test_bytes(
    tmp_path: Path, data: bytes, text: str | None, grade: Grade | None, why: str
) -> None:
    path = make(tmp_path, {"a.cpp": data}) / "a.cpp"
    found = chosen(str(path))
    assert [f.grade for f in found.findings] == ([] if grade is None else [grade])
    assert all(why in f.why for f in found.findings)
    if text is not None:
        assert found.files["a.cpp"].text == text
    if grade is Grade.UNREADABLE:
        assert found.files == {}


def test_a_byte_that_is_no_utf8_is_shown(tmp_path: Path) -> None:
    make(tmp_path, {"a.cpp": b'// \xc3\xa9\nauto s = "\xe9";'})
    (finding,) = chosen(str(tmp_path / "a.cpp")).findings
    position = finding.source.position(finding.span.start)
    assert (position.line, position.column, finding.text) == (2, 11, "\xe9")


def test_code_that_is_too_large_is_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "_MUCH", 1000)
    make(tmp_path, {"n.cpp": NODE, "table.cpp": NODE + "int x;" * 1000})
    make(tmp_path, {"plain.cpp": "int x;" * 1000, "world.xml": " " * 9000})
    (only,) = read(tmp_path)
    assert sorted(only.files) == ["n.cpp"]
    assert [Path(f.source.path).name for f in only.findings] == ["table.cpp"]
