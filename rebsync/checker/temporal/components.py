"""The strongly connected components of a graph of numbered nodes."""

from __future__ import annotations

from array import array

from rebsync.checker.look import Look, unwatched


def components(first: array[int], target: array[int], look: Look = unwatched) -> array[int]:
    """A number for each node; nodes have the same number when each can reach the other.

    Edge `e` of node `n` has first[n] <= e < first[n+1]. An edge between components goes to the one
    with the higher number. (Pearce's variant of Tarjan's algorithm: one number a node.)
    """
    count = len(first) - 1
    rank = array("q", bytes(8 * count))  # 0: not met; then an order, at last a component
    position = array("q", first[:count])  # the next edge to follow
    is_root = bytearray(b"\1") * count
    order, component = 1, count
    closing: list[int] = []
    for start in range(count):
        if rank[start]:
            continue
        rank[start], order = order, order + 1
        trail = [start]
        while trail:
            node = trail[-1]
            edge, end, low = position[node], first[node + 1], rank[node]
            while edge < end:
                other = rank[target[edge]]
                if not other:
                    break
                if other < low:
                    low, is_root[node] = other, 0
                edge += 1
            position[node], rank[node] = edge, low
            if edge < end:  # the target is visited first, then this edge is looked at again
                node = target[edge]
                rank[node], order = order, order + 1
                trail.append(node)
                continue
            trail.pop()
            if not node & 4095:
                look()
            if not is_root[node]:
                closing.append(node)
                continue
            order -= 1
            while closing and rank[closing[-1]] >= low:
                rank[closing.pop()], order = component, order - 1
            rank[node], component = component, component - 1
    return rank
