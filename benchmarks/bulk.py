"""Seven values of 100,000 engines at 720 crank angles: compiled from the memory, NumPy in chunks, C++ with SLEEF.

C++ needs g++ and libsleef-dev. All run in turns on one core; the median of five is told, as designs per second.
"""

from __future__ import annotations

import argparse
import ctypes
import json
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

import crankwork
from crankwork.formula.known import Known
from crankwork.kernel.compiled import Bulk, Kernel
from crankwork.kinematics.crank_grid import CrankGrid

ENGINE = """
[crank]
radius = "50 mm"
speed = "2600 rpm"
[rod]
length = "190 mm"
mass = "1.2 kg"
small_end_share = 0.3
[piston]
mass = "0.8 kg"
[cylinder]
bore = "95 mm"
compression_ratio = 9
[flywheel]
fluctuation = 0.01
[gas]
cycle = "720 deg"
ambient = "0.1 MPa"
pressures = "absolute"
pieces = [
 {law = "constant", points = ["r", "a"]},
 {law = "polytropic", points = ["a", "c"], exponent = 1.35},
 {law = "polytropic", points = ["z", "b"], exponent = 1.25},
 {law = "constant", points = ["s", "t"]},
]
[gas.points]
r = {angle = "0 deg", pressure = "0.09 MPa"}
a = {angle = "180 deg", pressure = "0.09 MPa"}
c = {angle = "360 deg"}
z = {angle = "360 deg", pressure = "5 MPa"}
b = {angle = "540 deg"}
s = {angle = "540 deg", pressure = "0.11 MPa"}
t = {angle = "720 deg", pressure = "0.11 MPa"}
"""
FIELDS = {
    "crank.radius": ("m", 0.05), "rod.length": ("m", 0.19), "cylinder.bore": ("m", 0.095), "piston.mass": ("kg", 0.8),
    "crank.speed": ("rad/s", 2600 * np.pi / 30), "cylinder.compression_ratio": ("", 9.0),
}  # fmt: skip
KEYS = (
    "piston_force_max", "tangential_force_max", "mean_torque", "total_torque_max", "total_torque_min", "indicated_work",
    "flywheel_inertia",
)  # fmt: skip
ROD_MASS = 0.36
ANGLES, CHUNK = 720, 64


def kernel(steps: int | None) -> Kernel:
    """Return the calculation compiled."""
    description = crankwork.Description(ENGINE)
    middle = np.array([value for _, value in FIELDS.values()])
    rows = [middle]
    for at in range(len(middle)):
        rows += [np.where(np.arange(len(middle)) == at, part * middle, middle) for part in (0.97, 1.03)]

    def memory(design: np.ndarray) -> Mapping[str, Known]:
        pairs = zip(FIELDS.items(), design, strict=True)
        settings = [f"{key}={float(value)!r} {unit}".strip() for (key, (unit, _)), value in pairs]
        return crankwork.analyse(description.machine(settings)).memory

    memories = [memory(one) for one in rows]
    return Kernel(memories, np.array(rows), KEYS, CrankGrid.from_degrees, cycle=720.0, steps=steps)


def by_numpy(designs: np.ndarray) -> np.ndarray:
    """Return the values as an engineer writes them with NumPy: arrays of designs by angles, chunk by chunk."""
    angle = np.radians(np.arange(ANGLES))
    step, sine, cosine = angle[1], np.sin(angle), np.cos(angle)
    result = np.empty((7, designs.shape[1]))
    for start in range(0, designs.shape[1], CHUNK):
        r, l, bore, piston, w, ratio = (one[:, None] for one in designs[:, start : start + CHUNK])  # noqa: E741
        area = np.pi / 4 * bore**2
        swept = 2 * area * r
        clearance = swept / (ratio - 1)
        sin_beta = r / l * sine
        cos_beta = np.sqrt(1 - sin_beta**2)
        volume = clearance + area * (r * (1 - cosine) + l * (1 - cos_beta))
        pressure = np.empty_like(volume)
        pressure[:, :181] = 0.09e6
        pressure[:, 181:361] = 0.09e6 * ((swept + clearance) / volume[:, 181:361]) ** 1.35
        pressure[:, 361:541] = 5e6 * (clearance / volume[:, 361:541]) ** 1.25
        pressure[:, 541:] = 0.11e6
        shape = (cosine * cos_beta - sine * sin_beta) / cos_beta + r / l * cosine**2 / cos_beta**3
        force = area * (pressure - 0.1e6) - (piston + ROD_MASS) * r * w**2 * shape
        tangential = force * (sine * cos_beta + cosine * sin_beta) / cos_beta
        torque = tangential * r
        mean = torque.mean(axis=1, keepdims=True)
        energy = np.cumsum(((torque + np.roll(torque, -1, axis=1)) / 2 - mean) * step, axis=1)
        spread = np.maximum(energy.max(axis=1), 0) - np.minimum(energy.min(axis=1), 0)
        after = np.roll(pressure, -1, axis=1), np.roll(volume, -1, axis=1)
        work = ((pressure + after[0]) / 2 * (after[1] - volume)).sum(axis=1)
        result[:, start : start + CHUNK] = (
            force.max(axis=1), tangential.max(axis=1), mean[:, 0], torque.max(axis=1), torque.min(axis=1), work,
            spread / (0.01 * w[:, 0] ** 2),
        )  # fmt: skip
    return result


def by_cpp(folder: str | Path) -> Callable[[np.ndarray], np.ndarray] | str:
    """Return a function that does the same in C++, or why there is none."""
    library = Path(folder) / "bulk.so"
    source = Path(__file__).with_name("bulk.cpp")
    command = ["g++", "-O3", "-march=native", "-shared", "-fPIC", str(source), "-o", str(library), "-lsleef"]
    try:
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603 - a compiler on a file beside this one
    except (OSError, subprocess.CalledProcessError) as error:
        return str(error)
    engines = ctypes.CDLL(str(library)).engines
    pointer = ctypes.POINTER(ctypes.c_double)
    engines.argtypes = [pointer, pointer, ctypes.c_long, pointer, pointer, ctypes.c_double]
    angle = np.radians(np.arange(ANGLES))
    sine, cosine = np.sin(angle), np.cos(angle)

    def run(designs: np.ndarray) -> np.ndarray:
        result = np.empty((7, designs.shape[1]))
        given = [one.ctypes.data_as(pointer) for one in (designs, result, sine, cosine)]
        engines(given[0], given[1], designs.shape[1], given[2], given[3], ROD_MASS)
        return result

    return run


def measured(
    functions: Mapping[str, tuple[Callable[[np.ndarray], np.ndarray | Bulk], int]], designs: np.ndarray, runs: int = 5
) -> dict[str, float]:
    """Return the median rate of each function on one core, all in turns."""
    rates = {name: [] for name in functions}
    for _ in range(runs):
        for name, (function, count) in functions.items():
            start = time.thread_time()
            function(np.ascontiguousarray(designs[:, :count]))
            rates[name].append(count / (time.thread_time() - start))
    return {name: statistics.median(one) for name, one in rates.items()}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--count", type=int, default=102_400)
    asked = parser.parse_args()
    generator = np.random.default_rng(1)
    count = asked.count // 64 * 64
    designs = np.array([value * generator.uniform(0.9, 1.1, count) for _, value in FIELDS.values()])
    sampled, exact = kernel(ANGLES), kernel(None)
    start = time.perf_counter()
    ours = sampled(designs[:, :64]).values
    first = time.perf_counter() - start
    functions = {
        "compiled memory": (sampled, count),
        "NumPy in chunks": (by_numpy, count // 16),
        "compiled memory, exact extremes and integrals": (exact, count // 64),
    }
    with tempfile.TemporaryDirectory() as folder:
        cpp = by_cpp(folder)
        if callable(cpp):
            functions["C++ with SLEEF"] = cpp, count
        for name, (function, _) in functions.items():
            found = function(np.ascontiguousarray(designs[:, :64]))
            found = getattr(found, "values", found)
            print(f"{name}: first seven within {np.max(np.abs(found / ours - 1)):.1e} of the compiled memory")
        rates = measured(functions, designs)
    ratios = {name: rates["compiled memory"] / rate for name, rate in rates.items()}
    if asked.json:
        print(json.dumps({"rates": rates, "ratios": ratios, "first_call": first}))
        return
    for name, rate in rates.items():
        print(f"{name:46s} {rate / 1e3:9.1f} thousand designs/s   ours {ratios[name]:7.2f} times that")
    if not callable(cpp):
        print(f"C++ was not measured: {cpp}")
    print(f"first call of a kernel: {first:.2f} s")


if __name__ == "__main__":
    main()
