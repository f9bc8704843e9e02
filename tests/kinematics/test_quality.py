"""The type of a four-bar linkage."""

import pytest

from crankwork.mechanism.structure import grashof
from each import for_each

pytestmark = pytest.mark.elsewhere


@for_each(
    ("lengths", "kind"),
    [
        ((2.5, 7, 4.5, 8), "crank-rocker"),
        ((4, 2, 5, 6), "double rocker"),
        ((5, 6, 2, 4), "rocker-crank"),
        ((4, 5, 6, 2), "double crank"),
        ((3, 4, 5, 11), "triple rocker"),
        ((2, 4, 2, 4), "change point"),
    ],
)
def test_types(lengths, kind):
    assert grashof(*lengths).type == kind
