"""Python to the intermediate form: one function at a time, from the trees of `reverse/python`."""
