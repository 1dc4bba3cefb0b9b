"""The grammars, and the parsers that turn text into values."""
