"""One search by many machines: workers of Ray that each own a share of the states.

The search is breadth first, level by level, and gives the numbers, events and runs of one machine;
how, templates/shard.c says. `shard.py` is one worker's share of it, `worker.py` what Ray calls,
`pool.py` the workers, which are replaced when they are lost, `search.py` the levels, and `scope.py`
what a cluster is not asked for.
"""


class NoCluster(Exception):
    """There is no cluster to search with; the text says why."""
