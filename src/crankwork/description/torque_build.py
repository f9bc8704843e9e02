"""From the values of a machine file to a shaft with torques on it, elastic with discs, or with masses in planes."""

from __future__ import annotations

import itertools
import math
import string
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from crankwork.cylinders.planes import PlaneMass, Rotor, Sector, arrangements, sector_moment
from crankwork.description.build import crank_speed, exact_method, machine_alone, read_drive, read_flywheel
from crankwork.description.links_keys import FORMS
from crankwork.description.schema import Values
from crankwork.description.value_types import MeasuredValue, Reader
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import given
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.method import Method
from crankwork.preparation.given_torques import excess_work_of
from crankwork.shaft.torque_diagram import (
    Harmonic,
    ShaftTorques,
    TorqueDiagram,
    WorkStroke,
    angle_in_plate,
    common_period,
    sheared_area_of_hole,
)
from crankwork.shaft.torsion_model import (
    GROUNDED,
    Damper,
    Disc,
    ElasticShaft,
    ExcitingTorque,
    GearPair,
    ShaftPart,
    Throw,
    TorsionModel,
    structure_of,
    walked,
)
from crankwork.shaft.torsional_system import NaturalModes

_TABLES = ("torque", "load")
_OF_ENERGY = ("areas", "excess_work", "energy_fluctuation")
# largest imbalance of stated works, which are rounded, as a share
_BALANCED = 5e-3
_CLOSED = 1e-6
_MOST_ROWS = 10_000
_TRIES, _SETTLED = 50, 1e-15
_TURN = 6.283185307179586
_MOST = 10_000


class _Shaft(NamedTuple):
    """Stated speed of the shaft, and method. [rad/s]"""

    stated: float
    method: Method
    reader: Reader

    @property
    def speed(self) -> float:
        """Speed with the method's own pi. [rad/s]"""
        return self.stated * self.method.pi / math.pi


def build_turning(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of a shaft with torques, or None after complaints."""
    method = exact_method(values, reader)
    flywheel, crank = values["flywheel"], values["crank"]
    stated, largest = (crank_speed(crank[key], method) if key in crank else None for key in ("speed", "largest_speed"))
    speed = stated or largest or _mean_of_speeds(flywheel)
    if speed is None and not reader.has_errors("crank.speed", "flywheel.speeds"):
        reader.add_error("crank.speed", ErrorMessage("missing", advice=('speed = "100 rpm"',)))
    drive = read_flywheel(flywheel, read_drive(values, reader), stated, reader, pi=method.pi)
    drive = replace(drive, inertia=drive.inertia + crank.si("inertia"))
    if reader.problems or speed is None:
        return None
    turning = _turning(values, _Shaft(speed, method, reader))
    rows = 0.0 if turning is None else turning.cycle / values["table"].si("step")
    if rows > _MOST_ROWS:
        reader.add_error("table.step", ErrorMessage("transient_rows", rows=rows, most=_MOST_ROWS))
    if reader.problems or turning is None:
        return None
    machine = machine_alone(values, method, speed, turning=turning, drive=drive)
    return machine if largest is None else _slowed(machine, turning, values, reader)


def _slowed(machine: Machine, turning: ShaftTorques, values: Values, reader: Reader) -> Machine | None:
    """Return the machine with the mean speed that follows from its largest speed, or None after a complaint.

    Angles stated by time and torques stated by power change with the speed.
    """
    drive, largest, counted = machine.drive, machine.speed, machine.method.pi / math.pi
    if "flywheel.speeds[1]" in machine.stated or not (drive.inertia or drive.fluctuation):
        name = "largest_speed_alone" if drive.fluctuation is None else "largest_speed_twice"
        reader.add_error("crank.largest_speed", ErrorMessage(name))
        return None
    if drive.fluctuation and not drive.inertia:
        speed = largest / (1 + drive.fluctuation / 2)
        turning = _turning(values, _Shaft(speed, machine.method, reader)) or turning
        return replace(machine, speed=speed, turning=turning)
    for _ in range(_TRIES):
        excess = excess_work_of(machine, turning, given("speed", machine.speed * counted))
        square = largest**2 - 2 * excess / machine.drive.inertia / counted**2
        if square <= 0:
            reader.add_error("crank.largest_speed", ErrorMessage("largest_speed_small", excess=excess))
            return None
        speed = (largest + math.sqrt(square)) / 2
        turning = _turning(values, _Shaft(speed, machine.method, reader)) or turning
        settled = abs(speed - machine.speed) <= _SETTLED * largest
        machine = replace(machine, speed=speed, turning=turning)
        if settled:
            break
    return machine


def _mean_of_speeds(flywheel: Values) -> float | None:
    """Return the mean of the speed limits of a flywheel."""
    speeds = [speed.value for speed in flywheel["speeds"] if speed]
    return sum(speeds) / 2 if len(speeds) == 2 else None


def _turning(values: Values, shaft: _Shaft) -> ShaftTorques | None:
    """Return the torques that drive and load a shaft."""
    reader, given = shaft.reader, [name for name in _TABLES if name in values]
    periods = {name: _period(values[name], shaft) for name in given}
    known = [period for period in periods.values() if period is not None]
    if not known and {form for name in given for form in FORMS if form in values[name]} == {"harmonics"}:
        known = [math.tau]
    if not known:
        for name in given:
            reader.add_error(
                f"{name}.period", ErrorMessage("missing", advice=('period = "360 deg"', 'rate = "30 1/min"'))
            )
        return None
    made = {name: _diagram(values[name], name, periods[name] or known[0], shaft) for name in given}
    of_energy = [name for name in given if any(form in values[name] for form in _OF_ENERGY)]
    if of_energy and len(given) > 1:
        reader.add_error(of_energy[0], ErrorMessage("diagram_alone"))
    cycle = common_period(known[0], known[-1])
    if cycle is None:
        first, second = math.degrees(known[0]), math.degrees(known[-1])
        reader.add_error("load.period", ErrorMessage("periods_apart", first=first, second=second))
    if reader.problems or cycle is None:
        return None
    turning = ShaftTorques(made.get("torque"), made.get("load"), cycle)
    _check_balance(turning, reader)
    return turning


def _period(values: Values, shaft: _Shaft) -> float | None:
    """Return the period of a torque, None if it is not stated. [rad]"""
    if "rate" in values:
        return math.tau * shaft.speed / float(values["rate"].value)
    return None if "period" not in values else _angle(values["period"], shaft)


def _angle(given: MeasuredValue, shaft: _Shaft) -> float:
    """Return an angle, or the angle turned in a time at mean speed. [rad]"""
    return given.value * shaft.speed if given.dimension == "time" else given.value


def _diagram(values: Values, table: str, period: float, shaft: _Shaft) -> TorqueDiagram:
    """Return a torque over its period; report mistakes."""
    if not any(form in values for form in (*FORMS, "constant", "power")):
        shaft.reader.add_error(table, ErrorMessage("diagram_empty"))
    constant = values.si("power") / shaft.speed if "power" in values else values.si("constant") or 0.0
    scale = _scale(values, table, shaft.reader)
    return TorqueDiagram(
        period=period,
        constant=constant,
        points=_points(values, table, period, shaft.reader),
        harmonics=_harmonics(values, table, period, shaft.reader),
        strokes=tuple(
            _stroke(stroke, f"{table}.strokes[{number}]", period, scale, shaft)
            for number, stroke in enumerate(values["strokes"], start=1)
        ),
        delays=_delays(values, table, period, shaft.reader),
        loops=_loops(values, table, scale, shaft.reader),
        excess=_excess(values, table, constant * period, scale, shaft.reader),
    )


def _scale(values: Values, table: str, reader: Reader) -> float:
    """Return the work per area of the drawing; report an incomplete scale. [J/m2]"""
    scale = values["scale"]
    if "work" in scale:
        return float(scale["work"].value)
    if len(scale) == 2:
        return float(scale["torque"].value * scale["angle"].value)
    if scale:
        missing = "angle" if "torque" in scale else "torque"
        example = '"3 deg/mm"' if missing == "angle" else '"600 N*m/mm"'
        reader.add_error(f"{table}.scale.{missing}", ErrorMessage("missing", advice=(f"{missing} = {example}",)))
    return 0.0


def _work(given: MeasuredValue, path: str, scale: float, reader: Reader) -> float:
    """Return a work, or the work of an area of the drawing. [J]"""
    if given.dimension == "energy":
        return given.value
    table = path.partition(".")[0]
    if not scale and not reader.has_errors(f"{table}.scale"):
        reader.add_error(path, ErrorMessage("area_scale", table=table))
    return given.value * scale


def _points(values: Values, table: str, period: float, reader: Reader) -> tuple[tuple[float, float], ...]:
    """Return the corners of a diagram; report angles that descend or exceed the period."""
    if "torque" not in values or "at" not in values or None in (*values["at"], *values["torque"]):
        return ()
    angles, torque = ([angle.value for angle in values[name]] for name in ("at", "torque"))
    if len(angles) != len(torque):
        reader.add_error(
            f"{table}.at", ErrorMessage("load_at_count", count=len(angles), others=len(torque), column="torque")
        )
        return ()
    for number, (before, after) in enumerate(itertools.pairwise(angles), start=2):
        if after < before:
            reader.add_error(f"{table}.at[{number}]", ErrorMessage("points_descend"))
        if number > 2 and before == after == angles[number - 3]:
            reader.add_error(f"{table}.at[{number}]", ErrorMessage("points_thrice"))
    if angles[-1] > period * (1 + _CLOSED):
        beyond = next(number for number, angle in enumerate(angles, start=1) if angle > period * (1 + _CLOSED))
        reader.add_error(f"{table}.at[{beyond}]", ErrorMessage("points_beyond", period=math.degrees(period)))
    if angles[0] == angles[-1]:
        reader.add_error(f"{table}.at", ErrorMessage("points_descend"))
    gap = period - (angles[-1] - angles[0])
    widest = max(after - before for before, after in itertools.pairwise(angles))
    if gap > widest * (1 + _CLOSED) + _CLOSED * period and (torque[0] or torque[-1]):
        first, last, full = (math.degrees(angle) for angle in (angles[0], angles[-1], period))
        reader.add_error(f"{table}.at", ErrorMessage("points_short", first=first, last=last, period=full))
    return tuple((min(angle, period), other) for angle, other in zip(angles, torque, strict=True))


def _harmonics(values: Values, table: str, period: float, reader: Reader) -> tuple[Harmonic, ...]:
    """Return the orders of a torque; report orders that are not periodic in the period."""
    harmonics = []
    for number, harmonic in enumerate(values["harmonics"], start=1):
        if not harmonic or "order" not in harmonic:
            continue
        times = harmonic["order"] * period / math.tau
        if abs(times - round(times)) > _CLOSED * times or not round(times):
            path = f"{table}.harmonics[{number}].order"
            reader.add_error(path, ErrorMessage("order_open", order=harmonic["order"], period=math.degrees(period)))
        harmonics.append(Harmonic(harmonic["order"], harmonic.si("sin"), harmonic.si("cos")))
    return tuple(harmonics)


def _stroke(values: Values | None, path: str, period: float, scale: float, shaft: _Shaft) -> WorkStroke:
    """Return work over an interval; report an interval longer than the period."""
    if values is None or not {"work", "shear_energy", "shear_strength"} & set(values):
        return WorkStroke(0.0, 0.0, 0.0)
    work, reader = 0.0, shaft.reader
    if "work" in values:
        work = _work(values["work"], f"{path}.work", scale, reader)
    elif "thickness" in values and {"hole_diameter", "cut_width"} & set(values):
        area = _sheared_area(values, shaft.method.pi)
        if "shear_energy" in values:
            work = values["shear_energy"].value * area
        elif "penetration" in values:
            work = values["shear_strength"].value * area * values["penetration"] * values.si("thickness")
    else:
        reader.add_error(
            f"{path}.{'shear_energy' if 'shear_energy' in values else 'shear_strength'}", ErrorMessage("shear_of_what")
        )
    over = _over(values, period, shaft)
    if over > period * (1 + _CLOSED):
        message = ErrorMessage("stretch_long", over=math.degrees(over), period=math.degrees(period))
        reader.add_error(f"{path}.over" if "over" in values else f"{path}.punch_stroke", message)
    start = _angle(values["from"], shaft)
    if start > period * (1 + _CLOSED):
        reader.add_error(f"{path}.from", ErrorMessage("points_beyond", period=math.degrees(period)))
    return WorkStroke(work, start, min(over, period), values["shape"], values.get("peak", 0.5))


def _sheared_area(values: Values, pi: float) -> float:
    thickness = values.si("thickness")
    if "hole_diameter" in values:
        return float(sheared_area_of_hole(pi, values.si("hole_diameter"), thickness))
    return float(values.si("cut_width") * thickness)


def _over(values: Values, period: float, shaft: _Shaft) -> float:
    """Return the angle over which work is done, zero for an impulse. [rad]"""
    if "punch_stroke" in values and "thickness" in values:
        return float(angle_in_plate(values.si("thickness"), period, values.si("punch_stroke")))
    over = values.get("over", 0.0)
    if isinstance(over, MeasuredValue):
        return _angle(over, shaft)
    return float(over * period)


def _delays(values: Values, table: str, period: float, reader: Reader) -> tuple[float, ...]:
    """Return the delay of the torque of each cylinder. [rad]"""
    if "cylinders" in values:
        count = int(values["cylinders"])
        return tuple(period * index / count for index in range(count))
    if "delays" not in values or None in values["delays"]:
        return (0.0,)
    delays = tuple(delay.value for delay in values["delays"])
    for number, delay in enumerate(delays, start=1):
        if delay > period * (1 + _CLOSED):
            reader.add_error(f"{table}.delays[{number}]", ErrorMessage("points_beyond", period=math.degrees(period)))
    return delays


def _loops(values: Values, table: str, scale: float, reader: Reader) -> tuple[float, ...]:
    """Return the works of loops about the mean; report a sum that is not zero."""
    if "areas" not in values or None in values["areas"]:
        return ()
    works = tuple(
        _work(area, f"{table}.areas[{number}]", scale, reader) for number, area in enumerate(values["areas"], start=1)
    )
    left, size = sum(works), max(map(abs, works))
    if abs(left) > _BALANCED * size and not reader.has_errors(table):
        reader.add_error(f"{table}.areas", ErrorMessage("areas_open", left=left, share=100 * abs(left) / size))
    return works


def _excess(values: Values, table: str, work: float, scale: float, reader: Reader) -> float | None:
    """Return the fluctuation of the energy, stated in J or as a share of the work of a period. [J]"""
    if "excess_work" in values:
        return _work(values["excess_work"], f"{table}.excess_work", scale, reader)
    if "energy_fluctuation" not in values:
        return None
    if not work and not reader.has_errors(f"{table}.constant", f"{table}.power"):
        reader.add_error(f"{table}.energy_fluctuation", ErrorMessage("fluctuation_of_what"))
    return float(values["energy_fluctuation"] * abs(work))


def _check_balance(turning: ShaftTorques, reader: Reader) -> None:
    """Report a torque whose work differs from that of its load."""
    if turning.torque is None or turning.load is None:
        return
    driven, taken = (diagram.work * turning.cycle / diagram.period for diagram in (turning.torque, turning.load))
    if abs(driven - taken) > _BALANCED * max(abs(driven), abs(taken)):
        mean = driven / turning.cycle
        reader.add_error(
            "load", ErrorMessage("work_unbalanced", driven=driven, taken=taken, left=driven - taken, mean=mean)
        )


def build_rotor(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of masses on a shaft, or None after complaints."""
    method, table = exact_method(values, reader), values["rotor"]
    train, crank = table["locomotive"], values["crank"]
    speed = crank_speed(crank["speed"], method) if "speed" in crank else None
    if {"speed", "wheel_diameter"} <= set(train):
        if speed is not None:
            reader.add_error("rotor.locomotive.speed", ErrorMessage("same", others=["crank.speed"]))
        speed = 2 * train.si("speed") / train.si("wheel_diameter") * math.pi / method.pi
    rotor = None if reader.problems else _rotor(table, reader)
    try:
        states = arrangements(rotor) if rotor is not None and not reader.problems else []
        if rotor is not None and states and rotor.arrangement > len(states):
            reader.add_error("rotor.arrangement", ErrorMessage("rotor_arrangement", count=len(states)))
        elif rotor is not None and states:
            _check_sectors(rotor, states[rotor.arrangement - 1].sizes.tolist(), reader)
    except CrankworkError as error:
        reader.add_error("rotor.masses", error.args[0])
    if rotor is None or reader.problems:
        return None
    return machine_alone(values, method, speed or 1.0, rotor=replace(rotor, has_speed=speed is not None))


def _check_sectors(rotor: Rotor, sizes: Sequence[float], reader: Reader) -> None:
    """Report sectors that are wanted and too small for their moments."""
    for number, (mass, needed) in enumerate(zip(rotor.masses, sizes, strict=True), start=1):
        if mass.sector is not None and mass.sector.angle is None:
            most = float(sector_moment(*vars(replace(mass.sector, angle=math.pi)).values()))
            if needed > most:
                path = f"rotor.masses[{number}].sector"
                reader.add_error(path, ErrorMessage("rotor_sector", most=most, needed=needed))


def _rotor(table: Values, reader: Reader) -> Rotor:
    """Return the masses; report names and positions that do not fit together, and shares of nothing."""
    train, masses = table["locomotive"], list[PlaneMass]()
    for number, entry in enumerate(table["masses"]):
        path = f"rotor.masses[{number + 1}]"
        name = entry["name"] or string.ascii_uppercase[number % 26] + str(number // 26 or "")
        if name in {mass.name for mass in masses}:
            reader.add_error(f"{path}.name", ErrorMessage("rotor_name", name=name))
        ring = entry["sector"].made(Sector) if "sector" in entry else None
        if ring is not None and ring.inner_radius >= ring.outer_radius:
            reader.add_error(f"{path}.sector.inner_radius", ErrorMessage("rotor_ring"))
        if table["kind"] == "reciprocating" and "reciprocating" in entry:
            reader.add_error(f"{path}.reciprocating", ErrorMessage("rotor_mass"))
        pistons = entry.si("reciprocating") or 0.0
        masses.append(entry.made(PlaneMass, name=name, sector=ring, reciprocating=pistons))
    rotor = Rotor(
        tuple(masses),
        table["kind"],
        table["reciprocating_share"] or 0.0,
        table.si("rod_length"),
        table.si("reference"),
        tuple(place.value for place in table["bearings"] or ()),
        int(train["coupled"]) if "locomotive" in table else 0,
        (train.si("wheel_diameter"), train.si("wheel_load")),
        int(table["arrangement"]),
    )
    if rotor.bearings and (len(set(rotor.bearings)) == 1 or rotor.is_flat):
        reader.add_error("rotor.bearings", ErrorMessage("rotor_bearings"))
    # the share is an idle key
    has_pistons = rotor.kind != "reciprocating" and any(mass.reciprocating for mass in masses)
    if "locomotive" in table and not has_pistons:
        reader.add_error("rotor.locomotive", ErrorMessage("rotor_no_pistons"))
    return rotor


def build_torsion_alone(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of discs on shafts alone, or None after complaints."""
    method = exact_method(values, reader)
    model = torsion_of_throws(values["torsion"], reader)
    stated = values["crank"]["speed"]
    speed = crank_speed(stated, method) if stated else 0.0
    if not speed and model is not None and any(torque.order is not None for torque in model.torques):
        reader.add_error("crank.speed", ErrorMessage("missing", advice=('speed = "1500 rpm"',)))
    if reader.problems or model is None:
        return None
    return machine_alone(values, method, speed or 1.0, turning=ShaftTorques(None, None, _TURN), torsion=model)


def torsion_of_throws(values: Values, reader: Reader, throws: int = 0, radius: float = 0.0) -> TorsionModel | None:
    """Return the torsional system, with a disc for each throw of a crankshaft of a radius, or None after complaints."""
    names = tuple(f"throw_{number}" for number in range(1, throws + 1))
    shafts = dict(_shafts(values, names, radius, reader))
    if reader.problems or any(
        item is None for table in ("discs", "gears", "dampers") for item in values[table].values()
    ):
        return None
    discs = {name: item.made(Disc) for name, item in values["discs"].items()}
    gears = {name: _gear(item) for name, item in values["gears"].items()}
    dampers = {
        name: item.made(Damper, stiffness=item.si("stiffness") or 0.0, mode=int(item["mode"]))
        for name, item in values["dampers"].items()
    }
    torques = tuple(item.made(ExcitingTorque) for item in values["torques"] if item is not None)
    speeds = tuple(item.value for item in values["speeds"] if item is not None)
    model = TorsionModel(
        discs, shafts, gears, dampers, torques, values.si("modulus"), values.si("reference_diameter"), names,
        values.si("throw_inertia") or 0.0, tuple(item.value for item in values["trials"] if item is not None),
        (speeds[0], speeds[1]) if len(speeds) == 2 else None, float(values["orders"]), int(values["modes"]),
    )  # fmt: skip
    _check(model, reader)
    return None if reader.problems else model


def _shafts(values: Values, throws: Sequence[str], radius: float, reader: Reader) -> Iterator[tuple[str, ElasticShaft]]:
    """Yield the shafts that are stated, and those between neighbouring throws."""
    if len(throws) > 1:
        path = "torsion.throw_shaft"
        if "throw_shaft" not in values:
            reader.add_error(path, ErrorMessage("missing", advice=('throw_shaft.stiffness = "1 MN*m/rad"',)))
            return
        for number, (before, after) in enumerate(itertools.pairwise(throws), start=1):
            yield f"crank_{number}", _shaft(values["throw_shaft"], (before, after), path, radius, reader)
    for name, item in values["shafts"].items():
        if item is not None and None not in item["between"] and len(item["between"]) == 2:
            first, second = item["between"]
            yield name, _shaft(item, (first, second), f"torsion.shafts.{name}", radius, reader)


def _shaft(values: Values, between: tuple[str, str], path: str, radius: float, reader: Reader) -> ElasticShaft:
    """Return a shaft; report sections that are no sections."""
    parts = [
        (f"{path}.parts[{number}]", part.made(ShaftPart))
        for number, part in enumerate(values["parts"], start=1)
        if part is not None and {"length", "diameter"} <= set(part)
    ]
    diameter, bore = values.si("diameter"), values.si("bore") or 0.0
    if "length" in values and diameter is not None:
        parts = [(path, ShaftPart(values.si("length"), diameter, bore))]
    if diameter is not None and bore >= diameter:
        reader.add_error(f"{path}.bore", ErrorMessage("torsion_bore"))
    for place, part in parts:
        if part.bore >= part.diameter and place != path:
            reader.add_error(f"{place}.bore", ErrorMessage("torsion_bore"))
    throw = None
    if "throw" in values and {"journal_length", "journal_diameter", "pin_length", "pin_diameter", "web_thickness",
                              "web_width"} <= set(values["throw"]):  # fmt: skip
        throw = values["throw"].made(Throw)
        if not throw.radius and not radius:
            reader.add_error(f"{path}.throw.radius", ErrorMessage("missing", advice=('radius = "60 mm"',)))
        for name in ("journal", "pin"):
            if getattr(throw, f"{name}_bore") >= getattr(throw, f"{name}_diameter"):
                reader.add_error(f"{path}.throw.{name}_bore", ErrorMessage("torsion_bore"))
    return ElasticShaft(
        path, between, values.si("stiffness"), tuple(part for _, part in parts), throw, values.si("modulus"),
        values.si("density"), int(values["elements"] or 0), values.si("damping"), float(values["loss_factor"]),
        diameter, bore,
    )  # fmt: skip


def _gear(values: Values) -> GearPair:
    first, second = values["between"]
    teeth = tuple(values["teeth"]) if len(values["teeth"]) == 2 else None
    return GearPair((first, second), teeth[0] / teeth[1] if teeth else float(values["ratio"]), teeth)


def _check(model: TorsionModel, reader: Reader) -> None:
    """Report names of discs that there are not, and what cannot vibrate."""
    _check_names(model, reader)
    for table in ("discs", "dampers"):
        for name in getattr(model, table):
            if name == GROUNDED or name in model.throws or (table == "dampers" and name in model.discs):
                reader.add_error(f"torsion.{table}.{name}", ErrorMessage("torsion_name", name=name))
    for name, gear in model.gears.items():
        if not gear.ratio:
            reader.add_error(f"torsion.gears.{name}.ratio", ErrorMessage("torsion_ratio"))
    if model.speeds is not None and model.speeds[0] >= model.speeds[1]:
        reader.add_error("torsion.speeds", ErrorMessage("torsion_speeds"))
    if not model.shafts:
        reader.add_error("torsion.shafts", ErrorMessage("torsion_empty"))
    if not reader.problems:
        _check_numbers(model, reader)


def _check_names(model: TorsionModel, reader: Reader) -> None:
    """Report names of discs that there are not, and shafts and gears between a disc and itself."""
    known = (*model.throws, *model.discs)
    pairs = [(item.path, item.between, (*known, GROUNDED)) for item in model.shafts.values()]
    pairs += [(f"torsion.gears.{name}", item.between, known) for name, item in model.gears.items()]
    named = [
        (f"{path}.between[{number}]", name, allowed)
        for path, pair, allowed in pairs
        for number, name in enumerate(pair, start=1)
    ]
    named += [(f"torsion.dampers.{name}.on", item.on, known) for name, item in model.dampers.items()]
    with_rings = (*known, *model.dampers)
    named += [
        (f"torsion.torques[{number}].disc", item.disc, with_rings) for number, item in enumerate(model.torques, 1)
    ]
    for path, name, allowed in named:
        if name not in allowed:
            reader.add_error(path, ErrorMessage("torsion_no_disc", name=name, known=", ".join(known)))
    for path, pair, _ in pairs:
        if pair[0] == pair[1]:
            reader.add_error(f"{path}.between", ErrorMessage("torsion_itself", name=pair[0]))


def _check_joined(model: TorsionModel, reader: Reader) -> None:
    """Report discs that nothing joins to the others, and rings of shafts and gears in which nothing can turn."""
    ends = [(item.path, item.between, 1.0) for item in model.shafts.values()]
    ends += [(f"torsion.gears.{name}", item.between, item.ratio) for name, item in model.gears.items()]
    ends += [(path, (second, first), 1 / ratio) for path, (first, second), ratio in ends]
    speed, parts = dict[str, float](), list[tuple[list[str], bool]]()
    for start in (*model.throws, *model.discs):
        if start in speed:
            continue
        speed[start], part, closing = 1.0, [start], ""
        for name in part:
            for path, other, ratio in ((path, pair[1], ratio) for path, pair, ratio in ends if pair[0] == name):
                if other != GROUNDED and speed.setdefault(other, speed[name] * ratio) and other not in part:
                    part.append(other)
                closing = path if not math.isclose(speed.get(other, 0.0), speed[name] * ratio) else closing
        held = any(GROUNDED in pair for _, pair, _ in ends if {*part} & {*pair})
        parts.append((part, held))
        if closing and not held:
            reader.add_error(closing, ErrorMessage("torsion_ring"))
    main, is_main_held = max(parts, key=lambda item: len(item[0]), default=([""], False))
    for (name, *_), held in ((part, held) for part, held in parts if part is not main):
        if not (held and is_main_held):
            path = f"torsion.discs.{name}" if name in model.discs else "torsion.shafts"
            reader.add_error(path, ErrorMessage("torsion_loose", name=name, other=main[0]))


def _check_numbers(model: TorsionModel, reader: Reader) -> None:
    """Report discs that hang on nothing, gears in a ring, a system that does not vibrate, and modes it has not."""
    structure = structure_of(replace(model, dampers={}))
    if len(set(structure.groups)) != structure.discs - len(structure.gears):
        reader.add_error("torsion.gears", ErrorMessage("torsion_gear_ring"))
    _check_joined(model, reader)
    heavy = any(disc.inertia or disc.mass for disc in model.discs.values()) or model.throws
    if not heavy and not any(shaft.density for shaft in model.shafts.values()):
        reader.add_error("torsion.discs", ErrorMessage("torsion_massless"))
    massive = {name for name, disc in model.discs.items() if disc.inertia or disc.mass} | {*model.throws}
    massive |= {name for shaft in model.shafts.values() if shaft.density for name in shaft.between}
    groups = {group for name, group in zip(walked(model), structure.groups, strict=False) if name in massive}
    light = len(set(structure.groups)) - len(groups)
    count = NaturalModes(structure, _MOST).count - light
    if not reader.problems and count < 1:
        reader.add_error("torsion.discs", ErrorMessage("torsion_no_mode"))
    for name, damper in model.dampers.items():
        if 0 < count < damper.mode:
            reader.add_error(f"torsion.dampers.{name}.mode", ErrorMessage("torsion_mode", count=str(count)))
