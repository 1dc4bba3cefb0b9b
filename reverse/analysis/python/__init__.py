"""What Python refuses: calls, types, attributes, names without a value."""
