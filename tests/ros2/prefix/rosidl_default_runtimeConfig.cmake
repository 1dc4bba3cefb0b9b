# Nothing is needed at run time.
