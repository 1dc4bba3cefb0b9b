"""Behaviour of models: models go in; bisimilarity, or proved properties with runs, comes out."""
