"""The joints of master rods: their crankpin, piston pin and wall also carry forces of articulated rods."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from crankwork.analysis.crankshaft_bearings import distinct_crankpins
from crankwork.analysis.cylinder_forces import force_on_rod, joint_names
from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.dynamics.reaction import pin_columns
from crankwork.formula.traced_value import TracedAngle, TracedValue, total


def master_joints(engine: MultiCylinderEngine, loads: Mapping[str, TracedValue]) -> Iterator[TracedValue]:
    """Yield the forces in the joints of every distinct master rod, under the keys of a single rod.

    `loads`: those of the crankpins.
    """
    pin, piston = joint_names(engine.master)
    for crankpin in distinct_crankpins(engine):
        passed = [engine.of(item.number, "knuckle_side_force") for item in engine.on_pin[crankpin - 1] if item.master]
        if not passed:
            continue
        place = next(item for item in engine.on_pin[crankpin - 1] if not item.master)
        number, own = place.number, "" if place.number == 1 else f".{place.number}"
        angle = TracedAngle().shifted(-place.firing_angle)
        radial, tangential = (loads[f"crankpin_{axis}_force.{crankpin}"] for axis in ("radial", "tangential"))
        yield from force_on_rod(f"{pin}{own}", radial, tangential, angle).values()
        side = total(f"knuckle_side_force{own}", passed)
        x, y = (engine.of(number, f"joint_force_{axis}.{piston}") for axis in "xy")
        across = (x - side).named(f"joint_force_x.{piston}{own}")
        yield from pin_columns(f"{piston}{own}", across, y).values()
        yield (engine.of(number, f"normal_force.{piston}") - side).named(f"normal_force.{piston}{own}")
