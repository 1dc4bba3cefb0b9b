"""Nodes that people wrote, as reactive classes: set-up, entries, what starts them, what escapes."""
