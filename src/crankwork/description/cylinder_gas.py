"""From the values of a machine file to the gas of cylinders that differ: misfire, own diagrams, factors."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from crankwork.description.measured_build import build_diagram, build_valves, check_parts, has_diagram, with_valves
from crankwork.description.schema import Values, no_effect_message
from crankwork.description.value_types import Reader, shown
from crankwork.formula.traced_value import given
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.loads.measured_pressure import FEWEST
from crankwork.loads.pressure_processing import PEAKS, centred, peak_angle
from crankwork.locale import ErrorMessage
from crankwork.machine import Engine, Gas
from crankwork.working_cycle.pressure_models import CornerPressure, HeatReleasePressure, MisfirePressure

_AMBIENT = "ambient"
_TURN = 360.0


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
    diagram = build_diagram(values.but(pressures=pressures), path, reader)
    valves = build_valves(values, path, reader)
    if valves is not None and not (gas.is_absolute and gas.cycle == _TURN):
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
        points = {"o": DiagramPoint(0.0, pressure), "o'": DiagramPoint(gas.cycle, pressure)}
        level = replace(gas, points=points, pieces=(Piece("constant", ("o", "o'")),), measured=None, valves=None)
        return replace(level, path="gas.motored")
    return _with_diagram(gas, motored, "gas.motored", table, reader)
