"""Tests of packages that take classes, helpers and messages of others in their workspace."""
