"""Temporal properties: LTL and TCTL, decided on a finished state space."""

from __future__ import annotations

from rebsync.checker.temporal.lasso import Lasso
from rebsync.checker.temporal.ltl import Fairness, check_ltl
from rebsync.checker.temporal.tctl import Branching, check_tctl

__all__ = ["Branching", "Fairness", "Lasso", "check_ltl", "check_tctl"]
