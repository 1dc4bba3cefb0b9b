"""Comparison of bodies: two callables go in; differences of statements, expressions come out."""
