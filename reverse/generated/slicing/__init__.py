"""The backward slice of the model's behaviour in generated C++, and what is outside of it."""
