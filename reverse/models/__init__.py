"""Pieces of models, whatever they are read from."""
