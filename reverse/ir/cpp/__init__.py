"""C++ to the intermediate form: what the language does without saying so is said in the form."""
