"""Khurmi and Gupta, Theory of Machines, 14th ed., example 15.20: torque of the inertia of a horizontal engine.

Crank 0.3 m, rod 1.5 m with its centre of mass 0.5 m from the crankpin and a radius of gyration of 0.65 m, 125 rev/min
which the book takes as 13.1 rad/s, 30 degrees after the inner dead centre. Masses 300 kg (piston) and 250 kg (rod).
The book has two terms of the piston acceleration, the rod as two masses with a correction couple, and the weight of
the mass at the crankpin: 3840 N m in all. The rigid rod is nearer to that than 0.3 per cent.
"""

from dataclasses import replace

import numpy as np
import pytest

from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.reduction import crank_torque
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.load import Weight, applied_loads
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Body, Crank, Mechanism, body_at

ENGINE = Mechanism(
    Crank(0.3),
    (RRP("crank_pin", "piston_pin", "rod", 1.5),),
    (
        Body("rod", 250.0, 250 * 0.65**2, "crank_pin", "piston_pin", 0.5 / 1.5),
        body_at("piston_pin", 300.0, 0.0, "piston_pin"),
    ),
)
GRID = CrankGrid.from_degrees(np.array([30.0]))
# the exact rate of change of the kinetic energy of both bodies over the angle
EXACT = 3415.7234


def engine(speed: float) -> OperatingState:
    return OperatingState(ENGINE, linkage_motion(ENGINE, GRID), speed)


def test_inertia_torque():
    running = engine(125 * 2 * np.pi / 60)
    assert crank_torque(running).dynamic == pytest.approx(EXACT, abs=0.0005)
    assert joint_forces(running).balancing_torque == pytest.approx(EXACT, abs=0.0005)
    assert system_joint_forces(running).balancing_torque == pytest.approx(EXACT, abs=0.0005)


def test_with_the_weight_of_the_rod_as_printed():
    running = engine(13.1)
    loaded = replace(running, loads=applied_loads(ENGINE, running.motion, [Weight(9.81)]))
    assert joint_forces(loaded).balancing_torque == pytest.approx(3840, rel=0.003)
