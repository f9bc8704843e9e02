"""Which lines of the memory the note of an engine shows, by subject and in their order."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from crankwork.analysis import Results
from crankwork.analysis.engine import own_key
from crankwork.formula.known import Delayed, Use
from crankwork.formula.known import Given as GivenNode
from crankwork.formula.lines import FormulaLine, Line, Moment, ValueLine, symbols_of
from crankwork.machine import Engine, Machine
from crankwork.notation import ARGUMENTS
from crankwork.note.flywheel import values_by_method
from crankwork.note.groups import DELIVERY, Group

_DEGREES, _TURN = 30.0, 360.0

_GEOMETRY = (
    "crank_radius", "rod_length", "rod_ratio", "relative_offset", "stroke", "top_dead_centre_angle",
    "bottom_dead_centre_angle",
)  # fmt: skip
_SPEED = ("speed", "mean_piston_speed")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine")
_MOTION = (
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
_FORCES = (
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
_REDUCTION = ("reduced_inertia.", "reduced_inertia", "reduced_inertia_1.", "reduced_inertia_1")
_POWER = ("indicated_work", "indicated_mean_pressure", "indicated_power", "mean_torque")

# of the whole engine
_FIRING = ("swept_volume.", "displacement", "firing_interval", "firing_interval.")
_TORQUES = (
    "crank_torque.", "throw_torque.", "total_torque", "crankpin_torque.", "journal_torque.", "reduced_inertia",
    "reduced_inertia_1",
)  # fmt: skip
_OF_ARTICULATED = (
    "piston_displacement", "piston_velocity", "piston_acceleration", "gas_force", "inertia_force", "piston_force",
    "side_force", "rod_force", "radial_force", "tangential_force", "knuckle_couple", "knuckle_side_force",
)  # fmt: skip
_BEARINGS = tuple(
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


def engine_lines(results: Results, degrees: float = _DEGREES, force_degrees: float | None = None) -> tuple[Group, ...]:
    """Return the groups of lines of the note of an engine, motion and forces at crank angles. [deg]

    Forces by default stand as far into the last revolution: of four strokes that is the working one.
    """
    machine, angle = results.machine, degrees
    force_angle = machine.cycle - _TURN + angle if force_degrees is None else force_degrees
    moving, loaded = results.moment(angle), results.moment(force_angle)
    has_forces, has_gas = "piston_force" in results.memory, results.solved.space is not None
    groups = [
        Group("cycle", tuple(_cycle(results))),
        Group("geometry", _own(moving, results, _GEOMETRY)),
        Group("speed", _own(moving, results, _SPEED)),
        Group("motion", _followed(moving, results, _MOTION), angle),
        Group("harmonics", _own(moving, results, _HARMONICS), angle),
        Group("extremes", _own(moving, results, _EXTREMES)),
        Group("masses", _followed(moving, results, _MASSES)),
        Group("gas", _own(loaded, results, (*_space(results), *_points(results)))),
        Group("forces", _followed(loaded, results, _FORCES if has_forces else ()), force_angle),
        Group("reduction", _own(loaded, results, _of_cylinder(machine, _REDUCTION if has_forces else ())), force_angle),
        Group("force_extremes", _own(loaded, results, _FORCE_EXTREMES)),
        Group("power", _own(loaded, results, _of_cylinder(machine, _POWER if has_gas else ()))),
    ]
    groups.append(Group("delivery", _own(loaded, results, DELIVERY if "induced_volume" in results.memory else ())))
    if machine.engine is not None:
        groups += _of_engine(results, machine.engine, loaded)
    return tuple(group for group in groups if group.lines)


def _of_engine(results: Results, engine: Engine, moment: Moment) -> Iterator[Group]:
    """Yield the groups of lines of an engine with its cylinders."""
    yield Group("firing", _own(moment, results, _FIRING))
    if "crank_torque" not in results.columns:
        return
    yield Group("engine_torque", _own(moment, results, (*_later_forces(results), *_TORQUES)), moment.degrees)
    yield _articulated(results, engine, moment.degrees)
    yield Group("bearings", _own(moment, results, _BEARINGS), moment.degrees)
    yield Group("bearing_loads", _own(moment, results, _LOADS))
    yield Group("torque_harmonics", _own(moment, results, _major_harmonics(results)))
    yield Group("uniformity", _own(moment, results, _uniformity(results)))
    yield Group("flywheel", tuple(moment.step(known) for known in values_by_method(results.memory)))
    yield Group("balance", _own(moment, results, (*_orders(results, engine), *_ROTATING, *_weights(results))))


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


def _own(moment: Moment, results: Results, keys: Iterable[str]) -> tuple[Line, ...]:
    """Return the lines of keys, of a key that ends in a point those of all its parts; inputs have none."""
    memory = results.memory
    keys = (key for kind in keys for key in (_parts(results, kind) if kind.endswith(".") else (kind,)) if key in memory)
    return tuple(moment.step(memory[key]) for key in keys if not isinstance(memory[key].node, GivenNode))


def _parts(results: Results, start: str) -> list[str]:
    return [key for key in results.memory if key.startswith(start)]


def _space(results: Results) -> tuple[str, ...]:
    """Return the sizes of the cylinder; a calculated cycle begins with the compression ratio."""
    space = results.solved.space
    return _SPACE[:-1] if space is not None and space.calculated is not None else _SPACE


def _points(results: Results) -> list[str]:
    """Return volumes and pressures at the points of a diagram."""
    return [key for key, known in results.memory.items() if key.startswith(_POINTS) and not known.varies]


def _later_forces(results: Results) -> list[str]:
    """Return the tangential forces that are those of cylinder 1, only later."""
    memory, later = results.memory, []
    for key in _parts(results, "tangential_force."):
        node = memory[key].node
        if isinstance(node, Delayed) and node.of.node is memory["tangential_force"].node:
            later.append(key)
    return later


def _followed(moment: Moment, results: Results, keys: Iterable[str]) -> tuple[Line, ...]:
    """Return the lines of keys after those of everything they are made of."""
    return tuple(moment.steps(results.memory[key] for key in keys if key in results.memory))


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
        known = results.memory.get(f"{key}.{number}")
        if known is None:
            continue
        if isinstance(known.node, Delayed):
            angle, known = (degrees - known.node.by) % known.node.cycle, known.node.of
        own.append(known.named(key))
    return Group("articulated", tuple(results.moment(angle, str(number)).steps(own)), angle)


def first_articulated(engine: Engine) -> int:
    """Return the number of the first cylinder with an articulated rod, 0 if none has one."""
    return next((number for number, rod in enumerate(engine.slaves, start=1) if rod is not None), 0)


def _major_harmonics(results: Results) -> Iterator[str]:
    """Yield the first harmonics in which all cylinders pull together, where each has that of the first."""
    columns, count = results.listings["torque_harmonics"].columns, results.summary["cylinder_count"]
    pairs = zip(columns["harmonic_order"].tolist(), columns["phase_sum"].tolist(), strict=True)
    major = [f"{order:g}" for order, star in pairs if abs(star - count) < _ROUNDING][:_SHOWN_HARMONICS]
    for order in major:
        if isinstance(results.memory[f"total_harmonic_amplitude.{order}"].node, Use):
            yield from (f"{kind}.{order}" for kind in _OF_HARMONIC)


def _orders(results: Results, engine: Engine) -> Iterator[str]:
    """Yield the keys of each order of the inertia forces; of articulated rods those of two cylinders."""
    names = results.listings["balance"].names if "balance" in results.listings else ()
    for name in names:
        row, _, order = name.partition(".")
        if row == "reciprocating":
            for suffix in (order, f"{order}.1", f"{order}.{first_articulated(engine)}"):
                yield from (f"{kind}.{suffix}" for kind in _OF_ORDER)


def _weights(results: Results) -> Iterator[str]:
    """Yield counterweights that differ, each after its parts, and the weights of balance shafts."""
    if "balance" not in results.listings:
        return
    seen: set[float] = set()
    for key in _parts(results, "counterweight_moment."):
        known = results.memory[key]
        if key.count(".") == 1 and known.value and known.value not in seen:
            seen.add(known.value)
            yield from (f"{key}.", key)
    yield from ("best_balanced_share", "best_counterweight_moment", "best_counterweight_moment.")
    yield from ("balance_shaft_moment.", "unbalance_force.balance_shafts.")
