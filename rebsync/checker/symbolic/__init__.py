"""Symbolic execution of bodies: whether two of them do the same, whatever they are given."""
