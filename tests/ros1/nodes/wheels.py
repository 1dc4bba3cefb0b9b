"""The wheels of a robot: they drive as they are told, but only so much of the way."""

from __future__ import annotations

import math


class Wheels:
    """Begin away from the origin and turned, as odometry does."""

    def __init__(self, grip: float, fastest: float) -> None:
        self.x, self.y, self.heading = 3.0, -2.0, 0.7
        self.grip, self.fastest = grip, fastest
        self.begun = self.x, self.y, self.heading

    def step(self, forward: float, left: float, turn: float, elapsed: float) -> None:
        """Drive on at some velocity for some seconds."""
        way = self.grip * elapsed
        forward = max(-self.fastest, min(self.fastest, forward)) * way
        left = max(-self.fastest, min(self.fastest, left)) * way
        self.x += forward * math.cos(self.heading) - left * math.sin(self.heading)
        self.y += forward * math.sin(self.heading) + left * math.cos(self.heading)
        self.heading += turn * elapsed

    def driven(self) -> tuple[float, float]:
        """How far they are from where they began, in the directions that they had then."""
        east, north, turn = self.x - self.begun[0], self.y - self.begun[1], -self.begun[2]
        return (
            east * math.cos(turn) - north * math.sin(turn),
            east * math.sin(turn) + north * math.cos(turn),
        )
