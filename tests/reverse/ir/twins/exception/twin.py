class Failure(Exception):
    def __init__(self, code: int) -> None:
        self.code = code


def risky(k: int) -> int:
    if k > 2:
        raise Failure(k)
    return k * 2


def f(k: int) -> int:
    try:
        return risky(k) + 1
    except Failure as failure:
        return failure.code * 100
