"""Andrews' squeezing mechanism over 0.03 s: crankwork's energy quadrature, timed and compared with 34-digit values.

Run with `python benchmarks/andrews.py`. Seven bodies, one degree of freedom, a spring and a constant driving torque:
problem of the Test Set for IVP solvers (Hairer, Wanner: Solving Ordinary Differential Equations II, ch. VII.7).
"""

from __future__ import annotations

import math
import time

import numpy as np

from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.dyads import RRR
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, body_at
from crankwork.shaft.energy_machine import Spring, energy_machine
from crankwork.shaft.energy_motion import Moment, moment_after

# lengths [m], masses [kg], moments of inertia [kg m2], driving torque [N m], spring [N/m], [m], as printed
A, B, C = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
DRIVE, STIFFNESS, FREE_LENGTH = 0.033, 4530.0, 0.07785
START, END = -0.06171389001427645, 0.03

MECHANISM = Mechanism(
    Crank(0.007, link="K1", pin="R"),
    (
        RRR("R", "B", "P", "K2", "K3", 0.028, 0.035, 1),
        RRR("P", "A", "E", "K4", "K5", 0.02, 0.04, -1),
        RRR("P", "A", "G", "K6", "K7", 0.02, 0.04, 1),
    ),
    ground={"A": A, "B": B, "C": C},
    points=(
        LinkPoint("S1", "K1", 0.00092),
        LinkPoint("S2", "K2", 0.0115),
        LinkPoint("S3", "K3", 0.01874, 0.01043),
        LinkPoint("S4", "K4", 0.01421),
        LinkPoint("S5", "K5", 0.02308, 0.00916),
        LinkPoint("S6", "K6", 0.01421),
        LinkPoint("S7", "K7", 0.01228, 0.00449),
        LinkPoint("D", "K3", 0.018, 0.02),
    ),
    bodies=tuple(
        body_at(f"K{i}", mass, inertia, f"S{i}")
        for i, mass, inertia in (
            (1, 0.04325, 2.194e-6),
            (2, 0.00365, 4.410e-7),
            (3, 0.02373, 5.255e-6),
            (4, 0.00706, 5.667e-7),
            (5, 0.0705, 1.169e-5),
            (6, 0.00706, 5.667e-7),
            (7, 0.05498, 1.912e-5),
        )
    ),
)
SPRINGS = (Spring("C", "D", STIFFNESS, FREE_LENGTH),)
REPEATS = 200

# 34-digit values of cases/andrews_A03, from an energy quadrature and an extrapolation that agree to 16 digits
ANGLES = (
    15.81077119515370709712,
    -15.75637105841183946973,
    0.04082224011964580485828,
    -0.5347301163420795937702,
    0.5244099658799540693717,
    0.5347301163420795937702,
    1.048080741041937873069,
)
RATES = (
    1139.920302259106064198,
    -1424.379295177540073196,
    11.03291191061859374533,
    19.29337410503204083163,
    0.5735699148295024538173,
    -19.29337410503204083163,
    0.3231791492491308749916,
)


def coordinates(moment: Moment) -> tuple[Array, Array]:
    """Return the seven angles of the test set (beta, Theta, gamma, Phi, delta, Omega, epsilon) and their rates."""
    frames = linkage_motion(MECHANISM, CrankGrid.from_radians(np.array([moment.angle]))).frames
    angle = {name: math.atan2(float(one.sin[0]), float(one.cos[0])) for name, one in frames.items()}
    rate = {name: moment.speed * float(one.angle_1[0]) for name, one in frames.items()}
    delta, epsilon, turn = angle["K5"], angle["K7"] + math.pi / 2, 2 * math.pi
    small = [
        angle["K3"] + math.pi / 2,
        angle["K4"] - delta - math.pi / 2,
        delta,
        angle["K6"] - epsilon - math.pi,
        epsilon,
    ]
    folded = [math.remainder(one, turn) for one in small]
    # Theta turns back once per turn of the crank
    theta = math.remainder(angle["K2"] - math.pi, turn) - moment.angle
    rates = [
        moment.speed,
        rate["K2"] - moment.speed,
        rate["K3"],
        rate["K4"] - rate["K5"],
        rate["K5"],
        rate["K6"] - rate["K7"],
        rate["K7"],
    ]
    return np.array([moment.angle, theta, *folded]), np.array(rates)


def solution(*, fast: bool) -> tuple[Moment, float]:
    """Return where the mechanism is at the end, and the best time of one solution [s], compilation left out."""
    best = math.inf
    machine = energy_machine(MECHANISM, DRIVE, SPRINGS, fast=fast)
    for _ in range(REPEATS):
        start = time.perf_counter()
        moment = moment_after(machine, END, angle=START)
        best = min(best, time.perf_counter() - start)
    return moment, best


def main() -> None:
    """Print times, errors and energy drift with and without the extra `fast`."""
    for fast in (False, True):
        moment, seconds = solution(fast=fast)
        angles, rates = coordinates(moment)
        worst, worst_rate = np.max(np.abs(angles / ANGLES - 1)), np.max(np.abs(rates / RATES - 1))
        print(
            f"{'fast' if fast else 'NumPy':6}{seconds * 1e3:8.3f} ms   relative error of angles {worst:.1e}, of rates "
            f"{worst_rate:.1e}, energy drift {energy_drift(fast=fast):.1e}"
        )


def energy_drift(*, fast: bool) -> float:
    """Return kinetic energy gained less work done, over the former, with the torque integrated on its own. [-]"""
    machine = energy_machine(MECHANISM, DRIVE, SPRINGS, fast=fast)
    moment = moment_after(machine, END, angle=START)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    half = (moment.angle - START) / 2
    _, _, slope = machine.state(START + half * (1 + nodes))
    return abs(half * float(weights @ (DRIVE - slope)) / moment.energy - 1)


if __name__ == "__main__":
    main()
