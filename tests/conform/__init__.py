"""Recorded runs against models."""
