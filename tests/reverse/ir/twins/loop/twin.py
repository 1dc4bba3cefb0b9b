def f(n: int) -> int:
    total = 0
    for i in range(n):
        if i % 3 == 0:
            continue
        if total > 50:
            break
        total += i
    return total
