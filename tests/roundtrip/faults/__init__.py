"""What can go wrong around `rebsync sync`: each fault with what it says, and nothing is lost.

`python -m tests.roundtrip.faults` makes every fault, interrupts a sync at every operation that
writes, and prints a table.
`python -m tests.roundtrip.faults.signals` ends real commands by signals at any moment.
"""
