"""Everything here expects what somebody else printed.

Published cases of mechanisms that no machine file expresses, with the reason:

* synthesis: the fifteen four-bars through five points (Morgan and Wampler, J. Mech. Des. 112, 1990, problem 7). Files
  have lengths that are known; what a synthesis gives is analysed, like the crank-rocker and the slotted lever made for
  a swing and a time ratio.
* rubbing speeds of pins, and the point of least speed on a rod (Khurmi and Gupta, ex. 7.2): the velocity of any stated
  point is there, but pins of linkages have no size.
* readings of engines on a brake (Gupta, Fundamental of internal combustion engines, ex. 16.4, a Morse test, and
  the brake of ex. 16.5): forces of a brake and flows of fuel describe a test, not a machine.
* the Ross yoke by the displacement formula of its program (Urieli, D-90), which takes the end of the yoke on a
  straight line where it goes on an arc: a linkage moves as it is made.
"""

from pathlib import Path

import pytest


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests of this folder."""
    for item in items:
        if item.path.is_relative_to(Path(__file__).parent):
            item.add_marker("elsewhere")
