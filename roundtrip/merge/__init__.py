"""Three-way merge: base, model and code go in; the merged text and files come out."""
