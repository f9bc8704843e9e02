"""What the sheets of an engine show of all its cylinders and of its first crankpin, the numbers of the note."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.engine_diagrams import EngineDiagrams


def whole_engine_extra(results: Results) -> dict[str, Array | float]:
    """Return what `engine_sheets` takes as `extra`, on a grid of its own however coarse the tables are. [SI]

    `crank_angle`, `total_torque` and `total_torque_mean` of several cylinders, and of the first crankpin
    `crankpin_load`, `crankpin_load_mean`, `crankpin_tangential`, `crankpin_radial`, `crankpin_inertia`,
    `crankpin_rods`, `crankpin` where others are unlike it, `wear_sums`, `wear_angle` and `oil_hole_angle`; nothing
    where the forces or the cylinders are not known.
    """
    machine, summary = results.machine, results.summary
    if machine.engine is None or "crank_torque" not in results.columns:
        return {}
    engine = EngineDiagrams(results)
    pins = list(engine.loads[1].crankpins)
    pin, degrees = pins[0], engine.degrees
    load = engine.crankpin(pin, degrees)
    name = f".{pin}" if len(pins) > 1 else ""
    found: dict[str, Array | float] = {
        "crank_angle": np.radians(degrees),
        "crankpin_load": load.size,
        "crankpin_load_mean": summary[f"mean_crankpin_load{name}"],
        "crankpin_tangential": load.polar.across,
        "crankpin_radial": load.polar.down,
        "crankpin_inertia": load.inertia,
        "crankpin_rods": float(load.rods),
    }
    if name:
        found["crankpin"] = float(pin)
    if engine.count > 1:
        torque = engine.torques.sum(axis=0)
        found |= {"total_torque": torque, "total_torque_mean": summary["mean_total_torque"]}
    wear = results.listings["crankpin_wear"].columns
    return found | {
        "wear_sums": wear[f"wear_sum.{pin}"],
        "wear_angle": wear["wear_ray_angle"],
        "oil_hole_angle": summary[f"oil_hole_angle{name}"],
    }
