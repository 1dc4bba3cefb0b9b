def f(k: int) -> int:
    values = [3, 1, 2]
    values.append(k)
    total = 0
    for value in values:
        total = total * 10 + value
    values[0] = 9
    return total + values[0] * len(values)
