"""Linkages with every dyad, fixed and moving guides, both branches."""

import pytest

from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Guide
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism
from linkages import LINKAGES as DRAWN

CRANK = Crank(0.05, start=0.3, pin="A")
FOUR_BAR = RRR("A", "B", "C", "rod", "rocker", 0.2, 0.12)
YOKE = RPP("A", "yoke", "yoke_block", Guide((0.0, 0.0), 1.2), Guide((0.1, 0.02), 0.3))

LINKAGES = {
    "six-bar with slider": Mechanism(
        CRANK,
        (FOUR_BAR, RRP("C", "D", "link", 0.25, (0.0, -0.05))),
        ground={"B": (0.18, 0.0)},
        points=(LinkPoint("S", "rod", 0.1, 0.02),),
    ),
    "offset slotted lever": Mechanism(
        CRANK,
        (RPR("A", "B", "lever", "block", Guide((0.03, 0.012), 0.2)), RRP("C", "ram", "rod", 0.3, (0.0, 0.1), 0.1)),
        ground={"B": (0.0, -0.15)},
        points=(LinkPoint("C", "lever", 0.02, 0.3),),
    ),
    "lever behind, crank clockwise": Mechanism(
        Crank(0.05, direction=-1, pin="A"),
        (RPR("A", "B", "lever", "block", Guide((0.03, 0.012), 0.2), branch=-1),),
        ground={"B": (0.0, -0.15)},
    ),
    "guide on the lever": Mechanism(
        CRANK,
        (RPR("A", "B", "lever", "block"), PRP("D", "up", "ram", Guide((0.0, 0.01), 0.05, "lever"), Guide((0, 0.2)))),
        ground={"B": (0.0, -0.15)},
    ),
    "guides on rocker and yoke": Mechanism(
        CRANK,
        (
            FOUR_BAR,
            YOKE,
            RRP("O", "S", "arm", 0.3, (0.02, 0.03), 0.4, 1, "rocker"),
            RRP("A", "T", "leg", 0.3, (0.02, 0.03), 0.4, -1, "yoke"),
        ),
        ground={"B": (0.18, 0.0), "O": (0.0, -0.1)},
    ),
    "yoke on the rod": Mechanism(
        CRANK,
        (FOUR_BAR, RPP("O", "yoke", "yoke_block", Guide((0.01, 0.0), 1.3), Guide((0.02, 0.03), 0.4, "rod"))),
        ground={"B": (0.18, 0.0), "O": (0.0, 0.1)},
    ),
    "crank shaper": DRAWN["shaper"],
    **{name: DRAWN[name] for name in ("whitworth", "scotch yoke", "watt", "stephenson", "slotted press")},
}


@pytest.fixture
def linkages():
    """Return all linkages by name."""
    return LINKAGES


@pytest.fixture(params=list(LINKAGES))
def linkage(request):
    """Return one linkage after the other."""
    return LINKAGES[request.param]
