"""Patches of model texts: two models go in; the text of one with changes of the other comes out."""
