"""Bodies of functions as statements of the model."""
