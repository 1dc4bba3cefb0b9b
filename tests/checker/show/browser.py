"""A real browser, driven through the WebDriver protocol with nothing but the standard library."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, TypeVar
from urllib.request import ProxyHandler, Request, build_opener

_OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
)
_ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
T = TypeVar("T")

_PATIENCE = 60.0  # s, what a busy machine may need
_ENDS = 20.0  # s, within which a driver ends its browser and itself
_NAMES = ("chromium", "chromium-browser", "google-chrome")


def missing_browser() -> str | None:
    """Why there is no browser to drive, or None."""
    if shutil.which("chromedriver") is None:
        return "chromedriver is not installed"
    if not any(shutil.which(name) for name in _NAMES):
        return "chromium is not installed"
    return None


@dataclass(frozen=True)
class Browser:
    """A session of the browser; `url` is where its commands go."""

    url: str

    def open(self, page: Path, fragment: str = "") -> None:
        """Opens a file anew."""
        self.command("POST", "url", {"url": "about:blank"})
        self.command("POST", "url", {"url": page.as_uri() + fragment})
        # A page takes no input before it has been painted.
        painted = "requestAnimationFrame(() => requestAnimationFrame(arguments[0]))"
        self.command("POST", "execute/async", {"script": painted, "args": []})

    def run(self, script: str, *arguments: object) -> Any:  # noqa: ANN401
        """The value of the body of a function that runs in the page."""
        return self.command("POST", "execute/sync", {"script": script, "args": list(arguments)})

    def press(self, *keys: str) -> None:
        """Presses and releases keys, by character or WebDriver's code for it."""
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        keyboard = {"type": "key", "id": "keyboard", "actions": actions}
        self.command("POST", "actions", {"actions": [keyboard]})

    def click(self, selector: str) -> None:
        """Clicks the middle of the first element that a selector finds."""
        found = self.command("POST", "element", {"using": "css selector", "value": selector})
        move = {"type": "pointerMove", "origin": {_ELEMENT: found[_ELEMENT]}, "x": 0, "y": 0}
        press = [{"type": kind, "button": 0} for kind in ("pointerDown", "pointerUp")]
        mouse = {"type": "pointer", "id": "mouse", "actions": [move, *press]}
        self.run("arguments[0].scrollIntoView({block: 'center', inline: 'center'})", found)
        self.command("POST", "actions", {"actions": [mouse]})

    def until(self, read: Callable[[Browser], T], holds: Callable[[T], bool]) -> T:
        """What is read in the page once it holds: what a click has asked for may come later."""
        end = time.monotonic() + _PATIENCE
        while not holds(found := read(self)):
            assert time.monotonic() < end, f"never: {found}"
            time.sleep(0.05)
        return found

    def resize(self, width: int, height: int) -> None:
        """Gives the window a size."""
        self.command("POST", "window/rect", {"width": width, "height": height})

    def picture(self, path: Path) -> None:
        """Keeps what the window shows."""
        path.write_bytes(base64.b64decode(self.command("GET", "screenshot")))

    def command(self, method: str, name: str, value: object = None) -> Any:  # noqa: ANN401
        """What a command of the protocol answers."""
        return _request(method, f"{self.url}/{name}", value)


@contextmanager
def browser(profile: Path, *options: str) -> Iterator[Browser]:
    """Starts a browser with a fresh profile, and ends it."""
    driver = subprocess.Popen(
        ["chromedriver", "--port=0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    try:
        root = f"http://127.0.0.1:{_port(driver.stdout)}/session"
        session = _request("POST", root, _wanted([f"--user-data-dir={profile}", *options]))
        url = f"{root}/{session['sessionId']}"
        try:
            yield Browser(url)
        finally:
            with suppress(OSError):  # it is ended below
                _request("DELETE", url)
    finally:
        _end(driver)
        if driver.stdout is not None:
            driver.stdout.close()


def _end(driver: subprocess.Popen[str]) -> None:
    """Ends a driver and its browser: on a busy machine it may wait for that for good."""
    driver.terminate()
    try:
        driver.wait(_ENDS)
    except subprocess.TimeoutExpired:
        os.killpg(driver.pid, signal.SIGKILL)
        driver.wait()


def _wanted(options: Sequence[str]) -> dict[str, Any]:
    binary = next(path for name in _NAMES if (path := shutil.which(name)))
    chosen = {"binary": binary, "args": [*_OPTIONS, *options]}
    capabilities = {"browserName": "chrome", "goog:chromeOptions": chosen}
    return {"capabilities": {"alwaysMatch": capabilities}}


def _port(output: IO[str] | None) -> int:
    """The port that the driver says it has taken."""
    assert output is not None
    for line in output:
        if found := re.search(r"started successfully on port (\d+)", line):
            return int(found[1])
    raise AssertionError("chromedriver did not start")


def _request(method: str, url: str, value: object = None) -> Any:  # noqa: ANN401
    body = None if method != "POST" else json.dumps(value or {}).encode()
    request = Request(url, body, {"Content-Type": "application/json"}, method=method)
    with build_opener(ProxyHandler({})).open(request, timeout=120) as answer:
        return json.load(answer)["value"]
