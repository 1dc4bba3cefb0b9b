def f(k: int) -> int:
    total = 1

    def add(by: int) -> int:
        nonlocal total
        total += by * k
        return total

    first = add(2)
    second = add(3)
    return first * 1000 + second * 10 + total
