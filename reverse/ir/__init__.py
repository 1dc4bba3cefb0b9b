"""The intermediate form: what functions do, as frozen values that name no language.

`types` are what values are, `operators` what is applied to them, `expressions` trees that are
evaluated from left to right, `statements` what has effects, `program` functions and classes.
`walk` goes through all of it, `dump` shows it as text. Lowerings stand in rooms of their own
(`python/`, `cpp/`); nothing else here or over it knows syntax.
"""
