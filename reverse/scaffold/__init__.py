"""What is around the bodies of generated code: the facts that join nodes, the run-time part."""
