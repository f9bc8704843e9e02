"""The stated inputs of an engine, and the values that follow from them before the calculation begins.

A machine holds its lengths and masses in one form; a description may state others: stroke, rod ratio, masses over the
piston area. The stated number is the input of the trace, and the step between them is calculated.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.dynamics import masses as masses_of_rod
from crankwork.dynamics.masses import CrankGearMasses, rod_big_end_mass, rod_inertia_excess, rod_small_end_mass
from crankwork.dynamics.piston_forces import angular_speed
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, given
from crankwork.kinematics.slider_crank import SliderCrank, stroke_central, stroke_offset
from crankwork.machine import Drive, Machine
from crankwork.method import Method
from crankwork.units import UNITS
from crankwork.working_cycle.engine_size import bore_and_stroke, swept_volume_of_one

_SAME = 1e-12
# sizes that give others, by their keys in a description
_SIZES = {
    "cylinder.displacement": "displacement", "cylinder.stroke_bore_ratio": "stroke_bore_ratio", "cylinder.bore": "bore",
    "crank.stroke": "stroke", "crank.radius": "crank_radius", "engine.cylinders": "cylinder_count",
}  # fmt: skip


def stated_value(machine: Machine, path: str, key: str) -> TracedValue:
    """Return a number that the description states, as a quantity of that key; absent if it does not state it."""
    return given(key, machine.stated[path].value, path) if path in machine.stated else absent(key)


def size(path: str, value: float) -> TracedValue:
    """Return a size of an engine that a description states there."""
    return given(_SIZES[path], value, path)


def lengths(machine: Machine, sizes: SliderCrank) -> SliderCrank:
    """Return crank radius, rod length and offset."""
    r, l, e = (float(size) for size in sizes)  # noqa: E741
    radius = size("crank.radius", r)
    calculated = calculated_size(machine, "stroke")
    if calculated is not None and "crank.radius" not in machine.stated:
        radius = checked(calculated / 2, radius)
    stroke = stated_value(machine, "crank.stroke", "stroke")
    if not stroke.is_absent:
        radius = checked(stroke / 2, radius)
    length, ratio = given("rod_length", l, "rod.length"), stated_value(machine, "rod.ratio", "rod_ratio")
    if not ratio.is_absent:
        is_inverse = not _is_close(ratio.value, r / l)
        length = checked(radius * ratio.named("inverse_rod_ratio") if is_inverse else radius / ratio, length)
    return SliderCrank(radius, length, given("offset", e, _offset_of(machine, e)) if e else absent("offset"))


def _offset_of(machine: Machine, offset: float) -> str:
    """Return where an offset is stated: of all cylinders, or of the first that has it."""
    offsets = machine.engine.offsets if machine.engine is not None else ()
    return f"engine.offsets[{offsets.index(offset) + 1}]" if offset in offsets else "cylinder.offset"


def calculated_size(machine: Machine, key: str) -> TracedValue | None:
    """Return the size from other sizes or the calculation of a cycle if the description leaves the size open."""
    cycle = getattr(machine.gas.calculated, "cycle", None) if machine.gas is not None else None
    result = None if cycle is None or "cycle.power" not in machine.stated else cycle.trace.get(key)
    if result is None:
        return _sizes(machine)[key == "stroke"]
    # calculated sizes are rounded to millimetres
    return TracedValue(ProcedureValue(round(result.value, 3), "rounded", (result,)), key)


def _sizes(machine: Machine) -> tuple[TracedValue | None, TracedValue | None]:
    """Return bore and stroke, of which some follow from a displacement or stroke over bore; None without these."""
    known = {path: size(path, machine.stated[path].value) for path in _SIZES if path in machine.stated}
    volume, ratio, bore, stroke, radius, count = map(known.get, _SIZES)
    if volume is None and ratio is None:
        return None, None
    if volume is not None and count is not None:
        volume = swept_volume_of_one(volume, count)
    stroke = stroke if radius is None else stroke_central(radius)
    return bore_and_stroke(machine.method.pi, volume, ratio, bore, stroke)


def bore(machine: Machine, diameter: float) -> TracedValue:
    """Return the bore: stated, or of the calculation of the cycle."""
    stated, calculated = size("cylinder.bore", diameter), calculated_size(machine, "bore")
    return stated if calculated is None else checked(calculated, stated)


def stroke(lengths: SliderCrank) -> TracedValue:
    """Return the stroke: stated, or of the lengths."""
    r, l, e = lengths  # noqa: E741
    if not e.is_absent:
        return stroke_offset(l, r, e)  # type: ignore[no-any-return]
    stated = r.node.operands
    result: TracedValue = stated[0] if stated else stroke_central(r)
    return result


def revolutions(machine: Machine) -> TracedValue:
    """Return the speed of the crank in revolutions per minute."""
    return given("rotational_speed", machine.speed * 30 / math.pi, "crank.speed", "rpm")


def speed(machine: Machine, method: Method) -> TracedValue:
    """Return the angular speed of the crank: stated, or of its revolutions with the method's own pi."""
    return speed_at(machine, method, "crank.speed", machine.speed)


def speed_at(machine: Machine, method: Method, path: str, value: float, name: str = "") -> TracedValue:
    """Return an angular speed with an input path: stated, or of its revolutions with the method's own pi. [rad/s]

    `name`: suffix that distinguishes it from the speed of the crank.
    """
    stated, turns = machine.stated.get(path), given(f"rotational_speed{name}", value * 30 / math.pi, path, "rpm")
    result: TracedValue = angular_speed(method.pi, turns).named(f"speed{name}")
    in_radians = stated is not None and UNITS[stated.unit].factor == 1.0
    return checked(given(f"speed{name}", stated.value, path), result) if stated and in_radians else result


def acceleration(machine: Machine) -> TracedValue:
    """Return the angular acceleration of the crank."""
    value, key = machine.angular_acceleration, "angular_acceleration"
    return given(key, value, f"crank.{key}") if value else absent(key)


def speeds(machine: Machine, w: TracedValue) -> dict[str, TracedValue]:
    """Return the stated speed of the crank, and its angular speed."""
    return {"rotational_speed": given("rotational_speed", machine.speed, "crank.speed"), "speed": w}


def gravity(machine: Machine, method: Method) -> TracedValue:
    """Return the acceleration of gravity, absent where weights do not count."""
    return given("gravity", method.gravity, "method.gravity") if machine.has_gravity else absent("gravity")


def efficiency(drive: Drive) -> dict[str, TracedValue]:
    """Return the efficiency of a drive if it has one."""
    return {} if drive.efficiency == 1 else {"efficiency": efficiency_of(drive)}


def efficiency_of(drive: Drive) -> TracedValue:
    """Return the efficiency of the joints between motor and process, the product over a chain if one is given."""
    if drive.efficiency == 1:
        return absent("efficiency", 1.0)
    if drive.chain is None:
        return given("efficiency", drive.efficiency, "efficiency.chain")
    # few machines have one
    from crankwork.dynamics.efficiency import traced_efficiency  # noqa: PLC0415 - loaded where it is needed

    if drive.exact_efficiency is None:
        return traced_efficiency(drive.chain)
    exact = traced_efficiency(drive.chain).named("efficiency.exact")
    return TracedValue(ProcedureValue(drive.efficiency, "rounded", (exact,)), "efficiency")


def inclination(machine: Machine, lean: float) -> tuple[TracedValue, TracedValue]:
    """Return cosine and sine of the angle by which a cylinder leans that is so far ahead of cylinder 1. [deg]"""
    angle = given("inclination", machine.inclination, "cylinder.inclination")
    if lean:
        angle = (angle + given("bank_axis", math.radians(lean), "engine.bank_angle")).named("inclination")
    turned = angle.value
    return TracedValue(ProcedureValue(math.cos(turned), "cosine", (angle,))), TracedValue(
        ProcedureValue(math.sin(turned), "sine", (angle,))
    )


def cycle_angle(machine: Machine) -> TracedValue:
    """Return the length of the cycle."""
    path = "engine.strokes" if machine.gas is None else "gas.cycle" if machine.gas.calculated is None else "cycle.cycle"
    # that of a linkage follows from its parts
    path = path if machine.lengths is not None else ""
    return given("cycle_angle", math.radians(machine.cycle), path)


def masses(
    machine: Machine, known: CrankGearMasses, area: TracedValue | None, length: Value, table: str = "rod"
) -> Iterator[TracedValue]:
    """Yield the masses of piston and crank, the two of the rod, and its excess of inertia if it has one.

    `table`: where the rod is described, if it is not like the master rod.
    """

    def mass(key: str, value: float, path: str) -> TracedValue:
        stated, plain = machine.stated.get(path), given(key, value, path)
        if stated is None or area is None or UNITS[stated.unit].dimension != "mass_per_area":
            return plain
        own = given(f"mass_per_area.of_{key.removesuffix('_mass')}", stated.value, path)
        return checked(own * area, plain) if value else plain

    yield mass("piston_mass", known.piston, "piston.mass")
    yield mass("crank_mass", known.crank, "crank.mass")
    small = mass("rod_small_end_mass", known.rod_small_end, f"{table}.small_end_mass")
    big = mass("rod_big_end_mass", known.rod_big_end, f"{table}.big_end_mass")
    excess = given("rod_inertia_excess", known.rod_inertia_excess, f"{table}.inertia")
    stated = machine.stated.get(f"{table}.mass")
    if stated is not None:
        total_mass = mass("rod_mass", known.rod_small_end + known.rod_big_end, f"{table}.mass")
        centre = _centre(machine, length, table)
        small = checked(rod_small_end_mass(total_mass, centre, length), small)
        big = checked(rod_big_end_mass(total_mass, small), big)
        excess = _excess(machine, (total_mass, centre, length), excess, table)
    yield from (small, big)
    if known.rod_inertia_excess:
        yield excess
    if stated is not None and table == "rod":
        yield from _equivalent(machine, total_mass, centre, length)


def _centre(machine: Machine, length: Value, table: str) -> TracedValue:
    """Return the distance of the centre of mass of the rod from the crankpin."""
    share = stated_value(machine, f"{table}.small_end_share", "small_end_share")
    centre = stated_value(machine, f"{table}.centre_of_mass", "rod_centre_distance")
    if not share.is_absent:
        distance: TracedValue = share * length
        return distance.named("rod_centre_distance")
    if centre.is_absent and (swings := pendulum(machine, length)):
        return swings[0]
    return given("rod_centre_distance", centre.value, f"{table}.centre_of_mass")


def _excess(
    machine: Machine, rod: tuple[TracedValue, TracedValue, Value], excess: TracedValue, table: str
) -> TracedValue:
    mass, centre, length = rod
    own = _own_inertia(machine, mass, length, table)
    return excess if own is None else checked(rod_inertia_excess(own, mass, centre, length), excess)


def _own_inertia(machine: Machine, mass: TracedValue, length: Value, table: str) -> TracedValue | None:
    """Return the moment of inertia of the rod about its centre of mass, None if nothing tells it."""
    inertia = stated_value(machine, f"{table}.inertia", "rod_inertia")
    gyration = stated_value(machine, f"{table}.radius_of_gyration", "rod_gyration_radius")
    if inertia.is_absent and gyration.is_absent and table == "rod":
        gyration = next(iter(pendulum(machine, length)[1:]), gyration)
    if inertia.is_absent and gyration.is_absent:
        return None
    return (mass * gyration * gyration).named("rod_inertia") if inertia.is_absent else inertia


def pendulum(machine: Machine, length: Value) -> tuple[TracedValue, ...]:
    """Return centre of mass and radius of gyration of a rod that swung on either bore, nothing if it did not."""
    swings = (
        stated_value(machine, f"rod.pendulum.{end}_{name}", f"{key}.{end}")
        for key, name in (("swing_period", "period"), ("bore_diameter", "diameter"))
        for end in ("small_end", "big_end")
    )
    small, big, upper, lower = swings
    if any(number.is_absent for number in (small, big, upper, lower)):
        return ()
    method = machine.method
    g = given("gravity", method.gravity, "method.gravity")
    first, second = (
        masses_of_rod.pendulum_length(method.pi, g, period).named(f"pendulum_length.{end}")
        for end, period in (("small_end", small), ("big_end", big))
    )
    span = (length + (upper + lower) / 2).named("suspension_span")
    distance = masses_of_rod.suspension_distance(first, second, span)
    centre = (span - distance - lower / 2).named("rod_centre_distance")
    return centre, masses_of_rod.pendulum_gyration(distance, first)


def _equivalent(machine: Machine, mass: TracedValue, centre: TracedValue, length: Value) -> Iterator[TracedValue]:
    """Yield the masses that replace the rod with its inertia, where they are asked for."""
    count, inertia = machine.rod_equivalent, _own_inertia(machine, mass, length, "rod")
    if not count or inertia is None:
        return
    if count == "two masses":
        distance = masses_of_rod.equivalent_distance(inertia, mass, centre, length)
        first = masses_of_rod.first_equivalent_mass(mass, centre, length, distance).named("equivalent_mass.small_end")
        yield from (inertia, distance, first, (mass - first).named("equivalent_mass.other"))
        return
    ends = {"small_end": length - centre, "big_end": centre}
    first, last = (
        masses_of_rod.end_mass_of_three(inertia, arm.named(f"rod_centre_distance.{end}"), length).named(
            f"equivalent_mass.{end}"
        )
        for end, arm in ends.items()
    )
    yield from (inertia, first, last, (mass - first - last).named("equivalent_mass.centre"))


def _is_close(first: float, second: float) -> bool:
    return math.isclose(first, second, rel_tol=_SAME)


def checked(value: TracedValue, plain: TracedValue) -> TracedValue:
    """Return a calculated value if it equals that of the machine, else the latter, which was changed since."""
    return value.named(plain.key) if _is_close(value.value, plain.value) else plain
