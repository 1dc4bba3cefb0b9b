"""Intervals of the variables of a class, over statements of the model."""
