"""All kinds of changes: those that change what a system does, and those that do not."""

from __future__ import annotations

from tests.roundtrip.mutations import bodies, joints, neutral, sending, spelling, surroundings

BEHAVIOUR = (*bodies.KINDS, *sending.KINDS, *joints.KINDS, *surroundings.KINDS)
NEUTRAL = (*neutral.KINDS, *spelling.KINDS)
BY_NAME = {kind.name: kind for kind in (*BEHAVIOUR, *NEUTRAL)}
