"""What all tests share."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

# Drawing a model takes longer than hypothesis expects of one example.
_SLOW = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example)
settings.register_profile("quick", max_examples=50, deadline=None, suppress_health_check=_SLOW)
settings.register_profile(
    "few", max_examples=10, deadline=None, derandomize=True, suppress_health_check=_SLOW
)
settings.register_profile("long", max_examples=1000, deadline=None, suppress_health_check=_SLOW)
settings.load_profile(os.environ.get("REBSYNC_HYPOTHESIS", "quick"))
