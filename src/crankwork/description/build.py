"""From the values of a machine file to the machine they describe and its drive, with the checks of several keys."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

from crankwork.description.measured_build import build_gas
from crankwork.description.schema import Values, stated_numbers
from crankwork.description.value_types import MeasuredValue, Reader
from crankwork.dynamics.efficiency import Chain, efficiency
from crankwork.dynamics.masses import (
    CrankGearMasses,
    pendulum_gyration,
    pendulum_length,
    rod_big_end_mass,
    rod_inertia_excess,
    rod_small_end_mass,
    suspension_distance,
)
from crankwork.errors import CrankworkError, MethodError
from crankwork.kinematics.slider_crank import SliderCrank, turns_fully
from crankwork.loads.gas import piston_area
from crankwork.locale import ErrorMessage
from crankwork.machine import Cylinder, Drive, Engine, Gas, Machine
from crankwork.mechanism.mechanism import Crank, Mechanism, slider_crank
from crankwork.method import EXACT, Method
from crankwork.shaft.flywheel import FlywheelSpec, RimSpec, inertia_of_rim, inertia_of_wheel, mass_of_rim
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor, MotorSelection
from crankwork.units import UNITS
from crankwork.working_cycle.engine_size import bore_and_stroke

_LEAST_EFFICIENCY = 1e-4
WANTED = ("fluctuation", "percent", "speeds")
_SECTION = ("width", "thickness", "density")
_SAME = 5e-3


if TYPE_CHECKING:
    from crankwork.shaft.torsion_model import TorsionModel

_LEAST_RISE = 1e-3
_RADIANS = [name for name, unit in UNITS.items() if unit.dimension == "speed" and unit.factor == 1.0]
_OWN_GAS = {"misfire", "pressure_factors"}
# keys of [cylinder] that bore or stroke follow from
SIZES = frozenset({"displacement", "stroke_bore_ratio"})
_ENGINE_TABLES = {"engine", "bearings", "balance", "flywheel"}


def build_machine(values: Values, reader: Reader) -> Machine | None:
    """Return the machine, or None after complaints."""
    method, stated = build_method(values["method"], reader), stated_numbers(values)
    calculated, values = None, _with_sizes(values, method.pi, reader)
    if "cycle" in values:
        from crankwork.description.cycle_build import build_cycle  # noqa: PLC0415 - few files calculate a cycle

        calculated = build_cycle(values, reader, method.pi)
        values = calculated.values if calculated else values
    crank, rod = values["crank"], values["rod"]
    lengths = _lengths(crank, rod, values["cylinder"], reader)
    sizes, cylinder = values["cylinder"], None
    if "bore" in sizes:
        cylinder = _cylinder(sizes, lengths, reader)
    _check_clearance(cylinder, lengths, reader)
    check_inertia_ratio(method, lengths, reader)
    masses = _masses(values, lengths, cylinder, method, reader)
    gas = calculated.gas if calculated else build_gas(values.get("gas"), cylinder, reader)
    table, flywheel = values["table"], values["flywheel"]
    special = table.degrees("special_angles")
    is_whole = not _ENGINE_TABLES.isdisjoint(values)
    cycle = gas.cycle if gas else 180.0 * values["engine"]["strokes"] if is_whole else 360.0
    for number, angle in enumerate(special, start=1):
        # how long the cycle of a refused gas is nobody knows
        if angle > cycle + 1e-9 and (gas or not {"gas", "cycle"} & set(values)) and not reader.has_errors("gas.cycle"):
            reader.add_error(f"table.special_angles[{number}]", ErrorMessage("angle_beyond", angle=angle, cycle=cycle))
    engine = None
    if is_whole:
        from crankwork.description.crankshaft_build import build_engine  # noqa: PLC0415 - most files have one cylinder

        engine = build_engine(values, lengths, cycle, reader)
    own = not _OWN_GAS.isdisjoint(values["engine"]) or "cylinders" in values["gas"]
    if own or values["gas"]["measured"]["columns"]:
        engine, gas = _with_own_gas(values, engine, gas, reader)
    speed = crank_speed(crank["speed"], method) if crank["speed"] else 0.0
    torsion = build_torsion(values, engine, lengths, reader)
    if "recovery" in flywheel and masses and (masses.piston or masses.rod_small_end) and method.name != "textbook":
        reader.add_error("flywheel.recovery", ErrorMessage("recovery_of_linkage"))
    drive = read_flywheel(flywheel, Drive(), speed, reader, pi=method.pi)
    if reader.problems or lengths is None:
        return None
    if engine is not None and engine.offsets:
        lengths = (*lengths[:2], engine.offsets[0])
    return Machine(
        mechanism=slider_crank(*lengths),
        speed=speed,
        angular_acceleration=crank.si("angular_acceleration"),
        title=values["title"] or "",
        cylinder=cylinder,
        masses=masses,
        gas=gas,
        has_gravity=values["method"]["weights"],
        method=method,
        table_step=table.degrees("step"),
        table_special=tuple(special),
        engine=engine,
        drive=drive,
        stated=stated,
        rod_equivalent=rod["equivalent"] or "",
        test=test_values(values) if "test" in values else None,
        torsion=torsion,
    )


def _cylinder(sizes: Values, lengths: tuple[float, float, float] | None, reader: Reader) -> Cylinder:
    """Return the cylinder, after complaints about ways beyond its stroke."""
    travels = {name: travel.value for name, travel in sizes["travels"].items() if travel is not None}
    for name, travel in travels.items():
        if lengths is not None and abs(travel) > 2 * lengths[0]:
            reader.add_error(f"cylinder.travels.{name}", ErrorMessage("travel_beyond", stroke=2e3 * lengths[0]))
    return sizes.made(
        Cylinder, clearance_volume=sizes.si("clearance_volume") or None,
        piston_rod_diameter=sizes.si("piston_rod_diameter") or 0.0, travels=travels,
    )  # fmt: skip


def test_values(values: Values) -> dict[str, tuple[float, ...]]:
    """Return what a test bed measured by key, defaults included. [SI]"""
    table, stated = values["test"], {}
    for key in table.table.keys:
        numbers = table[key] if isinstance(table[key], list) else [table[key]]
        if None not in numbers:
            stated[key] = tuple(item.value if isinstance(item, MeasuredValue) else float(item) for item in numbers)
    return stated


def build_test(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of a test alone, or None after complaints."""
    from crankwork.preparation.test_bed import worked_alone  # noqa: PLC0415 - few files have a test alone

    method, crank = build_method(values["method"], reader), values["crank"]
    if reader.problems:
        return None
    speed = crank_speed(crank["speed"], method) if crank["speed"] else math.pi / 30
    cylinder = values["cylinder"].made(
        Cylinder, piston_rod_diameter=values["cylinder"].si("piston_rod_diameter") or 0.0
    )
    radius = crank.si("radius") or (crank.si("stroke") or 0.0) / 2
    test = test_values(values)
    if (volume := values["cylinder"].si("displacement")) is not None:
        test["displacement"] = (volume,)
    machine = Machine(
        Mechanism(Crank(radius=radius), ()), speed, title=values["title"] or "", cylinder=cylinder, method=method,
        stated=stated_numbers(values), test=test,
    )  # fmt: skip
    return _workable(machine, worked_alone, "test", reader)


def build_clutch(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of a clutch alone, or None after complaints."""
    from crankwork.preparation.clutch import worked_clutch  # noqa: PLC0415 - few files have a clutch

    method, table = exact_method(values, reader), values["clutch"]
    if reader.problems or table is None:
        return None
    if "outer_diameter" in table and table.si("inner_diameter") >= table.si("outer_diameter"):
        reader.add_error("clutch.inner_diameter", ErrorMessage("clutch_inner"))
        return None
    machine = machine_alone(values, method, 1.0, clutch=table["contact"] or "uniform wear")
    return _workable(machine, worked_clutch, "clutch", reader)


def _workable(machine: Machine, work: Callable[[Machine], object], table: str, reader: Reader) -> Machine | None:
    """Return a machine from whose table something follows, or None after the complaint."""
    try:
        work(machine)
    except CrankworkError as error:
        reader.add_error(getattr(error, "key", table), error.args[0])
        return None
    return machine


def build_torsion(
    values: Values, engine: Engine | None, lengths: tuple[float, float, float] | None, reader: Reader
) -> TorsionModel | None:
    """Return the torsional system of the crankshaft, if one is stated."""
    if "torsion" not in values:
        return None
    from crankwork.description.torque_build import torsion_of_throws  # noqa: PLC0415 - few files have one

    throws = 1 if engine is None else max(place.throw for place in engine.layout.places) + 1
    return torsion_of_throws(values["torsion"], reader, throws, lengths[0] if lengths else 0.0)


def _with_sizes(values: Values, pi: float, reader: Reader) -> Values:
    """Return the values with bore and crank radius that follow from a displacement or from stroke over bore."""
    crank, cylinder = values["crank"], values["cylinder"]
    if reader.has_errors(*(f"cylinder.{key}" for key in SIZES)):
        # one of them is misspelt
        reader.suspect("cylinder.bore")
        return values
    if SIZES.isdisjoint(cylinder):
        return values
    volume, ratio, bore = (cylinder.si(key) for key in ("displacement", "stroke_bore_ratio", "bore"))
    stroke = 2 * crank.si("radius") if "radius" in crank else crank.si("stroke")
    stated = [f"cylinder.{key}" for key in cylinder if key in SIZES]
    key = stated[0]
    if reader.has_errors("cylinder.bore", "crank.radius", "crank.stroke"):
        reader.suspect("cylinder.bore")
        return values
    count = sum(size is not None for size in (volume, ratio, bore, stroke))
    if count != 2 or "power" in values["cycle"]:
        reader.add_error(key, ErrorMessage("sizes_two"))
    elif cylinder.si("offset") or values["engine"]["offsets"]:
        reader.add_error(key, ErrorMessage("sizes_offset"))
    if reader.has_errors(key):
        reader.suspect("cylinder.bore")
        return values
    volume = None if volume is None else volume / (values["engine"]["cylinders"] or 1)
    bore, stroke = bore_and_stroke(pi, volume, ratio, bore, stroke)
    radius = MeasuredValue(float(stroke) / 2, "length")
    return values.but(crank=crank.but(radius=radius), cylinder=cylinder.but(bore=MeasuredValue(float(bore), "length")))


def _with_own_gas(
    values: Values, engine: Engine | None, gas: Gas | None, reader: Reader
) -> tuple[Engine | None, Gas | None]:
    """Return an engine whose cylinders have different gas, and the gas of the first."""
    from crankwork.description.cycle_build import with_own_gas  # noqa: PLC0415 - few engines have such cylinders

    if engine is None:
        keys = (
            ("gas.cylinders", "cylinders" in values["gas"]),
            ("gas.measured.columns", values["gas"]["measured"]["columns"]),
        )
        for key, is_stated in keys if "engine" not in values else ():
            if is_stated:
                reader.add_error(key, ErrorMessage("cylinders_engine"))
        return None, gas
    engine = with_own_gas(values, engine, gas, reader)
    return engine, engine.gases[0] if engine.gases else gas


def crank_speed(given: MeasuredValue, method: Method) -> float:
    """Return the speed of a crank; a speed in radians per second is independent of the pi of the method. [rad/s]"""
    # the calculation multiplies by the pi of the method over pi
    return given.value * math.pi / method.pi if given.unit in _RADIANS else given.value


def build_method(values: Values, reader: Reader) -> Method:
    """Return the method of a machine file; exact after a complaint."""
    method = Method(pi=values["pi"], gravity=values.si("gravity"), inertia_rod_ratio=values["inertia_rod_ratio"])
    try:
        method = method.named(values["kinematics"])
    except MethodError as error:
        reader.add_error("method.kinematics", error.args[0])
        return EXACT
    rod = values["rod"] or method.rod
    return method if rod == method.rod else Method(**{**vars(method), "rod": rod})


def exact_method(values: Values, reader: Reader) -> Method:
    """Return the method of a file without a mechanism; report one that is not exact."""
    method = build_method(values["method"], reader)
    if not method.is_exact:
        reader.add_error("method.kinematics", ErrorMessage("turning_exact"))
    return method


def machine_alone(
    values: Values,
    method: Method,
    speed: float,
    **parts: Any,  # noqa: ANN401 - of kinds of their own
) -> Machine:
    """Return a machine of parts without a mechanism. [rad/s]"""
    if "table" in values.table.keys:
        table = values["table"]
        parts |= {"table_step": table.degrees("step"), "table_special": tuple(table.degrees("special_angles"))}
    mechanism = Mechanism(Crank(radius=0.0), ())
    title, stated = values["title"] or "", stated_numbers(values)
    return Machine(mechanism, speed=speed, title=title, method=method, stated=stated, **parts)


def _lengths(crank: Values, rod: Values, cylinder: Values, reader: Reader) -> tuple[float, float, float] | None:
    """Return crank radius, rod length and offset."""
    ratio = rod["ratio"]
    inverse = rod["ratio_definition"] == "l/r"
    if ratio is not None and not inverse and ratio >= 1:
        meant = f"{1 / ratio:.6g}"
        # close to 1 the inverse would be rejected too
        key = "ratio_inverse" if float(meant) < 1 else "ratio_of_one"
        reader.add_error("rod.ratio", ErrorMessage(key, ratio=f"{ratio:g}", inverse=meant))
        return None
    if "radius" in crank:
        radius = crank["radius"].value
    elif "stroke" in crank:
        radius = crank["stroke"].value / 2
    else:
        return None
    if ratio is not None:
        length = radius * ratio if inverse else radius / ratio
    elif "length" in rod:
        length = rod["length"].value
    else:
        return None
    offset = cylinder.si("offset")
    if not turns_fully(SliderCrank(radius, length, offset)):
        key = "rod.ratio" if ratio is not None else "rod.length"
        lengths = {"length": length, "radius": radius, "offset": abs(offset), "missing": radius + abs(offset) - length}
        reader.add_error(key, ErrorMessage("rod_short", **{name: size * 1e3 for name, size in lengths.items()}))
        return None
    return radius, length, offset


def check_inertia_ratio(method: Method, lengths: tuple[float, float, float] | None, reader: Reader) -> None:
    """Report a ratio for the inertia force with which a rod would not turn."""
    ratio = method.inertia_rod_ratio
    if ratio is None or method.is_exact or lengths is None:
        return
    radius, _, offset = lengths
    if not turns_fully(SliderCrank(radius, radius / ratio, offset)):
        reader.add_error("method.inertia_rod_ratio", ErrorMessage("inertia_ratio_large", ratio=f"{ratio:g}"))


def _check_clearance(cylinder: Cylinder | None, lengths: tuple[float, float, float] | None, reader: Reader) -> None:
    """Report a clearance volume that is large compared with the swept volume."""
    if cylinder is None or cylinder.clearance_volume is None or lengths is None:
        return
    swept = 2 * lengths[0] * float(piston_area(math.pi, cylinder.bore))
    if swept < _LEAST_RISE * cylinder.clearance_volume:
        reader.add_error(
            "cylinder.clearance_volume",
            ErrorMessage("clearance_large", times=cylinder.clearance_volume / swept, swept=swept * 1e6),
        )


def _masses(
    values: Values,
    lengths: tuple[float, float, float] | None,
    cylinder: Cylinder | None,
    method: Method,
    reader: Reader,
) -> CrankGearMasses | None:
    area = float(piston_area(method.pi, cylinder.bore)) if cylinder else None
    rod_keys = ("mass", "small_end_mass", "big_end_mass")
    keys = [("piston", "mass"), ("crank", "mass"), *(("rod", key) for key in rod_keys)]
    given = {(table, key): values[table][key] for table, key in keys if key in values[table]}
    if not given:
        return None
    mass = {place: _mass(measure, area, ".".join(place), reader) for place, measure in given.items()}
    piston, crank = mass.get(("piston", "mass"), 0.0), mass.get(("crank", "mass"), 0.0)
    rod = values["rod"]
    if ("rod", "mass") not in mass:
        for key in ("inertia", "radius_of_gyration", "centre_of_mass", "small_end_share"):
            if key in rod and not reader.has_errors("rod.mass"):
                reader.add_error(f"rod.{key}", ErrorMessage("only_beside", key="mass", advice='mass = "1 kg"'))
        small, big = (mass.get(("rod", key), 0.0) for key in rod_keys[1:])
        return CrankGearMasses(piston, small, big, crank)
    if "pendulum" in rod and lengths and len(rod["pendulum"]) == len(rod["pendulum"].table.keys):
        rod = _swung(rod, lengths[1], method, reader)
    if "equivalent" in rod and not {"inertia", "radius_of_gyration", "pendulum"} & set(rod):
        reader.add_error("rod.equivalent", ErrorMessage("equivalent_inertia"))
    ends = rod_masses(rod, mass["rod", "mass"], lengths[1], reader, "rod") if lengths else None
    return replace(ends, piston=piston, crank=crank) if ends else None


def _swung(rod: Values, length: float, method: Method, reader: Reader) -> Values:
    """Return a rod with the centre of mass and the radius of gyration that follow from its swinging."""
    swings = rod["pendulum"]
    first, second = (
        pendulum_length(method.pi, method.gravity, swings.si(f"{end}_period")) for end in ("small_end", "big_end")
    )
    span = length + (swings.si("small_end_diameter") + swings.si("big_end_diameter")) / 2
    distance = float(suspension_distance(first, second, span)) if first + second != 2 * span else math.nan
    centre = span - distance - swings.si("big_end_diameter") / 2
    if not (0 <= centre < length and 0 < distance < first):
        reader.add_error("rod.pendulum", ErrorMessage("pendulum_open"))
        return rod
    sizes = {"centre_of_mass": centre, "radius_of_gyration": float(pendulum_gyration(distance, first))}
    return rod.but(**{key: MeasuredValue(value, "length") for key, value in sizes.items()})


def rod_masses(rod: Values, mass: float, length: float, reader: Reader, table: str) -> CrankGearMasses | None:
    """Return the masses of a rod at its ends and its excess of inertia, or None after complaints.

    `table`: the key of the table that describes it.
    """
    centre = _centre_of_mass(rod, length, reader, table)
    if centre is None:
        return None
    small = float(rod_small_end_mass(mass, centre, length))
    excess = _inertia_excess(rod, mass, centre, length)
    return CrankGearMasses(
        rod_small_end=small, rod_big_end=float(rod_big_end_mass(mass, small)), rod_inertia_excess=excess
    )


def _mass(measure: MeasuredValue, area: float | None, key: str, reader: Reader) -> float:
    """Return a mass, multiplied by the piston area if it is given per area. [kg]"""
    if measure.dimension == "mass":
        return measure.value
    if area is None:
        if not reader.has_errors("cylinder.bore"):
            reader.add_error(key, ErrorMessage("mass_per_area"))
        return 0.0
    return measure.value * area


def _centre_of_mass(rod: Values, length: float, reader: Reader, table: str) -> float | None:
    """Return the distance of the rod's centre of mass from the crankpin."""
    if "small_end_share" in rod:
        return float(rod["small_end_share"] * length)
    if "centre_of_mass" not in rod:
        if not reader.has_errors(f"{table}.centre_of_mass", f"{table}.small_end_share"):
            reader.add_error(f"{table}.mass", ErrorMessage("rod_mass_where"))
        return None
    centre = float(rod["centre_of_mass"].value)
    if centre >= length:
        reader.add_error(f"{table}.centre_of_mass", ErrorMessage("rod_centre_beyond", length=length * 1e3))
        return None
    return centre


def _inertia_excess(rod: Values, mass: float, centre: float, length: float) -> float:
    if "inertia" in rod:
        inertia = rod["inertia"].value
    elif "radius_of_gyration" in rod:
        inertia = mass * rod["radius_of_gyration"].value ** 2
    else:
        return 0.0
    return float(rod_inertia_excess(inertia, mass, centre, length))


def _is_whole(part: object) -> bool:
    """Return whether an efficiency, or a list of them in parallel, could be read."""
    return bool(part) and None not in part if isinstance(part, list) else part is not None


def read_drive(values: Values, reader: Reader) -> Drive:
    """Return efficiency and motor of a description."""
    drive = Drive()
    chain = values["efficiency"]["chain"]
    # unreadable values are already reported
    if chain and all(_is_whole(part) for part in chain):
        table = values["efficiency"]
        parts: Chain = tuple(tuple(part) if isinstance(part, list) else part for part in chain)
        total = efficiency(parts)
        if total < _LEAST_EFFICIENCY:
            reader.add_error("efficiency.chain", ErrorMessage("efficiency_small", whole=total))
            return drive
        losses: Literal["", "drive", "machine"] = table.get("losses", "")
        drive = replace(drive, efficiency=total, chain=parts, losses=losses)
        if not losses and any(joints in values.get("friction", {}) for joints in ("pins", "sliders")):
            reader.add_error("efficiency", ErrorMessage("losses_twice"))
        if "decimals" in table:
            used = round(total, int(table["decimals"]))
            drive = replace(drive, efficiency=used, exact_efficiency=total)
            if used <= 0:
                reader.add_error("efficiency.decimals", ErrorMessage("efficiency_rounded", whole=total))
    if "motor_selection" in values:
        table = values["motor_selection"]
        selection = table.made(MotorSelection, frequency=table.si("frequency") / (2 * math.pi))
        drive = replace(drive, selection=selection)
    motor = values.get("motor")
    if motor and {"rated_power", "rated_speed", "overload", "pole_pairs"} <= set(motor):
        frequency = motor.si("frequency") / (2 * math.pi)
        try:
            own = AsynchronousMotor.of_catalogue(
                motor["rated_power"].value, motor["rated_speed"].value, motor["overload"],
                frequency=frequency, pole_pairs=int(motor["pole_pairs"]),
            )  # fmt: skip
        except MethodError as error:
            reader.add_error("motor.rated_speed", error.args[0])
        else:
            geared = GearedMotor(own, motor["ratio"], motor.si("inertia"), drive.efficiency)
            drive = replace(drive, motor=geared, rated_power=motor["rated_power"].value)
    return drive


def read_flywheel(values: Values, drive: Drive, speed: float | None, reader: Reader, *, pi: float = math.pi) -> Drive:
    """Return a drive with the flywheel of a table. `speed`: of the crank, where the description states it. [rad/s]"""
    rim = values["rim"]
    if "rim" in values and {"diameter", "speed", "stress"}.isdisjoint(rim) and not {*_SECTION} <= set(rim):
        # a section of a density has the diameter that its inertia needs
        advice = ('diameter = "1 m"', 'speed = "30 m/s"', 'stress = "5 MPa"')
        reader.add_error("flywheel.rim.diameter", ErrorMessage("missing", advice=advice))
        return drive
    wheel = FlywheelSpec(
        mass=values.si("mass"),
        gyration_radius=values.si("radius_of_gyration"),
        rim=rim.made(RimSpec) if "rim" in values else None,
        recovery_time=values.si("recovery"),
    )
    if wheel == FlywheelSpec() and not {"inertia", *WANTED} & set(values):
        return drive
    if wheel.mass is not None and wheel.gyration_radius is None and not (wheel.rim and wheel.rim.diameter is not None):
        if not reader.has_errors("flywheel.radius_of_gyration", "flywheel.rim"):
            reader.add_error("flywheel.mass", ErrorMessage("wheel_mass_where"))
        return drive
    return replace(
        drive,
        inertia=drive.inertia + _inertia(values, wheel, pi),
        fluctuation=_fluctuation(values, speed, reader),
        wheel=wheel,
    )


def is_given(values: Values) -> bool:
    """Return whether a table states a flywheel, not only its required fluctuation."""
    rim = values["rim"]
    return bool(values.si("inertia")) or "mass" in values or {"diameter", *_SECTION} <= set(rim)


def _inertia(values: Values, wheel: FlywheelSpec, pi: float) -> float:
    """Return the given moment of inertia, zero if it is to be determined. [kg m2]"""
    rim = wheel.rim
    if wheel.mass is not None and wheel.gyration_radius is not None:
        return float(inertia_of_wheel(wheel.mass, wheel.gyration_radius))
    if rim is not None and wheel.mass is not None and rim.diameter is not None:
        return float(inertia_of_rim(wheel.mass, rim.diameter)) / rim.share
    if rim is not None and not values.si("inertia") and is_given(values):
        mass = float(mass_of_rim(rim.density, pi, rim.diameter, rim.width, rim.thickness))
        return float(inertia_of_rim(mass, rim.diameter)) / rim.share
    inertia: float = values.si("inertia") or 0.0
    return inertia


def _fluctuation(values: Values, speed: float | None, reader: Reader) -> float | None:
    """Return the required fluctuation, in any form it is stated."""
    if "percent" in values:
        return float(2 * values["percent"] / 100)
    if "speeds" not in values:
        fluctuation: float | None = values["fluctuation"]
        return fluctuation
    high, low = (limit.value if limit else math.nan for limit in values["speeds"])
    mean = (high + low) / 2
    if not high > low and not reader.has_errors("flywheel.speeds", "flywheel.speeds[1]", "flywheel.speeds[2]"):
        reader.add_error("flywheel.speeds", ErrorMessage("wheel_speeds_order"))
    elif speed is not None and abs(mean - speed) > _SAME * speed:
        reader.add_error("flywheel.speeds", ErrorMessage("wheel_speeds_mean", mean=mean * 30 / math.pi))
    return (high - low) / mean
