"""Andrews' squeezing mechanism: seven bodies, one degree of freedom, a spring and a constant torque, over 0.03 s.

Problem of the Test Set for Initial Value Problem Solvers (Bari), from E. Hairer, G. Wanner: Solving Ordinary
Differential Equations II, Springer, 2nd ed. 1996, ch. VII.7. The printed reference (PSIDE) is good to 2.7e-10 in the
angles and 5e-8 in the rates; the 34-digit values are from an energy quadrature and an extrapolation of the index-1
form, which agree to 16 digits.
"""

import runpy
import types
from pathlib import Path

import numpy as np
import pytest

PRINTED_ANGLES = (
    15.81077119629904,
    -15.75637105984298,
    0.04082224013073101,
    -0.5347301163226948,
    0.5244099658805303,
    0.5347301163226948,
    1.048080741042263,
)
PRINTED_RATES = (
    1139.920302151208,
    -1424.379294994111,
    11.03291221937134,
    19.29337464421385,
    0.5735699284790808,
    -19.29337464421385,
    0.3231791658026955,
)


@pytest.fixture(scope="module")
def andrews():
    place = Path(__file__).parents[2] / "benchmarks" / "andrews.py"
    return types.SimpleNamespace(**runpy.run_path(str(place)))


def test_angles_and_rates_at_the_end(andrews):
    angles, rates = andrews.coordinates(andrews.solution())
    assert angles == pytest.approx(np.array(andrews.ANGLES), rel=1e-13)
    assert rates == pytest.approx(np.array(andrews.RATES), rel=1e-12)
    assert angles == pytest.approx(np.array(PRINTED_ANGLES), rel=1e-9)
    assert rates == pytest.approx(np.array(PRINTED_RATES), rel=2e-7)


def test_the_start(andrews):
    """The first acceleration of the crank, printed as 14222.4439199541, is torque over inertia at rest."""
    machine = andrews.machine()
    assert machine.acceleration(np.zeros(1), np.zeros(1), 1) == pytest.approx(14222.4439199541, rel=1e-12)
