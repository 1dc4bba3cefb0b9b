"""Histories: random edits of a model and of its package, with `rebsync sync` in between.

`python -m tests.roundtrip.histories` draws sequences of edits by a seed, holds every sync against
the laws (`laws.py`), and prints how many steps were merged, left a conflict or were refused, each
refusal with its reason, and every law that did not hold with the seed that shows it.
"""
