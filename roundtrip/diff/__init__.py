"""Comparison of models: two models go in; a `Comparison`, differences with places, comes out."""
