"""What the sheets of an engine show of all its cylinders and of its first crankpin, the numbers of the note."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.engine_bearings import bearing_loads
from crankwork.cylinders.load_statistics import polar_diagram
from crankwork.kinematics.crank_grid import Array
from crankwork.machine import Machine
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.figure_data import drawn_from


def whole_engine_extra(results: Results) -> dict[str, Array | float]:
    """Return what `engine_sheets` takes as `extra`, on a grid of its own however coarse the tables are.

    Parameters
    ----------
    results : Results
        Of an engine with all its cylinders; a crank gear of its own is an engine of one cylinder.

    Returns
    -------
    dict of str to array or float
        `crank_angle`, `total_torque` and `total_torque_mean` of several cylinders, and of the first crankpin
        `crankpin_load`, `crankpin_load_mean`, `crankpin_tangential`, `crankpin_radial`, `crankpin_inertia`,
        `crankpin_rods`, `crankpin` where others are unlike it, `wear_sums` and `wear_angle`; nothing where the forces
        or the cylinders are not known. [SI]
    """
    machine, summary = results.machine, results.summary
    if not isinstance(machine, Machine) or machine.engine is None or "crank_torque" not in results.columns:
        return {}
    engine = EngineDrawn(drawn_from(results, "en", per_area=False))
    degrees = engine.degrees
    loads = bearing_loads(engine.whole, degrees)
    pin, load = next(iter(loads.crankpins.items()))
    rods = len(engine.whole.on_pin[pin - 1])
    inertia = rods * engine.rod_inertia
    diagram = polar_diagram(load, degrees, engine.cycle, inertia)
    name = f".{pin}" if len(loads.crankpins) > 1 else ""
    found: dict[str, Array | float] = {
        "crank_angle": np.radians(degrees),
        "crankpin_load": load.resultant,
        "crankpin_load_mean": summary[f"mean_crankpin_load{name}"],
        "crankpin_tangential": diagram.across,
        "crankpin_radial": diagram.down,
        "crankpin_inertia": inertia,
        "crankpin_rods": float(rods),
    }
    if name:
        found["crankpin"] = float(pin)
    if len(engine.whole.cylinders) > 1:
        torque = engine.torques.sum(axis=0)
        found |= {"total_torque": torque, "total_torque_mean": summary["mean_total_torque"]}
    wear = results.listings["crankpin_wear"].columns
    return found | {"wear_sums": wear[f"wear_sum.{pin}"], "wear_angle": wear["wear_ray_angle"]}
