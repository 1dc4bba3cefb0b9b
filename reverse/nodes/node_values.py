"""What names, numbers and parameters of the code are in one node that a launch file starts."""

from __future__ import annotations

from fractions import Fraction

from rebsync.records import dataclass
from rebsync.reverse.graph import FromParameter, OneOf, Plain, Resolved, Under, Unresolved
from rebsync.reverse.launch.arithmetic import evaluate
from rebsync.reverse.launch.graph_names import join, resolve
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.parameter_sections import asked
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.nodes.node_units import Start
from rebsync.reverse.unknowns import Open, Text

_FOR_EVER = 1e18  # seconds


@dataclass(frozen=True, slots=True)
class Instance:
    """A rebec to be: what runs it, under which name, started by which tag of which launch file.

    Without a launch file a node has its own name in the global namespace and no parameters. What
    is `idle` is started by nobody: it stands for how the objects of its class would be wired.
    """

    start: Start
    name: str
    node: str
    launched: LaunchedNode | None = None
    launch: Launch | None = None
    idle: bool = False

    def topic(self, name: Resolved) -> Text:
        """The absolute name of a topic or service."""
        value = self.value(name)
        if isinstance(value, Open):
            return value
        if not isinstance(value, str) or not value:
            return Open("its name is no text")
        return self._resolved(value)

    def value(self, resolved: Resolved) -> Plain | Open:
        """A value as this node has it."""
        match resolved:
            case FromParameter():
                return self._from(resolved)
            case OneOf(values):
                if (own := of_object(self.start, resolved)) is not resolved:
                    return self.value(own)
                found = [self.value(v) for v in values]
                if found and all(f == found[0] for f in found):
                    return found[0]
                return Open("it is one of several, by the way that the program takes")
            case Under(name, handles):
                if len(handles) == 1:
                    return _text(join(handles[0], name))
                return Open("its node handle comes from outside of the files")
            case Unresolved(why):
                return Open(why)
            case plain:
                return plain

    def seconds(self, resolved: Resolved) -> Fraction | Open:
        """A time in seconds."""
        value = self.value(resolved)
        if isinstance(value, Open):
            return value
        if isinstance(value, bool) or not isinstance(value, int | float):
            return Open("it is no number")
        if not abs(value) < _FOR_EVER:
            return Open("it is no time that ends")
        exact = exact_seconds(value)
        return exact if exact >= 0 else Open("it is negative")

    def parameter(self, name: Resolved) -> Parameter | None:
        """The parameter of that name, where the launch files set it."""
        text = self.value(name)
        if self.launched is None or not isinstance(text, str):
            return None
        if self.start.unit.flat:
            return asked(self.launched.parameters, text.replace(".", "/"))
        absolute = self._resolved(text)
        own = self.launched.private_namespace
        if isinstance(absolute, Open) or isinstance(own, Open):
            return None
        if absolute.startswith(own):
            return asked(self.launched.parameters, absolute.removeprefix(own))
        return asked(self.launch.parameters if self.launch is not None else (), absolute)

    def _resolved(self, name: str) -> Text:
        if self.launched is None:
            return resolve(name, "/", self.node)
        return self.launched.resolved(name)

    def _from(self, resolved: FromParameter) -> Plain | Open:
        parameter = self.parameter(resolved.name)
        if parameter is None:
            if resolved.default is None:
                return Open("the parameter that it comes from is not set")
            return self._within(resolved, self.value(resolved.default))
        if isinstance(parameter.value, Open):
            return parameter.value
        if not isinstance(parameter.value, bool | int | float | str):
            return Open("the parameter that it comes from is a list")
        if resolved.expression is None:
            return self._within(resolved, parameter.value)
        if isinstance(parameter.value, str):
            return Open("the parameter that it comes from is no number")
        return evaluate(resolved.expression, {"value": parameter.value}, {})

    def _within(self, resolved: FromParameter, value: Plain | Open) -> Plain | Open:
        """A text that is a name under the handle of whoever asks for it."""
        if isinstance(value, str) and resolved.within:
            if len(set(resolved.within)) > 1:
                return Open("its node handle is one of several")
            return _text(join(resolved.within[0], value))
        return value


def of_object(start: Start, value: Resolved) -> Resolved:
    """Which of several values is that of an object, by the arguments that it is made of."""
    if not isinstance(value, OneOf) or start.made is None or not start.made.arguments:
        return value
    given = {node.id for node in start.made.arguments}
    own = [v for arguments, v in value.by if given <= arguments]
    return own[0] if own and all(v == own[0] for v in own) else value


def _text(text: Text) -> Plain | Open:
    return text


def exact_seconds(value: int | float) -> Fraction:
    """The number without the error of binary fractions: 0.1 is a tenth, 1/30 a thirtieth."""
    short = Fraction(repr(value))
    near = Fraction(value).limit_denominator(1000)
    return near if float(near) == float(value) else short
