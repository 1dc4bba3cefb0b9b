"""The model checker: what a model does, whether it holds, and runs that show why not."""
