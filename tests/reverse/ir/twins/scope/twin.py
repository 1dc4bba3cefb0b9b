count = 0


class Guard:
    def __enter__(self) -> None:
        global count
        count += 1

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        global count
        count += 10


def f(k: int) -> int:
    global count
    count = 0
    with Guard():
        if k > 2:
            return count
        count *= 2
    return count
