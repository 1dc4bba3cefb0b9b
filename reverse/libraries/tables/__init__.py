"""One module for each library: every module here is found, and gives its `LIBRARIES`."""
