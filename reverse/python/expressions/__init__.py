"""Expressions of Python that mean the same in generated code and in what people wrote."""
