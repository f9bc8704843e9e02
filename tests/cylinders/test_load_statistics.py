"""What a bearing load comes to, against loads whose means, extremes and reversals are known in closed form."""

import numpy as np
import pytest

from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.cylinders.wear import LoadReversal, polar_diagram, reversal
from each import for_each

pytestmark = pytest.mark.elsewhere

DEGREES = np.arange(0.0, 720.5, 0.5)
PHI = np.radians(DEGREES)


@for_each("turn", [0.0, 200.0, 690.0])
def test_the_longest_unbroken_stretch_counts(turn):
    """Tension from 100 to 130 and from 700 over the end of the cycle to 20, wherever the cycle begins."""
    ends = sorted((one + turn) % 720 for one in (20.0, 100.0, 130.0, 700.0))
    is_compression = [20 < (one - 1 - turn) % 720 <= 100 or 130 < (one - 1 - turn) % 720 <= 700 for one in ends]
    found = reversal([*ends, 720.0], [*is_compression, is_compression[0]], (5.0, -50.0))
    assert (found.tension, found.tension_peak, found.compression_peak) == (40.0, 5.0, 50.0)
    assert (found.compression, found.duration, found.ratio) == (570.0, 40.0, 0.1)


@for_each(("sign", "expected"), [(1, (720, 0, 3, 0)), (-1, (0, 720, 0, 3))])
def test_a_load_of_one_sign_does_not_reverse(sign, expected):
    found = reversal([720.0], [sign > 0], (-1.0, -3.0) if sign > 0 else (3.0, 1.0))
    assert found == expected
    assert (found.duration, found.ratio) == (0, 0)


def test_no_load_has_no_ratio():
    assert LoadReversal(720.0, 0.0, 0.0, 0.0).ratio == 0


# --- polar diagram


def test_the_pole_of_the_polar_diagram_lies_below_by_the_inertia():
    radial, tangential = 1000 * np.cos(PHI), 700 * np.sin(PHI / 2)
    load = BearingLoad(-(radial - 250.0), tangential)
    diagram = polar_diagram(load, DEGREES, 720.0, inertia=-250.0, step=45.0)
    assert np.allclose(diagram.across, tangential)
    assert np.allclose(diagram.down, radial)
    assert diagram.pole == (0.0, 250.0)
    from_pole = np.hypot(diagram.across - diagram.pole[0], diagram.down - diagram.pole[1])
    assert np.allclose(from_pole, load.resultant, rtol=1e-13)
    assert diagram.marks.tolist() == np.arange(0, 720, 45).tolist()
    assert np.allclose(diagram.marks_across, 700 * np.sin(np.radians(diagram.marks) / 2))
    assert np.allclose(diagram.marks_down, 1000 * np.cos(np.radians(diagram.marks)))
