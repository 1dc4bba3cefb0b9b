"""The statements at the top of modules of generated Python: which of them no model has.

What a module imports, names and defines for the model is read where it is used. All else may only
bind names, raise nothing, and the names must be told to people, or to nobody.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reserved import NO_PYTHON_CLASSES
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.libraries.generated_calls import LOGGER
from rebsync.reverse.python.generated.import_effects import acting_lines
from rebsync.reverse.python.generated.named_constants import CodeConstants
from rebsync.reverse.python.generated.names import ModelNames
from rebsync.reverse.python.generated.pair_methods import is_context
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    expression_in,
    is_alias,
    is_text,
)
from rebsync.reverse.python.generated.slicing.log_setup import sets_up_logs
from rebsync.reverse.syntax.ancestors import ancestors, holds
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import Scope, module_named, module_of
from rebsync.reverse.syntax.py_tree import field, is_label, named, text_of

_WHY = "what this does is not in the model"
_NAMED = frozenset({"Server", "logging.getLogger", "getLogger", LOGGER})
_IMPORTS = frozenset(
    {"comment", "import_statement", "import_from_statement", "future_import_statement"}
)
_TYPES_ONLY = frozenset({"TYPE_CHECKING", "typing.TYPE_CHECKING"})
_BINDING = frozenset(
    {"expression_statement", "try_statement", "if_statement", "decorated_definition"}
)


@dataclass(frozen=True, slots=True)
class ModuleTop:
    """A module with classes of the model, `names` what each of these calls things."""

    module: Scope
    constants: CodeConstants
    names: Sequence[ModelNames]
    owners: Sequence[Scope]

    def check(self, findings: Findings) -> None:
        """Lists what a module does besides."""
        for node in self.odd():
            findings.unreadable(self.module.py.source, Unread(self.module.py.span(node), _WHY), "")

    def odd(self) -> Iterator[Node]:
        """The statements that are none of the model's, and may count for it."""
        found = [s for s in named(self.module.node) if not self._is_known(s)]
        silent = [n.silent for n in self.names]
        counters = frozenset.intersection(*(s.counters for s in silent)) if silent else frozenset()
        own = [owner.name for owner in self.owners]
        acting = acting_lines(self.constants.code, self.module, own, found) if found else None
        for statement in found:
            is_counted = bool(counters.intersection(_set_in(statement)))
            if not (is_counted or self._is_beside(statement, acting)):
                yield statement

    def _is_known(self, statement: Node) -> bool:
        """Whether a statement imports, or names and defines what is read where it is used."""
        module, constants = self.module, self.constants
        if any(c.type == "wildcard_import" for c in statement.children):
            return False
        inner = expression_in(statement)
        called, _ = call_parts(inner.child_by_field_name("right") if inner else None) or ("", [])
        if statement.type in _IMPORTS or called in _NAMED or is_text(statement):
            return True
        if constants.is_quiet(module, statement) or is_alias(module, statement):
            return True
        if sets_up_logs(module, statement):
            return True
        definition = statement.child_by_field_name("definition") or statement
        if definition.type == "class_definition":  # of other names generated code means its own
            return text_of(field(definition, "name")) not in NO_PYTHON_CLASSES
        if statement.type == "decorated_definition":
            return is_context(module, constants.code.scope_of(definition, module.py))
        is_for_types = statement.type == "if_statement" and not statement.children_by_field_name(
            "alternative"
        )
        return is_for_types and text_of(field(statement, "condition")) in _TYPES_ONLY

    def _is_beside(self, statement: Node, acting: Collection[int] | None) -> bool:
        """Whether a statement only binds names that no code of the model has to do with."""
        lines = range(statement.start_point.row + 1, statement.end_point.row + 2)
        if (
            statement.type not in _BINDING
            or acting is None
            or any(line in acting for line in lines)
        ):
            return False
        bindings = {n: b for n, b in self.module.names.items() if _binds(statement, b)}
        if not all(holds(statement, b.node) for of in bindings.values() for b in of):
            return False
        if any(n.silent.exceptions.raises(statement) for n in self.names[:1]):
            return False
        if any(map(self._is_imported, bindings)):
            return False
        return not any(self._are_asked(n, bindings.keys()) for n in self.names)

    def _is_imported(self, name: str) -> bool:
        """Whether another module has a name from this one."""
        code = self.constants.code
        others = (m for m in code.modules.values() if m is not self.module)
        return any(
            binding.node.type == "import_from_statement"
            and module_named(code, module_of(binding.node), other) is self.module
            for other in others
            for binding in other.names.get(name, ())
        )

    def _are_asked(self, names: ModelNames, bound: Collection[str]) -> bool:
        """Whether a class, or a function that it calls, names what is bound but to tell of it."""
        roots = [*(o.node for o in self.owners), *(h.function.node for h in names.helpers.values())]
        uses = (n for root in roots for n in nodes_in(root) if n.type == "identifier")
        return any(
            text_of(n) in bound
            and not is_label(n)
            and not any(map(names.silent.tells, ancestors(n)))
            for n in uses
        )


def _binds(statement: Node, bindings: Sequence[Binding]) -> bool:
    return any(holds(statement, b.node) for b in bindings)


def _set_in(statement: Node) -> Iterator[str]:
    """The variable that a statement makes."""
    inner = named(statement)[0] if named(statement) else statement
    if inner.type == "assignment":
        yield text_of(field(inner, "left"))
