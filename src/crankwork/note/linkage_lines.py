"""Which lines of the memory the note of a linkage, or of a table of transfer functions, shows, by subject."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Results
from crankwork.formula.known import Found, Given, Known, in_order
from crankwork.formula.lines import Line, ValueLine
from crankwork.note.flywheel import WHEEL_SIZES, values_by_method
from crankwork.note.groups import DELIVERY, Group

_DEGREES = 30.0

_DRIVER = (
    "driver_displacement", "driver_velocity", "driver_acceleration", "driver_angle", "driver_speed",
    "driver_angular_acceleration",
)  # fmt: skip
_MOTION = (
    "point_x", "point_y", "point_velocity", "point_acceleration", "link_angle", "link_angular_velocity",
    "link_angular_acceleration", "slider_displacement", "slider_velocity", "slider_acceleration",
    "coriolis_acceleration",
)  # fmt: skip
_CHARGES = ("swept_volume", "clearance_volume", "compression_ratio", "gas_mass")
_CHAMBERS = ("cylinder_volume", "diagram_pressure", "gas_pressure", "gas_force", "rod_load")
_GAS_WORK = ("indicated_work", "indicated_mean_pressure", "indicated_power")
_INERTIA = ("link_inertia_force", "link_inertia_torque")
_JOINTS = (
    "tooth_force", "separating_force", "joint_force_x", "joint_force_y", "joint_force", "axial_force", "normal_force",
    "normal_moment",
)  # fmt: skip
_REDUCTION = ("reduced_inertia", "kinetic_energy", "reduced_inertia_1", "reduced_torque")
_CENTRES = ("instant_centre_x", "instant_centre_y")
_BEARINGS = ("crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "main_journal_load")
_BEARING_SIZES = ("bearing_pressure", "bearing_pressure_max")
_SHAKING = ("shaking_force_x", "shaking_force_y", "shaking_force", "shaking_moment")
_COUNTERWEIGHT = ("counterweight_moment", "counterweight_angle")
_FRICTION = ("friction_torque", "friction_force", "friction_power")
WORST_ANGLES = ("transmission_angle_min", "transmission_angle_max", "pressure_angle_max")
_TORQUES = ("static_torque", "dynamic_torque", "balancing_torque", "driving_torque")


_STRETCHES = ("sheared_area", "flat_shearing_force", "shearing_force", "stroke_work", "stroke_angle")
_POWER_OF_SHAFT = ("speed", "mean_torque", "shaft_power", "efficiency", "motor_power", "work_per_cycle")
_EXCESS = ("excess_work", "energy_fluctuation")
_WHEEL_OF_SHAFT = ("speed_fluctuation", "whole_inertia", "flywheel_inertia", *WHEEL_SIZES, "recovery_torque")
_COLUMNS_OF_SHAFT = (
    "turning_moment", "load_torque", "excess_torque", "kinetic_energy_change", "crank_speed", "angular_acceleration",
)  # fmt: skip


def linkage_lines(results: Results, degrees: float | None = None) -> tuple[Group, ...]:
    """Return the lines of the note of a linkage at a crank angle, or the nearest that it reaches, each once. [deg]"""
    if results.machine.turning is not None:
        return _of_shaft(results)
    reached = results.grid.degrees
    if degrees is None or results.machine.linkage is None:
        # what was given as a table is known at its rows only
        angle = float(reached[np.argmin(np.abs(reached - (_DEGREES if degrees is None else degrees)))])
    else:
        angle = float(np.clip(degrees, reached[0], reached[-1]))
    new = _LineFilter(results, angle)
    groups = [
        Group("structure", new.lines(["mobility"])),
        Group("speed", new.lines(["speed"]) if results.method.pi != math.pi else ()),
        new.group("driver", _DRIVER),
        new.group("motion", _MOTION),
        _centres(results, new),
        Group("transmission", tuple(_transmission(results))),
        Group("charges", new.lines(_CHARGES)),
        new.group("chambers", _CHAMBERS),
        Group("gas_work", new.lines(_GAS_WORK)),
        Group("delivery", new.lines(DELIVERY)),
        Group("inertia_loads", new.of(_inertia(results)), new.degrees),
        new.group("joint_forces", _JOINTS),
        new.group("shaking", _SHAKING),
        Group("counterweight", new.lines(_COUNTERWEIGHT)),
        new.group("driver_force", ("driver_force", "driver_torque", "driver_power")),
        new.group("reduction", _REDUCTION),
        new.group("torques", _TORQUES),
        Group("efficiency", tuple(_efficiency(results))),
        _friction(results, new),
        new.group("joint_bearings", _BEARINGS),
        Group("bearing_sizes", new.lines(_BEARING_SIZES)),
        Group("crank_harmonics", new.of(_first_harmonic(results))),
        Group("flywheel", tuple(_flywheel(results, new))),
        Group("motor", new.lines(["motor_power", "inertia_on_crank"])),
    ]
    return tuple(group for group in groups if group.lines)


def _of_shaft(results: Results) -> tuple[Group, ...]:
    """Return the lines of the note of a shaft, at the position nearest to the greatest value of its torque."""
    peaks = (results.memory.get(f"{key}_max") for key in ("turning_moment", "load_torque"))
    angle = next((peak.node.at for peak in peaks if peak is not None and isinstance(peak.node, Found)), None)
    row = int(np.argmin(np.abs(results.grid.degrees - (angle or 0.0))))
    new, turning = _LineFilter(results, float(results.grid.degrees[row])), results.machine.turning
    given = turning.diagrams if turning is not None else {}
    acting = [key for table, key in (("torque", "turning_moment"), ("load", "load_torque")) if table in given]
    columns = [key for key in results.columns if key in _COLUMNS_OF_SHAFT]
    groups = (
        Group("stretches", new.lines(_STRETCHES)),
        new.group("turning_moments", acting if columns else ()),
        Group("shaft_power", new.lines(_POWER_OF_SHAFT)),
        Group("energy_extremes", new.lines(_EXCESS if columns else ("kinetic_energy_change", *_EXCESS))),
        Group("flywheel", new.lines(_WHEEL_OF_SHAFT)),
        new.group("shaft_course", columns),
    )
    return tuple(group for group in groups if group.lines)


class _LineFilter:
    """Lines at one crank angle, each shown once."""

    def __init__(self, results: Results, degrees: float) -> None:
        self._memory, self.degrees = results.memory, degrees
        self._moment = results.moment(degrees)
        self._shown: set[tuple[str, str]] = set()

    def of(self, values: Iterable[Known]) -> tuple[Line, ...]:
        """Return the lines of values that were not shown before; of plain numbers only those asked for."""
        lines, present = [], [traced for traced in values if not traced.is_absent]
        keys = {value.key for value in present}
        for step in self._moment.steps(present):
            # what is found again is the same but for rounding
            mark = step.key, f"{step.value:.12g}"
            if mark not in self._shown and (step.key in keys or not isinstance(step, ValueLine)):
                self._shown.add(mark)
                lines.append(step)
        return tuple(lines)

    def lines(self, kinds: Iterable[str]) -> tuple[Line, ...]:
        """Return the lines of what the memory has of some kinds."""
        kinds = tuple(kinds)
        return self.of(known for key, known in self._memory.items() if key.partition(".")[0] in kinds)

    def group(self, name: str, kinds: Iterable[str]) -> Group:
        """Return these lines as a group."""
        return Group(name, self.lines(kinds), self.degrees)


def _centres(results: Results, new: _LineFilter) -> Group:
    """Return the instant centres of links; where one of them does not turn, at the nearest position where all do."""
    keys = [key for key in results.columns if key.partition(".")[0] in _CENTRES]
    degrees = results.grid.degrees
    turning = np.all([np.isfinite(results.columns[key]) for key in keys], axis=0)
    shown = degrees[turning & ((degrees == new.degrees) | (degrees % _DEGREES == 0))] if keys else degrees[:0]
    if not shown.size:
        return Group("instant_centres", ())
    nearest = float(shown[np.argmin(np.abs(shown - new.degrees))])
    moment = results.moment(nearest)
    return Group("instant_centres", tuple(moment.step(results.memory[key]) for key in keys), nearest)


class Extreme(NamedTuple):
    """The extreme of a column: its key, what it is and how it came about, and where it is reached. [deg]"""

    key: str
    known: Known
    at: float


def extreme_of(results: Results, key: str) -> Extreme | None:
    """Return the extreme that a single value is or depends on; None if there is none."""
    for traced in in_order([results.memory[key]]) if key in results.memory else ():
        if isinstance(traced.node, Found) and traced.node.at is not None:
            return Extreme(traced.key, traced, traced.node.at)
    return None


def worst_angles(results: Results) -> Iterator[str]:
    """Yield the extreme transmission angles between links, and pressure angles at guides."""
    for key in results.summary:
        kind, _, name = key.partition(".")
        # beside a guide the transmission angle is what the pressure angle leaves of a right angle
        if kind in WORST_ANGLES and (kind == WORST_ANGLES[-1] or f"{WORST_ANGLES[-1]}.{name}" not in results.summary):
            yield key


def _transmission(results: Results) -> Iterator[Line]:
    """Yield each extreme angle after its cosine or sine where that is reached."""
    moment = results.moment()
    for key in worst_angles(results):
        extreme = extreme_of(results, key)
        if extreme is not None:
            yield moment.step(extreme.known)
            yield moment.step(results.memory[key])


def _first_harmonic(results: Results) -> Iterator[Known]:
    """Yield the amplitude of the first harmonic of the torque, for which the harmonics are worked."""
    key = next((key for key in results.memory if key.startswith("total_harmonic_amplitude.")), None)
    if results.machine.linkage is not None and key is not None:
        yield results.memory[key]


def _inertia(results: Results) -> Iterator[Known]:
    """Yield inertia forces and torques, which the forces in the joints remember."""
    forces = [known for key, known in results.memory.items() if key.partition(".")[0] in _JOINTS]
    yield from (known for known in in_order(forces) if known.key.partition(".")[0] in _INERTIA)


def _efficiency(results: Results) -> Iterator[Line]:
    """Yield the efficiencies of a chain of joints, and what they come to before it is rounded."""
    drive, memory = results.machine.drive, results.memory
    if drive.chain is None or "efficiency" not in memory:
        return
    moment = results.moment()
    for known in in_order([memory["efficiency"]]):
        # an efficiency of its own stands in the line of its share
        is_alone = known.key == "efficiency" and isinstance(known.node, Given)
        if known.key and not is_alone and not isinstance(known.node, Found):
            yield moment.step(known)


def _friction(results: Results, new: _LineFilter) -> Group:
    """Return the lines of the friction in each joint, and of the efficiency where the forces are known."""
    moment = results.moment(new.degrees)
    keys = [key for key in results.columns if key.partition(".")[0] in _FRICTION]
    if not all(math.isfinite(moment.value(results.memory[key])) for key in keys):
        return Group("friction", ())
    ratio = results.memory.get("instantaneous_efficiency")
    has_ratio = ratio is not None and math.isfinite(moment.value(ratio))
    lines = (*new.lines(_FRICTION), *((moment.step(ratio),) if ratio is not None and has_ratio else ()))
    return Group("friction", (*lines, *new.lines(("mean_efficiency",))), new.degrees)


def _flywheel(results: Results, new: _LineFilter) -> Iterator[Line]:
    """Yield the flywheel by every method; the excess work of each is found over the turn."""
    memory = results.memory
    if "excess_work" not in memory:
        return
    for known in values_by_method(memory):
        if known.key.startswith("excess_work"):
            yield ValueLine(known.key, known.value)
        else:
            yield from new.of([known])
    yield from new.lines(["work_per_cycle", "energy_fluctuation", *WHEEL_SIZES])
