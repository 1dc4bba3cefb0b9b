"""Types of C++ and what they make of numbers: ranges, widths, conversions, literals."""
