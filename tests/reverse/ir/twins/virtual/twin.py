class Shape:
    def area(self, k: int) -> int:
        return k

    def twice(self, k: int) -> int:
        return 2 * self.area(k)


class Square(Shape):
    def area(self, k: int) -> int:
        return k * k


def f(k: int) -> int:
    shape = Shape()
    square = Square()
    return shape.twice(k) * 1000 + square.twice(k)
