"""Synchronisation: a checked package goes in; the texts to write, or the conflicts, come out."""
