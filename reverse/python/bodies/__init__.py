"""Bodies of functions that people wrote, as statements of the model."""
