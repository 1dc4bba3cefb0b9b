"""The laws of the domain of intervals."""

from __future__ import annotations

from hypothesis import assume, given
from hypothesis import strategies as st

from rebsync.intervals import (
    ANY,
    INT32,
    Interval,
    around,
    compared,
    exactly,
    of_binary,
    of_unary,
    signed,
    unsigned,
)

_NUMBERS = st.integers(-9, 9) | st.integers(-(2**33), 2**33)
_OPERATORS = ("+", "-", "*", "/", "%", "<<", ">>", "&", "|", "^", "**")
_COMPARES = ("<", "<=", ">", ">=", "==", "!=")


@st.composite
def intervals(draw: st.DrawFn) -> tuple[Interval, int]:
    """An interval with a number in it."""
    found = around((draw(_NUMBERS), draw(_NUMBERS)))
    return found, draw(
        st.sampled_from((found.low, found.high)) | st.integers(found.low, found.high)
    )


def _truncated(left: int, right: int) -> int:
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) is (right < 0) else -quotient


def _result(operator: str, left: int, right: int) -> int:
    match operator:
        case "/":
            return _truncated(left, right)
        case "%":
            return left - right * _truncated(left, right)
        case "**":
            return 0
        case _:
            found = eval(f"({left}) {operator} ({right})")
            assert isinstance(found, int)
            return found


@given(st.sampled_from(_OPERATORS), intervals(), intervals())
def test_what_an_operator_gives_is_in_the_interval(
    operator: str, one: tuple[Interval, int], other: tuple[Interval, int]
) -> None:
    (left, a), (right, b) = one, other
    assume(b != 0 or operator not in ("/", "%"))
    assume(0 <= b <= 80 or operator not in ("<<", ">>"))
    found = of_binary(operator, left, right)
    assert found.includes(exactly(_result(operator, a, b))) or found == ANY


@given(st.sampled_from("-+~!"), intervals())
def test_what_a_sign_gives_is_in_the_interval(sign: str, one: tuple[Interval, int]) -> None:
    of, number = one
    found = {"-": -number, "+": number, "~": ~number, "!": int(not number)}[sign]
    assert of_unary(sign, of).includes(exactly(found))


@given(st.sampled_from(_COMPARES), intervals(), intervals())
def test_a_true_comparison_takes_no_number_away(
    sign: str, one: tuple[Interval, int], other: tuple[Interval, int]
) -> None:
    (left, a), (right, b) = one, other
    found = compared(left, sign, right)
    assert found is None or left.includes(found)
    if eval(f"({a}) {sign} ({b})"):
        assert found is not None
        assert found.includes(exactly(a))


@given(intervals(), intervals(), intervals())
def test_join_is_the_least_upper_bound_and_meet_the_greatest_lower(
    one: tuple[Interval, int], other: tuple[Interval, int], third: tuple[Interval, int]
) -> None:
    (a, _), (b, number), (c, _) = one, other, third
    joined, met = a.join(b), a.meet(b)
    assert joined == b.join(a)
    assert joined.includes(a)
    assert joined.includes(b)
    assert c.includes(joined) == (c.includes(a) and c.includes(b))
    assert (met is not None and met.includes(exactly(number))) == a.includes(exactly(number))
    assert met is None or (a.includes(met) and b.includes(met))
    assert a.join(b.join(c)) == joined.join(c)


@given(intervals(), intervals(), st.lists(_NUMBERS))
def test_widening_is_an_upper_bound(
    one: tuple[Interval, int], later: tuple[Interval, int], thresholds: list[int]
) -> None:
    (a, _), (b, _) = one, later
    assert a.widen(a.join(b), sorted(thresholds)).includes(a.join(b))


@given(intervals(), st.lists(intervals(), min_size=40, max_size=40), st.lists(_NUMBERS, max_size=9))
def test_widening_ends(
    start: tuple[Interval, int], steps: list[tuple[Interval, int]], numbers: list[int]
) -> None:
    """Each step takes a bound beyond the next threshold: between them there is none."""
    thresholds = sorted({*numbers, INT32.low, INT32.high})
    now, changes = start[0], 0
    for step, _ in steps:
        wider = now.widen(now.join(step.meet(INT32) or now), thresholds)
        changes += wider != now
        now = wider
    assert changes <= len(thresholds) + 2


@given(intervals(), st.integers(1, 63))
def test_a_type_makes_numbers_of_its_own(one: tuple[Interval, int], bits: int) -> None:
    of, number = one
    half = 1 << bits
    for whole, made in (
        (signed(bits), (number + half) % (2 * half) - half),
        (unsigned(bits), number % half),
    ):
        assert whole.includes(of.in_type(whole))
        assert of.in_type(whole).includes(exactly(made))
