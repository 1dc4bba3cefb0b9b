"""Nodes that people wrote, as reactive classes and a system."""
