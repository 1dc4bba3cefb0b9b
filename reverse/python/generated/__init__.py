"""Generated classes that people edited: roles, statements, and what only people are told."""
