"""From the values of a machine file to a shaft with the torques on it."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import NamedTuple

from crankwork.analysis.turning import analyse_turning
from crankwork.description.build import build_method, crank_speed
from crankwork.description.drive_build import read_drive
from crankwork.description.kinds import Measure, Reader
from crankwork.description.schema import Values
from crankwork.description.stated import stated_numbers
from crankwork.description.turning_keys import FORMS
from crankwork.description.wheel_build import read_wheel
from crankwork.locale import Refusal
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.method import Method
from crankwork.shaft.torque_diagram import (
    Harmonic,
    Stroke,
    TorqueDiagram,
    Turning,
    angle_in_plate,
    common_period,
    sheared_area_of_hole,
)

_TABLES = ("torque", "load")
_OF_ENERGY = ("areas", "excess_work", "energy_fluctuation")
# works of a document are rounded; beyond this share a shaft would not run at one speed
_BALANCED = 5e-3
_CLOSED = 1e-6
_MOST_ROWS = 10_000
_TRIES, _SETTLED = 50, 1e-15


class _Shaft(NamedTuple):
    """What diagrams need to know: stated speed of the shaft and method. [rad/s]"""

    stated: float
    method: Method
    reader: Reader

    @property
    def speed(self) -> float:
        """Speed with the method's own pi. [rad/s]"""
        return self.stated * self.method.pi / math.pi


def build_turning(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of a shaft with torques, or None after complaints."""
    method = build_method(values["method"], reader)
    if not method.is_exact:
        reader.complain("method.kinematics", Refusal("turning_exact"))
    flywheel, crank = values["flywheel"], values["crank"]
    stated, largest = (crank_speed(crank[key], method) if key in crank else None for key in ("speed", "largest_speed"))
    speed = stated or largest or _mean_of_speeds(flywheel)
    if speed is None and not reader.doubts("crank.speed", "flywheel.speeds"):
        reader.complain("crank.speed", Refusal("missing", advice=('speed = "100 rpm"',)))
    drive = read_wheel(flywheel, read_drive(values, reader), stated, reader, pi=method.pi)
    drive = replace(drive, inertia=drive.inertia + crank.si("inertia"))
    if reader.problems or speed is None:
        return None
    turning = _turning(values, _Shaft(speed, method, reader))
    if turning is not None:
        _check_rows(turning, values, reader)
    if reader.problems or turning is None:
        return None
    machine = Machine(
        Mechanism(Crank(radius=0.0), ()),
        speed=speed,
        title=values["title"] or "",
        turning=turning,
        drive=drive,
        method=method,
        table_step=values["table"].degrees("step"),
        table_special=tuple(values["table"].degrees("special_angles")),
        stated=stated_numbers(values),
    )
    return machine if largest is None else _slowed(machine, turning, values, reader)


def _check_rows(turning: Turning, values: Values, reader: Reader) -> None:
    """Complain of a table that would be longer than anybody reads."""
    rows = turning.cycle / values["table"].si("step")
    if rows > _MOST_ROWS:
        reader.complain("table.step", Refusal("transient_rows", rows=rows, most=_MOST_ROWS))


def _slowed(machine: Machine, turning: Turning, values: Values, reader: Reader) -> Machine | None:
    """Return the machine with the mean speed that its largest one leaves, or None after a complaint.

    What is stated by time or by power changes its angle or torque with the speed.
    """
    if not machine.drive.inertia:
        reader.complain("crank.largest_speed", Refusal("largest_speed_alone"))
        return None
    largest, counted = machine.speed, machine.method.pi / math.pi
    for _ in range(_TRIES):
        excess = analyse_turning(machine, turning).summary["excess_work"]
        square = largest**2 - 2 * excess / machine.drive.inertia / counted**2
        if square <= 0:
            reader.complain("crank.largest_speed", Refusal("largest_speed_small", excess=excess))
            return None
        speed = (largest + math.sqrt(square)) / 2
        turning = _turning(values, _Shaft(speed, machine.method, reader)) or turning
        settled = abs(speed - machine.speed) <= _SETTLED * largest
        machine = replace(machine, speed=speed, turning=turning)
        if settled:
            break
    return machine


def _mean_of_speeds(flywheel: Values) -> float | None:
    """Return the mean of the extreme speeds that a flywheel shall keep to."""
    speeds = [one.value for one in flywheel["speeds"] if one]
    return sum(speeds) / 2 if len(speeds) == 2 else None


def _turning(values: Values, shaft: _Shaft) -> Turning | None:
    """Return what drives a shaft and what it drives."""
    reader, given = shaft.reader, [name for name in _TABLES if name in values]
    periods = {name: _period(values[name], shaft) for name in given}
    known = [one for one in periods.values() if one is not None]
    if not known:
        for name in given:
            reader.complain(f"{name}.period", Refusal("missing", advice=('period = "360 deg"', 'rate = "30 1/min"')))
        return None
    made = {name: _diagram(values[name], name, periods[name] or known[0], shaft) for name in given}
    of_energy = [name for name in given if any(one in values[name] for one in _OF_ENERGY)]
    if of_energy and len(given) > 1:
        reader.complain(of_energy[0], Refusal("diagram_alone"))
    cycle = common_period(known[0], known[-1])
    if cycle is None:
        first, second = math.degrees(known[0]), math.degrees(known[-1])
        reader.complain("load.period", Refusal("periods_apart", first=first, second=second))
    if reader.problems or cycle is None:
        return None
    turning = Turning(made.get("torque"), made.get("load"), cycle)
    _check_balance(turning, reader)
    return turning


def _period(values: Values, shaft: _Shaft) -> float | None:
    """Return the angle after which a torque repeats, None where it is not stated. [rad]"""
    if "rate" in values:
        return math.tau * shaft.speed / float(values["rate"].value)
    return None if "period" not in values else _angle(values["period"], shaft)


def _angle(given: Measure, shaft: _Shaft) -> float:
    """Return an angle, or that of a time at mean speed. [rad]"""
    return given.value * shaft.speed if given.dimension == "time" else given.value


def _diagram(values: Values, table: str, period: float, shaft: _Shaft) -> TorqueDiagram:
    """Return a torque over its period; complain of what cannot be."""
    if not any(one in values for one in (*FORMS, "constant", "power")):
        shaft.reader.complain(table, Refusal("diagram_empty"))
    constant = values.si("power") / shaft.speed if "power" in values else values.si("constant") or 0.0
    scale = _scale(values, table, shaft.reader)
    return TorqueDiagram(
        period=period,
        constant=constant,
        points=_points(values, table, period, shaft.reader),
        harmonics=_harmonics(values, table, period, shaft.reader),
        strokes=tuple(
            _stroke(one, f"{table}.strokes[{number}]", period, scale, shaft)
            for number, one in enumerate(values["strokes"], start=1)
        ),
        delays=_delays(values, table, period, shaft.reader),
        loops=_loops(values, table, scale, shaft.reader),
        excess=_excess(values, table, constant * period, scale, shaft.reader),
    )


def _scale(values: Values, table: str, reader: Reader) -> float:
    """Return the work that a square metre of the drawing stands for; complain of areas without a scale. [J/m2]"""
    scale = values["scale"]
    if "work" in scale:
        return float(scale["work"].value)
    if len(scale) == 2:
        return float(scale["torque"].value * scale["angle"].value)
    if scale:
        missing = "angle" if "torque" in scale else "torque"
        example = '"3 deg/mm"' if missing == "angle" else '"600 N*m/mm"'
        reader.complain(f"{table}.scale.{missing}", Refusal("missing", advice=(f"{missing} = {example}",)))
    return 0.0


def _work(given: Measure, path: str, scale: float, reader: Reader) -> float:
    """Return a work, or that of an area of the drawing. [J]"""
    if given.dimension == "energy":
        return given.value
    table = path.partition(".")[0]
    if not scale and not reader.doubts(f"{table}.scale"):
        reader.complain(path, Refusal("area_scale", table=table))
    return given.value * scale


def _points(values: Values, table: str, period: float, reader: Reader) -> tuple[tuple[float, float], ...]:
    """Return the corners of a diagram; complain where angles descend, or lie beyond the period."""
    if "torque" not in values or "at" not in values or None in (*values["at"], *values["torque"]):
        return ()
    at, torque = ([one.value for one in values[name]] for name in ("at", "torque"))
    if len(at) != len(torque):
        reader.complain(f"{table}.at", Refusal("load_at_count", count=len(at), others=len(torque), column="torque"))
        return ()
    for number, (before, after) in enumerate(itertools.pairwise(at), start=2):
        if after < before:
            reader.complain(f"{table}.at[{number}]", Refusal("points_descend"))
        if number > 2 and before == after == at[number - 3]:
            reader.complain(f"{table}.at[{number}]", Refusal("points_thrice"))
    if at[-1] > period * (1 + _CLOSED):
        beyond = next(number for number, one in enumerate(at, start=1) if one > period * (1 + _CLOSED))
        reader.complain(f"{table}.at[{beyond}]", Refusal("points_beyond", period=math.degrees(period)))
    if at[0] == at[-1]:
        reader.complain(f"{table}.at", Refusal("points_descend"))
    return tuple((min(one, period), other) for one, other in zip(at, torque, strict=True))


def _harmonics(values: Values, table: str, period: float, reader: Reader) -> tuple[Harmonic, ...]:
    """Return the orders of a torque; complain of one that does not close over the period."""
    found = []
    for number, one in enumerate(values["harmonics"], start=1):
        if not one or "order" not in one:
            continue
        times = one["order"] * period / math.tau
        if abs(times - round(times)) > _CLOSED * times or not round(times):
            path = f"{table}.harmonics[{number}].order"
            reader.complain(path, Refusal("order_open", order=one["order"], period=math.degrees(period)))
        found.append(Harmonic(one["order"], one.si("sin"), one.si("cos")))
    return tuple(found)


def _stroke(values: Values | None, path: str, period: float, scale: float, shaft: _Shaft) -> Stroke:
    """Return work in a stretch; complain of a stretch longer than the period."""
    if values is None or not {"work", "shear_energy", "shear_strength"} & set(values):
        return Stroke(0.0, 0.0, 0.0)
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
        reader.complain(
            f"{path}.{'shear_energy' if 'shear_energy' in values else 'shear_strength'}", Refusal("shear_of_what")
        )
    over = _over(values, period, shaft)
    if over > period * (1 + _CLOSED):
        told = Refusal("stretch_long", over=math.degrees(over), period=math.degrees(period))
        reader.complain(f"{path}.over" if "over" in values else f"{path}.punch_stroke", told)
    start = values.si("from")
    if start > period * (1 + _CLOSED):
        reader.complain(f"{path}.from", Refusal("points_beyond", period=math.degrees(period)))
    return Stroke(work, start, min(over, period), values["shape"], values.get("peak", 0.5))


def _sheared_area(values: Values, pi: float) -> float:
    thickness = values.si("thickness")
    if "hole_diameter" in values:
        return float(sheared_area_of_hole(pi, values.si("hole_diameter"), thickness))
    return float(values.si("cut_width") * thickness)


def _over(values: Values, period: float, shaft: _Shaft) -> float:
    """Return over which angle work is done, zero where it is done at once. [rad]"""
    if "punch_stroke" in values and "thickness" in values:
        return float(angle_in_plate(values.si("thickness"), period, values.si("punch_stroke")))
    over = values.get("over", 0.0)
    if isinstance(over, Measure):
        return _angle(over, shaft)
    return float(over * period)


def _delays(values: Values, table: str, period: float, reader: Reader) -> tuple[float, ...]:
    """Return by how much the torque of each cylinder comes later. [rad]"""
    if "cylinders" in values:
        count = int(values["cylinders"])
        return tuple(period * at / count for at in range(count))
    if "delays" not in values or None in values["delays"]:
        return (0.0,)
    found = tuple(one.value for one in values["delays"])
    for number, one in enumerate(found, start=1):
        if one > period * (1 + _CLOSED):
            reader.complain(f"{table}.delays[{number}]", Refusal("points_beyond", period=math.degrees(period)))
    return found


def _loops(values: Values, table: str, scale: float, reader: Reader) -> tuple[float, ...]:
    """Return the works of loops about the mean; complain if they leave something."""
    if "areas" not in values or None in values["areas"]:
        return ()
    works = tuple(
        _work(one, f"{table}.areas[{number}]", scale, reader) for number, one in enumerate(values["areas"], start=1)
    )
    left, size = sum(works), max(map(abs, works))
    if abs(left) > _BALANCED * size and not reader.doubts(table):
        reader.complain(f"{table}.areas", Refusal("areas_open", left=left, share=100 * abs(left) / size))
    return works


def _excess(values: Values, table: str, work: float, scale: float, reader: Reader) -> float | None:
    """Return the fluctuation of the energy, stated as it is or over the work of a period. [J]"""
    if "excess_work" in values:
        return _work(values["excess_work"], f"{table}.excess_work", scale, reader)
    if "energy_fluctuation" not in values:
        return None
    if not work and not reader.doubts(f"{table}.constant", f"{table}.power"):
        reader.complain(f"{table}.energy_fluctuation", Refusal("fluctuation_of_what"))
    return float(values["energy_fluctuation"] * abs(work))


def _check_balance(turning: Turning, reader: Reader) -> None:
    """Complain of a torque that does more work, or less, than its load takes."""
    if turning.torque is None or turning.load is None:
        return
    driven, taken = (one.work * turning.cycle / one.period for one in (turning.torque, turning.load))
    if abs(driven - taken) > _BALANCED * max(abs(driven), abs(taken)):
        mean = driven / turning.cycle
        reader.complain("load", Refusal("work_unbalanced", driven=driven, taken=taken, left=driven - taken, mean=mean))
