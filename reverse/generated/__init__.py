"""Classes of generated code, however edited."""
