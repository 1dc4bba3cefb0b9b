"""Packages of which every file was touched, so that digests tell nothing: all are in step."""
