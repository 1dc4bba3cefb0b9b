"""What bodies can do, found without running them."""
