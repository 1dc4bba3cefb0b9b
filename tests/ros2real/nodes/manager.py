"""Changes the state of a node with a life cycle: `manager.py NODE WORD...`.

A word is a transition, of which the state that follows is written; `drives`, which waits until the
robot does; or `stands`, which asks that its last velocity is zero and stays so for some seconds.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import rclpy
from geometry_msgs.msg import Twist
from lifecycle_msgs.srv import ChangeState, GetState

_PATIENCE = 40.0  # s, on a busy machine
_STILL = 2.0  # s


class Manager:
    """Asks the node, and hears what its robot is told."""

    def __init__(self, name: str) -> None:
        self._node = rclpy.create_node("manager")
        self._change = self._node.create_client(ChangeState, f"{name}/change_state")
        self._get = self._node.create_client(GetState, f"{name}/get_state")
        self._speeds: list[float] = []
        self._node.create_subscription(
            Twist, f"{name}/cmd_vel", lambda twist: self._speeds.append(twist.linear.x), 100
        )
        if not self._change.wait_for_service(_PATIENCE):
            raise TimeoutError(name)

    def do(self, word: str) -> str:
        """What has come of a word."""
        if word == "drives":
            before = len(self._speeds)
            self._spin(lambda: any(self._speeds[before:]))
            return word
        if word == "stands":
            end = time.monotonic() + _STILL
            self._spin(lambda: time.monotonic() > end)
            return "drives" if any(self._speeds[-1:]) else word
        request = ChangeState.Request()
        request.transition.label = word
        self._ask(self._change, request)
        return str(self._ask(self._get, GetState.Request()).current_state.label)

    def _ask(self, client: Any, request: object) -> Any:  # noqa: ANN401 rclpy has no types
        future = client.call_async(request)
        self._spin(future.done)
        return future.result()

    def _spin(self, holds: Callable[[], bool]) -> None:
        limit = time.monotonic() + _PATIENCE
        while not holds():
            if time.monotonic() > limit:
                raise TimeoutError(str(self._speeds[-10:]))
            rclpy.spin_once(self._node, timeout_sec=0.05)


def main(name: str, *words: str) -> None:
    rclpy.init()
    manager = Manager(name)
    for word in words:
        print(manager.do(word), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
