"""The page that is served: who may ask, from where, and for what."""

from __future__ import annotations

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from rebsync.cli.serving import Live, LiveServer, Refused
from tests.cli.run import ROOT, environment, rebsync

EXAMPLE = str(ROOT / "examples" / "experiment2_unsafe" / "experiment2_unsafe.rebeca")
JSON = {"Content-Type": "application/json"}


def follow(ordinals: tuple[int, ...], by_chance: int) -> str:
    """What is served of a run, in these tests."""
    if 9 in ordinals:
        raise Refused("step 9 cannot be made")
    return f"ran {list(ordinals)}, {by_chance} by chance"


@pytest.fixture
def server() -> Iterator[LiveServer]:
    """A server that answers in a thread of its own."""
    with LiveServer(Live(lambda address: f"page {address}", follow)) as made:
        thread = threading.Thread(target=made.serve_forever, args=(0.01,))
        thread.start()
        yield made
        made.shutdown()
        thread.join()


def asked(
    server: LiveServer,
    method: str,
    path: str,
    headers: Mapping[str, str] | None = None,
    body: bytes | None = None,
) -> tuple[int, str]:
    """Status and text of an answer."""
    connection = http.client.HTTPConnection("127.0.0.1", server.server_port, timeout=20)
    try:
        connection.request(method, path, body, dict(headers or {}))
        answer = connection.getresponse()
        return answer.status, answer.read().decode()
    finally:
        connection.close()


def posted(server: LiveServer, body: object, **changed: str) -> tuple[int, str]:
    """The answer to a run that the page asks for, with some headers changed."""
    headers = {**JSON, "Origin": f"http://127.0.0.1:{server.server_port}"}
    headers.update({name.replace("_", "-"): value for name, value in changed.items()})
    data = body if isinstance(body, bytes) else json.dumps(body).encode()
    return asked(server, "POST", f"{server.base}run", headers, data)


def test_the_page_and_a_run_are_answered(server: LiveServer) -> None:
    assert asked(server, "GET", server.base) == (200, f"page {server.base}run")
    assert posted(server, {"path": [0, 1, 2], "chance": 7}) == (
        200,
        "ran [0, 1, 2], 7 by chance",
    )
    assert posted(server, {"path": [9], "chance": 0}) == (400, "step 9 cannot be made")


def test_only_this_machine_can_ask(server: LiveServer) -> None:
    assert server.socket.getsockname()[0] == "127.0.0.1"


def test_two_servers_have_two_tokens(server: LiveServer) -> None:
    with LiveServer(Live(lambda address: address, follow)) as other:
        assert other.base != server.base
        assert len(other.base) > 30


@pytest.mark.parametrize(
    "path",
    ["/", "/run", "//", "/../../etc/passwd", "/%2e%2e/etc/passwd", "BASE../../etc/passwd",
     "BASErun/../x", "BASE%2e%2e/etc/passwd", "BASE?x", "BASE/run", "/é"],
)  # fmt: skip
@pytest.mark.parametrize("method", ["GET", "POST"])
def test_other_addresses_lead_nowhere(server: LiveServer, method: str, path: str) -> None:
    wanted = path.replace("BASE", server.base).encode()
    lines = (
        f"{method} ".encode() + wanted + b" HTTP/1.1",
        f"Host: 127.0.0.1:{server.server_port}".encode(),
        f"Origin: http://127.0.0.1:{server.server_port}".encode(),
        b"Content-Type: application/json\r\nContent-Length: 0\r\n\r\n",
    )
    with socket.create_connection(("127.0.0.1", server.server_port), timeout=20) as connection:
        connection.sendall(b"\r\n".join(lines))
        answer = b""
        while piece := connection.recv(4096):
            answer += piece
    assert re.match(rb"HTTP/1.0 (404|400) ", answer), answer
    assert b"root:" not in answer


@pytest.mark.parametrize("host", ["evil.example", "evil.example:PORT", "127.0.0.1", ""])
def test_a_name_that_leads_here_is_refused(server: LiveServer, host: str) -> None:
    named = host.replace("PORT", str(server.server_port))
    assert asked(server, "GET", server.base, {"Host": named})[0] == 403
    assert posted(server, {"path": [0], "chance": 0}, Host=named)[0] == 403


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:1", "https://127.0.0.1:PORT", ""]
)
def test_other_pages_cannot_ask(server: LiveServer, origin: str) -> None:
    named = origin.replace("PORT", str(server.server_port))
    assert posted(server, {"path": [0], "chance": 0}, Origin=named)[0] == 403


def test_a_request_without_origin_is_refused(server: LiveServer) -> None:
    assert asked(server, "POST", f"{server.base}run", JSON, b'{"path": [0], "chance": 0}')[0] == 403


def test_forms_of_other_pages_are_no_requests(server: LiveServer) -> None:
    assert posted(server, {"path": [0], "chance": 0}, Content_Type="text/plain")[0] == 400


@pytest.mark.parametrize(
    "body",
    [b"", b"{", b"[]", b"1", b"null", b'{"path": [0]}', b'{"chance": 0}',
     *(b'{"chance": 0, "path": %b}' % path for path in (
         b"1", b"[]", b'["0"]', b"[-1]", b"[true]", b"[0.5]", b"[" + b"0," * 100_001 + b"0]")),
     *(b'{"path": [0], "chance": %b}' % chance for chance in (b"-1", b"1001", b"true", b"[]")),
     b"[" * 5000, b"\xff"],
)  # fmt: skip
def test_what_is_no_path_is_refused(server: LiveServer, body: bytes) -> None:
    assert posted(server, body)[0] == 400


@pytest.mark.parametrize("length", ["1048577", "99999999999999999999", "-1", "x", "\u0661"])
def test_what_is_too_long_is_not_read(server: LiveServer, length: str) -> None:
    lines = (
        f"POST {server.base}run HTTP/1.1",
        f"Host: localhost:{server.server_port}",
        f"Origin: http://localhost:{server.server_port}",
        f"Content-Type: application/json\r\nContent-Length: {length}\r\n\r\n",
    )
    with socket.create_connection(("127.0.0.1", server.server_port), timeout=20) as connection:
        connection.sendall("\r\n".join(lines).encode())
        assert connection.recv(4096).startswith(b"HTTP/1.0 400 ")


def test_answers_may_not_be_kept_framed_or_guessed(server: LiveServer) -> None:
    connection = http.client.HTTPConnection("127.0.0.1", server.server_port, timeout=20)
    connection.request("GET", server.base)
    headers = connection.getresponse().headers
    connection.close()
    assert headers["Cache-Control"] == "no-store"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert "Access-Control-Allow-Origin" not in headers


@pytest.mark.parametrize(("command", "status"), [("simulate", 0), ("verify", 3)])
def test_it_ends_in_order_when_interrupted(tmp_path: Path, command: str, status: int) -> None:
    program = (sys.executable, "-m", "rebsync", command, EXAMPLE, "--serve")
    environ = environment() | {"XDG_CACHE_HOME": str(tmp_path)}
    running = subprocess.Popen(
        program, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environ
    )
    try:
        assert running.stderr is not None
        address = next(found for line in running.stderr if (found := re.search(r"http\S+", line)))
        connection = http.client.HTTPConnection(address[0].split("/")[2], timeout=20)
        connection.request("GET", "/" + address[0].split("/", 3)[3])
        text = connection.getresponse().read().decode()
        connection.close()
        assert "What else could happen" in text
        os.kill(running.pid, signal.SIGINT)
        out, err = running.communicate(timeout=120)
    finally:
        running.kill()
        running.wait()
    assert (running.returncode, out) == (status, "")
    assert "Traceback" not in err


@pytest.mark.parametrize("command", ["simulate", "verify"])
@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--serve", "--format", "html"], "leave --format and --output out"),
        (["--serve", "-o", "page.html"], "leave --format and --output out"),
        (["--port", "8080"], "--port is that of --serve"),
    ],
)
def test_what_is_served_is_not_written(
    tmp_path: Path, command: str, options: list[str], said: str
) -> None:
    done = rebsync(command, EXAMPLE, *options, cwd=tmp_path)
    assert (done.status, said in done.err, list(tmp_path.iterdir())) == (2, True, [])


def test_a_port_that_is_taken_is_told(tmp_path: Path, server: LiveServer) -> None:
    done = rebsync("simulate", EXAMPLE, "--serve", "--port", str(server.server_port), cwd=tmp_path)
    assert done.status == 2
    assert f"port {server.server_port} cannot be used: Address already in use" in done.err
