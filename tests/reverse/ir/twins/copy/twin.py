class Point:
    def __init__(self, x: int, y: int) -> None:
        self.x = x
        self.y = y

    def copied(self) -> "Point":
        return Point(self.x, self.y)


def f(k: int) -> int:
    a = Point(k, 2)
    b = a.copied()
    c = a
    b.x += 10
    c.y += 5
    return a.x * 1000 + a.y * 100 + b.x * 10 + b.y
