"""Keeps a model and its package in step: markers, manifest, differences."""
