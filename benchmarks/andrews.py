"""Andrews' squeezing mechanism over 0.03 s, let go from its file: timed and compared with 34-digit values.

Run with `python benchmarks/andrews.py`. Seven bodies, one degree of freedom, a spring and a constant driving torque:
problem of the Test Set for IVP solvers (Hairer, Wanner: Solving Ordinary Differential Equations II, ch. VII.7).
"""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

import crankwork
from crankwork.analysis.charts import chart_of
from crankwork.analysis.loose import Loose
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.shaft.transient import FreeMachine, Run

MACHINE = crankwork.read(Path(__file__).parents[1] / "examples" / "andrews-squeezer.toml")
START, END, REPEATS = MACHINE.mechanism.crank.start, 0.03, 20

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


class Moment(NamedTuple):
    """How far the crank has turned, and how fast it turns. [rad], [rad/s]"""

    turn: float
    speed: float


def machine() -> FreeMachine:
    """Return the mechanism as its crank feels it."""
    return Loose(crankwork.analyse(MACHINE).solved, chart_of(MACHINE, None)).felt


def coordinates(moment: Moment) -> tuple[Array, Array]:
    """Return the seven angles of the test set (beta, Theta, gamma, Phi, delta, Omega, epsilon) and their rates."""
    frames = linkage_motion(MACHINE.mechanism, CrankGrid.from_radians(np.array([moment.turn]))).frames
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
    theta = math.remainder(angle["K2"] - math.pi, turn) - (START + moment.turn)
    rates = [
        moment.speed,
        rate["K2"] - moment.speed,
        rate["K3"],
        rate["K4"] - rate["K5"],
        rate["K5"],
        rate["K6"] - rate["K7"],
        rate["K7"],
    ]
    return np.array([START + moment.turn, theta, *folded]), np.array(rates)


def solution(repeats: int = REPEATS) -> tuple[Moment, float]:
    """Return where the mechanism is at the end, and the best time of one solution [s]."""
    best, felt = math.inf, machine()
    for _ in range(repeats):
        start = time.perf_counter()
        course = Run(felt, 0.0, 0.0).until(END)
        best = min(best, time.perf_counter() - start)
    turn, speed, _ = course.at(np.array([END]))
    return Moment(float(turn[0]), float(speed[0])), best


def main() -> None:
    """Print time and errors."""
    moment, seconds = solution()
    angles, rates = coordinates(moment)
    worst, worst_rate = np.max(np.abs(angles / ANGLES - 1)), np.max(np.abs(rates / RATES - 1))
    print(f"{seconds * 1e3:8.3f} ms   relative error of angles {worst:.1e}, of rates {worst_rate:.1e}")


if __name__ == "__main__":
    main()
