calls = 0


def is_even(k: int) -> bool:
    global calls
    calls += 1
    return k % 2 == 0


def f(a: int, b: int) -> int:
    global calls
    calls = 0
    both = is_even(a) and is_even(b)
    one = is_even(a) or is_even(b)
    return calls * 100 + (10 if both else 0) + (1 if one else 0)
