"""From the syntax tree to the instructions that both engines run: the meaning, said once."""

from rebsync.checker.lowering.system import lower

__all__ = ["lower"]
