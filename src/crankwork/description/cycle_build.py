"""From a working cycle to the calculated pressure and the size of an engine; the gas of cylinders that differ."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple, cast

import numpy as np

from crankwork.description.keys import CYCLE
from crankwork.description.measured_build import build_diagram, build_valves, check_parts, has_diagram, with_valves
from crankwork.description.schema import Values, no_effect_message
from crankwork.description.value_types import MeasuredValue, Reader, shown
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import Input, TracedValue, given, in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank, turns_fully
from crankwork.loads.gas import compression_ratio, piston_area, swept_volume
from crankwork.loads.indicator import constant_diagram
from crankwork.loads.measured_pressure import FEWEST
from crankwork.loads.pressure_processing import PEAKS, centred, peak_angle
from crankwork.locale import ErrorMessage
from crankwork.machine import Engine, Gas
from crankwork.mechanism.cells import NoCellsError, crank_cells
from crankwork.mechanism.mechanism import Mechanism
from crankwork.preparation.cell_gas import relocate
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, CalculatedPressure
from crankwork.working_cycle.closed_gas import HeatReleaseData
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import FUELS, Fuel
from crankwork.working_cycle.grinevetsky import AssignedData, assigned_cycle, grinevetsky
from crankwork.working_cycle.ideal import IdealData, ideal_cycle
from crankwork.working_cycle.pressure_models import CornerPressure, HeatReleasePressure, MisfirePressure
from crankwork.working_cycle.rounding import Rounding, Timing

_IDEAL, _ASSIGNED = ("otto", "ideal-diesel", "dual"), ("assigned-petrol", "assigned-diesel")
_TURN = 360.0
# where a chamber states what an engine states elsewhere
_PLACES = {
    "cycle": "cycle", "cycle.cycle": "period", "cycle.ambient_pressure": "ambient", "cylinder.bore": "faces[1].bore",
    "cylinder.compression_ratio": "compression_ratio", "cylinder.clearance_volume": "clearance_volume",
}  # fmt: skip
_AMBIENT = "ambient"
_FULL_TURN = 360.0


class Cycle(NamedTuple):
    """The gas of a calculated cycle, and the values of the machine file with the calculated sizes."""

    gas: Gas
    values: Values


class CylinderSize(NamedTuple):
    """What the calculation of a cycle takes from its cylinder, None or nothing where it is not known."""

    ratio: float | None  # Largest over smallest volume of the closed cylinder [-]
    speed: float  # Of the crank [rad/s]
    cylinders: int = 1
    bore: float | None = None  # [m]
    stroke: float | None = None  # [m]
    lengths: SliderCrank | None = None  # Of crank and rod, without offset, in any unit
    chamber: str = ""  # Path of its chamber in the description, in a linkage
    clearance: float | None = None  # [m3]
    offset: SliderCrank | None = None  # The same with the offset of the cylinder, if it changes the stroke [m]


def build_cycle(values: Values, reader: Reader, pi: float) -> Cycle | None:
    """Return the gas of a calculated cycle, or None after complaints."""
    table, cylinder = values["cycle"], values["cylinder"]
    if "kind" not in table:
        return None
    offset, clearance = _offset_lengths(values), cylinder.si("clearance_volume")
    stroke = _stroke(values["crank"]) if offset is None else float(offset.stroke)
    has_volumes = clearance and (table["kind"] == "wiebe" or (cylinder["bore"] and stroke))
    if cylinder["compression_ratio"] is None and "total_volume" not in table and not has_volumes:
        if not reader.has_errors("cylinder.compression_ratio", "cylinder.clearance_volume"):
            reader.add_error("cylinder.compression_ratio", ErrorMessage("cycle_ratio"))
        return None
    if reader.has_errors("cycle", "crank.speed") or "speed" not in values["crank"]:
        return None
    size = CylinderSize(
        cylinder["compression_ratio"], values["crank"]["speed"].value, int(values["engine"]["cylinders"] or 1),
        cylinder.si("bore"), stroke, _rod_of(values), clearance=clearance, offset=offset,
    )  # fmt: skip
    pressure = calculated_pressure(table, size, pi, "cycle", reader)
    if pressure is None:
        return None
    if "power" in table and isinstance(pressure, CornerPressure):
        values = _sized(values, pressure.cycle)
    values = values.but(cylinder=cylinder_of(values["cylinder"], pressure))
    angle, ambient = float(table["cycle"].split()[0]), table.si("ambient_pressure")
    return Cycle(Gas(cycle=angle, is_absolute=True, ambient=ambient, names_ambient=True, calculated=pressure), values)


def cylinder_of(cylinder: Values, pressure: CalculatedPressure | None) -> Values:
    """Return the values of a cylinder or chamber, with the geometric ratio if its ports take a part of the stroke."""
    cycle = getattr(pressure, "cycle", None)
    if cycle is None or "geometric_compression_ratio" not in cycle.trace or "clearance_volume" in cylinder:
        return cylinder
    return cylinder.but(compression_ratio=cycle.trace["geometric_compression_ratio"].value)


def calculated_pressure(
    table: Values, size: CylinderSize, pi: float, path: str, reader: Reader
) -> CornerPressure | HeatReleasePressure | None:
    """Return the pressure of a calculated cycle, or None after complaints; `path`: of its table."""
    if table["kind"] in _ASSIGNED and reader.has_errors(*(f"{path}.{key}" for key in CYCLE.keys)):
        return None
    if size.bore is None and reader.has_errors("cylinder.bore"):
        return None
    try:
        return _built(table, size, pi)
    except CrankworkError as error:
        reader.add_error(_blamed(error.args[0], table, path), error.args[0])
        return None


def _blamed(message: str, table: Values, path: str) -> str:
    """Return the path of the key at the beginning of a message, or of the table."""
    word = message.split(maxsplit=1)[0].rstrip(",:") if message else ""
    return f"{path}.{word}" if word in table else path


def _built(table: Values, size: CylinderSize, pi: float) -> CornerPressure | HeatReleasePressure:
    kind = table["kind"]
    angle = float(table["cycle"].split()[0])
    if kind == "wiebe":
        return HeatReleasePressure(heat_release_data(table, angle, size))
    timing = _timing(table["timing"], angle)
    ratio = None
    if size.ratio is None and "total_volume" not in table:
        ratio = _ratio_of_volumes(size, _lost_stroke(table, size.lengths, timing, angle), pi)
        size = size._replace(ratio=ratio.value)
    if kind in _IDEAL:
        state = {"pressure": table.si("intake_pressure"), "temperature": table.si("intake_temperature")}
        cycle = ideal_cycle(table.made(IdealData, compression_ratio=size.ratio, **state, angle=angle))
    elif kind in _ASSIGNED:
        cycle = assigned_cycle(_assigned(table, size, angle))
    else:
        cycle = grinevetsky(_data(table, size, angle, timing, pi))
    for known in in_order((*cycle.trace.values(), *cycle.corners)):
        if ratio is not None and isinstance(known.node, Input) and known.node.path == "cylinder.compression_ratio":
            # it is not stated but follows
            known.node = ratio.node
    corners = table["corners"] or ("rounded" if "timing" in table else "sharp")
    rounds = corners == "rounded" and table["school"] != "none"
    return CornerPressure(cycle, timing if rounds else None, _rounding(table))


def _ratio_of_volumes(size: CylinderSize, lost_stroke: float, pi: float) -> TracedValue:
    """Return the compression ratio of the closed cylinder from its clearance volume, bore and stroke."""
    stroke = given("stroke", size.stroke or 0.0)
    swept = swept_volume(piston_area(pi, given("bore", size.bore or 0.0, "cylinder.bore")), stroke)
    clearance = given("clearance_volume", size.clearance or 0.0, "cylinder.clearance_volume")
    closed = swept * (1 - given("lost_stroke", lost_stroke, "cycle.lost_stroke")) if lost_stroke else swept
    result: TracedValue = compression_ratio(closed, clearance)
    return result


def _timing(table: Values, angle: float) -> Timing:
    events = ("ignition_delay", "intake_opens", "intake_closes", "exhaust_opens", "exhaust_closes")
    degrees = {name: table.degrees(name) or 0.0 for name in events}
    return Timing(ignition_advance=table.degrees("ignition") or 0.0, cycle=angle, **degrees)


def _rounding(table: Values) -> Rounding:
    return table.made(Rounding, peak_angle=table["timing"].degrees("peak"))


def _assigned(table: Values, size: CylinderSize, angle: float) -> AssignedData:
    """Return what an assignment gives of a cycle."""
    volumes = {"compression_ratio": size.ratio, "clearance_volume": None}
    if "total_volume" in table:
        if size.clearance is None or size.ratio is not None:
            raise CrankworkError(ErrorMessage("total_volume_alone"))
        if table.si("total_volume") <= size.clearance:
            raise CrankworkError(ErrorMessage("total_volume_small", least=size.clearance * 1e6))
        volumes["clearance_volume"] = size.clearance
    return table.made(AssignedData, angle=angle, **volumes)


def _data(table: Values, cylinder: CylinderSize, angle: float, timing: Timing, pi: float) -> GrinevetskyData:
    """Return the data of a calculation by Grinevetsky and Mazing."""
    size: dict[str, Any] = {}
    if cylinder.bore and cylinder.stroke:
        size |= {"bore": cylinder.bore, "stroke": cylinder.stroke, "lengths": cylinder.offset}
    if "power" in table:
        # of a file that is written out both stand beside it
        size["rounds_size"] = bool(cylinder.bore) == bool(cylinder.stroke)
    loss = table["mechanical_loss"]
    return table.made(
        GrinevetskyData,
        compression_ratio=cylinder.ratio,
        rotational_speed=cylinder.speed * 30 / math.pi,
        fuel=_fuel(table["fuel"]),
        strokes=4 if angle == 720 else 2,
        cylinders=cylinder.cylinders,
        mechanical_loss=None if not loss or None in loss else (loss[0] * 1e6, loss[1] * 1e6),
        lost_stroke=_lost_stroke(table, cylinder.lengths, timing, angle),
        pi=pi,
        **size,
    )


def _stroke(crank: Values) -> float | None:
    stroke: float | None = 2 * crank.si("radius") if "radius" in crank else crank.si("stroke")
    return stroke


def _offset_lengths(values: Values) -> SliderCrank | None:
    """Return the lengths of a cylinder whose axis passes the shaft: its stroke is longer than twice the radius."""
    offsets = values["engine"]["offsets"] or [values["cylinder"]["offset"]]
    offset = 0.0 if offsets[0] is None else float(offsets[0].value)
    lengths = _rod_of(values)._replace(offset=offset)
    return lengths if _stroke(values["crank"]) is not None and offset and turns_fully(lengths) else None


def _rod_of(values: Values) -> SliderCrank:
    """Return crank and rod without offset, of radius 1 if only their ratio is given."""
    rod, stroke = values["rod"], _stroke(values["crank"])
    radius, ratio = (stroke or 2.0) / 2, rod["ratio"] or 0.25
    if "length" in rod and stroke:
        return SliderCrank(radius, float(rod["length"].value))
    return SliderCrank(radius, radius * ratio if rod["ratio_definition"] == "l/r" else radius / ratio)


def _fuel(given: object) -> Fuel | None:
    """Return a fuel by name or by its composition."""
    if given is None:
        return None
    if isinstance(given, str):
        if given not in FUELS:
            raise CrankworkError(ErrorMessage("fuel_unknown", fuel=given, known=tuple(FUELS)))
        return FUELS[given]
    table = cast("Values", given)
    parts = [table[key] or 0.0 for key in ("carbon", "hydrogen", "oxygen")]
    if abs(sum(parts) - 1) > 0.01:
        raise CrankworkError(ErrorMessage("fuel_parts", sum=sum(parts)))
    return Fuel(parts[0], parts[1], parts[2], table["molar_mass"], table.si("heating_value"))


def _lost_stroke(table: Values, lengths: SliderCrank | None, timing: Timing, angle: float) -> float:
    """Return the share of the stroke after the last port has shut: stated, or from the ratio of rod and crank."""
    closes = max(timing.intake_closes, timing.exhaust_closes) if angle == _TURN else 0.0
    if table["lost_stroke"] is not None or not closes:
        return float(table["lost_stroke"] or 0.0)
    if lengths is None:
        raise CrankworkError(ErrorMessage("cycle_lost_stroke"))
    if not turns_fully(lengths):
        return 0.0
    bottom = dead_centres(lengths)[1]
    x = piston_motion(lengths, CrankGrid.from_degrees(np.array([bottom + closes]))).piston.position[0]
    return 1 - float(x) / float(lengths.stroke)


def _sized(values: Values, cycle: CalculatedCycle) -> Values:
    """Return the values with the bore and stroke required for a power, in whole millimetres, unless they are stated."""
    crank, cylinder = values["crank"], values["cylinder"]
    if _stroke(crank) is None:
        crank = crank.but(radius=MeasuredValue(round(cycle.values["stroke"], 3) / 2, "length"))
    bore = cylinder["bore"] or MeasuredValue(round(cycle.values["bore"], 3), "length")
    return values.but(crank=crank, cylinder=cylinder.but(bore=bore))


def heat_release_data(table: Values, angle: float, size: CylinderSize) -> HeatReleaseData:
    """Return the data of a release of heat, with defaults for missing values."""
    timing = table["timing"]
    given: dict[str, Any] = {
        "heat": table.si("cycle_heat"),
        "fuel_per_cycle": table.si("fuel_mass"),
        "heating_value": table.si("heating_value"),
        "burning_efficiency": table["burning_efficiency"],
        "burning_shape": table["shape"],
        "heat_ratio": table["adiabatic_exponent"],
        "has_wall_loss": "wall_temperature" in table,
        "wall_temperature": table.si("wall_temperature"),
        "exhaust_pressure": table.si("residual_pressure"),
        "intake_pressure": table.si("intake_pressure"),
    }
    angles = {
        "burning_advance": (table, "combustion_start"),
        "burning_duration": (table, "combustion_duration"),
        "intake_opens": (timing, "intake_opens"),
        "intake_closes": (timing, "intake_closes"),
        "exhaust_opens": (timing, "exhaust_opens"),
        "exhaust_closes": (timing, "exhaust_closes"),
    }
    given |= {name: place.degrees(key) for name, (place, key) in angles.items()}
    of_fuel = [key for key in ("fuel_mass", "heating_value", "burning_efficiency") if key in table]
    if given["heat"] is not None and of_fuel:
        raise CrankworkError(ErrorMessage("cycle_heat_twice", names=", ".join(of_fuel)))
    if given["heat"] is None and not {"fuel_mass", "heating_value"} <= set(of_fuel):
        raise CrankworkError(ErrorMessage("cycle_heat_missing"))
    if size.bore is None:
        raise CrankworkError(ErrorMessage("cycle_bore_missing"))
    return HeatReleaseData(
        bore=size.bore,
        rotational_speed=size.speed * 30 / math.pi,
        shut_pressure=table.si("intake_pressure"),
        shut_temperature=table.si("intake_temperature"),
        cycle=angle,
        chamber=size.chamber,
        **{name: value for name, value in given.items() if value is not None},
    )


def chamber_cycles(
    tables: Mapping[str, Values], mechanism: Mechanism | None, values: Values, reader: Reader, pi: float
) -> tuple[dict[str, Values], dict[str, CalculatedPressure]]:
    """Return the values of chambers with calculated sizes, and calculated pressures by name; equal cycles share one."""
    crank, sized, calculated = values["crank"], dict(tables), dict[str, CalculatedPressure]()
    if "speed" not in crank or mechanism is None:
        return sized, calculated
    sliders = values["shaft"]["cylinders"]
    lengths = _lengths(mechanism)
    for names in _equal_cycles({name: table for name, table in tables.items() if "kind" in table["cycle"]}, sliders):
        pressure = _of_cycle(names, tables, lengths, crank["speed"].value, reader, pi)
        if pressure is not None:
            calculated |= {name: _in_chamber(pressure, tables[name], name) for name in names}
            sized |= {name: cylinder_of(tables[name], pressure) for name in names}
    return sized, calculated


def _in_chamber(
    pressure: CornerPressure | HeatReleasePressure, chamber: Values, name: str
) -> CornerPressure | HeatReleasePressure | MisfirePressure:
    """Return the pressure of a calculated cycle in a chamber, that without combustion if it is motored."""
    motored, around = chamber["cycle"]["motored"], None
    if motored is None:
        return pressure
    if motored == "ambient":
        ambient = chamber.but(pressures="absolute").si("ambient")
        around = given("ambient_pressure", ambient, f"chambers.{name}.ambient")
    return MisfirePressure(pressure, float(chamber["period"].split()[0]), around)


def _equal_cycles(tables: Mapping[str, Values], sliders: list[str]) -> list[list[str]]:
    """Return the names of chambers whose cycles state the same, in the order of their pieces on the shaft."""
    groups = list[tuple[object, list[str]]]()
    place = {slider: number for number, slider in enumerate(sliders)}
    for name in sorted(tables, key=lambda name: place.get(tables[name]["slider"], len(place))):
        table = tables[name]
        cycle = {key: value for key, value in table["cycle"].items() if key != "motored"}
        states = cycle, *(table[key] for key in ("bore", "area", "compression_ratio", "period", "ambient"))
        equal = next((names for other, names in groups if other == states), None)
        if equal is None:
            groups.append((states, [name]))
        else:
            equal.append(name)
    return [names for _, names in groups]


def _lengths(mechanism: Mechanism) -> dict[str, SliderCrank]:
    """Return crank, rod and offset of each piece that a rod of the crank moves."""
    try:
        crank = crank_cells(mechanism)
    except NoCellsError:
        return {}
    return {
        cell.slider: SliderCrank(crank.crank.radius, cell.length, cell.offset)
        for cell in crank.cells
        if not cell.master
    }


def _of_cycle(
    names: list[str], tables: Mapping[str, Values], lengths: Mapping[str, SliderCrank], speed: float, reader: Reader,
    pi: float,
) -> CornerPressure | HeatReleasePressure | None:  # fmt: skip
    """Return the calculated pressure of chambers whose cycles state the same, or None after complaints at each."""
    chamber, pressure = tables[names[0]], None
    known = [lengths[tables[name]["slider"]] for name in names if tables[name]["slider"] in lengths]
    rod = known[0] if known and turns_fully(known[0]) else None
    size = CylinderSize(
        chamber["compression_ratio"], speed, len(names), chamber.si("bore"), None if rod is None else rod.stroke,
        None if rod is None else rod._replace(offset=0.0), f"chambers.{names[0]}", chamber.si("clearance_volume"),
    )  # fmt: skip
    around = {"cycle": chamber["period"], "ambient_pressure": chamber.but(pressures="absolute")["ambient"]}
    table = Values({**chamber["cycle"], **around}, CYCLE)
    for name in names:
        path = f"chambers.{name}"
        if reader.has_errors(path):
            continue
        has_volumes = "total_volume" in table or (size.clearance and size.bore and size.stroke)
        if chamber["compression_ratio"] is None and table["kind"] != "wiebe" and not has_volumes:
            reader.add_error(f"{path}.compression_ratio", ErrorMessage("cycle_ratio"))
        elif {"clearance_volume", "compression_ratio"}.isdisjoint(chamber):
            reader.add_error(path, ErrorMessage("gas_volume"))
        else:
            pressure = pressure or calculated_pressure(table, size, pi, f"{path}.cycle", reader)
    if isinstance(pressure, CornerPressure):
        places = {key: f"{size.chamber}.{place}" for key, place in _PLACES.items()}
        relocate((*pressure.cycle.trace.values(), *pressure.cycle.corners), places)
    return pressure


def with_own_gas(values: Values, engine: Engine, gas: Gas | None, reader: Reader) -> Engine:
    """Return an engine with the gas of each cylinder if they differ; report contradictions."""
    table, count = values["engine"], len(engine.layout.places)
    requested = [f"engine.{key}" for key in ("misfire", "pressure_factors") if key in table]
    own = values["gas"]["cylinders"]
    if gas is None:
        for key in requested:
            if not reader.has_errors("gas", "cycle", "cylinder"):
                reader.add_error(key, ErrorMessage("cylinder_gas_none"))
        return engine
    if not requested and not own and not values["gas"]["measured"]["columns"]:
        return engine
    diagrams = _own_diagrams(values["gas"], gas, count, reader) if own else {}
    diagrams = {**_of_columns(values["gas"], gas, engine, reader), **diagrams}
    misfires = _misfires(table, own, count, reader)
    factors = _factors(table, misfires, count, reader)
    motored = _motored(values, gas, reader) if misfires else None
    if reader.problems:
        return engine
    left = [number for number in range(1, count + 1) if number not in diagrams and number not in misfires]
    if left and not (gas.calculated or has_diagram(values["gas"])):
        reader.add_error("gas.points", ErrorMessage("cylinder_gas", numbers=", ".join(map(str, left)), first=left[0]))
        return engine
    own_or_first = {number: diagrams.get(number, gas) for number in sorted({*diagrams, *left[:1]})}
    _check_order(own_or_first, values["gas"], reader)
    gases, known = list[Gas](), dict[tuple[int, float], Gas]()
    for number, factor in enumerate(factors, start=1):
        own_gas = motored if motored is not None and number in misfires else diagrams.get(number, gas)
        if factor != 1:
            path = f"engine.pressure_factors[{number}]"
            own_gas = known.setdefault((id(own_gas), factor), replace(own_gas, factor=factor, factor_path=path))
        gases.append(own_gas)
    return replace(engine, gases=tuple(gases), misfires=tuple(sorted(misfires)))


def _own_diagrams(table: Values, gas: Gas, count: int, reader: Reader) -> dict[int, Gas]:
    """Return the gas of the cylinders that have a diagram of their own, by number."""
    gases = {}
    for name, values in table["cylinders"].items():
        path = f"gas.cylinders.{name}"
        if name not in map(str, range(1, count + 1)):
            reader.add_error(path, ErrorMessage("cylinder_name", count=count))
        elif values is not None:
            gases[int(name)] = _with_diagram(gas, values, path, table, reader)
    return gases


def _of_columns(table: Values, gas: Gas, engine: Engine, reader: Reader) -> dict[int, Gas]:
    """Return the gas of each cylinder from the columns of one file over one crank angle, by number."""
    measured, places = table["measured"], engine.layout.places
    columns = measured["columns"]
    if columns and len(columns) != len(places):
        reader.add_error("gas.measured.columns", ErrorMessage("entries", count=len(columns), wanted=len(places)))
        return {}
    gases = dict[int, Gas]()
    for place, column in zip(places, columns, strict=False):
        later = (place.firing_angle + place.top - places[0].firing_angle - places[0].top) % gas.cycle
        own = Values({**measured, "pressure_column": column}, measured.table)
        del own["columns"]
        pressures = "absolute" if gas.is_absolute else "gauge"
        diagram = build_diagram(Values({"measured": own, "pressures": pressures}, table.table), "gas", reader)
        # what is reported of the first is true of all
        samples = diagram.measured and replace(diagram.measured, notices=() if gases else diagram.measured.notices)
        gases[place.number] = replace(gas, measured=samples, angle_shift=gas.angle_shift - later)
    return gases


def _check_order(gases: dict[int, Gas], table: Values, reader: Reader) -> None:
    """Report pressures of several cylinders that suit the firing order in another order only."""
    samples = {number: gas.measured for number, gas in gases.items() if gas.measured is not None}
    if len(samples) < len(gases) or len(gases) < 2:
        return
    # the diagram refuses a file of fewer
    if any(len(measured.degrees) < FEWEST for measured in samples.values()):
        return
    cycle, peaks = gases[min(gases)].cycle, {number: peak_angle(measured) for number, measured in samples.items()}

    def is_far(number: int, other: int, turn: float = 0.0) -> float:
        """Return how far the peak of another column is from where that of a cylinder is usual. [deg]"""
        late = centred(peaks[other] + gases[number].angle_shift + turn - 360.0, cycle)
        return max(PEAKS[0] - late, late - PEAKS[1], 0.0) + 1e-3 * abs(late)

    stated = {number: table if gas.path == "gas" else table["cylinders"][str(number)] for number, gas in gases.items()}
    columns = table["measured"]["columns"] or [own["measured"].get("pressure_column") for own in stated.values()]
    # columns as they follow each other may count from another dead centre
    turns = (0.0, 180.0, 360.0, -180.0) if columns == sorted(columns, key=str) else (0.0,)
    if any(all(is_far(number, number, turn) < 1 for number in gases) for turn in turns):
        return
    left, order = list(gases), dict[int, int]()
    for number in gases:
        order[number] = min(left, key=lambda other: is_far(number, other))
        left.remove(order[number])
    if any(is_far(number, other) > 1 for number, other in order.items()):
        return
    if table["measured"]["columns"]:
        line = f"columns = [{', '.join(_written(columns[other - 1]) for other in order.values())}]"
        reader.add_error("gas.measured.columns", ErrorMessage("columns_order", line=line))
        return
    for number, other in order.items():
        own, right = (stated[either]["measured"] for either in (number, other))
        keys = [key for key in ("file", "pressure_column") if right.get(key) != own.get(key)]
        line = ", ".join(f"{key} = {_written(right.get(key))}" for key in keys)
        if keys:
            reader.add_error(f"{gases[number].path}.measured.{keys[0]}", ErrorMessage("columns_order", line=line))


def _written(column: str | float) -> str:
    return shown(int(column) if isinstance(column, float) else column)


def _with_diagram(gas: Gas, values: Values, path: str, table: Values, reader: Reader) -> Gas:
    """Return the gas with another diagram; its pressures are absolute or gauge as those of the gas table."""
    check_parts(values, path, reader)
    pressures = "absolute" if gas.is_absolute else table["pressures"]
    diagram = build_diagram(values.but(pressures=pressures), path, reader, f"{gas.cycle:g} deg")
    valves = build_valves(values, path, reader)
    if valves is not None and not (gas.is_absolute and gas.cycle == _FULL_TURN):
        key, wanted = ("cycle", "360 deg") if gas.is_absolute else ("pressures", "absolute")
        reader.add_error(f"{path}.valves", no_effect_message(key, table[key], (wanted,)))
    elif valves is not None:
        diagram = with_valves(diagram, valves, has_clearance=True)
    return replace(gas, **diagram._asdict(), valves=valves, path=path)


def _misfires(table: Values, own: dict[str, Values | None], count: int, reader: Reader) -> set[int]:
    """Return the numbers of the cylinders without combustion."""
    misfires = set[int]()
    for index, entry in enumerate(table["misfire"], start=1):
        if entry is None:
            continue
        number, place = int(entry), f"engine.misfire[{index}]"
        if number > count:
            reader.add_error(place, ErrorMessage("misfire_absent", number=number, count=count))
        elif number in misfires:
            reader.add_error(place, ErrorMessage("misfire_twice", number=number))
        elif str(number) in own:
            reader.add_error(place, ErrorMessage("misfire_own", number=number))
        misfires.add(number)
    return misfires


def _factors(table: Values, misfires: set[int], count: int, reader: Reader) -> list[float]:
    """Return the factor of the gauge pressure of each cylinder."""
    factors = table["pressure_factors"]
    if not factors or None in factors:
        return [1.0] * count
    if len(factors) != count:
        reader.add_error("engine.pressure_factors", ErrorMessage("offsets_count", count=len(factors), cylinders=count))
    for number in misfires:
        if number <= len(factors) and factors[number - 1] != 1:
            reader.add_error(f"engine.pressure_factors[{number}]", ErrorMessage("misfire_factor", number=number))
    return [float(factor) for factor in factors]


def _motored(values: Values, gas: Gas, reader: Reader) -> Gas | None:
    """Return the gas of a cylinder without combustion."""
    if gas.calculated is not None:
        calculated = cast("CornerPressure | HeatReleasePressure", gas.calculated)
        is_open = values["cycle"]["motored"] == _AMBIENT
        around = given("ambient_pressure", gas.ambient, "cycle.ambient_pressure") if is_open else None
        return replace(gas, calculated=MisfirePressure(calculated, gas.cycle, around))
    table = values["gas"]
    motored = table["motored"]
    if motored is None:
        if not reader.has_errors("gas.motored"):
            reader.add_error("engine.misfire", ErrorMessage("motored_missing"))
        return None
    if isinstance(motored, str):
        if motored != _AMBIENT:
            reader.add_error("gas.motored", ErrorMessage("motored_word"))
        pressure = gas.ambient if gas.is_absolute else 0.0
        points, pieces = constant_diagram(pressure, gas.cycle)
        level = replace(gas, points=points, pieces=pieces, measured=None, valves=None)
        return replace(level, path="gas.motored")
    return _with_diagram(gas, motored, "gas.motored", table, reader)
