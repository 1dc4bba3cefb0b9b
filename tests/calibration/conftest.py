"""The browser that tests of pages share."""

from tests.checker.show.conftest import chromium, pytest_collection_modifyitems

__all__ = ["chromium", "pytest_collection_modifyitems"]
