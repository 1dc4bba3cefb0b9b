"""What is around a package that was read: its environment, and an observer of its topics."""
