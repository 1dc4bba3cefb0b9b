"""Builds the syntax tree while lark reduces: one method a rule of timed_rebeca.lark."""

from __future__ import annotations

from rebsync.grammars.tree_bodies import Expressions, Statements
from rebsync.grammars.tree_structure import Structure


class TreeBuilder(Structure, Statements, Expressions):
    """The rules of timed_rebeca.lark, all together."""
