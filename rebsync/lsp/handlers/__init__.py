"""What the server answers to requests of an editor, by what they are about."""
