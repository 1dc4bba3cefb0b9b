"""What a search by a cluster on this machine costs for each state: bytes, texts, memory, processor.

    python bench/cluster.py exact|compacted WORKERS MODEL [CONSTANT=VALUE ...]

`states`, `orders` and `checkpoints` are bytes that workers write: states for others, what puts new
ones in order, and checkpoints. `messages` are the texts of one worker for another in a level.
`memory` is what the processes of workers have more at the end, `cpu` what they spend.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

from searching import program_of

from rebsync.checker.cluster.connecting import Crew, connected
from rebsync.checker.cluster.search import ClusterSearch
from rebsync.checker.exploration import Limits
from rebsync.checker.problem import LOCAL, Cluster


def own_memory() -> int:
    """The bytes of a process that are its own: objects of Ray are in memory of all."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return next(1024 * int(line.split()[1]) for line in status.splitlines() if "RssAnon" in line)


def spent(crew: Crew, workers: int) -> tuple[float, int]:
    """The seconds of the processor that workers have taken, and the memory that is their own."""
    asked = [
        crew.actor(number).__ray_call__.remote(lambda _: (time.process_time(), own_memory()))
        for number in range(workers)
    ]
    seconds, memory = zip(*crew.ray.get(asked), strict=True)
    return sum(seconds), sum(memory)


def main() -> None:
    kind, count, path, *constants = sys.argv[1:]
    program = program_of(Path(path), dict(c.split("=", 1) for c in constants))
    cluster = Cluster(LOCAL, int(count))
    crew, workers = connected(cluster)
    ClusterSearch(program, "ftts", (), (), cluster).run(Limits(states=2))  # all is loaded
    before = spent(crew, workers)
    search = ClusterSearch(program, "ftts", (), (), cluster, kind == "compacted")
    found = search.run(Limits())
    after = spent(crew, workers)
    assert found.reason is None
    sent, states, levels = search.traffic, found.states, found.depth + 1
    figures = {
        "states": states,
        "transitions": found.transitions,
        "levels": levels,
        "sent": sent.states / states,
        "orders": sent.orders / states,
        "checkpoints": sent.checkpoints / states,
        "messages": sent.messages / levels,
        "memory": (after[1] - before[1]) / states,
        "cpu": 1e6 * (after[0] - before[0]) / states,
    }
    print(json.dumps({k: round(v, 2) for k, v in figures.items()}))


if __name__ == "__main__":
    main()
