"""A page of runs that follows other steps, served to the browser of this user on this machine.

Only the loopback address listens. The address of the page has a token that nobody can guess, so
that other users and other pages cannot ask; the name of the host must be that of the address, so
that no name of a domain leads here (DNS rebinding); what is sent must come from the page itself.
No file is read: there are two addresses, one for the page and one that makes a run.
"""

from __future__ import annotations

import gc
import json
import re
import secrets
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import click

from rebsync.records import dataclass
from rebsync.terminal import say

HOST = "127.0.0.1"
_LONGEST = 1 << 20  # bytes of what may be sent
_MOST_STEPS = 100_000  # of a run that is asked for
_MOST_BY_CHANCE = 1000
_PATIENCE = 30.0  # s, within which a request must have come
_HEADERS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}


class Refused(Exception):
    """A run that cannot be made; the text says why."""


@dataclass(frozen=True, slots=True)
class Live:
    """What is served: the page, by the address that it asks; and the part of a run along ordinals.

    `follow` also takes how many steps more are made by chance. It raises Refused.
    """

    page: Callable[[str], str]
    follow: Callable[[tuple[int, ...], int], str]


def serve(live: Live, port: int = 0) -> None:
    """Serves until it is interrupted; port 0 is any that is free. UsageError: it is taken."""
    try:
        server = LiveServer(live, port)
    except OSError as error:
        raise click.UsageError(f"port {port} cannot be used: {error.strerror}") from None
    with server:
        say(f"the page is at {server.address}", err=True)
        say("Ctrl-C ends", err=True)
        gc.enable()  # it may go on for long
        with suppress(KeyboardInterrupt):
            server.serve_forever()


class LiveServer(ThreadingHTTPServer):
    """The server of one page; requests are answered one after the other."""

    daemon_threads = True

    def __init__(self, live: Live, port: int = 0) -> None:
        super().__init__((HOST, port), _Handler)
        self.base = f"/{secrets.token_urlsafe(24)}/"
        self.live = live
        self.lock = threading.Lock()
        self.hosts = frozenset(f"{name}:{self.server_port}" for name in (HOST, "localhost"))
        self.page = live.page(f"{self.base}run").encode()

    @property
    def address(self) -> str:
        """The address of the page."""
        return f"http://{HOST}:{self.server_port}{self.base}"

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that goes away is no mistake."""
        if not isinstance(sys.exc_info()[1], OSError):
            raise


class _Handler(BaseHTTPRequestHandler):
    server: LiveServer
    timeout = _PATIENCE
    server_version = "rebsync"
    sys_version = ""

    def do_GET(self) -> None:
        """The page."""
        if self._is_ours(self.server.base):
            self._answer(HTTPStatus.OK, self.server.page, "text/html")

    def do_POST(self) -> None:
        """The part of a run along the ordinals that are sent."""
        if not self._is_ours(f"{self.server.base}run"):
            return
        if self.headers.get("Origin") not in {f"http://{host}" for host in self.server.hosts}:
            self._refuse(HTTPStatus.FORBIDDEN, "this comes from another page")
            return
        try:
            asked = _asked(self._body())
            with self.server.lock:
                part = self.server.live.follow(*asked)
        except Refused as refused:
            self._refuse(HTTPStatus.BAD_REQUEST, str(refused))
            return
        self._answer(HTTPStatus.OK, part.encode(), "text/html")

    def log_message(self, format: str, *args: object) -> None:
        """Requests are not told: their addresses have the token."""

    def _is_ours(self, wanted: str) -> bool:
        """Whether host and address are right; where not, that is answered."""
        if self.headers.get("Host") not in self.server.hosts:
            self._refuse(HTTPStatus.FORBIDDEN, "this host is another one")
            return False
        if not secrets.compare_digest(self.path.encode(), wanted.encode()):
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")
            return False
        return True

    def _body(self) -> bytes:
        if self.headers.get("Content-Type") != "application/json":
            raise Refused("what is sent is no JSON")
        length = self.headers.get("Content-Length", "")
        if not re.fullmatch("[0-9]{1,8}", length) or int(length) > _LONGEST:
            raise Refused(f"what is sent has no length, or more than {_LONGEST} bytes")
        return self.rfile.read(int(length))

    def _refuse(self, status: HTTPStatus, reason: str) -> None:
        self.close_connection = True  # what was sent may not have been read
        self._answer(status, reason.encode(), "text/plain")

    def _answer(self, status: HTTPStatus, content: bytes, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(content)))
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        self.end_headers()
        with suppress(OSError):  # the browser went away
            self.wfile.write(content)


def _asked(body: bytes) -> tuple[tuple[int, ...], int]:
    """The ordinals of `{"path": [...], "chance": 0}`, and the steps by chance. Raises Refused."""
    try:
        found = json.loads(body)
        path, chance = found["path"], found["chance"]
    except (ValueError, RecursionError, KeyError, TypeError):
        raise Refused("what is sent has no path") from None
    if not isinstance(path, list) or not 0 < len(path) <= _MOST_STEPS:
        raise Refused(f"a path is a list of at most {_MOST_STEPS} numbers")
    if not all(type(each) is int and each >= 0 for each in (*path, chance)):
        raise Refused("a path is a list of whole numbers")
    if chance > _MOST_BY_CHANCE:
        raise Refused(f"at most {_MOST_BY_CHANCE} steps are made by chance at once")
    return tuple(path), chance
