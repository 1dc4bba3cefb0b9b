"""Mutated inputs for every command: none may end in a traceback, or print what a terminal obeys."""
