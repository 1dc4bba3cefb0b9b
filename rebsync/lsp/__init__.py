"""The language server: texts of an editor in, values of its protocol out."""
