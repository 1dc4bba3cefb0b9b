"""Proof by mutation: what somebody changes in generated code is reported, and nothing else is.

`python -m tests.roundtrip.mutations` applies every kind of change to the package of every example
and prints, for each kind, how many changes `rebsync check` reported at the element that changed,
how many made it say "undetermined", each that it missed, and each false alarm. Kinds that change
what a system does are in `bodies.py`, `joints.py` and `surroundings.py`, those that do not in
`neutral.py`.
"""
