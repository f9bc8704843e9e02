"""From the values of a machine file to a linkage, its driver and chambers, or to a tabulated motion."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

from crankwork.description.build import build_method, check_inertia_ratio, crank_speed, read_drive, read_flywheel
from crankwork.description.crankshaft_build import (
    build_bearings,
    build_friction,
    build_shaft,
    check_friction,
    with_crankshaft,
)
from crankwork.description.keys import DIAGRAM
from crankwork.description.measured_build import (
    add_questions,
    build_diagram,
    build_valves,
    check_parts,
    in_file,
    pressures_of,
    with_valves,
)
from crankwork.description.range_checks import (
    branches_from_positions,
    checked_motion,
    explain_redundant,
    fitting,
    geometry_of,
    position_notices,
    with_starts,
    without_redundant,
    without_unshared,
)
from crankwork.description.schema import Values, no_effect_message, stated_numbers
from crankwork.description.stages_build import stage_valves
from crankwork.description.value_types import MeasuredValue, Reader
from crankwork.dynamics.reduction import TabulatedBody
from crankwork.errors import GeometryError
from crankwork.kinematics.crank_range import pass_change_points
from crankwork.loads.chamber import Chamber, Charge, DeadVolume, Face, PressureOfCycle, Vessel
from crankwork.loads.curves import LoadCurve as LoadTable
from crankwork.loads.indicator import DiagramError
from crankwork.loads.load import (
    Damper,
    ForceOnPoint,
    Load,
    ProcessForce,
    SliderDamper,
    SliderSpring,
    Spring,
    TorqueOnLink,
    Weight,
)
from crankwork.loads.valves import Pipe, Valves
from crankwork.locale import ErrorMessage
from crankwork.machine import Drive, Machine, TransferTable, Transient
from crankwork.mechanism.driver import DrivingSlider, Law, LawKind, LinkMotor, Segment
from crankwork.mechanism.joints import links_of_points
from crankwork.mechanism.linkage import GROUND, LengthInertia, Linkage, MassPerLength
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.mechanism.table_reader import linkage_from
from crankwork.method import Method
from crankwork.preparation.linkage import traced_linkage
from crankwork.preparation.reachable_motion import find_reachable_motion

_GEOMETRY = ("fixed_points", "crank", "geared", "links", "guides", "sliders", "branch", "positions")
_STEP = 1.0
_MOST_ROWS = 100_000
_REVOLUTION = math.tau + 1e-9
_OF_SPRING = ("stiffness", "free_length", "preload")
_ENDED = ("spring", "damper")
_RATES = ("speed", "angular_acceleration", "from", "to")
# tables for a crank with a constant mean speed
_TURNING = ("efficiency", "motor", "motor_selection", "flywheel", "transient")
_WITHOUT_DRIVER = ("speed", "angular_acceleration")
_SUM = 1e-9
# how long a motion is followed of which one instant is asked about [s]
_INSTANT = 1e-3
_OWN_PRESSURE = ("pressure", *DIAGRAM, "valves", "cycle")
_AMOUNTS = ("mean_pressure", "pressure", "mass")


def build_linkage(values: Values, reader: Reader) -> Machine | None:
    """Return the linkage machine, or None after complaints."""
    if reader.problems:
        return None
    tables = _geometry(values, reader)
    if reader.problems:
        return None
    linkage, problems = linkage_from(tables)
    mechanism, notices = None, tuple[tuple[str, dict[str, float | str]], ...]()
    if linkage is not None:
        linkage, carried = without_unshared(*without_redundant(linkage, values, reader))
        branched = branches_from_positions(linkage)
        mechanism, problems = branched.mechanism, explain_redundant(linkage, branched.problems)
        notices = tuple(position_notices(tables, linkage, branched, reader, is_new=values["format"] > 1))
    for problem in problems:
        reader.add_error(problem.key or "links", problem.message)
    method = build_method(values["method"], reader)
    loads = _loads(values, linkage, reader)
    stages, staged = stage_valves(values, method, reader)
    chambers, charges = build_chambers(values, linkage, mechanism, reader, method.pi, staged)
    if "driver" in values:
        _check_by_angle(values, reader)
    drive = _drive(values, method, reader)
    transient = _transient(values, reader)
    if reader.problems or mechanism is None or linkage is None:
        return None
    crank_range = None
    # what cannot be assembled is reported later
    with suppress(GeometryError):
        mechanism, crank_range = pass_change_points(mechanism)
    redundant = fitting(linkage, carried, values, reader)
    if reader.problems:
        return None
    friction = build_friction(values, linkage, mechanism, reader)
    bearings = build_bearings(values, mechanism, reader, turns=crank_range is None or crank_range.is_whole)
    notices += tuple(_on_pins(loads, linkage, mechanism))
    loads = with_starts(loads, values, mechanism, crank_range)
    if values["method"]["weights"]:
        loads = (*loads, Weight(method.gravity))
    crank, table = values["crank"], values["table"]
    machine = Machine(
        mechanism=mechanism,
        linkage=linkage,
        speed=crank_speed(crank["speed"], method) if crank["speed"] else 0.0,
        angular_acceleration=crank.si("angular_acceleration") or 0.0,
        title=values["title"] or "",
        loads=loads,
        redundant=redundant,
        friction=friction,
        bearings=bearings,
        extents=_extents(values, linkage, reader),
        way=crank_range,
        notices=notices,
        chambers=chambers,
        charges=charges,
        stages=stages,
        crossheads=_crossheads(values, reader),
        vessels=_vessels(values, chambers, reader),
        shaft=build_shaft(values, reader),
        drive=drive if _weighs(values) else replace(drive, inertia=drive.inertia + (crank.si("inertia") or 0.0)),
        transient=transient,
        method=method,
        table_step=_table_step(table.si("step"), mechanism.driver.law),
        table_special=tuple(table.degrees("special_angles") or ()),
        stated=stated_numbers(values),
    )
    check_friction(machine, reader)
    _check_method(machine, reader)
    moving = checked_motion(machine, values, reader)
    return with_crankshaft(moving, values, reader) if moving is not None and _fits(moving, values, reader) else None


def _extents(values: Values, linkage: Linkage, reader: Reader) -> tuple[str, ...]:
    """Return the points whose paths are measured; report names of none."""
    names = tuple(name for name in values["extents"] if name)
    for number, name in enumerate(names, start=1):
        if name not in linkage.owners:
            known = ", ".join(sorted(linkage.owners))
            reader.add_error(f"extents[{number}]", ErrorMessage("absent_point", name=name, known=known))
    return names


def _check_method(machine: Machine, reader: Reader) -> None:
    """Report an approximate method of a linkage that is no engine."""
    method = machine.method
    if method.is_exact:
        return
    # most linkages are computed exactly
    from crankwork.preparation.cylinder_form import engine_form_or_reason  # noqa: PLC0415

    form = engine_form_or_reason(machine, has_all=True)
    if not isinstance(form, Machine):
        message = ErrorMessage("method_of_engines", method=method.name, reason=form.message)
        reader.add_error("method.kinematics", message)
    else:
        check_inertia_ratio(method, form.lengths, reader)


def _crossheads(values: Values, reader: Reader) -> dict[str, float]:
    """Return the masses of crossheads by piece [kg]; report those heavier than their piece, or without gas on it."""
    tables = {name: table for name, table in values["sliders"].items() if table and "crosshead_mass" in table}
    chambers = [table for table in values["chambers"].values() if table]
    pressed = {face["slider"] for table in chambers for face in (*table["faces"], table) if face}
    for name, table in tables.items():
        key = f"sliders.{name}.crosshead_mass"
        if table.si("crosshead_mass") > (table.si("mass") or 0.0):
            reader.add_error(key, ErrorMessage("crosshead_heavy"))
        if name not in pressed:
            reader.add_error(key, ErrorMessage("crosshead_gas", name=name))
    return {name: table.si("crosshead_mass") for name, table in tables.items()}


def _vessels(values: Values, chambers: Mapping[str, Chamber], reader: Reader) -> dict[str, Vessel]:
    """Return the vessels by name; report unknown chambers, and those that pump no liquid."""
    vessels, taken = dict[str, Vessel](), dict[tuple[str, str], str]()
    for name, table in (values["vessels"] or {}).items():
        for number, chamber in enumerate(table["chambers"], start=1):
            place = f"vessels.{name}.chambers[{number}]"
            known = chambers.get(chamber)
            if known is None:
                message = ErrorMessage("absent_chamber", name=chamber, known=", ".join(chambers) or "–")
                reader.add_error(place, message)
            elif known.valves is None or known.valves.density is None:
                reader.add_error(place, ErrorMessage("vessel_gas", name=chamber))
            elif (other := taken.setdefault((chamber, table["side"]), place)) != place:
                reader.add_error(place, ErrorMessage("vessel_twice", name=chamber, other=other))
        pipe = table.made(Pipe) if "length" in table else None
        vessels[name] = Vessel(tuple(table["chambers"]), table["side"], pipe)
    return vessels


def _drive(values: Values, method: Method, reader: Reader) -> Drive:
    """Return efficiency, motor and flywheel."""
    flywheel, crank = values["flywheel"], values["crank"]
    speed = crank_speed(crank["speed"], method) if "speed" in crank else None
    if "recovery" in flywheel:
        reader.add_error("flywheel.recovery", ErrorMessage("recovery_of_linkage"))
    return read_flywheel(flywheel, read_drive(values, reader), speed, reader, pi=method.pi)


def _weighs(values: Values) -> bool:
    """Return whether the crank is a body with mass among the others."""
    crank = values["crank"]
    is_of_length = isinstance(crank.get("inertia"), LengthInertia)
    return "driver" in values or is_of_length or not {"mass", "centre"}.isdisjoint(crank)


def _geometry(values: Values, reader: Reader) -> dict[str, Any]:
    """Return the tables that describe the linkage, and its driver with its law."""
    tables = {name: _plain(values[name]) for name in _GEOMETRY if name in values}
    if "links" in tables:
        tables["links"] = {name: geometry_of(link) for name, link in tables["links"].items()}
    if "crank" in tables:
        # an inertia without a mass belongs to the drive, not to the crank
        elsewhere = _RATES if _weighs(values) else (*_RATES, "inertia")
        tables["crank"] = {name: value for name, value in tables["crank"].items() if name not in elsewhere}
    if "driver" in values:
        _check_driver(values, reader)
        _check_halves(values["driver"], reader)
        named = {
            name: _plain(value) for name, value in values["driver"].items() if name not in ("start", "period", "law")
        }
        tables["driver"] = {**named, "law": build_law(values, reader)}
    return tables


def _table_step(given: float | None, law: Law | None) -> float:
    """Return the step of the tables [deg], stated as an angle, or as a time of a driver with a law."""
    if law is None:
        return round(math.degrees(given or 0.0), 9)
    return 10.0 if given is None else min(360.0 * given / law.period, 360.0)


def _fits(machine: Machine, values: Values, reader: Reader) -> bool:
    """Return whether the gas suits the volumes of its chambers; report if not."""
    if not machine.chambers:
        return True
    reached = find_reachable_motion(machine, _STEP)
    if reached.travel is not None:
        reader.add_error("chambers", ErrorMessage("chambers_partial"))
        return False
    try:
        add_questions(traced_linkage(machine, reached.motion)[1].filling.notices, values, reader)
    except DiagramError as error:
        mistake = in_file(error.key, error.args[0], values)
        if machine.mechanism.driver.law is not None:
            mistake = ErrorMessage("in_period", mistake=mistake)
        reader.add_error(error.key, mistake)
        return False
    return True


def build_tabulated(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of a table of transfer functions, or None after complaints."""
    method = build_method(values["method"], reader)
    if not method.is_exact:
        reader.add_error("method.kinematics", ErrorMessage("table_exact"))
    drive = read_drive(values, reader)
    if reader.problems:
        return None
    if "transfer" in values:
        reduced = values["transfer"]
        positions, stated_bodies, places = reduced, reduced["bodies"], ("transfer", "transfer.bodies", "transfer")
    else:
        reduced, positions, stated_bodies = (values[name] for name in ("crank", "table", "links"))
        places = ("table", "links", "crank")
    of_table, of_bodies, of_crank = places
    angles = _plain(positions["angles"])
    count = len(angles)
    if any(after <= before for before, after in itertools.pairwise(angles)) or angles[-1] - angles[0] > _REVOLUTION:
        reader.add_error(f"{of_table}.angles", ErrorMessage("table_rises"))
    if not stated_bodies:
        reader.add_error(of_bodies, ErrorMessage("bodies_empty"))
    bodies = [_body(name, body, f"{of_bodies}.{name}", count, reader) for name, body in stated_bodies.items()]
    optional: dict[str, tuple[float, ...] | None] = {}
    for key in ("reduced_inertia_1", "static_torque", "balancing_torque"):
        column = tuple(_plain(reduced[key])) if key in reduced else None
        if column is not None:
            _check_count(f"{of_crank}.{key}", column, count, reader)
        optional[key] = column
    if reader.problems:
        return None
    table = TransferTable(
        tuple(angles), tuple(bodies), differences=reduced["differences"] or "central", **optional, of_bodies=of_bodies,
        of_crank=of_crank,
    )  # fmt: skip
    return Machine(
        Mechanism(Crank(radius=0.0), ()),
        speed=crank_speed(values["crank"]["speed"], method),
        title=values["title"] or "",
        transfer=table,
        drive=drive,
        method=method,
        stated=stated_numbers(values),
    )


def _body(name: str, body: Values, path: str, count: int, reader: Reader) -> TabulatedBody:
    """Return a body of a table of transfer functions; report columns of a wrong length."""
    columns = {key: tuple(_plain(body[key])) for key in ("velocity", "rotation") if key in body}
    for key, column in columns.items():
        _check_count(f"{path}.{key}", column, count, reader)
    if not columns:
        reader.add_error(path, ErrorMessage("body_still"))
    still = (0.0,) * count
    return TabulatedBody(
        name, body.si("mass"), body.si("inertia"),
        columns.get("velocity", still), columns.get("rotation", still),
    )  # fmt: skip


def _check_count(key: str, column: tuple[float, ...], count: int, reader: Reader) -> None:
    if len(column) != count:
        reader.add_error(key, ErrorMessage("column_count", count=len(column), positions=count))


def _transient(values: Values, reader: Reader) -> Transient | None:
    table = values.get("transient")
    if table is None:
        return None
    has_motor = "motor" in values
    if table["motor"] and not has_motor:
        reader.add_error("transient.motor", ErrorMessage("transient_motorless"))
    start, ends = table.si("start"), tuple(stop.value for stop in table["stops"] or ())
    if ends and not (ends[0] <= start <= ends[1] and ends[0] < ends[1]):
        low, high = (f"{math.degrees(start) + away:g}" for away in (-90, 90))
        reader.add_error("transient.stops", ErrorMessage("transient_stops", low=low, high=high))
    rows = table.si("time") / table.si("step") if table["step"] and table["time"] else 0.0
    if rows > _MOST_ROWS:
        reader.add_error("transient.step", ErrorMessage("transient_rows", rows=rows, most=_MOST_ROWS))
    transient: Transient = table.made(
        Transient,
        torque=table.si("torque") or 0.0,
        motor=has_motor and table.get("motor", "torque" not in table),
        stops=ends or (-math.inf, math.inf),
        restitution=table["restitution"] or 0.0,
        speeds=tuple(speed.value for speed in table["speeds"] or ()),
    )
    return transient


def _loads(values: Values, linkage: Linkage | None, reader: Reader) -> tuple[Load, ...]:
    loads = []
    for number, load in enumerate(values["loads"], start=1):
        if load and "kind" in load and _check_load(f"loads[{number}]", load, linkage, reader):
            try:
                loads.append(_load(load))
            except ValueError as error:
                reader.add_error(f"loads[{number}]", error.args[0])
    return tuple(loads)


def _check_load(key: str, load: Values, linkage: Linkage | None, reader: Reader) -> bool:
    """Return whether ends of springs, tables and names of a load are valid; report mistakes."""
    if load["kind"] in _ENDED and ("between" in load) == ("slider" in load):
        reader.add_error(f"{key}.between", ErrorMessage(f"{load['kind']}_ends"))
    if len(set(load["between"] or "  x")) < 2:
        reader.add_error(f"{key}.between", ErrorMessage(f"{load['kind']}_twice", point=load["between"][0]))
    if "between" in load and (load.si("free_length") or 0.0) < 0:
        reader.add_error(f"{key}.free_length", ErrorMessage("spring_below_zero"))
    if load["kind"] == "force" and len(load["force"]) > 1:
        reader.add_error(f"{key}.force", ErrorMessage("entries", count=len(load["force"]), wanted=1))
    else:
        _check_table(key, load, reader)
    if linkage is not None:
        _check_names(key, load, linkage, reader)
    return not any(problem.key.startswith(key) for problem in reader.problems)


def _check_names(key: str, load: Values, linkage: Linkage, reader: Reader) -> None:
    """Report unknown sliders, links and points, and a point that is not on the link."""
    names = {"slider": {member.name for member in (*linkage.members, linkage.driving) if member.guide},
             "link": {member.name for member in linkage.members} | linkage.base - {GROUND},
             "point": set(linkage.owners)}  # fmt: skip
    for name, known in names.items():
        if name in load and load[name] not in known:
            reader.add_error(
                f"{key}.{name}", ErrorMessage(f"absent_{name}", name=load[name], known=", ".join(sorted(known)))
            )
    for point in load["between"]:
        if point not in names["point"]:
            reader.add_error(
                f"{key}.between", ErrorMessage("absent_point", name=point, known=", ".join(sorted(names["point"])))
            )
    ends = [("links", *end) for end in zip(load["between"], load["links"] or (), strict=False)]
    ends += [("link", load["point"], load["link"])] if load["point"] and load["link"] else []
    for where, point, link in ends:
        owners = linkage.owners.get(point, [])
        if owners and link not in owners:
            message = ErrorMessage("load_elsewhere", point=point, link=link, owners=", ".join(owners))
            reader.add_error(f"{key}.{where}", message)


def _on_pins(
    loads: Iterable[Load], linkage: Linkage, mechanism: Mechanism
) -> Iterator[tuple[str, dict[str, float | str]]]:
    """Yield notices of loads at pins of several links if no link is named, with the link assumed."""
    first_links = links_of_points(mechanism)
    # the third side of a triangle that a motor drives is not a link
    no_link = mechanism.driver.link if isinstance(mechanism.driver, LinkMotor) else ""
    for number, load in enumerate(loads, start=1):
        match load:
            case ForceOnPoint():
                key, ends = "link", [(load.point, load.link)]
            case Spring() | Damper():
                key, ends = "links", [(load.start, load.start_link), (load.end, load.end_link)]
            case _:
                continue
        for point, link in ends:
            owners = [owner for owner in linkage.owners[point] if owner != no_link]
            if not link and len(owners) > 1 and GROUND not in owners:
                yield "load_on_pin", {
                    "load": f"loads[{number}]", "point": point, "owners": ", ".join(owners), "link": first_links[point],
                    "field": key,
                }  # fmt: skip


def _check_table(key: str, load: Values, reader: Reader) -> None:
    """Report a table of a load with columns that differ in length, do not rise, or have a wrong dimension."""
    column = "torque" if load["kind"] == "torque" else "force"
    values, abscissas = load[column], load.get("at")
    if None in values or abscissas is None or None in abscissas:
        if abscissas is None and len(values) > 1:
            reader.add_error(f"{key}.at", ErrorMessage("load_at_missing", count=len(values), column=column))
        return
    wanted = "angle" if column == "torque" or load["against"] == "angle" else "length"
    shares = sum(isinstance(abscissa, float) for abscissa in abscissas)
    if wanted == "length" and 0 < shares < len(abscissas):
        reader.add_error(f"{key}.at", ErrorMessage("load_at_shares"))
        return
    if shares and wanted == "length":
        abscissas = [MeasuredValue(abscissa, wanted) for abscissa in abscissas]
        if "start" in load:
            reader.add_error(f"{key}.start", ErrorMessage("load_start_share"))
    if (shares and wanted == "angle") or any(abscissa.dimension != wanted for abscissa in abscissas):
        reader.add_error(f"{key}.at", ErrorMessage(f"load_at_{wanted}"))
    elif not _rises(
        [abscissa.value for abscissa in abscissas], jumps=wanted == "length" and load["curve"] == "straight"
    ):
        reader.add_error(f"{key}.at", ErrorMessage("load_at_rises"))
    elif wanted == "angle" and abscissas[-1].value - abscissas[0].value > _REVOLUTION:
        reader.add_error(f"{key}.at", ErrorMessage("load_at_turn"))
    if len(abscissas) != len(values) and not (len(abscissas) == 2 and len(values) == 1):
        reader.add_error(
            f"{key}.at", ErrorMessage("load_at_count", count=len(abscissas), others=len(values), column=column)
        )


def _rises(abscissas: list[float], *, jumps: bool) -> bool:
    """Return whether abscissas rise; where jumps may be, two that are equal make one, between parts with a length."""
    steps = [after - before for before, after in itertools.pairwise(abscissas)]
    if not jumps:
        return all(step > 0 for step in steps)
    has_lengths = all(first > 0 or second > 0 for first, second in itertools.pairwise(steps))
    return all(step >= 0 for step in steps) and has_lengths and steps[0] > 0 and steps[-1] > 0


def _load(load: Values) -> Load:
    match load["kind"]:
        case "process":
            return ProcessForce(
                load["slider"], _curve(load, "force"), load["against"],
                -1 if load["stroke"] == "falling" else 1, load.si("start") or 0.0, load["acts"],
            )  # fmt: skip
        case "force" if "force" in load:
            size, direction = load["force"][0].value, load.si("angle")
            x, y = size * math.cos(direction), size * math.sin(direction)
            return ForceOnPoint(load["point"], x, y, load["link"] or "", (size, direction))
        case "force":
            return load.made(ForceOnPoint, link=load["link"] or "", polar=None)
        case "torque":
            return TorqueOnLink(load["link"], _curve(load, "torque"))
        case "damper" if "slider" in load:
            return load.made(SliderDamper)
        case "damper":
            return load.made(Damper, **_ends(load))
        case _ if "slider" in load:
            return SliderSpring(load["slider"], *(load.si(key) for key in _OF_SPRING))
    return load.made(Spring, **_ends(load))


def _ends(load: Values) -> dict[str, str]:
    """Return the points that a spring or damper joins, and the links named for them."""
    named = zip(("start", "end", "start_link", "end_link"), (*load["between"], *(load["links"] or ())), strict=False)
    return dict(named)


def _curve(load: Values, key: str) -> LoadTable:
    """Return the table of a load; a single value holds everywhere."""
    values = tuple(_plain(load[key]))
    smooth = load["curve"] == "smooth"
    if "at" not in load:
        return LoadTable((-1e3, 1e3), (values[0], values[0]))
    abscissas = tuple(_plain(load["at"]))
    period = 2 * math.pi if load["against"] == "angle" or load["kind"] == "torque" else 0.0
    stroke = 1.0 if isinstance(load["at"][0], float) else 0.0
    if len(values) == 1:
        return LoadTable(abscissas, 2 * values, "constant", period, stroke)
    return LoadTable(abscissas, values, "monotone" if smooth else "linear", period, stroke)


def _plain(value: Any) -> Any:  # noqa: ANN401 - tables, lists and quantities, as the file has them
    """Return values with every quantity as its SI number."""
    match value:
        case MeasuredValue(dimension="mass_per_length"):
            return MassPerLength(value.value)
        case MeasuredValue():
            return value.value
        case [MeasuredValue(dimension="length") as distance, MeasuredValue(dimension="angle") as direction]:
            return [distance.value * math.cos(direction.value), distance.value * math.sin(direction.value)]
        case dict():
            return {name: _plain(item) for name, item in value.items()}
        case list():
            return [_plain(item) for item in value]
    return value


def _check_driver(values: Values, reader: Reader) -> None:
    """Report tables and keys that a machine with a driver cannot have, or needs."""
    driver, crank = values["driver"], values.get("crank")
    for name in _TURNING:
        if name in values:
            reader.add_error(name, ErrorMessage("needs_turning", key=name))
    if crank is None:
        if not {"slider", "cylinder", "between"} & set(driver):
            reader.add_error("driver", ErrorMessage("driver_none"))
        return
    for name in _WITHOUT_DRIVER:
        if name in crank:
            reader.add_error(f"crank.{name}", ErrorMessage("crank_with_law", key=name))
    for name, example in (("pivot", "O"), ("pin", "A"), ("radius", "50 mm")):
        if name not in crank:
            reader.add_error(f"crank.{name}", ErrorMessage("missing", advice=(f'{name} = "{example}"',)))


def _check_halves(driver: Values, reader: Reader) -> None:
    """Report barrel and rod without a driving cylinder."""
    for name in ("barrel", "rod"):
        if name in driver and "cylinder" not in driver and not reader.has_errors("driver.cylinder"):
            reader.add_error(f"driver.{name}", ErrorMessage("half_alone", key=name))


def _check_by_angle(values: Values, reader: Reader) -> None:
    """Report loads and gas over the crank angle, which a machine with a driver that follows a law does not have."""
    for number, load in enumerate(values["loads"], start=1):
        if load and ((load["kind"] == "torque" and "at" in load) or load["against"] == "angle"):
            reader.add_error(f"loads[{number}]", ErrorMessage("load_by_angle"))
    for name, charge in values.get("chambers", {}).items():
        path, table = f"chambers.{name}", charge or {}
        keys = [
            key
            for key in ("measured", "cycle", "period", "delay")
            if key in table and (key, table[key]) != ("period", "360 deg")
        ]
        points = table.get("points", {}).items()
        keys += [f"points.{point}.angle" for point, placed in points if placed and "angle" in placed]
        for key in keys:
            reader.add_error(f"{path}.{key}", ErrorMessage("gas_by_angle"))
    for name, charge in values.get("charges", {}).items():
        if charge and "angle" in charge:
            reader.add_error(f"charges.{name}.angle", ErrorMessage("charge_by_angle"))


def build_law(values: Values, reader: Reader) -> Law | None:
    """Return the law of a driver, or None after complaints."""
    driver = values["driver"]
    wanted = "length" if {"slider", "cylinder"} & set(driver) else "angle"
    places = [_place(driver, "start", "driver.start", wanted, reader)]
    if "velocity" in driver:
        return _law_of_instant(driver, places[0], wanted, reader)
    segments = [(number, segment) for number, segment in enumerate(driver["law"], start=1) if segment is not None]
    for number, segment in segments:
        places.append(_end(segment, number, places, wanted, reader))
        _check_kind(segment, f"driver.law[{number}]", wanted, reader)
    if reader.problems:
        return None
    if places[0] is None:
        places[0] = next((start for start in reversed(places) if start is not None), None)
    if places[0] is None:
        reader.add_error("driver.start", ErrorMessage("driver_start"))
        return None
    filled = [float(places[0])]
    for place in places[1:]:
        filled.append(filled[-1] if place is None else float(place))
    passed = (place.value for _, segment in segments for place in segment["values"])
    if "start" not in driver and all(place == filled[0] for place in itertools.chain(filled, passed)):
        reader.add_error("driver.start", ErrorMessage("law_stands"))
        return None
    if min(filled) <= 0 and "cylinder" in driver:
        reader.add_error("driver.law", ErrorMessage("cylinder_short"))
        return None
    times = _times(driver, [segment for _, segment in segments], filled, reader)
    if times is None:
        return None
    period = math.fsum(times)
    made = tuple(
        Segment(
            segment["kind"], to, time / period, segment["ramp"] or Segment.ramp,
            tuple(zip(segment["at"], (place.value for place in segment["values"]), strict=True)), _rates(segment),
        )
        for (_, segment), to, time in zip(segments, filled[1:], times, strict=True)
    )  # fmt: skip
    return Law(made, period, filled[0], has_jerk=driver["jerk"] or False)


def _law_of_instant(driver: Values, start: float | None, wanted: str, reader: Reader) -> Law | None:
    """Return the law of a constant acceleration from a position and its velocity there, over a short time."""
    kinds = ("velocity", "acceleration") if wanted == "length" else ("speed", "angular_acceleration")
    rates = [driver["velocity"], driver["acceleration"]]
    for key, rate, kind in zip(("velocity", "acceleration"), rates, kinds, strict=True):
        if rate is not None and rate.dimension != kind:
            name = "speed" if key == "velocity" else key
            reader.add_error(f"driver.{key}", ErrorMessage(f"driver_{name}_{wanted}"))
    if start is None and not reader.has_errors("driver.start"):
        reader.add_error("driver.start", ErrorMessage("driver_start"))
    if start is None or reader.problems:
        return None
    velocity, acceleration = (0.0 if rate is None else rate.value for rate in rates)
    period = driver.si("period") or _INSTANT
    end = start + velocity * period + acceleration * period**2 / 2
    moved: LawKind = "dwell" if end == start else "constant-acceleration" if acceleration else "constant"
    segment = Segment(moved, end, 1.0, rates=(velocity, None))
    return Law((segment,), period, start, has_jerk=bool(driver["jerk"]), is_instant="period" not in driver)


def _place(table: Values, key: str, path: str, wanted: str, reader: Reader) -> float | None:
    """Return a value of the coordinate in SI; report a wrong dimension."""
    measure: MeasuredValue | None = table[key]
    if measure is not None and measure.dimension != wanted:
        reader.add_error(path, ErrorMessage(f"driver_{wanted}"))
    return None if measure is None else measure.value


def _end(segment: Values, number: int, before: list[float | None], wanted: str, reader: Reader) -> float | None:
    """Return the end of a segment, None for its start."""
    path = f"driver.law[{number}]"
    if segment["kind"] == "dwell":
        return before[-1]
    if "to" not in segment:
        reader.add_error(f"{path}.to", ErrorMessage("law_to", example="0.5 m" if wanted == "length" else "90 deg"))
    return _place(segment, "to", f"{path}.to", wanted, reader)


def _rates(segment: Values) -> tuple[float | None, float | None]:
    """Return the rates at both ends of a segment, None where they follow from the points of a table."""
    usual = None if segment["ends"] == "natural" else 0.0
    start, end = (segment.si(f"{end}_speed") for end in ("start", "end"))
    return usual if start is None else start, usual if end is None else end


def _check_kind(segment: Values, path: str, wanted: str, reader: Reader) -> None:
    """Report a rate of a wrong dimension, and an invalid table."""
    for key in ("speed", "start_speed", "end_speed"):
        if key in segment and segment[key].dimension != ("velocity" if wanted == "length" else "speed"):
            reader.add_error(f"{path}.{key}", ErrorMessage(f"driver_speed_{wanted}"))
    if segment["kind"] == "table":
        _check_law_table(segment, path, wanted, reader)


def _check_law_table(segment: Values, path: str, wanted: str, reader: Reader) -> None:
    """Report a table that does not rise, or with columns of different lengths."""
    times, values = segment["at"], segment["values"]
    if len(times) != len(values) or not times:
        reader.add_error(f"{path}.at", ErrorMessage("law_table"))
    elif None not in times and any(b <= a for a, b in itertools.pairwise([0.0, *times, 1.0])):
        reader.add_error(f"{path}.at", ErrorMessage("law_table_rises"))
    for number, value in enumerate(values, start=1):
        if value is not None and value.dimension != wanted:
            reader.add_error(f"{path}.values[{number}]", ErrorMessage(f"driver_{wanted}"))


def _times(driver: Values, segments: list[Values], places: list[float], reader: Reader) -> list[float] | None:
    """Return the time of each segment. [s]"""
    period = driver.si("period")
    times, shares = [], []
    for number, (segment, (low, high)) in enumerate(zip(segments, itertools.pairwise(places), strict=True), start=1):
        if "speed" in segment:
            times.append(abs(high - low) / segment["speed"].value)
            if not times[-1]:
                reader.add_error(f"driver.law[{number}].speed", ErrorMessage("law_still"))
                return None
        elif isinstance(segment["over"], MeasuredValue):
            times.append(segment["over"].value)
        elif period is None:
            reader.add_error(f"driver.law[{number}].over", ErrorMessage("law_period"))
            return None
        else:
            times.append(segment["over"] * period)
            shares.append(segment["over"])
    if period is not None and abs(math.fsum(times) - period) > _SUM * period:
        text = ErrorMessage(
            "law_shares" if shares else "law_times", whole=f"{math.fsum(times):.6g}", period=f"{period:.6g}"
        )
        reader.add_error("driver.period", text)
        return None
    return times


def build_chambers(
    values: Values,
    linkage: Linkage | None,
    mechanism: Mechanism | None,
    reader: Reader,
    pi: float,
    staged: Mapping[str, Valves],
) -> tuple[dict[str, Chamber], dict[str, Charge]]:
    """Return chambers and charges by name; those with mistakes may be left out.

    `staged`: valves of chambers that are told by the stages of a compressor, by name.
    """
    tables = {name: table for name, table in values["chambers"].items() if table is not None}
    sealed = {name: charge for name, charge in values["charges"].items() if charge is not None}
    sliders = {member.name for member in linkage.members if member.guide} if linkage is not None else None
    if linkage is not None and sliders is not None and isinstance(linkage.driver, DrivingSlider):
        sliders.add(linkage.driver.link)
    holder = _holders(sealed, tables, reader)
    for name, charge in sealed.items():
        _check_charge(f"charges.{name}", charge, reader)
    chambers = dict[str, Chamber]()
    pressures: Mapping[str, PressureOfCycle] = {}
    if any("cycle" in table for table in tables.values()):
        from crankwork.description.cycle_build import chamber_cycles  # noqa: PLC0415 - few chambers have one

        tables, pressures = chamber_cycles(tables, mechanism, values, reader, pi)
    for name, table in tables.items():
        path = f"chambers.{name}"
        faces = tuple(_faces(path, table, sliders, reader))
        if name in staged:
            _check_staged(path, table, reader)
        else:
            _check_pressure(path, table, sealed.get(holder.get(name, "")), reader)
        diagram = build_diagram(table, path, reader, table["period"])
        valves = staged.get(name) or build_valves(table, path, reader)
        if not faces or any(problem.key.startswith(path) for problem in reader.problems):
            continue
        if valves is not None:
            volumes = (table.si("clearance_volume"), table["compression_ratio"])
            diagram = with_valves(diagram, valves, has_clearance=any(volumes))
        is_absolute = pressures_of(table, diagram.measured) == "absolute" or name in holder or "cycle" in table
        is_absolute |= name in staged
        counted = table.but(pressures="absolute") if is_absolute else table
        chambers[name] = table.made(
            Chamber,
            faces=faces,
            ambient=counted.si("ambient") or 0.0,
            names_ambient="ambient" in table or not is_absolute,
            cycle=float(table["period"].split()[0]),
            delay=table.degrees("delay") or 0.0,
            factor=table["pressure_factor"],
            valves=valves,
            calculated=pressures.get(name),
            **diagram._asdict(),
        )
    return chambers, {} if reader.problems else {name: _charge(charge) for name, charge in sealed.items()}


def _faces(path: str, chamber: Values, sliders: set[str] | None, reader: Reader) -> Iterator[Face]:
    """Yield the faces of a chamber; report invalid faces."""
    listed = chamber["faces"]
    written = listed or [chamber]
    taken: set[str] = set()
    for number, face in enumerate(written, start=1):
        place = f"{path}.faces[{number}]" if listed else path
        if face is None or reader.has_errors(place):
            continue
        slider, bore, rod = face["slider"] or "", face.si("bore"), face.si("rod_diameter") or 0.0
        if not slider and not reader.has_errors(f"{place}.slider"):
            reader.add_error(f"{place}.slider", ErrorMessage("face_slider"))
        elif slider and sliders is not None and slider not in sliders:
            reader.add_error(
                f"{place}.slider", ErrorMessage("absent_slider", name=slider, known=", ".join(sorted(sliders)))
            )
        elif slider in taken:
            reader.add_error(f"{place}.slider", ErrorMessage("face_twice", slider=slider))
        if bore is None and "area" not in face and not reader.has_errors(f"{place}.bore", f"{place}.area"):
            reader.add_error(f"{place}.bore", ErrorMessage("face_area"))
        if rod and not rod < (bore or 0.0) and not reader.has_errors(f"{place}.bore"):
            reader.add_error(f"{place}.rod_diameter", ErrorMessage("face_rod"))
        taken.add(slider)
        yield Face(slider, bore, rod, face.si("area"), -1 if face["sense"] == -1 else 1)


def _check_staged(path: str, chamber: Values, reader: Reader) -> None:
    """Report a pressure of its own of a chamber that a stage gives its pressures."""
    for key in (*_OWN_PRESSURE, "pressures", "period"):
        if key in chamber and (key, chamber[key]) not in (("pressures", "absolute"), ("period", "360 deg")):
            reader.add_error(f"{path}.{key}", ErrorMessage("chamber_staged"))


def _check_pressure(path: str, chamber: Values, charge: Values | None, reader: Reader) -> None:
    """Report a chamber without a pressure or with several, and keys of another kind of pressure."""
    own = [key for key in _OWN_PRESSURE if key in chamber]
    if charge is not None:
        for key in (*own, "pressures", "period", "delay", "pressure_factor"):
            if key in chamber:
                reader.add_error(f"{path}.{key}", ErrorMessage("chamber_sealed"))
    else:
        if (
            chamber["pressures"] != "absolute"
            and "ambient" in chamber
            and "cycle" not in own
            and not reader.has_errors(f"{path}.pressures")
        ):
            reader.add_error(f"{path}.ambient", no_effect_message("pressures", "gauge", ("absolute",)))
        if not own and not reader.has_errors(*(f"{path}.{key}" for key in _OWN_PRESSURE), "charges"):
            reader.add_error(path, ErrorMessage("chamber_pressure", path=path))
        elif own and {"pressure", "cycle"}.isdisjoint(own):
            check_parts(chamber, path, reader)
        if "delay" in chamber and "pressure" in own:
            reader.add_error(f"{path}.delay", ErrorMessage("delay_constant"))
    if "temperature" in chamber and (charge is None or "exponent" in charge):
        reader.add_error(f"{path}.temperature", ErrorMessage("temperature_unused"))
    elif charge is not None and "exponent" not in charge and "temperature" not in chamber:
        _miss(path, "temperature", reader)


def _miss(path: str, key: str, reader: Reader) -> None:
    if not reader.has_errors(f"{path}.{key}"):
        reader.add_error(f"{path}.{key}", ErrorMessage(f"charge_{key}"))


def _holders(sealed: Mapping[str, Values], chambers: Mapping[str, Values], reader: Reader) -> dict[str, str]:
    """Return the charge of each chamber; report unknown names, and chambers of two charges."""
    holder: dict[str, str] = {}
    for charge, table in sealed.items():
        for number, name in enumerate(table["chambers"], start=1):
            place = f"charges.{charge}.chambers[{number}]"
            if name is not None and name not in chambers and not reader.has_errors(f"chambers.{name}"):
                reader.add_error(
                    place, ErrorMessage("absent_chamber", name=name, known=", ".join(sorted(chambers)) or "–")
                )
            elif name in holder:
                reader.add_error(place, ErrorMessage("chamber_twice", name=name))
            elif name is not None:
                holder[name] = charge
    return holder


def _check_charge(path: str, charge: Values, reader: Reader) -> None:
    """Report missing and superfluous keys of the state of a charge."""
    amounts = [key for key in _AMOUNTS if key in charge]
    if not amounts and not reader.has_errors(*(f"{path}.{key}" for key in _AMOUNTS)):
        reader.add_error(path, ErrorMessage("charge_amount"))
    parts = [(f"{path}.dead_volumes[{k}]", volume) for k, volume in enumerate(charge["dead_volumes"], start=1)]
    if "exponent" in charge:
        unused = [f"{path}.{key}" for key in ("gas_constant", "mass") if key in charge]
        unused += [f"{place}.temperature" for place, volume in parts if volume and "temperature" in volume]
        for place in unused:
            reader.add_error(place, ErrorMessage("charge_polytrope"))
        return
    if "gas_constant" not in charge:
        _miss(path, "gas_constant", reader)
    for place, volume in parts:
        if volume and "temperature" not in volume:
            _miss(place, "temperature", reader)


def _charge(values: Values) -> Charge:
    return values.made(
        Charge,
        chambers=tuple(values["chambers"]),
        dead_volumes=tuple(volume.made(DeadVolume) for volume in values["dead_volumes"] if volume),
        angle=math.degrees(values.si("angle") or 0.0),
    )
