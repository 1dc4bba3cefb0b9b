"""The browser that the tests of pages share."""

from __future__ import annotations

from tests.checker.show.conftest import chromium, pytest_collection_modifyitems

__all__ = ["chromium", "pytest_collection_modifyitems"]
