"""Andrews' squeezing mechanism over 0.03 s: compiled from its memory, and IDA of SUNDIALS on its seven bodies.

Run with `python benchmarks/andrews.py [--json]`. Seven bodies, one degree of freedom, a spring and a constant driving
torque: problem of the Test Set for IVP solvers (Hairer, Wanner: Solving Ordinary Differential Equations II, ch. VII.7).
Ours is timed from what a file states of a design to where it is in the end: inertia and torque over the crank angle by
the kernel of 64 designs, then the steps. IDA comes with scikit-sundae, where that is installed, its residual compiled
by Numba. Times are those of the processor, medians of runs in turns.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import math
import statistics
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

import crankwork
from crankwork.analysis.path_coordinate import path_coordinate
from crankwork.analysis.transient import TransientModel
from crankwork.formula.traced_value import TracedValue
from crankwork.kernel.compiled import Kernel
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.shaft.transient import Integrator, TransientSystem

FILE = Path(__file__).parents[1] / "examples" / "andrews-squeezer.toml"
MACHINE = crankwork.read(FILE)
START, END, RUNS, DESIGNS = MACHINE.mechanism.crank.start, 0.03, 5, 64
FIELDS = {"transient.torque": 0.033, "links.K7.mass": 0.05498}
TOLERANCES = (1e-9, 1e-10, 1e-11, 1e-12)

# 34-digit values from an energy quadrature and an extrapolation that agree to 16 digits
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
FIRST = (START, 0.0, 0.45527981916307037, 0.22266839016588588, 0.48736497954384256, -0.22266839016588588,
         1.2305474445498212)  # fmt: skip
MULTIPLIERS = (98.56687039624109, -6.122688344255662)


class Moment(NamedTuple):
    """How far the crank has turned, and how fast it turns. [rad], [rad/s]"""

    turn: float
    speed: float


def machine() -> TransientSystem:
    """Return the mechanism as its crank feels it."""
    return TransientModel(crankwork.analyse(MACHINE).solved, path_coordinate(MACHINE, None)).system


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


def solution() -> Moment:
    """Return where the mechanism is at the end."""
    course = Integrator(machine(), 0.0, 0.0).until(END)
    turn, speed, _ = course.at(np.array([END]))
    return Moment(float(turn[0]), float(speed[0]))


def kernel() -> Kernel:
    """Return the motion in time compiled, for designs with another torque and mass."""
    description = crankwork.Description(FILE.read_text(encoding="utf-8"))
    middle = np.array(list(FIELDS.values()))
    rows = [middle, *(middle * (1 + sign * 0.01 * one) for one in np.eye(2) for sign in (-1, 1))]

    def memory(row: Array) -> Mapping[str, TracedValue]:
        stated = zip(FIELDS, row.tolist(), ("N*m", "kg"), strict=True)
        return crankwork.analyse(description.machine([f"{key}={value!r} {unit}" for key, value, unit in stated])).trace

    memories = [memory(row) for row in rows]
    return Kernel(memories, np.array(rows), ["final_turn", "final_speed"], CrankGrid.from_degrees, cycle=360.0)


def designs(count: int = DESIGNS) -> Array:
    """Return designs, the stated one first."""
    middle = np.array(list(FIELDS.values()))[:, None]
    return np.asarray(middle * (1 + 0.01 * np.linspace(0.0, 1.0, count)))


def errors(angles: Array, rates: Array) -> tuple[float, float]:
    """Return the largest relative errors of angles and rates."""
    return float(np.max(np.abs(angles / ANGLES - 1))), float(np.max(np.abs(rates / RATES - 1)))


def seven_bodies() -> Callable[..., None]:
    """Return the residual of the mechanism of the test set, index 1: q' = v, v' = w, M w = f - G'l, G w = -G_1 v."""
    from numba import njit  # noqa: PLC0415 - for the peer only

    m_1, m_2, m_3, m_4, m_5, m_6, m_7 = 0.04325, 0.00365, 0.02373, 0.00706, 0.0705, 0.00706, 0.05498
    i_1, i_2, i_3, i_4, i_5, i_6, i_7 = 2.194e-6, 4.41e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5
    xb, yb, xc, yc, c_0, l_0, mom = -0.03635, 0.03273, 0.014, 0.072, 4530.0, 0.07785, 0.033
    d, da, e, ea, rr, ra, ss, sa, sb, sc, sd = (
        0.028,
        0.0115,
        0.02,
        0.01421,
        0.007,
        0.00092,
        0.035,
        0.01874,
        0.01043,
        0.018,
        0.02,
    )
    ta, tb, u, ua, ub, zf, zt, fa = 0.02308, 0.00916, 0.04, 0.01228, 0.00449, 0.02, 0.04, 0.01421

    @njit(error_model="numpy")
    def residual(_, y, y_1, res):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        be, th, ga, ph, de, om, ep = y[0], y[1], y[2], y[3], y[4], y[5], y[6]
        bep, thp, php, dep, omp, epp = y[7], y[8], y[10], y[11], y[12], y[13]
        v, w, l = y[7:14], y[14:21], y[21:27]  # noqa: E741
        G = np.zeros((6, 7))
        sbt, cbt = d * math.sin(be + th), d * math.cos(be + th)
        for k in (0, 2, 4):
            G[k, 0], G[k, 1] = -rr * math.sin(be) + sbt, sbt
            G[k + 1, 0], G[k + 1, 1] = rr * math.cos(be) - cbt, -cbt
        G[0, 2], G[1, 2] = -ss * math.cos(ga), -ss * math.sin(ga)
        G[2, 3], G[3, 3] = -e * math.cos(ph + de), -e * math.sin(ph + de)
        G[2, 4], G[3, 4] = G[2, 3] + zt * math.sin(de), G[3, 3] - zt * math.cos(de)
        G[4, 5], G[5, 5] = zf * math.sin(om + ep), -zf * math.cos(om + ep)
        G[4, 6], G[5, 6] = G[4, 5] - u * math.cos(ep), G[5, 5] - u * math.sin(ep)
        both, phd, ome = (bep + thp) ** 2, (php + dep) ** 2, (omp + epp) ** 2
        x, z = -rr * math.cos(be) * bep**2 + cbt * both, -rr * math.sin(be) * bep**2 + sbt * both
        res[21], res[22] = x + ss * math.sin(ga) * v[2] ** 2, z - ss * math.cos(ga) * v[2] ** 2
        res[23] = x + e * math.sin(ph + de) * phd + zt * math.cos(de) * dep**2
        res[24] = z - e * math.cos(ph + de) * phd + zt * math.sin(de) * dep**2
        res[25] = x + zf * math.cos(om + ep) * ome + u * math.sin(ep) * epp**2
        res[26] = z + zf * math.sin(om + ep) * ome - u * math.cos(ep) * epp**2
        xd, yd = sd * math.cos(ga) + sc * math.sin(ga) + xb, sd * math.sin(ga) - sc * math.cos(ga) + yb
        length = math.hypot(xd - xc, yd - yc)
        force = -c_0 * (length - l_0) / length
        fx, fy = force * (xd - xc), force * (yd - yc)
        o, p = e - ea, zf - fa
        f = (
            mom - m_2 * da * rr * thp * (thp + 2 * bep) * math.sin(th),
            m_2 * da * rr * bep**2 * math.sin(th),
            fx * (sc * math.cos(ga) - sd * math.sin(ga)) + fy * (sd * math.cos(ga) + sc * math.sin(ga)),
            m_4 * zt * o * dep**2 * math.cos(ph),
            -m_4 * zt * o * php * (php + 2 * dep) * math.cos(ph),
            -m_6 * u * p * epp**2 * math.cos(om),
            m_6 * u * p * omp * (omp + 2 * epp) * math.cos(om),
        )
        M_12 = m_2 * (da**2 - da * rr * math.cos(th)) + i_2
        M_11 = m_1 * ra**2 + m_2 * (rr**2 - 2 * da * rr * math.cos(th) + da**2) + i_1 + i_2
        M_45 = m_4 * (o**2 + zt * o * math.sin(ph)) + i_4
        M_55 = m_4 * (zt**2 + 2 * zt * o * math.sin(ph) + o**2) + m_5 * (ta**2 + tb**2) + i_4 + i_5
        M_67 = m_6 * (p**2 - u * p * math.sin(om)) + i_6
        M_77 = m_6 * (p**2 - 2 * u * p * math.sin(om) + u**2) + m_7 * (ua**2 + ub**2) + i_6 + i_7
        res[14] = M_11 * w[0] + M_12 * w[1]
        res[15] = M_12 * w[0] + (m_2 * da**2 + i_2) * w[1]
        res[16] = (m_3 * (sa**2 + sb**2) + i_3) * w[2]
        res[17] = (m_4 * o**2 + i_4) * w[3] + M_45 * w[4]
        res[18] = M_45 * w[3] + M_55 * w[4]
        res[19] = (m_6 * p**2 + i_6) * w[5] + M_67 * w[6]
        res[20] = M_67 * w[5] + M_77 * w[6]
        for j in range(7):
            res[j], res[7 + j], res[14 + j] = y_1[j] - v[j], y_1[7 + j] - w[j], res[14 + j] - f[j]
            for k in range(6):
                res[14 + j] += G[k, j] * l[k]
                res[21 + k] += G[k, j] * w[j]

    return residual


def by_ida(tolerance: float) -> Callable[[], tuple[float, float]]:
    """Return what solves the seven bodies with IDA and returns its errors."""
    from sksundae.ida import IDA  # noqa: PLC0415 - a peer, where it is installed

    # rates, accelerations and multipliers are thousands
    each = np.repeat([tolerance, 1e3 * tolerance], (7, 20))
    solver = IDA(seven_bodies(), rtol=tolerance, atol=each, algebraic_idx=list(range(14, 27)), max_num_steps=200_000)
    first, slopes = np.zeros(27), np.zeros(27)
    first[:7], first[21:23], first[14:16] = FIRST, MULTIPLIERS, (14222.4439199541, -10666.8329399656)
    slopes[7:14] = first[14:21]

    def run() -> tuple[float, float]:
        y = solver.solve(np.array([0.0, END]), first, slopes).y[-1]
        return errors(y[:7], y[7:14])

    return run


def timed(functions: dict[str, Callable[[], object]], runs: int = RUNS) -> dict[str, float]:
    """Return the median processor time of each, in turns. [s]"""
    spent: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(runs):
        for name, function in functions.items():
            start = time.thread_time()
            function()
            spent[name].append(time.thread_time() - start)
    return {name: statistics.median(one) for name, one in spent.items()}


def rows() -> Iterator[tuple[str, float, float, float]]:
    """Yield what was timed, its time for one motion and its errors. [s]"""
    ours, many = kernel(), designs()
    turn, speed = ours(many).values[:, 0].tolist()
    functions: dict[str, Callable[[], object]] = {"compiled memory": lambda: ours(many)}
    missed = {"compiled memory": errors(*coordinates(Moment(turn, speed)))}
    if importlib.util.find_spec("sksundae") is not None:
        for tolerance in TOLERANCES:
            name = f"IDA {tolerance:.0e}"
            functions[name] = solve = by_ida(tolerance)
            missed[name] = solve()
    for name, spent in timed(functions).items():
        yield name, spent / (DESIGNS if name == "compiled memory" else 1), *missed[name]


def main() -> None:
    """Print times, errors and how many times as long the peer takes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    found = list(rows())
    if parser.parse_args().json:
        print(json.dumps([dict(zip(("name", "seconds", "angles", "rates"), one, strict=True)) for one in found]))
        return
    for name, seconds, angles, rates in found:
        times = f"{seconds / found[0][1]:7.1f} times ours"
        print(
            f"{name:16s} {seconds * 1e3:9.3f} ms {times}, relative error of angles {angles:.1e}, of rates {rates:.1e}"
        )
    if len(found) > 1:
        print("wanted of IDA with tolerances of 1e-12: 100 times ours, and worse rates")
    else:
        print("IDA was not measured: scikit-sundae is not installed")


if __name__ == "__main__":
    main()
