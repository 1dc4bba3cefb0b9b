"""Times fed back: what a recorded run took at the places of a model, and a model that allows it.

Model x Recording -> RunTimes -> Proposals -> text of the model. `bodies` finds which delays and
sends a recorded body ran, `measuring` times them, `proposals` says what the model has to allow.
"""
