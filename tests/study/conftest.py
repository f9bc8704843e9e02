"""What tests of studies share."""

import pytest


@pytest.fixture
def by_arrays(monkeypatch):
    """Calculate kernels by arrays, without what compiles them."""
    monkeypatch.setattr("crankwork.kernel.compiled.compiles", lambda: False)
