"""Compares engines with the linkages that they are, and both with another program: `scripts/campaign forms`.

First every template, example and machine of the tests with what `check --expand` writes of it: all keys, by every kind
of method, and of engines however the linkage is drawn. Then engines that are drawn by chance: results of the file, of
the file of its linkage, and of `bodies.py` must agree. That program takes from crankwork only the pressure at an angle
and where it breaks.
"""

from __future__ import annotations

import argparse
import functools
import math
import random
import runpy
import sys
import tempfile
import time
import tomllib
import traceback
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from campaigns.bodies import Array, Bodies, Panels, Turning, Values, area, si
from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import read_machine, template
from crankwork.description.shorthand import expanded
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import breakpoints_of
from expansions import ROOT, WAYS, Shares, differences, differences_as_drawn, machine_files, written
from machine_texts import POINTS_ENGINE

smooth_engine = runpy.run_path(str(Path(__file__).parents[1] / "doors" / "plausible_engines.py"))["smooth_engine"]
# tables that are shorthand, by one of which an engine is known
_SHORTHAND = ("rod", "piston", "cylinder", "engine", "transfer")
METHODS = ("exact", "textbook", "series:6")
# of the largest value of a key
LIMIT = 1e-8


def drawn(seed: int, number: int) -> Values:
    """Return an engine or a compressor by chance, the first of some that no rule refuses."""
    for attempt in range(100):
        values = _tried(random.Random(f"forms {seed} {number} {attempt}"))  # noqa: S311 - no secret
        try:
            read_machine(written(values))
        except CrankworkError:
            continue
        return values
    raise RuntimeError(f"no machine {number}")


def _tried(draw: random.Random) -> Values:
    if draw.random() < 0.1:
        return _compressor(draw)
    values: Values = smooth_engine(draw)
    engine = values.get("engine", {})
    if draw.random() < 0.3:
        values.pop("cycle", None)
    if "cycle" not in values and engine.get("strokes", 4) == 4 and "articulated" not in engine:
        gas = tomllib.loads(POINTS_ENGINE)["gas"]
        gas["points"]["z"]["pressure"] = f"{draw.uniform(4, 9):.6g} MPa"
        values["gas"] = gas
    if {"cycle", "gas"} & values.keys() and engine.get("cylinders", 1) > 1 and draw.random() < 0.3:
        engine["pressure_factors"] = [round(draw.uniform(0.9, 1.1), 3) for _ in range(engine["cylinders"])]
    return values


def _compressor(draw: random.Random) -> Values:
    values = tomllib.loads(template("compressor"))
    values["crank"] = {"radius": f"{draw.uniform(30, 90):.6g} mm", "speed": f"{draw.uniform(300, 1500):.5g} rpm"}
    values["rod"] |= {"length": f"{draw.uniform(300, 500):.6g} mm", "mass": f"{draw.uniform(0.5, 6):.4g} kg"}
    values["piston"]["mass"] = f"{draw.uniform(0.5, 9):.4g} kg"
    values["cylinder"] = {"bore": f"{draw.uniform(80, 250):.6g} mm", "compression_ratio": round(draw.uniform(9, 20), 2)}
    values["gas"]["valves"]["discharge"] = f"{draw.uniform(2, 6):.4g} bar"
    if draw.random() < 0.5:
        values["cylinder"] |= {"piston_rod_diameter": "25 mm", "offset": f"{draw.uniform(-20, 20):.5g} mm"}
        values["gas"]["back_pressure"] = "1.2 bar"
    if draw.random() < 0.5:
        values["crank"] |= {"mass": "2 kg", "angular_acceleration": "30 rad/s2"}
    if draw.random() < 0.5:
        values["cylinder"]["inclination"] = "30 deg"
        values["method"]["weights"] = True
    values["flywheel"] = {"fluctuation": 0.02, "inertia": "0.1 kg*m2"}
    return values


def pressures(results: Results, angles: Array) -> dict[str, Array]:
    """Return the pressure of each chamber above that behind the piston, at crank angles. [rad] -> [Pa]"""
    linkage = results.holding("joint_force.O")
    keys = [key for key in linkage.columns if key.startswith("gas_pressure.")]
    columns = linkage.columns_at(np.degrees(angles), keys)
    return {key.partition(".")[2]: np.broadcast_to(columns[key], angles.shape) for key in keys}


def apart_from_bodies(values: Values, results: Results) -> Iterator[tuple[str, float]]:
    """Yield how far keys are from what `Bodies` have, relative to the size of each."""
    bodies, found = Bodies(values), results.complete
    angles = np.radians(found.grid.degrees)
    loads = bodies.loads(pressures(results, angles), angles.size)
    expected, driven = bodies.forces(angles, loads)
    first = bodies.motion(angles)[0]
    given = si(values.get("flywheel", {}).get("inertia", 0))
    expected |= {
        "balancing_torque": driven + given * bodies.acceleration,
        "total_torque" if "total_torque" in found.columns else "crank_torque": -driven,
        "reduced_inertia": np.sum(bodies.masses * first**2, axis=1) + given,
        "static_torque": -np.sum(loads * first, axis=1),
    }
    largest = max(float(np.max(np.abs(one))) for key, one in expected.items() if key.startswith("joint_force"))
    for key, value in expected.items():
        size = largest if "force" in key else largest * abs(bodies.joints[1].at_other)
        size = float(np.max(value)) if key == "reduced_inertia" else size
        column = found.columns.get(key, np.full(angles.shape, 0.0))
        yield key, float(np.max(np.abs(column - value))) / (size or 1.0)
    if "chambers" in values:
        yield from _of_volumes(values, bodies, found, angles)
        breaks = np.radians(breakpoints_of([found.trace["static_torque"]], found.machine.cycle))
        turning = Turning(bodies, breaks, functools.partial(pressures, results))
        yield from _of_turning(turning, found, angles)


def _of_volumes(values: Values, bodies: Bodies, found: Results, angles: Array) -> Iterator[tuple[str, float]]:
    """Yield volumes: the clearance beside the swept volume follows from the ratio, and the stroke from all angles."""
    panels = Panels(np.array([0.0, 2 * math.pi]))

    def along(at: Array, slider: str) -> Array:
        piston, through, guide = bodies.sliders[slider]
        return np.asarray(((bodies.places(at)[0][:, piston] - through) * np.conj(guide)).real)

    for name, chamber in values["chambers"].items():
        if "compression_ratio" not in chamber:
            continue
        slider = chamber["slider"]
        ways = along(panels.angles.ravel(), slider).reshape(panels.angles.shape)
        low, high = panels.range(ways @ panels.to_series.T)
        swept = (high - low) * area(chamber)
        # of a cycle with ports it is the ratio of the closed cylinder
        closed = swept * (1 - found.summary.get("lost_stroke", 0.0))
        volume = closed / (chamber["compression_ratio"] - 1) + (along(angles, slider) - low) * area(chamber)
        yield f"cylinder_volume.{name}", float(np.max(np.abs(found[f"cylinder_volume.{name}"] - volume))) / swept


def _of_turning(turning: Turning, found: Results, angles: Array) -> Iterator[tuple[str, float]]:
    """Yield mean torque, excess work, flywheel and speed."""
    bodies, summary = turning.bodies, found.summary
    largest = float(np.max(np.abs(turning.torque))) or 1.0
    if not bodies.acceleration and "mean_torque" in summary:
        # that of a driver has the same key
        yield "mean_torque", abs(summary["mean_torque"] - abs(turning.mean)) / largest
    if "excess_work" not in summary:
        return
    yield "excess_work", abs(summary["excess_work"] / turning.excess - 1)
    change = turning.panels.at(turning.work, angles)
    yield "kinetic_energy_change", float(np.max(np.abs(found["kinetic_energy_change"] - change))) / turning.excess
    if "crank_speed" not in found.columns:
        return
    wheel, wanted = summary.get("flywheel_inertia", 0.0), summary["speed_fluctuation"]
    yield "crank_speed", float(np.max(np.abs(found["crank_speed"] - turning.speed(wheel, angles)))) / bodies.speed
    yield "speed_fluctuation", abs(turning.fluctuation(wheel) / wanted - 1)


def linkage_of(text: str) -> Values:
    """Return the tables of the linkage that an engine is."""
    return tomllib.loads(expanded_text(text))


def expanded_text(text: str, settings: Sequence[str] = ()) -> str:
    """Return a machine file written out."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "machine.toml"
        path.write_text(text, "utf-8")
        return expanded(path, settings)


def apart(text: str, number: int) -> tuple[list[str], float]:
    """Return what differs between an engine, its linkage and the bodies, and the largest difference from these."""
    values, engine = linkage_of(text), analyse(read_machine(text))
    found = differences_as_drawn(engine, values, WAYS[number % len(WAYS)], number)
    worst = 0.0
    for key, size in apart_from_bodies(values, engine):
        worst = max(worst, size)
        found += [] if size <= LIMIT else [f"bodies: {key} by {size:.2g}"]
    return found, worst


def apart_from_expansion(text: str, shares: Shares) -> Iterator[str]:
    """Yield where a machine differs from what `check --expand` writes of it."""
    stated = tomllib.loads(text)
    for method in METHODS if "rod" in stated else ("",):
        settings = [f"method.kinematics={method}"] if method else []
        out, machine = expanded_text(text, settings), read_machine(text, overrides=settings, folder=ROOT)
        results, values = analyse(machine), tomllib.loads(out)
        yield from (f"[{table}] stands in the expansion" for table in _SHORTHAND if table in values)
        others = analyse(read_machine(out, folder=ROOT))
        found = differences(results.complete, others.complete, shares=shares)
        yield from (f"{method}: {line[:160]}" for line in found)
        for way in WAYS[1:] if "rod" in stated else ():
            yield from (f"{method} {line}" for line in differences_as_drawn(results, values, way, shares=shares))


def compare_files(names: Sequence[str]) -> int:
    """Compare machine files with their expansions, print a line for each that differs, and return how many do."""
    began, differ, shares = time.monotonic(), 0, Shares()
    files = machine_files("examples", "tests/machines")
    files = {name: files[name] for name in names or files}
    for name, text in files.items():
        try:
            found = list(apart_from_expansion(text, shares))
        except CrankworkError as error:
            found = [str(error)]
        if found:
            differ += 1
            _tell(f"{name}: {'; '.join(found[:4])}{f'; {len(found)} in all' if len(found) > 4 else ''}")
    _tell(
        f"{len(files)} files compared with their expansions in {time.monotonic() - began:.0f} s, {differ} differ; "
        f"{len(shares)} values, the largest difference {max(shares, default=0.0):.2g}"
    )
    return differ


def main(words: Sequence[str] | None = None) -> int:
    """Compare files with their expansions and engines by chance with their linkages; return how many differ."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=("files", "chance"), help="files, or engines by chance; both otherwise")
    parser.add_argument("--files", nargs="*", default=[], help="names of files to compare; all of them otherwise")
    parser.add_argument("--count", type=int, default=300, help="how many engines by chance")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args(words)
    differ = 0 if asked.only == "chance" else compare_files(asked.files)
    differ += 0 if asked.only == "files" else compare_by_chance(asked.seed, asked.first, asked.count)
    return min(differ, 100)


def compare_by_chance(seed: int, first: int, count: int) -> int:
    """Compare engines that are drawn by chance, print a line for each that differs, and return how many do."""
    began, differ, worst = time.monotonic(), 0, 0.0
    kinds: dict[str, int] = {}
    for number in range(first, first + count):
        values = drawn(seed, number)
        kind = values.get("engine", {}).get("layout", "compressor" if "valves" in values.get("gas", {}) else "one")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                found, size = apart(written(values), number)
        except Exception as error:  # noqa: BLE001 - counted and told
            last = traceback.extract_tb(error.__traceback__)[-1]
            found, size = [f"{type(error).__name__}: {error} ({Path(last.filename).name}:{last.lineno})"], 0.0
        kinds[kind], worst = kinds.get(kind, 0) + 1, max(worst, size)
        if found:
            differ += 1
            again = f"--only chance --seed {seed} --first {number} --count 1"
            _tell(f"{again} ({kind}): {'; '.join(found[:4])}{f'; {len(found)} in all' if len(found) > 4 else ''}")
    _tell(
        f"{sum(kinds.values())} machines compared in {time.monotonic() - began:.0f} s, {differ} differ; "
        f"furthest from the bodies {worst:.2g}; {', '.join(f'{name} {n}' for name, n in sorted(kinds.items()))}"
    )
    return differ


def _tell(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
