"""Where the robots of a run are when: their moves, driven as the generated drive does."""

from rebsync.checker.movement.of_trace import movement_of

__all__ = ["movement_of"]
