"""What is known of numbers: signs, sizes, limits, constants."""
