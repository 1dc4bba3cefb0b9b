"""What Python refuses of one program, other than by values: each rule is made when first asked."""

from __future__ import annotations

from functools import cached_property

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.python.argument_types import ArgumentTypes
from rebsync.reverse.analysis.python.call_binding import CallBinding
from rebsync.reverse.analysis.python.class_decorators import ClassDecorators
from rebsync.reverse.analysis.python.construction_order import ConstructionOrder
from rebsync.reverse.analysis.python.declared_parameters import DeclaredParameters
from rebsync.reverse.analysis.python.fixed_attributes import FixedAttributes
from rebsync.reverse.analysis.python.float_numbers import FloatNumbers
from rebsync.reverse.analysis.python.inferred_types import InferredTypes
from rebsync.reverse.analysis.python.message_values import MessageValues
from rebsync.reverse.analysis.python.object_operators import ObjectOperators
from rebsync.reverse.libraries.routines import Language


class PythonRules:
    """The rules for one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins

    @cached_property
    def binding(self) -> CallBinding:
        """Which calls bind their arguments to the parameters of what they run."""
        is_python = self._origins.table.language is Language.PYTHON
        return CallBinding(self._origins.graph, self.decorators, is_python)

    @cached_property
    def decorators(self) -> ClassDecorators:
        """What decorates classes."""
        return ClassDecorators(self._origins.graph)

    @cached_property
    def construction(self) -> ConstructionOrder:
        """What constructors read before they have set it."""
        return ConstructionOrder(self._origins)

    @cached_property
    def fixed(self) -> FixedAttributes:
        """Which classes take no value for an attribute."""
        return FixedAttributes(self._origins.graph, self.decorators)

    @cached_property
    def objects(self) -> ObjectOperators:
        """Which objects lack what operators need."""
        return ObjectOperators(self._origins, self.decorators)

    @cached_property
    def types(self) -> InferredTypes:
        """Of which types values may be."""
        return InferredTypes(self._origins, self.arguments)

    @cached_property
    def floats(self) -> FloatNumbers:
        """Which numbers may be floats."""
        return FloatNumbers(self._origins, self.types)

    @cached_property
    def arguments(self) -> ArgumentTypes:
        """What functions get for their parameters."""
        return ArgumentTypes(self._origins, self.decorators)

    @cached_property
    def messages(self) -> MessageValues:
        """Which values are messages, or parts of these, whether or not their fields are known."""
        return MessageValues(self._origins.graph)

    @cached_property
    def declared(self) -> DeclaredParameters:
        """The parameters that nodes declare before their callbacks run."""
        return DeclaredParameters(self._origins)
