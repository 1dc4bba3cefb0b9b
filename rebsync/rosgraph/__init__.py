"""The computation graph of what was read: nodes, topics, services and actions, and findings."""
