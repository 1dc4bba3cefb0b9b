"""A cluster of Ray: one that runs somewhere, or one that is started on this machine."""

from __future__ import annotations

import os
from typing import Any

from rebsync.checker.cluster import NoCluster
from rebsync.checker.cluster.worker import Worker, before
from rebsync.checker.problem import LOCAL, Cluster


class Crew:
    """Ray, and processes of it for workers, which work for one search after the other."""

    def __init__(self, ray: Any) -> None:  # noqa: ANN401 - a module
        self.ray = ray
        self.before = ray.remote(num_cpus=0)(before)
        self._worker = ray.remote(num_cpus=1, max_restarts=0)(Worker)
        self._actors: dict[int, Any] = {}

    def actor(self, number: int) -> Any:  # noqa: ANN401 - as Ray has it
        """The process of a worker."""
        if number not in self._actors:
            self._actors[number] = self._worker.remote()
        return self._actors[number]

    def dismiss(self, number: int) -> None:
        """Leaves a process, which may have ended, for a new one."""
        del self._actors[number]


_crew: Crew | None = None


def connected(cluster: Cluster) -> tuple[Crew, int]:
    """Ray, connected to a cluster until this process ends; and how many workers there are to be.

    Raises NoCluster when Ray is missing, nobody answers, or there are not enough processors.
    """
    global _crew
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # nothing is sent to others
    try:
        import ray
    except ImportError:
        raise NoCluster("Ray is not installed: pip install 'rebsync[cluster]'") from None
    if _crew is None or not ray.is_initialized():
        _start(ray, cluster)
        _crew = Crew(ray)
    processors = int(ray.cluster_resources().get("CPU", 0))
    workers = cluster.workers or processors
    if not 0 < workers <= processors:
        raise NoCluster(f"the cluster has {processors} processors for {workers} workers")
    return _crew, workers


def _start(ray: Any, cluster: Cluster) -> None:  # noqa: ANN401 - a module
    quiet: dict[str, Any] = {"log_to_driver": False, "logging_level": "error"}
    try:
        if cluster.address == LOCAL:
            processors = cluster.workers or os.cpu_count()
            ray.init("local", num_cpus=processors, include_dashboard=False, **quiet)
        else:
            ray.init(cluster.address, **quiet)
    except (ConnectionError, OSError, RuntimeError, ValueError) as error:
        first = str(error).strip().partition("\n")[0]
        raise NoCluster(f"no cluster answers at {cluster.address}: {first}") from None
