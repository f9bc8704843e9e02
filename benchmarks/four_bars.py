"""The N-four-bar over ten seconds (IFToMM benchmark A02): crankwork beside Exudyn, against elliptic functions.

Run with `python benchmarks/four_bars.py 1 2 10`; Exudyn is compared where it is installed. Rods of 1 m and 1 kg, a row
of N parallelograms, pushed off upright with 1 m/s; it passes 2 N change points in every turn.
"""

from __future__ import annotations

import importlib.util
import math
import sys
import time
from pathlib import Path

import numpy as np

import crankwork
from crankwork.analysis.path_coordinate import path_coordinate
from crankwork.analysis.transient import TransientModel
from crankwork.shaft.transient import Integrator

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "literature"))
from test_free_motion import four_bars, turned

SECONDS = 10.0
STEPS = (10_000, 100_000)


def ours(count: int) -> tuple[float, float, float]:
    """Return seconds for reading and for a simulated second, and the error of the angle. [s], [s], [rad]"""
    start = time.perf_counter()
    machine = crankwork.read_machine(four_bars(count, SECONDS))
    read = time.perf_counter() - start
    results = crankwork.analyse(machine)
    loose = TransientModel(results.solved, path_coordinate(results.machine, None))
    start = time.perf_counter()
    course = Integrator(loose.felt, 0.0, -1.0).until(SECONDS)
    spent = time.perf_counter() - start
    return read, spent / SECONDS, abs(-course.at(np.array([SECONDS]))[0][0] - turned(count, SECONDS)[0])


def theirs(count: int, steps: int) -> tuple[float, float]:
    """Return seconds for a simulated second with Exudyn, and the error of the angle. [s], [rad]"""
    import exudyn as exu  # noqa: PLC0415 - a peer, where it is installed
    from exudyn import itemInterface as items  # noqa: N813, PLC0415 - one of its modules

    system = exu.SystemContainer().AddSystem()
    ground = system.AddObject(items.ObjectGround())

    def rod(x: float, y: float, angle: float, rates: tuple[float, float, float]) -> int:
        node = system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, y, angle], initialVelocities=[*rates]))
        body = system.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=1, inertia=1 / 12))
        centre = system.AddMarker(items.MarkerBodyPosition(bodyNumber=body))
        system.AddLoad(items.LoadForceVector(markerNumber=centre, loadVector=[0, -9.81, 0]))
        return int(body)

    def pin(body: int, at: float, other: int, there: list[float]) -> None:
        one = system.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[at, 0, 0]))
        two = system.AddMarker(items.MarkerBodyPosition(bodyNumber=other, localPosition=there))
        system.AddObject(items.ObjectJointRevolute2D(markerNumbers=[one, two]))

    uprights = [rod(k, 0.5, math.pi / 2, (0.5, 0.0, -1.0)) for k in range(count + 1)]
    for k, one in enumerate(uprights):
        pin(one, -0.5, ground, [k, 0, 0])
    for k in range(count):
        coupler = rod(k + 0.5, 1.0, 0.0, (1.0, 0.0, 0.0))
        pin(coupler, -0.5, uprights[k], [0.5, 0, 0])
        pin(coupler, 0.5, uprights[k + 1], [0.5, 0, 0])
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps, settings.timeIntegration.endTime = steps, SECONDS
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    start = time.perf_counter()
    system.SolveDynamic(settings)
    spent = time.perf_counter() - start
    angle = system.GetNodeOutput(0, exu.OutputVariableType.Coordinates)[2]
    return spent / SECONDS, abs(-angle - turned(count, SECONDS)[0])


def main() -> None:
    """Print times and errors, and how many times as long the peer takes."""
    for count in map(int, sys.argv[1:] or ["1", "2", "10"]):
        read, spent, error = ours(count)
        print(f"N = {count:3}: {spent * 1e3:8.2f} ms per second, error {error:.1e} rad; read in {read:.1f} s")
        if importlib.util.find_spec("exudyn") is None:
            continue
        for steps in STEPS:
            try:
                peer, miss = theirs(count, steps)
            except Exception as error:  # noqa: BLE001 - whatever keeps the peer from its end
                print(f"   Exudyn, {steps:8} steps: {error}")
                continue
            took = f"{peer * 1e3:8.1f} ms per second, {peer / spent:.1f} times ours"
            print(f"   Exudyn, {steps:8} steps: {took}, error {miss:.1e} rad")


if __name__ == "__main__":
    main()
