"""Andrews' squeezing mechanism: seven bodies, one degree of freedom, a spring and a constant torque, over 0.03 s.

Problem of the Test Set for Initial Value Problem Solvers (Bari), from E. Hairer, G. Wanner: Solving Ordinary
Differential Equations II, Springer, 2nd ed. 1996, ch. VII.7. The printed reference (PSIDE) is good to 2.7e-10 in the
angles and 5e-8 in the rates; the 34-digit values are from an energy quadrature and an extrapolation of the index-1
form, which agree to 16 digits.
"""

from __future__ import annotations

import runpy
import time
import types
from pathlib import Path

import numpy as np
import pytest

from crankwork.dynamics.reduction import reduced_inertia
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.mechanism import slider_crank
from crankwork.shaft.energy_machine import energy_machine
from crankwork.shaft.energy_motion import EnergyMachine, moment_after
from crankwork.shaft.speed import ReducedMachine
from crankwork.shaft.transient import run

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


@pytest.fixture(scope="module", params=[False, True], ids=["default", "fast"])
def machine(request, andrews):
    if request.param:
        pytest.importorskip("numba")
    return energy_machine(andrews.MECHANISM, andrews.DRIVE, andrews.SPRINGS, fast=request.param)


def test_angles_and_rates_at_the_end(andrews, machine):
    moment = moment_after(machine, andrews.END, angle=andrews.START)
    angles, rates = andrews.coordinates(moment)
    assert angles == pytest.approx(np.array(andrews.ANGLES), rel=1e-13)
    assert rates == pytest.approx(np.array(andrews.RATES), rel=1e-12)
    assert angles == pytest.approx(np.array(PRINTED_ANGLES), rel=1e-9)
    assert rates == pytest.approx(np.array(PRINTED_RATES), rel=2e-7)
    assert moment.tail < 1e-12


def test_the_start(andrews, machine):
    """The first acceleration of the crank, printed as 14222.4439199541, is torque over inertia at rest."""
    inertia, _, slope = machine.state(np.array([andrews.START]))
    assert float((andrews.DRIVE - slope[0]) / inertia[0]) == pytest.approx(14222.4439199541, rel=1e-12)


def test_energy_does_not_drift(andrews):
    assert andrews.energy_drift(fast=False) < 1e-13


def test_it_is_quick_without_extras(andrews):
    machine = energy_machine(andrews.MECHANISM, andrews.DRIVE, andrews.SPRINGS)
    times = []
    for _ in range(5):
        start = time.perf_counter()
        moment_after(machine, andrews.END, angle=andrews.START)
        times.append(time.perf_counter() - start)
    assert min(times) < 0.05


def test_the_equation_of_motion_gives_the_same(andrews):
    """J q'' + J' q'^2 / 2 = M, started from rest over two turns, against the energy quadrature."""
    conservative = energy_machine(andrews.MECHANISM, andrews.DRIVE, andrews.SPRINGS)

    def inertia(angle):
        moved = linkage_motion(andrews.MECHANISM, CrankGrid.from_radians(np.sort(angle, axis=None)))
        found = reduced_inertia(andrews.MECHANISM, moved)
        order = np.argsort(np.argsort(angle, axis=None))
        return tuple(one[order].reshape(angle.shape) for one in found)

    def torque(angle, _):
        return andrews.DRIVE - conservative.state(angle.ravel())[2].reshape(angle.shape)

    started = run(ReducedMachine(inertia, torque), angle=andrews.START, cycles=2, until_steady=False)
    moment = moment_after(conservative, float(started.time[-1]), angle=andrews.START)
    assert started.angle[-1] == pytest.approx(moment.angle, rel=1e-11)
    assert started.speed[-1] == pytest.approx(moment.speed, rel=1e-11)
    assert started.energy_drift < 1e-12


def test_a_shorter_time_and_a_running_start(andrews, machine):
    """Half the time and then the other half is the whole."""
    half = moment_after(machine, andrews.END / 2, angle=andrews.START)
    again = moment_after(machine, andrews.END / 2, angle=half.angle, speed=half.speed)
    assert again.angle == pytest.approx(andrews.ANGLES[0], rel=1e-12)
    early = moment_after(machine, 1e-4, angle=andrews.START)
    assert early.angle - andrews.START == pytest.approx(14222.4439199541 * 1e-8 / 2, rel=1e-3)
    still = moment_after(machine, 0.0, angle=1.0, speed=2.0)
    assert (still.angle, still.speed) == (1.0, 2.0)


def test_a_hill_that_is_too_high():
    hill = EnergyMachine(lambda at: (1 + 0 * at, 1 - np.cos(at), np.sin(at)), drive=0.1)
    with pytest.raises(MethodError, match="stands still shortly before"):
        moment_after(hill, 100.0)


def test_what_is_not_compiled():
    pytest.importorskip("numba")
    with pytest.raises(MethodError, match="RRR dyads only"):
        energy_machine(slider_crank(0.1, 0.3), 1.0, fast=True)
