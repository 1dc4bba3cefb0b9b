"""One search by many machines: workers of Ray that each own a share of the states.

The search is breadth first, level by level, and gives the numbers, events and runs of one machine:
how is said in templates/shard.c. `shard.py` is one worker's share, `worker.py` what of it Ray calls,
`pool.py` the workers, which are replaced when they are lost, and `search.py` the levels.
"""
