"""Which lines of the trace a note shows, by subject and in their order."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.one_cylinder import own_key
from crankwork.formula.calculation_lines import FormulaLine, Line, Snapshot, ValueLine, symbols_of
from crankwork.formula.traced_value import Delayed, FormulaCall, Input, ProcedureValue, TracedValue, in_order
from crankwork.machine import Engine, Machine
from crankwork.notation import ARGUMENTS
from crankwork.quantities.key import key_of

_DEGREES, _TURN = 30.0, 360.0


class Group(NamedTuple):
    """Lines in the order of calculation: what they are about, and where they hold, if they vary. [deg]"""

    name: str
    lines: tuple[Line, ...]
    degrees: float | None = None


# of one cylinder
DELIVERY = (
    "expanded_volume", "induced_volume", "clearance_volumetric_efficiency", "inlet_flow.", "inlet_flow",
    "discharge_coefficient",
    "pump_slip", "polytropic_exponent", "discharge_temperature", "gas_mass_flow", "free_air_delivery",
    "isothermal_power", "isothermal_efficiency",
)  # fmt: skip
_STAGES = (
    "limit_ratio", "needed_stages", "stage_count", "stage_pressure_ratio", "compression_exponent", "discharge_pressure",
    "suction_pressure", "discharge_temperature", "clearance_volumetric_efficiency", "clearance_ratio", "stage_flow",
    "gas_mass_flow", "free_air_delivery", "swept_flow", "swept_volume", "bore", "stroke", "free_volumetric_efficiency",
    "returned_power", "stage_power", "isothermal_power", "isothermal_efficiency", "single_stage_power", "stage_saving",
    "mechanical_efficiency", "motor_power", "overall_isothermal_efficiency", "specific_work", "cylinder_heat",
    "cooler_heat", "specific_cooler_heat", "heat_removed", "water_flow", "water_rise", "stage_flow_error",
)  # fmt: skip
_ROD_LOADS = (
    "piston_rod_load", "crosshead_load", "rod_load_tension", "rod_load_compression", "mean_rod_load",
    "piston_rod_load_tension", "piston_rod_load_compression", "crosshead_load_tension", "crosshead_load_compression",
)  # fmt: skip
_FLOWS = (
    "chamber_flow", "vessel_flow", "mean_flow", "vessel_inflow", "flow_pulsation", "flow_ratio", "vessel_volume_change",
    "even_pipe_power", "vessel_saving",
)  # fmt: skip
WHEEL_SIZES = (
    "flywheel_mass", "rim_speed", "rim_stress", "rim_diameter", "rim_mass", "rim_section", "rim_thickness", "rim_width",
)  # fmt: skip
_WHEEL = ("wittenbauer_slope", "whole_inertia", "flywheel_inertia")
_GEOMETRY = (
    "crank_radius", "rod_length", "rod_ratio", "relative_offset", "stroke", "top_dead_centre_angle",
    "bottom_dead_centre_angle", "time_ratio",
)  # fmt: skip
_SPEED = ("speed", "mean_piston_speed")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine")
_PISTON_MOTION = (
    *_SWING, "rod_angle", "piston_displacement", "piston_transfer_1", "piston_transfer_2", "piston_velocity",
    "piston_acceleration", "rod_transfer_1", "rod_transfer_2", "rod_angular_velocity", "rod_angular_acceleration",
)  # fmt: skip
_HARMONICS = tuple(
    f"piston_{noun}_{which}_order"
    for which in ("first", "second")
    for noun in ("displacement", "transfer_1", "velocity", "transfer_2", "acceleration")
)
_EXTREMES = tuple(f"piston_{noun}_{end}" for noun in ("velocity", "acceleration") for end in ("max", "min"))
_MASSES = ("reciprocating_mass", "rotating_mass")
_SPACE = ("piston_area", "swept_volume", "clearance_volume", "compression_ratio")
_POINTS = ("cylinder_volume.", "diagram_pressure.")
_PISTON_FORCES = (
    *_SWING, "cylinder_volume", "diagram_pressure", "gas_pressure", "gas_force", "inertia_acceleration",
    "inertia_force", "weight_force", "transverse_weight", "piston_force",
    "side_factor", "rod_factor", "radial_factor", "tangential_factor",
    "correction_couple", "rod_transverse_force", "side_force.couple", "side_force", "rod_force", "radial_force",
    "tangential_force", "rotating_inertia_force", "rotating_torque", "crank_torque", "pin_distance",
    "overturning_moment",
)  # fmt: skip
_FORCE_EXTREMES = tuple(
    f"{key}_{end}"
    for key in ("inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque")
    for end in ("max", "min")
)
_PISTON_REDUCTION = ("reduced_inertia.", "reduced_inertia", "reduced_inertia_1.", "reduced_inertia_1")
_BURNING = (
    "cylinder_temperature", "gas_heat_ratio", "net_heat_rate", "motored_pressure", "wall_gas_speed",
    "heat_transfer_coefficient", "wall_area", "wall_heat_rate", "gross_heat_rate", "burnt_fraction", "heat_released",
    "wall_heat", "burnt_angle.", "burning_start.fit", "burning_duration.fit", "burning_shape.fit", "fuel_heat.fit",
    "fit_scatter.fit", "pressure_rise_max", "gross_heat_rate_max", "indicated_mean_pressure.mean",
    "mean_pressure_variation", "peak_pressure_variation",
)  # fmt: skip
_POWER = ("indicated_work", "indicated_mean_pressure", "indicated_power", "mean_torque")

# of the whole engine
_FIRING = ("swept_volume.", "displacement", "firing_interval", "firing_interval.")
_ENGINE_TORQUES = (
    "crank_torque.", "throw_torque.", "total_torque", "total_tangential_force", "crankpin_torque.", "journal_torque.",
    "reduced_inertia", "reduced_inertia_1",
)  # fmt: skip
_OF_ARTICULATED = (
    "piston_displacement", "piston_velocity", "piston_acceleration", "gas_force", "inertia_force", "piston_force",
    "side_force", "rod_force", "radial_force", "tangential_force", "knuckle_couple", "knuckle_side_force",
)  # fmt: skip
_JOURNALS = tuple(
    prefix
    for kind in (
        "big_end_inertia_force", "crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "big_end_load",
        "weight_force.piston", "transverse_weight.piston", "piston_pin_force", "side_force.small_end", "small_end_load",
        "shaft_unbalance.throw", "unbalance_force.throw", "unbalance_force.counterweights", "unbalance_weight.throw",
        "unbalance_weight.counterweights", "unbalance_tangential_force.throw",
        "unbalance_tangential_force.counterweights", "journal_share",
        "bearing_force_x", "bearing_force_y", "main_journal_load",
    )
    for prefix in (kind, f"{kind}.")
)  # fmt: skip
_LOADS = tuple(
    prefix
    for kind in (
        "mean_bearing_load", "bearing_load_max", "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max",
        "mean_crankpin_load", "reversal_duration", "reversal_ratio",
    )
    for prefix in (kind, f"{kind}.")
)  # fmt: skip
_UNIFORMITY = (
    "mean_torque", "mean_torque.indicated.", "mean_torque.indicated", "excess_work", "work_per_cycle",
    "energy_fluctuation", "whole_inertia", "flywheel_inertia", "speed_fluctuation",
)  # fmt: skip
_OF_HARMONIC = ("harmonic_amplitude", "phase_sum", "total_harmonic_amplitude")
_SHOWN_HARMONICS, _ROUNDING = 3, 1e-9
_OF_ORDER = (
    "acceleration_coefficient", "order_inertia_force", "force_factor", "free_force.reciprocating", "moment_factor",
    "free_moment.reciprocating",
)  # fmt: skip
_ROTATING = (
    "rotating_mass.of_cylinder", "shaft_unbalance.rotating", "unbalance_force.rotating", "free_force.rotating",
    "free_moment.rotating",
)  # fmt: skip

# of links, chambers and shafts
_DRIVER = (
    "driver_displacement", "driver_velocity", "driver_acceleration", "driver_angle", "driver_speed",
    "driver_angular_acceleration", "driver_jerk", "driver_angular_jerk",
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


_TORSION = (
    "disc_inertia", "polar_moment", "equivalent_length", "torsional_stiffness", "shaft_inertia", "equivalent_inertia",
    "equivalent_node_distance", "node_distance",
)  # fmt: skip
_DAMPERS = (
    "damper_inertia_ratio", "optimum_tuning", "optimum_damping_ratio", "optimum_damping", "optimum_stiffness",
    "least_magnification",
)  # fmt: skip
_STRETCHES = ("sheared_area", "flat_shearing_force", "shearing_force", "stroke_work", "stroke_angle")
_POWER_OF_SHAFT = ("speed", "mean_torque", "shaft_power", "efficiency", "motor_power", "work_per_cycle")
_OF_STROKE = ("unbalanced_force_along", "unbalanced_force_across", "unbalanced_force", "unbalanced_couple")
_MOTOR = ("shaft_power", "efficiency", "motor_power", "standard_motor_power", "motor_ratio.")
_EXCESS = ("excess_work", "energy_fluctuation")
_WHEEL_OF_SHAFT = ("speed_fluctuation", "whole_inertia", "flywheel_inertia", *WHEEL_SIZES, "recovery_torque")
_COLUMNS_OF_SHAFT = (
    "turning_moment", "load_torque", "excess_torque", "kinetic_energy_change", "crank_speed", "angular_acceleration",
)  # fmt: skip


def lines_of(results: Results, degrees: float | None = None, force_degrees: float | None = None) -> tuple[Group, ...]:
    """Return the groups of lines of a note, motion and forces at crank angles, or the nearest that are reached. [deg]

    Forces in a cylinder by default stand as far into the last revolution: of four strokes that is the working one.
    """
    if "piston_displacement" in results.columns:
        groups = _of_piston(results, _DEGREES if degrees is None else degrees, force_degrees)
    elif results.machine.alone:
        groups = iter(_ALONE[results.machine.alone](results))
    else:
        groups = _of_links(results, degrees)
    groups = itertools.chain(groups, _of_torsion(results))
    return tuple(group for group in groups if group.lines)


def _of_torsion(results: Results) -> Iterator[Group]:
    """Yield the lines of discs and shafts, and of their dampers."""
    if results.machine.torsion is not None:
        new = _LineFilter(results, 0.0)
        yield Group("torsion", new.lines(_TORSION))
        yield Group("torsional_dampers", new.lines(_DAMPERS))


def _of_piston(results: Results, angle: float, force_angle: float | None) -> Iterator[Group]:
    """Yield the groups of lines of a piston, and of the other cylinders."""
    machine, trace = results.machine, results.trace
    force_angle = machine.cycle - _TURN + angle if force_angle is None else force_angle
    moving, loaded = results.moment(angle), results.moment(force_angle)
    has_forces, has_gas = "piston_force" in trace, results.solved.space is not None
    yield Group("cycle", tuple(_cycle(results)))
    yield Group("geometry", _own(moving, results, _GEOMETRY))
    yield Group("speed", _own(moving, results, _SPEED))
    yield Group("motion", _followed(moving, results, _PISTON_MOTION), angle)
    yield Group("harmonics", _own(moving, results, _HARMONICS), angle)
    yield Group("extremes", _own(moving, results, _EXTREMES))
    yield Group("masses", _followed(moving, results, _MASSES))
    points = [key for key, known in trace.items() if key.startswith(_POINTS) and not known.varies]
    yield Group("gas", _own(loaded, results, (*_space(results), *points)))
    if has_forces:
        yield Group("forces", _followed(loaded, results, _PISTON_FORCES), force_angle)
        yield Group("reduction", _own(loaded, results, _of_cylinder(machine, _PISTON_REDUCTION)), force_angle)
    yield Group("force_extremes", _own(loaded, results, _FORCE_EXTREMES))
    yield Group("power", _own(loaded, results, _of_cylinder(machine, _POWER if has_gas else ())))
    yield Group("burning", _own(loaded, results, _BURNING if "net_heat" in trace else ()), force_angle)
    yield _of_test(results)
    yield Group("delivery", _own(loaded, results, DELIVERY if "induced_volume" in trace else ()))
    yield Group("motor", _own(loaded, results, _MOTOR))
    if machine.engine is None:
        return
    yield Group("firing", _own(loaded, results, _FIRING))
    if "crank_torque" not in results.columns:
        return
    yield Group("engine_torque", _own(loaded, results, (*_later_forces(results), *_ENGINE_TORQUES)), force_angle)
    yield _articulated(results, machine.engine, force_angle)
    yield Group("bearings", _own(loaded, results, _JOURNALS), force_angle)
    yield Group("bearing_loads", _own(loaded, results, _LOADS))
    yield Group("torque_harmonics", _own(loaded, results, _major_harmonics(results)))
    yield Group("uniformity", _own(loaded, results, _uniformity(results)))
    yield Group("flywheel", tuple(loaded.step(known) for known in values_by_method(trace)))
    orders = (*_orders(results, machine.engine), *_ROTATING, *_weights(results))
    yield Group("balance", _own(loaded, results, orders))


def _of_test(results: Results, name: str = "test") -> Group:
    """Return the lines of what follows from a test, or from a clutch."""
    return Group(name, _own(results.moment(), results, results.groups.get(name, ())))


def _of_cylinder(machine: Machine, keys: Iterable[str]) -> tuple[str, ...]:
    """Return the keys of values of cylinder 1."""
    own = [own_key(machine, key) for key in keys]
    # a key that ends in a point stands for all that begin with it
    starts = tuple(key for key in own if key.endswith("."))
    return tuple(key for key in own if key in starts or not starts or not key.startswith(starts))


def _uniformity(results: Results) -> tuple[str, ...]:
    """Return the lines of the speed fluctuation of an engine; a flywheel by several methods has a group of its own."""
    if not results.summary.get("flywheel_inertia.exact"):
        return _UNIFORMITY
    return tuple(key for key in _UNIFORMITY if key not in ("whole_inertia", "flywheel_inertia"))


def _own(moment: Snapshot, results: Results, keys: Iterable[str]) -> tuple[Line, ...]:
    """Return the lines of keys, of a key that ends in a point those of all its parts; inputs have none."""
    trace = results.trace
    keys = (key for kind in keys for key in (_parts(results, kind) if kind.endswith(".") else (kind,)) if key in trace)
    return tuple(moment.step(trace[key]) for key in keys if not isinstance(trace[key].node, Input))


def _parts(results: Results, start: str) -> list[str]:
    return [key for key in results.trace if key.startswith(start)]


def _space(results: Results) -> tuple[str, ...]:
    """Return the sizes of the cylinder; a calculated cycle begins with the compression ratio."""
    space = results.solved.space
    return _SPACE[:-1] if space is not None and space.calculated is not None else _SPACE


def _later_forces(results: Results) -> list[str]:
    """Return the tangential forces that are those of cylinder 1, only later."""
    trace, later = results.trace, []
    for key in _parts(results, "tangential_force."):
        node = trace[key].node
        if isinstance(node, Delayed) and node.of.node is trace["tangential_force"].node:
            later.append(key)
    return later


def _followed(moment: Snapshot, results: Results, keys: Iterable[str]) -> tuple[Line, ...]:
    """Return the lines of keys after those of everything they are made of."""
    return tuple(moment.steps(results.trace[key] for key in keys if key in results.trace))


def cycle_lines(results: Results) -> tuple[Line, ...]:
    """Return the lines of the calculation of the working cycle; none where it was not calculated."""
    space = results.solved.space
    calculated = None if space is None else space.calculated
    return () if calculated is None else tuple(results.moment().steps(calculated.worked))


def _cycle(results: Results) -> Iterator[Line]:
    """Yield the lines of a calculated cycle, before them what was given and after them what was integrated.

    A value that the rest of the results has too is that `.cycle`. A size is calculated twice where it was rounded.
    """
    lines = cycle_lines(results)
    if not lines:
        return
    values = results.solved.space.calculated.values
    last = {line.key: row for row, line in enumerate(lines)}
    rounded = {"displacement"} if results.machine.engine is not None else set()

    def key_of(key: str) -> str:
        return f"{key}.cycle" if f"{key}.cycle" in results.summary or key in rounded else key

    end = max((row for row, key in enumerate(values) if key in last), default=-1)
    known = [
        (row, ValueLine(key_of(key), value))
        for row, (key, value) in enumerate(values.items())
        if key not in last and key_of(key) in results.summary
    ]
    yield from (known_line for row, known_line in known if row < end)
    for index, line in enumerate(lines):
        key = key_of(line.key) if index == last[line.key] else f"{line.key}.before_rounding"
        yield _of_cycle(line, key_of)._replace(key=key)
    yield from (known_line for row, known_line in known if row > end)


def _of_cycle(line: Line, key_of: Callable[[str], str]) -> Line:
    """Return a line of a cycle, its operands under the keys that they have in the results."""
    if not isinstance(line, FormulaLine):
        return line
    named = {name for name, _ in line.named}
    entries = {name: ARGUMENTS[name] for name in symbols_of(line.expression) if name in ARGUMENTS and name not in named}
    own = [(name, key_of(item.quantity)) for name, item in entries.items() if item.pattern == "{}" and item.quantity]
    return line._replace(named=(*line.named, *((name, key) for name, key in own if key != entries[name].quantity)))


def _articulated(results: Results, engine: Engine, degrees: float) -> Group:
    """Return motion and forces of the first cylinder with an articulated rod, at its own crank angle."""
    number, angle, own = first_articulated(engine), degrees, []
    for key in _OF_ARTICULATED:
        known = results.trace.get(f"{key}.{number}")
        if known is None:
            continue
        if isinstance(known.node, Delayed):
            angle, known = (degrees - known.node.by) % known.node.cycle, known.node.of
        own.append(known.named(key))
    return Group("articulated", tuple(results.moment(angle, str(number)).steps(own)), angle)


def first_articulated(engine: Engine) -> int:
    """Return the number of the first cylinder with an articulated rod, 0 if none has one."""
    return next((number for number, rod in enumerate(engine.articulated_rods, start=1) if rod is not None), 0)


def _major_harmonics(results: Results) -> Iterator[str]:
    """Yield the first harmonics in which all cylinders pull together, where each has that of the first."""
    columns, count = results.listings["torque_harmonics"].columns, results.summary["cylinder_count"]
    pairs = zip(columns["harmonic_order"].tolist(), columns["phase_sum"].tolist(), strict=True)
    major = [f"{order:g}" for order, star in pairs if abs(star - count) < _ROUNDING][:_SHOWN_HARMONICS]
    for order in major:
        if isinstance(results.trace[f"total_harmonic_amplitude.{order}"].node, FormulaCall):
            yield from (f"{kind}.{order}" for kind in _OF_HARMONIC)


def _orders(results: Results, engine: Engine) -> Iterator[str]:
    """Yield the keys of each order of the inertia forces; of articulated rods those of two cylinders."""
    names = results.listings["balance"].names if "balance" in results.listings else ()
    for name in names:
        row, order = key_of(name)
        if row == "reciprocating":
            for suffix in (order, f"{order}.1", f"{order}.{first_articulated(engine)}"):
                yield from (f"{kind}.{suffix}" for kind in _OF_ORDER)


def _weights(results: Results) -> Iterator[str]:
    """Yield counterweights that differ, each after its parts, and the weights of balance shafts."""
    if "balance" not in results.listings:
        return
    seen: set[float] = set()
    for key in _parts(results, "counterweight_moment."):
        known = results.trace[key]
        if key.count(".") == 1 and known.value and known.value not in seen:
            seen.add(known.value)
            yield from (f"{key}.", key)
    yield from ("best_balanced_share", "best_counterweight_moment", "best_counterweight_moment.")
    yield from ("balance_shaft_moment.", "unbalance_force.balance_shafts.")


def _of_links(results: Results, degrees: float | None) -> Iterator[Group]:
    """Yield the groups of lines of links and chambers, or of a table of transfer functions, each line once."""
    reached = results.grid.degrees
    if degrees is None or results.machine.linkage is None:
        # what was given as a table is known at its rows only
        angle = float(reached[np.argmin(np.abs(reached - (_DEGREES if degrees is None else degrees)))])
    else:
        angle = float(np.clip(degrees, reached[0], reached[-1]))
    new = _LineFilter(results, angle)
    yield Group("structure", new.lines(["mobility"]))
    yield Group("speed", new.lines(["speed"]) if results.method.pi != math.pi else ())
    yield new.group("driver", _DRIVER)
    yield new.group("motion", _MOTION)
    yield _centres(results, new)
    yield Group("transmission", tuple(_transmission(results)))
    yield Group("charges", new.lines(_CHARGES))
    yield new.group("chambers", _CHAMBERS)
    yield Group("gas_work", new.lines(_GAS_WORK))
    if results.machine.stages is not None and results.machine.linkage is not None:
        yield Group("stages", new.lines(_STAGES))
    yield Group("delivery", new.lines(DELIVERY))
    yield new.group("rod_loads", _ROD_LOADS)
    yield new.group("vessels", _FLOWS)
    yield Group("inertia_loads", new.of(_inertia(results)), new.degrees)
    yield new.group("joint_forces", _JOINTS)
    yield new.group("shaking", _SHAKING)
    yield Group("counterweight", new.lines(_COUNTERWEIGHT))
    yield new.group("driver_force", ("driver_force", "driver_torque", "driver_power"))
    yield new.group("reduction", _REDUCTION)
    yield new.group("torques", _TORQUES)
    yield Group("efficiency", tuple(_efficiency(results)))
    yield _friction(results, new)
    yield new.group("joint_bearings", _BEARINGS)
    yield Group("bearing_sizes", new.lines(_BEARING_SIZES))
    yield Group("crank_harmonics", new.of(_first_harmonic(results)))
    yield Group("flywheel", tuple(_flywheel(results, new)))
    yield Group(
        "motor", new.lines(["shaft_power", "motor_power", "standard_motor_power", "inertia_on_crank", "motor_ratio"])
    )


def _of_shaft(results: Results) -> Iterator[Group]:
    """Yield the groups of lines of a shaft, at the position nearest to the greatest value of its torque."""
    peaks = (results.trace.get(f"{key}_max") for key in ("turning_moment", "load_torque"))
    angle = next((peak.node.at for peak in peaks if peak is not None and isinstance(peak.node, ProcedureValue)), None)
    row = int(np.argmin(np.abs(results.grid.degrees - (angle or 0.0))))
    new, turning = _LineFilter(results, float(results.grid.degrees[row])), results.machine.turning
    given = turning.diagrams if turning is not None else {}
    acting = [key for table, key in (("torque", "turning_moment"), ("load", "load_torque")) if table in given]
    columns = [key for key in results.columns if key in _COLUMNS_OF_SHAFT]
    yield Group("stretches", new.lines(_STRETCHES))
    yield new.group("turning_moments", acting if columns else ())
    yield Group("shaft_power", new.lines(_POWER_OF_SHAFT))
    yield Group("motor", new.lines(["standard_motor_power", "motor_ratio"]))
    yield Group("energy_extremes", new.lines(_EXCESS if columns else ("kinetic_energy_change", *_EXCESS)))
    yield Group("flywheel", new.lines(_WHEEL_OF_SHAFT))
    yield new.group("shaft_course", columns)


def _of_rotor(results: Results) -> Iterator[Group]:
    """Yield the groups of lines of masses on a shaft: what balances them, and what is left."""
    new, summary = _LineFilter(results, _DEGREES), results.summary
    is_mass = {key: key.startswith(("plane_", "sector_")) for key in summary}
    yield Group("planes", new.of(results.trace[key] for key in summary if is_mass[key]))
    yield new.group("rotor_columns", _OF_STROKE)
    yield Group("rotor_forces", new.of(results.trace[key] for key in summary if not is_mass[key]))


class _LineFilter:
    """Lines at one crank angle, each shown once."""

    def __init__(self, results: Results, degrees: float) -> None:
        self._trace, self.degrees = results.trace, degrees
        self._moment = results.moment(degrees)
        self._shown: set[tuple[str, str]] = set()

    def of(self, values: Iterable[TracedValue]) -> tuple[Line, ...]:
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
        """Return the lines of what the trace has of some kinds."""
        kinds = tuple(kinds)
        return self.of(known for key, known in self._trace.items() if key_of(key).quantity in kinds)

    def group(self, name: str, kinds: Iterable[str]) -> Group:
        """Return these lines as a group."""
        return Group(name, self.lines(kinds), self.degrees)


def _centres(results: Results, new: _LineFilter) -> Group:
    """Return the instant centres of links; where one of them does not turn, at the nearest position where all do."""
    keys = [key for key in results.columns if key_of(key).quantity in _CENTRES]
    degrees = results.grid.degrees
    turning = np.all([np.isfinite(results.columns[key]) for key in keys], axis=0)
    shown = degrees[turning & ((degrees == new.degrees) | (degrees % _DEGREES == 0))] if keys else degrees[:0]
    if not shown.size:
        return Group("instant_centres", ())
    nearest = float(shown[np.argmin(np.abs(shown - new.degrees))])
    moment = results.moment(nearest)
    return Group("instant_centres", tuple(moment.step(results.trace[key]) for key in keys), nearest)


class Extreme(NamedTuple):
    """The extreme of a column: its key, what it is and how it came about, and where it is reached. [deg]"""

    key: str
    known: TracedValue
    at: float


def extreme_of(results: Results, key: str) -> Extreme | None:
    """Return the extreme that a single value is or depends on; None if there is none."""
    for traced in in_order([results.trace[key]]) if key in results.trace else ():
        if isinstance(traced.node, ProcedureValue) and traced.node.at is not None:
            return Extreme(traced.key, traced, traced.node.at)
    return None


def worst_angles(results: Results) -> Iterator[str]:
    """Yield the extreme transmission angles between links, and pressure angles at guides."""
    for key in results.summary:
        kind, name = key_of(key)
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
            yield moment.step(results.trace[key])


def _first_harmonic(results: Results) -> Iterator[TracedValue]:
    """Yield the amplitude of the first harmonic of the torque, for which the harmonics are worked."""
    key = next((key for key in results.trace if key.startswith("total_harmonic_amplitude.")), None)
    if results.machine.linkage is not None and key is not None:
        yield results.trace[key]


def _inertia(results: Results) -> Iterator[TracedValue]:
    """Yield inertia forces and torques, which the forces in the joints are made of."""
    forces = [known for key, known in results.trace.items() if key_of(key).quantity in _JOINTS]
    yield from (known for known in in_order(forces) if key_of(known.key).quantity in _INERTIA)


def _efficiency(results: Results) -> Iterator[Line]:
    """Yield the efficiencies of a chain of joints, and what they come to before it is rounded."""
    drive, trace = results.machine.drive, results.trace
    if drive.chain is None or "efficiency" not in trace:
        return
    moment = results.moment()
    for known in in_order([trace["efficiency"]]):
        # an efficiency of its own stands in the line of its share
        is_alone = known.key == "efficiency" and isinstance(known.node, Input)
        if known.key and not is_alone and not isinstance(known.node, ProcedureValue):
            yield moment.step(known)


def _friction(results: Results, new: _LineFilter) -> Group:
    """Return the lines of the friction in each joint, and of the efficiency where the forces are known."""
    moment = results.moment(new.degrees)
    keys = [key for key in results.columns if key_of(key).quantity in _FRICTION]
    if not all(math.isfinite(moment.value(results.trace[key])) for key in keys):
        return Group("friction", ())
    ratio = results.trace.get("instantaneous_efficiency")
    has_ratio = ratio is not None and math.isfinite(moment.value(ratio))
    lines = (*new.lines(_FRICTION), *((moment.step(ratio),) if ratio is not None and has_ratio else ()))
    return Group("friction", (*lines, *new.lines(("mean_efficiency",))), new.degrees)


def _flywheel(results: Results, new: _LineFilter) -> Iterator[Line]:
    """Yield the flywheel by every method; the excess work of each is found over the turn."""
    trace = results.trace
    if "excess_work" not in trace:
        return
    for known in values_by_method(trace):
        if known.key.startswith("excess_work"):
            yield ValueLine(known.key, known.value)
        else:
            yield from new.of([known])
    yield from new.lines(["work_per_cycle", "energy_fluctuation", *WHEEL_SIZES])


def values_by_method(trace: Mapping[str, TracedValue]) -> Iterator[TracedValue]:
    """Yield the excess work, slopes and inertias of each method of finding the flywheel."""
    for key in trace:
        for known in in_order([trace[key]]) if key.startswith("flywheel_inertia.") else ():
            kind = key_of(known.key).quantity
            if kind == "excess_work" or (kind in _WHEEL and isinstance(known.node, FormulaCall) and known.value > 0):
                yield known


def _of_stages(results: Results) -> Iterator[Group]:
    """Yield the lines of the stages of a compressor."""
    yield Group("stages", _LineFilter(results, 0.0).lines(_STAGES))


# groups where there is no mechanism
_ALONE: dict[str, Callable[[Results], Iterable[Group]]] = {
    "test": lambda results: (_of_test(results),),
    "turning": _of_shaft,
    "torsion": _of_shaft,
    "rotor": _of_rotor,
    "stages": _of_stages,
    "clutch": lambda results: (_of_test(results, "clutch"),),
}
