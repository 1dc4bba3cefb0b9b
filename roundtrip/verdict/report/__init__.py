"""Verdicts in each output format: outcomes go in; lines, JSON, SARIF, JUnit come out."""
