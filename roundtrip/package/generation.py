"""What is generated for a model, as the round trip needs it: to compare with, not to write."""

from __future__ import annotations

from rebsync.config import Config
from rebsync.diagnostics import Findings, RebsyncError, Severity
from rebsync.source import Source


def generated(source: Source, config: Config, stem: str) -> dict[str, str]:
    """The files of the package of a model by their paths, without `.rebsync/`.

    `stem` is the name of the model's file without its suffix. RebsyncError: it has no package.
    """
    from rebsync.forward.generate import generate
    from rebsync.forward.limits import limits
    from rebsync.grammars.parser import parse_model
    from rebsync.static import analyse

    parsed = parse_model(source)
    analysis = analyse(parsed.model)
    wrong = Findings(source, (*parsed.diagnostics, *analysis.diagnostics)).errors
    found = () if wrong else tuple(limits(parsed.model, analysis, config, stem))
    if wrong or any(d.severity is Severity.ERROR for d in found):
        raise RebsyncError([Findings(source, (*wrong, *found))])
    return generate(parsed.model, parsed.comments, analysis, config, stem)
