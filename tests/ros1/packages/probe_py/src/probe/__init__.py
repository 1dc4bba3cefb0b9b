"""A rebec whose bodies are scripts."""
