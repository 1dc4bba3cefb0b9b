"""Tests of where robots are when."""
