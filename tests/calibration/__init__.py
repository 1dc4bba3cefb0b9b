"""Tests of times that are measured and fed back."""
