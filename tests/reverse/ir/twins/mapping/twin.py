def f(k: int) -> int:
    table = {1: 10, 2: 20}
    table[k] = table[k] + 1 if k in table else 5
    total = 0
    for key, value in table.items():
        total += key * value
    return total
