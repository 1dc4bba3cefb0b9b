"""What a comparison of a recorded run with a model says, in each form of the command."""
