"""What names, numbers and handles in the code come to."""
