"""Whether a piece of C++ can touch what the model has, and which calls of it are not written."""
