"""Places where a function may do more than to give a value."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from rebsync.records import dataclass
from rebsync.reverse.analysis.element_counts import ElementCounts
from rebsync.reverse.analysis.held_values import texts_of
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.source import Span

BEYOND_TIMES = "this may be no time, or compare times of other clocks: then it throws"
ODD_PARAMETER = "this parameter may be of another type, or be declared already: then it throws"
NOTHING_THERE = "what this looks at may not be there, and the node may end"
NO_RESULT = "this may come to the end without a result, and the node may end"
SHIFTS_TOO_FAR = "this shifts by more than there are bits, and may do anything"
ODD_FORMAT = "this takes a value for a text, or lacks one, and may crash"
UNSAID = frozenset({BEYOND_TIMES, ODD_PARAMETER})  # what models say nothing of


@dataclass(frozen=True, slots=True)
class ParameterNeed:
    """A parameter for which a function may get None, or (`size`) fewer elements than so many."""

    function: str
    parameter: str
    size: int = 0


@dataclass(frozen=True, slots=True)
class Problem:
    """A place in a function; `raises` is the exception that is raised there, if one is.

    Where something is `given`, that is so only of calls that give it; what such a call may raise
    for that `is_of_call`. Nothing catches what has no exception: it does not end, acts, or has no
    lowering. Nor does anything catch `TERMINATES`.
    """

    function: str
    place: Span
    why: str
    raises: str = ""
    given: ParameterNeed | None = None
    is_of_call: bool = False

    def of_call(self) -> Problem:
        """The same of a call, whatever is given to the function that it stands in."""
        return replace(self, given=None, is_of_call=True)


@dataclass(frozen=True, slots=True)
class Called:
    """A function that runs, with which of its problems leave what is around the call.

    `gives` says what they are with the arguments of the call; without it none of these is None, and
    of containers among them nothing is known.
    """

    function: str
    tests: tuple[Callable[[Problem], bool], ...] = ()
    gives: Callable[[Problem], frozenset[Problem]] | None = None

    def leaving(self, problem: Problem) -> frozenset[Problem]:
        """What a problem of the function is for who calls it; nothing if it does not leave."""
        if not all(test(problem) for test in self.tests):
            return frozenset()
        if self.gives is not None:
            return self.gives(problem)
        if problem.given is None:
            return frozenset({problem})
        return frozenset({problem.of_call()} if problem.given.size else ())


class ProblemNotes:
    """What was found in a function so far, and what is known of the program around it.

    `is_model` says of a module, class or function whether it is the model's; `elements` how many
    elements each element of what a function gets has, by the function's name.
    """

    def __init__(
        self,
        function: Function,
        origins: Origins,
        counts: ElementCounts,
        is_model: Callable[[str], bool],
        elements: dict[str, int],
    ) -> None:
        self.function = function
        self.origins = origins
        self.counts = counts
        self.is_model = is_model
        self.elements = elements
        self.found: set[Problem | Called] = set()

    @property
    def table(self) -> LibraryOutcomes:
        """What is known of libraries."""
        return self.origins.table

    def problem(
        self,
        node: s.Statement | e.Expression,
        why: str,
        raises: str = "",
        given: ParameterNeed | None = None,
    ) -> None:
        """Notes what may happen at a place, or does where something is given."""
        place = getattr(node, "place", self.function.place)
        self.found.add(Problem(self.function.name, place, why, raises, given))

    def fails(
        self, node: s.Statement | e.Expression, failure: str, given: ParameterNeed | None = None
    ) -> None:
        """Notes that an operation may raise what the language raises for a failure."""
        raises = self.table.of_failure(failure)
        self.problem(node, f"this may fail: it {failure}", raises, given)

    def take(self, problems: Iterable[Problem | Called]) -> None:
        """Notes what was found elsewhere, or what functions run."""
        self.found |= set(problems)

    def texts_of(self, value: e.Expression) -> list[str]:
        """The texts that a value may be; none if that is not known."""
        return texts_of(self.origins, value, self.function.name)

    def is_parameter(self, value: e.Expression) -> bool:
        """Whether an expression is what the function gets for a parameter."""
        names = {p.name for p in self.function.parameters}
        return isinstance(value, e.Local) and value.name in names
