"""Bodies of nodes that people could have written in Python, as models."""
