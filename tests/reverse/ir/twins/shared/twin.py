class Counter:
    all = 0

    def __init__(self) -> None:
        self.own = 0

    def hit(self) -> None:
        self.own += 1
        Counter.all += 1


def f(k: int) -> int:
    Counter.all = k
    a = Counter()
    b = Counter()
    a.hit()
    b.hit()
    b.hit()
    return Counter.all * 100 + a.own * 10 + b.own
