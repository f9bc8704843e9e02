"""Many designs at once: compiled from the memory, NumPy in chunks, C++ with SLEEF, JAX.

Seven values of engines at 720 crank angles; torque and bearing loads of a V8; joint forces of a four-bar at 360 angles.
C++ needs g++ and libsleef-dev, JAX is measured where it is installed. pylinkage and kinepy have no forces of many
designs and are left out. All run in turns on one core; the median of five is told, as designs per second of the
processor's time, because others may share the machine. Two cores are timed by the clock. Beside a peer
stands how many times as fast ours is wanted to be; where results are farther apart than they may be, this ends with 1.
"""

from __future__ import annotations

import argparse
import ctypes
import importlib.util
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import crankwork
from crankwork.formula.traced_value import ProcedureValue, TracedValue
from crankwork.kernel.compiled import BatchResult, Kernel
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.study.variants import threaded

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
ROD_MASS, PIN_MASS = 0.36, 0.84
V8 = """
[engine]
layout = "V"
cylinders = 8
bank_angle = "90 deg"
firing_order = [1, 5, 4, 2, 6, 3, 7, 8]
spacing = "150 mm"
[bearings]
main_diameter = "60 mm"
main_length = "30 mm"
"""
V8_KEYS = (
    "total_torque_max", "total_torque_min", "crankpin_load_max.1", "crankpin_load_max.4",
    *(f"main_journal_load_max.{at}" for at in range(1, 6)),
)  # fmt: skip
LINKAGE = {
    "crank.radius": ("m", 0.0625), "crank.speed": ("rad/s", 100 * np.pi / 30), "links.coupler.length": ("m", 0.175),
    "links.rocker.mass": ("kg", 1.0),
}  # fmt: skip
LINKAGE_KEYS = (
    "joint_force_max.A", "joint_force_max.B", "joint_force_max.C", "balancing_torque_max", "balancing_torque_min",
)  # fmt: skip
ANGLES, CHUNK = 720, 64
# how many times as fast as a peer, where there is AVX-512, and how far the results may be apart
WANTED = {
    ("engines", "NumPy in chunks"): (7.0, 2e-4), ("engines", "C++ with SLEEF"): (0.0, 2e-4),
    ("V8", "C++ with SLEEF"): (0.4, 1e-12), ("four-bars", "JAX"): (5.0, 1e-11),
}  # fmt: skip


def kernel(steps: int | None) -> Kernel:
    """Return the calculation of one engine compiled."""
    return _kernel(ENGINE, FIELDS, KEYS, steps)


def v8_kernel() -> Kernel:
    """Return the calculation of the V8 compiled."""
    return _kernel(ENGINE + V8, FIELDS, V8_KEYS, ANGLES)


def linkage_kernel() -> Kernel:
    """Return the calculation of the four-bar compiled."""
    return _kernel(crankwork.template("four-bar"), LINKAGE, LINKAGE_KEYS, 360, cycle=360.0)


def _kernel(
    text: str, fields: Mapping[str, tuple[str, float]], keys: Sequence[str], steps: int | None, cycle: float = 720.0
) -> Kernel:
    description = crankwork.Description(text)
    middle = np.array([value for _, value in fields.values()])
    rows = [middle]
    for at in range(len(middle)):
        rows += [np.where(np.arange(len(middle)) == at, part * middle, middle) for part in (0.97, 1.03)]

    def memory(design: np.ndarray) -> Mapping[str, TracedValue]:
        pairs = zip(fields.items(), design, strict=True)
        settings = [f"{key}={float(value)!r} {unit}".strip() for (key, (unit, _)), value in pairs]
        found = crankwork.analyse(description.machine(settings)).trace
        # mains are columns of a table; their largest loads are asked for here
        mains = {key: one for key, one in found.items() if key.startswith("main_journal_load.")}
        return found | {
            key.replace("load", "load_max"): TracedValue(ProcedureValue(0.0, "max", (one,)))
            for key, one in mains.items()
        }

    memories = [memory(one) for one in rows]
    return Kernel(memories, np.array(rows), keys, CrankGrid.from_degrees, cycle=cycle, steps=steps)


def drawn(fields: Mapping[str, tuple[str, float]], count: int, spread: float = 0.1) -> np.ndarray:
    """Return designs drawn by chance, shape (fields, count)."""
    generator = np.random.default_rng(1)
    return np.array([value * generator.uniform(1 - spread, 1 + spread, count) for _, value in fields.values()])


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
        # the energy of all masses stays between two lines over their reduced inertia
        rate = r * (sine * cos_beta + cosine * sin_beta) / cos_beta
        inertia = (piston + ROD_MASS) * rate**2 + PIN_MASS * r**2
        gas = area * (pressure - 0.1e6) * rate
        gained = ((gas + np.roll(gas, -1, axis=1)) / 2 - gas.mean(axis=1, keepdims=True)) * step
        energy = np.cumsum(gained, axis=1) - gained
        above, below = (energy - (w * (1 + half)) ** 2 / 2 * inertia for half in (0.005, -0.005))
        spread = above.max(axis=1) - below.min(axis=1)
        after = np.roll(pressure, -1, axis=1), np.roll(volume, -1, axis=1)
        work = ((pressure + after[0]) / 2 * (after[1] - volume)).sum(axis=1)
        result[:, start : start + CHUNK] = (
            force.max(axis=1), tangential.max(axis=1), mean[:, 0], torque.max(axis=1), torque.min(axis=1), work,
            spread / (0.01 * w[:, 0] ** 2),
        )  # fmt: skip
    return result


def by_cpp(folder: str | Path) -> tuple[Callable[[np.ndarray], np.ndarray], Callable[[np.ndarray], np.ndarray]] | str:
    """Return functions that do the same in C++ for engines and for the V8, or why there are none."""
    library = Path(folder) / "bulk.so"
    source = Path(__file__).with_name("bulk.cpp")
    command = ["g++", "-O3", "-march=native", "-shared", "-fPIC", str(source), "-o", str(library), "-lsleef"]
    try:
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603 - a compiler on a file beside this one
    except (OSError, subprocess.CalledProcessError) as error:
        return str(error)
    found = ctypes.CDLL(str(library))
    pointer = ctypes.POINTER(ctypes.c_double)
    angle = np.radians(np.arange(ANGLES))
    sine, cosine = np.sin(angle), np.cos(angle)

    def function(name: str, rows: int, *masses: float) -> Callable[[np.ndarray], np.ndarray]:
        called = getattr(found, name)
        called.argtypes = [pointer, pointer, ctypes.c_long, pointer, pointer, *(ctypes.c_double for _ in masses)]

        def run(designs: np.ndarray) -> np.ndarray:
            result = np.empty((rows, designs.shape[1]))
            given = [one.ctypes.data_as(pointer) for one in (designs, result, sine, cosine)]
            called(given[0], given[1], designs.shape[1], given[2], given[3], *masses)
            return result

        return run

    return function("engines", len(KEYS), ROD_MASS, PIN_MASS), function("v8", len(V8_KEYS), ROD_MASS, PIN_MASS)


def by_jax() -> Callable[[np.ndarray], np.ndarray]:
    """Return a function that finds joint forces and torque of the four-bar with JAX, on one core."""
    os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
    import jax  # noqa: PLC0415 - a peer, where it is installed
    import jax.numpy as jnp  # noqa: PLC0415

    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - its own way
    phi = np.radians(np.arange(360.0))
    cos, sin = np.cos(phi), np.sin(phi)

    def cross(a, b):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        return a[0] * b[1] - a[1] * b[0]

    def dot(a, b):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        return a[0] * b[0] + a[1] * b[1]

    def across(a):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        return jnp.stack([-a[1], a[0]])

    def one(design):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
        r, w, l, m = design  # noqa: E741
        c, m_2, i_2, i_3 = 0.1125, 1.5, 0.004, 0.0011
        A = r * jnp.stack([cos, sin])
        C = jnp.stack([0.2 + 0 * cos, 0 * cos])
        d = C - A
        apart = jnp.sqrt(dot(d, d))
        u = d / apart
        along = (l**2 - c**2 + apart**2) / (2 * apart)
        B = A + along * u + jnp.sqrt(l**2 - along**2) * across(u)
        e, g = (B - A) / l, (B - C) / c
        n, o = across(e), across(g)
        A_1, A_2 = w * across(A), -(w**2) * A
        w_2, w_3 = -dot(A_1, g) / (l * dot(n, g)), dot(A_1, e) / (c * dot(o, e))
        eps_2 = (-(w_3**2) * c - dot(A_2, g) + w_2**2 * l * dot(e, g)) / (l * dot(n, g))
        eps_3 = (dot(A_2, e) - w_2**2 * l + w_3**2 * c * dot(g, e)) / (c * dot(o, e))
        p, q = 0.08 * e + 0.04 * n, 0.056 * g
        F_2, F_3 = -m_2 * (A_2 + eps_2 * across(p) - w_2**2 * p), -m * (eps_3 * across(q) - w_3**2 * q)
        a, b = -(cross(p, F_2) - i_2 * eps_2) / l, (cross(q, F_3) - i_3 * eps_3) / c
        F_B = (a * g - b * e) / cross(e, g)
        F_A, F_C = -(F_2 + F_B), F_B - F_3
        torque = cross(A, F_A)
        largest = [jnp.sqrt(dot(F, F)).max() for F in (F_A, F_B, F_C)]
        return jnp.stack([*largest, torque.max(), torque.min()])

    every = jax.jit(jax.vmap(one, in_axes=1, out_axes=1))
    return lambda designs: np.asarray(every(designs))


Work = Mapping[str, tuple[Callable[[np.ndarray], np.ndarray | BatchResult], int]]


def measured(functions: Work, designs: np.ndarray, runs: int = 5) -> dict[str, float]:
    """Return the median rate of each function on one core, all in turns."""
    rates: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(runs):
        for name, (function, count) in functions.items():
            part = np.ascontiguousarray(designs[:, :count])
            # of all threads: XLA has its own
            start = time.process_time()
            function(part)
            rates[name].append(count / (time.process_time() - start))
    return {name: statistics.median(one) for name, one in rates.items()}


def compared(functions: Work, designs: np.ndarray, ours: str) -> dict[str, Any]:
    """Return rates, ours over each, and how far the first results are apart."""
    few = np.ascontiguousarray(designs[:, :64])
    found = {name: function(few) for name, (function, _) in functions.items()}
    values = {name: getattr(one, "values", one) for name, one in found.items()}
    rates = measured(functions, designs)
    return {
        "rates": rates,
        "ratios": {name: rates[ours] / rate for name, rate in rates.items()},
        "apart": {name: float(np.max(np.abs(one / values[ours] - 1))) for name, one in values.items()},
    }


def on_two_cores(of: Kernel, designs: np.ndarray, runs: int = 5) -> float:
    """Return how many times as fast two cores are as one, by the clock: the median of runs in turns."""
    ratios = []
    for _ in range(runs):
        spent = []
        for workers in (1, 2):
            start = time.perf_counter()
            threaded(of, designs, workers)
            spent.append(time.perf_counter() - start)
        ratios.append(spent[0] / spent[1])
    return statistics.median(ratios)


def a_million() -> dict[str, float]:
    """Return how long a study of a million engines takes with two workers, figures included, and its memory."""
    study = Path(__file__).parents[1] / "examples" / "studies" / "million-engines.toml"
    found = {}
    for name in ("first", "again"):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-m", "crankwork", "sweep", str(study), "-o", folder, "--workers", "2"]
            start = time.perf_counter()
            subprocess.run(command, check=True, capture_output=True)  # noqa: S603 - this program on its own example
            found[name] = time.perf_counter() - start
    # of the largest of the processes
    return found | {"memory": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e6}


def main() -> int:
    """Measure and print, and return whether results are too far apart."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--count", type=int, default=102_400)
    parser.add_argument("--million", action="store_true", help="a whole study of a million engines too")
    asked = parser.parse_args()
    count = asked.count // 64 * 64
    # a process begins as large as the one that starts it
    study = a_million() if asked.million else {}
    sampled, exact, v8, linkage = kernel(ANGLES), kernel(None), v8_kernel(), linkage_kernel()
    designs = drawn(FIELDS, count)
    start = time.perf_counter()
    sampled(designs[:, :64])
    first = time.perf_counter() - start
    engines: dict[str, Any] = {
        "compiled memory": (sampled, count),
        "NumPy in chunks": (by_numpy, count // 16),
        "compiled memory, exact extremes and integrals": (exact, count // 64),
    }
    eights: dict[str, Any] = {"compiled memory": (v8, count // 4)}
    linkages: dict[str, Any] = {"compiled memory": (linkage, count // 4)}
    with tempfile.TemporaryDirectory() as folder:
        cpp = by_cpp(folder)
        if not isinstance(cpp, str):
            engines["C++ with SLEEF"], eights["C++ with SLEEF"] = (cpp[0], count), (cpp[1], count // 4)
        if importlib.util.find_spec("jax") is not None:
            linkages["JAX"] = by_jax(), count // 4
        found = {
            "engines": compared(engines, designs, "compiled memory"),
            "V8": compared(eights, designs, "compiled memory"),
            "four-bars": compared(linkages, drawn(LINKAGE, count, 0.03), "compiled memory"),
        }
    cores = on_two_cores(sampled, np.concatenate([designs] * 4, axis=1))
    load = os.getloadavg()[0]
    if asked.json:
        print(json.dumps(found | {"first_call": first, "two_cores": cores, "load": load, "million": study}))
        return 0
    too_far = False
    for work, one in found.items():
        print(work)
        for name, rate in one["rates"].items():
            more = f"ours {one['ratios'][name]:7.2f} times that, apart by {one['apart'][name]:.1e}"
            if (work, name) in WANTED:
                ratio, apart = WANTED[work, name]
                more += f" (wanted {ratio:g} times, {apart:g})"
                too_far |= not one["apart"][name] <= apart
            print(f"  {name:46s} {rate / 1e3:9.1f} thousand designs/s   {more}")
    if isinstance(cpp, str):
        print(f"C++ was not measured: {cpp}")
    if study:
        print(
            "a million engines: {first:.1f} s, again {again:.1f} s, {memory:.2f} GB in the largest process".format(
                **study
            )
        )
    print(f"first call of a kernel: {first:.2f} s; two cores {cores:.2f} times one, with {load:.1f} others at work")
    return int(too_far)


if __name__ == "__main__":
    sys.exit(main())
