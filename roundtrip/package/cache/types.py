"""The classes of which values are kept between runs: a closed table, as entries name them."""

from __future__ import annotations

from functools import cache
from importlib import import_module

_NAMES = {
    "rebsync.checker.result": "Coverage Extreme MeasureRange Result Violation",
    "rebsync.checker.steps": "Action",
    "rebsync.checker.trace": "Change ShownMessage ShownRebec Trace TraceStep",
    "rebsync.diagnostics": "Diagnostic Edit Findings Severity",
    "rebsync.expressions": (
        "Annotation Assign Binary BoolLiteral Broken Call Cast Choice Conditional FloatLiteral"
        " Index InstanceOf IntLiteral Member Name New NullLiteral Paren Postfix Self StringLiteral"
        " Super Type Unary"
    ),
    "rebsync.model": (
        "Constructor Env Interface KnownRebecs Main MessageServer Method Model ReactiveClass Rebec"
        " Refused StateVars"
    ),
    "rebsync.reverse.files.packages": "Listing",
    "rebsync.reverse.findings": "Finding Grade Ordered",
    "rebsync.reverse.generated.cpp_kept": "ClassRead",
    "rebsync.roundtrip.verdict.result": "AcceptedFinding CheckResult",
    "rebsync.roundtrip.package.cache.classes": "CachedClass",
    "rebsync.roundtrip.diff.difference": (
        "Added Aspect Changed Comparison Element Moved Place Removed Renamed StatementInserted"
        " StatementMoved StatementRemoved Undetermined"
    ),
    "rebsync.roundtrip.package.state": "PackageState",
    "rebsync.roundtrip.verdict.cached": "CachedVerdict",
    "rebsync.roundtrip.sync.refusals": "CachedRefusals",
    "rebsync.roundtrip.package.managed": "ManagedPackage",
    "rebsync.roundtrip.package.models": "CodeModel",
    "rebsync.roundtrip.package.record": "Record",
    "rebsync.roundtrip.diff.operands": "SourcedModel UnreadPlace",
    "rebsync.roundtrip.verdict.drift": "Drift Mover Verdict",
    "rebsync.source": "Source SourceSpan Span",
    "rebsync.statements": (
        "ArrayInitializer Block Break Case Continue Declaration Declarator Empty"
        " ExpressionStatement For If Local Parameter Return Switch While"
    ),
}
MODULES = {name: module for module, names in _NAMES.items() for name in names.split()}


@cache
def type_of(name: str) -> type:
    """The class of a name; its module is imported when first asked for. KeyError: none has it."""
    found = getattr(import_module(MODULES[name]), name)
    assert isinstance(found, type)
    return found
