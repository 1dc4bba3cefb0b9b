"""Conformance checking: is a recorded run of the system a run of its verified model?

Model x Recording -> Conformance. `recording` has the values, `readers` make them of bags and logs,
`search` finds a run of the model that has the same observations (trace inclusion of one trace),
`diagnosis` says what the first step is that no run has, `finite` evaluates properties.
"""
