"""What of generated Python lies outside of the backward slice of the model's behaviour.

Logs, counters, diagnostics and the like only tell people something: what nothing of the model
reads, and what cannot fail, wait or act, has no effect on it (program slicing, Weiser 1981).

`silent.py`      the members, locals and statements of a class outside of the slice: a fixpoint
`candidates.py`  which of them the intermediate form is asked of, as lowering takes time
`effects.py`, `scopes.py`  whether statements only compute and keep: effects by the
                 intermediate form
`escapes.py`     whether a value leads to an array of the model, or to the node: escape analysis
`library_calls.py`  what functions of Python take without an error, by the types of arguments
`exceptions.py`, `messages.py`  what statements may raise; whether fields take what they get
`publishers.py`, `timers.py`, `services.py`  handles that are set up, of which no model hears
`numbers.py`     state variables that people added, and only tell
`logs.py`, `log_words.py`, `log_setup.py`  calls that log, where no class of the model is around
"""
