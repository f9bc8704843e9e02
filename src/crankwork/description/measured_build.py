"""From the values of a machine file to the pressure of a gas, its diagram or measured samples, and its combustion."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import PureWindowsPath
from typing import NamedTuple

import numpy as np

from crankwork.description.keys import DIAGRAM, STROKES
from crankwork.description.schema import Values, nearest_name, no_effect_message
from crankwork.description.table_file import FileTable, read_list, read_table
from crankwork.description.value_types import MeasuredValue, Number, Reader
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import TracedValue, given
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import DiagramPoint, Piece, constant_diagram
from crankwork.loads.measured_pressure import MeasuredPressure, NoticeData, Pegging, Preprocessing, plausible_units
from crankwork.loads.pressure_processing import QUESTIONS
from crankwork.loads.valves import Pipe, Valves, discharge_of_height, suction_of_height
from crankwork.locale import ErrorMessage
from crankwork.machine import Cylinder, Gas
from crankwork.units import UNITS
from crankwork.working_cycle.burning_analysis import BurningAnalysis

# words of headings in the languages of test benches
_WORDS = {
    "angle": re.compile(
        r"ang|crank|phi|φ|alpha|α|theta|θ|deg|°|\bca\b|cad|winkel|угол|угла|кут|пкв|góc|\bgoc\b", re.IGNORECASE
    ),
    "pressure": re.compile(r"^p(?![a-z]{2}|ow)|press|druck|zyl|давл|тиск|р_?ц|áp|\bap suat", re.IGNORECASE),
}
_REFERENCES = {
    "absolute": re.compile(
        r"(?:\b|_)(?:abs(?:olut\w*)?|bara|psia)(?:\b|_)|\(a\)|абс|tuyệt đối|tuyet doi", re.IGNORECASE
    ),
    "gauge": re.compile(
        r"(?:\b|_)(?:gauge|barg|psig|rel)(?:\b|_)|\(g\)|изб|манометр|надлишк|áp suất dư|ap suat du|tương đối|tuong doi"
        r"|überdruck",
        re.IGNORECASE,
    ),
}
# angles from the dead centre of firing, and angles before a dead centre; words in each of the languages
_FROM_FIRING = re.compile(
    r"firing|fired|combust|ignition|compression|tdcf\b|tdc\s+power|power\s+(?:stroke|tdc)"
    r"|сгоран|сжат|рабоч|вспышк|воспламен|згор|стис|робоч|спалах|займан"
    r"|\bnổ|cháy|nén|\bdct (?:ky )?(?:no|chay|cuoi nen|nen)\b|zünd|\bzot\b",
    re.IGNORECASE,
)
_BEFORE = re.compile(r"\bb\.?tdc|before|(?:до|перед)\s+вмт|trước|\btruoc\b|\bvor\b", re.IGNORECASE)
_RANGE = re.compile(r"(\d+)\s*\.\.\s*(\d+)")
# text after an angle that is a unit: it has a number or a quotient
_SOME_UNIT = re.compile(r"\d|/")
_BEHIND = re.compile(r",(\d+)")
# least peak pressure of a working machine [Pa]
_MIN_PEAK = 50e3
_MOST = 16_384
_FEWEST = 8
# span too short for degrees, and too long for radians
_SHORT, _LONG = 60.0, 100.0
# share of the rows over which a crank angle rises
_MOSTLY = 0.9
_OF_GAS = ("expansion_exponent", "temperature")


class _Columns(NamedTuple):
    """Columns of the angle and the pressures of a table, and their units."""

    angle: int
    pressures: tuple[int, ...]
    angle_unit: str
    pressure_unit: str
    notices: tuple[NoticeData, ...]
    zero: float  # Angle of the cycle from which the file counts [deg]
    is_before: bool  # Whether angles count against time


def read_measured(values: Values, reader: Reader, path: str) -> MeasuredPressure | None:
    """Return the samples of a file, or None after a complaint; `path`: of their owner in the description."""
    if "step" in values and not {"file", "values"}.isdisjoint(values):
        return _listed(values, reader, f"{path}.measured")
    if "file" not in values:
        return None
    file = values["file"]
    try:
        table = read_table(reader.folder / file, name=file, sheet=values["sheet"])
        columns = _columns(table, values)
        if not (columns.pressure_unit or reader.has_errors(f"{path}.measured.pressure_unit")):
            reader.add_error(f"{path}.measured.pressure_unit", _without_unit(table, columns.pressures[0]))
        samples = table.columns((columns.angle, *columns.pressures))
        _check_angles(samples[:, 0], columns.angle_unit, table)
        other = next(filter(partial(_rises, table), columns.pressures), -1)
        if other >= 0 and not _rises(table, columns.angle):
            raise table.refused("measured_swapped", angle=table.label(columns.angle), other=table.label(other))
    except CrankworkError as error:
        reader.add_error(f"{path}.measured.file", *error.args)
        return None
    if not columns.pressure_unit:
        return None
    if not reader.decimal_comma and _are_thousands(table, samples[:, 1:] * UNITS[columns.pressure_unit].factor):
        line = table.lines[0]
        reader.add_error(
            f"{path}.measured.file",
            ErrorMessage("in_file", file=file, mistake=ErrorMessage("measured_thousands", line=line)),
        )
        return None
    degrees = samples[:, 0] * UNITS[columns.angle_unit].factor * _turned(values) / UNITS["deg"].factor
    degrees, lines = -degrees if columns.is_before else degrees, table.lines
    pressure = samples[:, 1:] * UNITS[columns.pressure_unit].factor
    if np.all(np.diff(degrees) < 0):
        degrees, pressure, lines = degrees[::-1], pressure[::-1], lines[::-1]
    if values["reversed"]:
        degrees, pressure, lines = -degrees[::-1], pressure[::-1], lines[::-1]
    # the name in a note does not depend on the separator of folders
    name = PureWindowsPath(file).name
    first = columns.pressures[0]
    spelled = f"{table.names[first]} {table.written[first]}"
    reference = next((kind for kind, words in _REFERENCES.items() if words.search(spelled)), "")
    return MeasuredPressure(
        degrees,
        pressure,
        lines,
        name,
        table.notices + columns.notices,
        reference=reference,
        zero=columns.zero,
        unit=columns.pressure_unit,
    )


def _turned(values: Values) -> float:
    """Return by how much a recording over time turns in a second, 1 for one over the crank angle. [rad/s]"""
    return float(values.si("speed") or 1.0) if "time_column" in values else 1.0


def _listed(values: Values, reader: Reader, path: str) -> MeasuredPressure | None:
    """Return pressures one after another at equal steps, or None after a complaint; `path`: of their table."""
    try:
        numbers = list(enumerate(values["values"], start=1)) or read_list(
            reader.folder / values["file"], name=values["file"], sheet=values["sheet"]
        )
    except CrankworkError as error:
        reader.add_error(f"{path}.file", *error.args)
        return None
    if "pressure_unit" not in values:
        reader.add_error(f"{path}.pressure_unit", ErrorMessage("missing", advice=('pressure_unit = "MPa"',)))
        return None
    pressure = np.array([number for _, number in numbers], dtype=float) * UNITS[values["pressure_unit"]].factor
    degrees = values.degrees("start") + values.degrees("step") * np.arange(len(pressure))
    name, lines = PureWindowsPath(values["file"] or "").name, tuple(line for line, _ in numbers)
    if values["reversed"]:
        degrees, pressure, lines = -degrees[::-1], pressure[::-1], lines[::-1]
    return MeasuredPressure(degrees, pressure, lines, name, unit=values["pressure_unit"])


def _without_unit(table: FileTable, column: int) -> ErrorMessage:
    """Return the question for the unit of a column of pressures, with those that suit its numbers."""
    units, written = plausible_units(table.readable(column)), table.written[column]
    if not written:
        return ErrorMessage("missing", advice=tuple(f'pressure_unit = "{unit}"' for unit in units))
    stated = {"unit": written[:20], "column": table.label(column), "name": "pressure_unit"}
    return ErrorMessage("measured_unit_unknown", **stated, options=", ".join(units))


def in_file(key: str, mistake: ErrorMessage, values: Values) -> ErrorMessage:
    """Return a mistake with the file that it is about, if it is about one."""
    owner, measured, _ = key.partition(".measured")
    if not measured:
        return mistake
    table = functools.reduce(dict.__getitem__, owner.split("."), values)
    return ErrorMessage("in_file", file=table["measured"]["file"] or "values", mistake=mistake)


def add_questions(notices: Iterable[NoticeData], values: Values, reader: Reader) -> None:
    """Report the notices that a description has to answer, each once."""
    for code, stated in notices:
        key = str(stated.get("name"))
        if code in QUESTIONS and not reader.has_errors(key):
            reader.add_error(key, in_file(key, ErrorMessage(f"notices.{code}", **stated), values))


def treatment_of(values: Values, path: str, reader: Reader, *, absolute: bool) -> Preprocessing:
    """Return the requested treatment of samples; `path`: of its table."""
    peg, which, smooth, loss = values.get("peg"), values["cycle"], values.si("smooth"), values.si("loss_angle")
    pegging = None
    if peg is not None and "exponent" in peg and not absolute:
        reader.add_error(f"{path}.peg.exponent", no_effect_message("pressures", "gauge", ("absolute",)))
    elif peg is not None and {"angle", "pressure"} <= set(peg):
        pegging = Pegging(math.degrees(peg.si("angle")), peg.si("pressure"))
    elif peg is not None and {"exponent", "from", "to"} <= set(peg):
        start, end = (round(math.degrees(peg.si(key)), 9) for key in ("from", "to"))
        pegging = Pegging(exponent=peg["exponent"], start=start, end=start + (end - start) % 720.0)
    return Preprocessing(
        cycle=int(which) if isinstance(which, float) else which,
        rest=values.si("rest_pressure"),
        peg=pegging,
        smooth=None if smooth is None else math.degrees(smooth),
        loss_angle=None if loss is None else math.degrees(loss),
        absolute=absolute,
        is_placed="shift" in values,
    )


def _columns(table: FileTable, values: Values) -> _Columns:
    """Return the columns to read, and their units; raise if the machine file must name them."""
    mistakes, chosen = list[ErrorMessage](), list[tuple[int, ...]]([(-1,)])
    over = "time" if "time_column" in values else "angle"
    for kind in (over, "pressure"):
        try:
            chosen.append(_chosen(table, values, kind, chosen[-1]))
        except CrankworkError as error:
            mistakes += error.args
    if mistakes:
        raise CrankworkError(*dict.fromkeys(mistakes))
    (angle, *_), pressures = chosen[1:]
    notices: list[NoticeData] = []
    more = f"..{table.label(pressures[-1])}" if len(pressures) > 1 else ""
    taken = table.label(pressures[0]) + more
    if len(table.names) > 2 and not {"angle_column", "pressure_column"} <= set(values):
        notices.append(("measured_columns_taken", {"angle": table.label(angle), "pressure": taken}))
    units = [_unit(table, values, over, angle, notices), _unit(table, values, "pressure", pressures[0], notices)]
    of_file = [unit for unit, key in zip(units, (f"{over}_unit", "pressure_unit"), strict=True) if key not in values]
    if pressures and "pressure_unit" not in values and units[1]:
        notices.append(("measured_units_of_file", {"units": ", ".join(of_file)}))
    heading = f"{table.names[angle]} {table.written[angle]}"
    # a heading may say that firing is at 360
    zero, is_before = (
        360.0 if _FROM_FIRING.search(heading) and "360" not in heading else 0.0,
        bool(_BEFORE.search(heading)),
    )
    if is_before:
        notices.append(("measured_before", {"column": table.label(angle)}))
    return _Columns(angle, pressures, units[0], units[1], tuple(notices), zero, is_before)


def _chosen(table: FileTable, values: Values, kind: str, taken: Sequence[int]) -> tuple[int, ...]:
    """Return the columns of angle or pressure: as stated, or the only possible ones."""
    key = f"{kind}_column"
    stated = values["columns"][0] if kind == "pressure" and "columns" in values else values.get(key)
    if stated is not None:
        return _stated(table, stated, key, taken)
    count, words = len(table.names), _WORDS[kind]
    free = [index for index in range(count) if index not in taken]
    dimensions = [UNITS[unit].dimension if unit else "" for unit in table.units]
    able = [index for index in free if dimensions[index] == kind]
    able = able or [index for index in free if not dimensions[index] and words.search(table.names[index])]
    if count == 2 and not able:
        # the first of two columns is the angle, unless its unit or its numbers say otherwise
        able = free[:1] if any(table.names) or _rises(table, free[0]) or not _rises(table, free[-1]) else free[-1:]
        if dimensions[able[0]] not in ("", kind):
            raise table.refused("measured_foreign", line=table.heading, column=table.label(able[0]),
                                unit=table.units[able[0]], key=key)  # fmt: skip
    if len(able) == 1 or (count == 2 and able):
        return (able[0],)
    meant = (able or free)[0 if able or kind == "angle" else -1]
    name = table.names[meant]
    by_name = name and table.names.count(name) == 1 and '"' not in name and len(name) <= 60
    example = f'"{name}"' if by_name else str(meant + 1)
    if not any(table.names):
        raise table.refused("measured_no_heading", line=table.heading, count=str(count), key=key, example=example)
    columns = tuple(table.label(index) for index in (able or free)[:12])
    requested = {"line": table.heading, "columns": columns, "key": key, "example": example}
    if kind == "pressure" and able and able[-1] - able[0] == len(able) - 1:
        raise table.refused("measured_which_cycles", **requested, cycles=f"{able[0] + 1}..{able[-1] + 1}")
    raise table.refused("measured_which", **requested)


def _rises(table: FileTable, column: int) -> bool:
    """Return whether the numbers of a column rise over most rows, as a crank angle does."""
    try:
        steps = np.diff(table.columns((column,))[:, 0])
    except CrankworkError:
        return False
    return bool(len(steps)) and float(np.mean(steps > 0)) > _MOSTLY


def _stated(table: FileTable, stated: str | float, key: str, taken: Sequence[int]) -> tuple[int, ...]:
    """Return the columns that a machine file names: one, or a range of pressures."""
    ends = _RANGE.fullmatch(stated) if isinstance(stated, str) and stated not in table.names and taken else None
    columns = [stated] if ends is None else [*map(float, range(int(ends[1]), min(int(ends[2]), _MOST) + 1))]
    positions = tuple(map(table.position, columns or [stated]))
    if set(positions) & set(taken):
        raise table.refused("measured_same", column=table.label(taken[0]), key=key)
    return positions


def _unit(table: FileTable, values: Values, kind: str, position: int, notices: list[NoticeData]) -> str:
    """Return the unit of angle or pressure: as stated, else as the file has it, empty for none."""
    key, own = f"{kind}_unit", table.units[position]
    if own and UNITS[own].dimension != kind:
        raise table.refused(
            "measured_foreign", line=table.heading, column=table.label(position), unit=own, key=f"{kind}_column"
        )
    written = table.written[position]
    if key not in values and not own and kind == "angle" and _SOME_UNIT.search(written):
        values_of_message = {"unit": written[:20], "column": table.label(position), "name": key}
        raise table.refused("measured_unit_unknown", **values_of_message, options="deg, rad")
    if key not in values:
        return own if own or kind == "pressure" else "s" if kind == "time" else "deg"
    stated = str(values[key])
    if own and UNITS[own] != UNITS[stated]:
        notices.append(
            ("measured_other_unit", {"column": table.label(position), "unit": own, "stated": stated, "name": key})
        )
    return stated


def _are_thousands(table: FileTable, pressure: Array) -> bool:
    """Return whether commas may separate thousands: three digits after each, and pressures too low for a machine."""
    if table.separator == "," or float(np.max(np.abs(pressure), initial=0.0)) > _MIN_PEAK:
        return False
    behind = [len(digits) for row in table.rows for digits in _BEHIND.findall(row)]
    return bool(behind) and set(behind) == {3}


def _check_angles(angles: Array, unit: str, table: FileTable) -> None:
    """Raise for angles in degrees that span whole turns in radians, and vice versa."""
    if len(angles) < _FEWEST or UNITS[unit].dimension == "time":
        return
    span, step = float(np.ptp(angles)), float(np.median(np.abs(np.diff(angles))))
    turn, other = (2 * math.pi, "rad") if unit == "deg" else (360.0, "deg")
    # a cycle is recorded with its last angle, or without it
    near = abs(span - turn * round(span / turn)) <= 1.5 * step
    if near and (span < _SHORT if unit == "deg" else span > _LONG):
        raise table.refused("measured_angle_unit", span=span, unit=unit, other=other, line=table.lines[0])


def build_gas(values: Values | None, cylinder: Cylinder | None, reader: Reader) -> Gas | None:
    """Return the gas in a cylinder, or None after complaints."""
    if values is None:
        return None
    _check_gas(values, cylinder, reader)
    _check_rod(values, cylinder, reader)
    diagram = build_diagram(values, "gas", reader, values.get("cycle"))
    if {"cycle", "pressure"}.isdisjoint(values):
        return None
    cycle = float(values["cycle"].split()[0]) if "cycle" in values else 360.0
    if "pressure" in values:
        points, pieces = constant_diagram(values.si("pressure"), cycle)
        diagram = diagram._replace(points=points, pieces=pieces)
    is_absolute = pressures_of(values, diagram.measured) == "absolute"
    valves = build_valves(values, "gas", reader)
    if valves is not None:
        volumes = (cylinder.clearance_volume, cylinder.compression_ratio) if cylinder is not None else ()
        diagram = with_valves(diagram, valves, has_clearance=any(volumes))
    return Gas(
        cycle=cycle,
        **diagram._asdict(),
        valves=valves,
        is_absolute=is_absolute,
        ambient=(values.but(pressures="absolute").si("ambient") or 0.0) if is_absolute else 0.0,
        names_ambient="ambient" in values,
        back_pressure=values.si("back_pressure") or 0.0,
        combustion=build_combustion(values, reader, is_absolute=is_absolute),
    )


def _check_gas(values: Values, cylinder: Cylinder | None, reader: Reader) -> None:
    """Report missing keys of the gas."""
    if cylinder is None:
        if not reader.has_errors("cylinder.bore", "cylinder.displacement", "cylinder.stroke_bore_ratio"):
            reader.add_error("gas", ErrorMessage("gas_cylinder"))
    elif (
        {cylinder.clearance_volume, cylinder.compression_ratio} == {None}
        and not (values.outer and "clearance_volume" in values.outer["cylinder"])
        and any(piece and piece.get("law") == "polytropic" for table in _tables(values) for piece in table["pieces"])
        and not reader.has_errors("cylinder.clearance_volume", "cylinder.compression_ratio")
    ):
        reader.add_error("cylinder", ErrorMessage("gas_volume"))
    if has_diagram(values) or "cylinders" not in values:
        check_parts(values, "gas", reader)


def has_diagram(values: Values) -> bool:
    """Return whether a table has a diagram or a part of it."""
    return not {*DIAGRAM, "valves"}.isdisjoint(values)


def _tables(values: Values) -> Iterator[Values]:
    """Yield the tables of the gas that may have a diagram: its own, and those of cylinders that differ."""
    yield values
    for table in (values["motored"], *values["cylinders"].values()):
        if isinstance(table, Values):
            yield table


def _check_rod(values: Values, cylinder: Cylinder | None, reader: Reader) -> None:
    """Report a piston rod without back pressure, and a back pressure without a rod."""
    has_rod, has_pressure = cylinder is not None and cylinder.piston_rod_diameter > 0, "back_pressure" in values
    if has_pressure and not has_rod and not reader.has_errors("cylinder.piston_rod_diameter", "cylinder"):
        reader.add_error("gas.back_pressure", ErrorMessage("back_pressure_alone"))
    if has_rod and not has_pressure and not reader.has_errors("gas.back_pressure"):
        reader.add_error("cylinder.piston_rod_diameter", ErrorMessage("piston_rod_alone"))


def check_parts(values: Values, path: str, reader: Reader) -> None:
    """Report points without laws, and laws without points."""
    pressure_keys = ("strokes", "measured", "valves", "pressure")
    for key in ("points", "pieces") if values.keys().isdisjoint(pressure_keys) else ():
        if key not in values and not reader.has_errors(*(f"{path}.{name}" for name in (key, *pressure_keys))):
            reader.add_error(f"{path}.{key}", ErrorMessage(f"gas_{key}", path=path))


def build_valves(values: Values, path: str, reader: Reader) -> Valves | None:
    """Return the valves of a cylinder or chamber, None without; report contradictions."""
    ends = ("suction", "discharge")
    if "valves" not in values or not all({end, f"{end}_height"} & {*values["valves"]} for end in ends):
        return None
    stated, path = values["valves"], f"{path}.valves"
    linked = {end: _of_height(values, path, end, reader) for end in ends if f"{end}_height" in stated}
    pipes = {name: _pipe(stated, name) for name in ("suction_pipe", "discharge_pipe")}
    valves: Valves = stated.made(Valves, **pipes, **{end: pressure.value for end, pressure in linked.items()})
    if linked:
        gravity = given("gravity", reader.gravity, "method.gravity")
        valves = replace(valves, linked={**linked, "gravity": gravity})
    if valves.suction <= 0:
        reader.add_error(f"{path}.suction_height", ErrorMessage("suction_high"))
    if not valves.discharge > valves.suction:
        key = "discharge_height" if "discharge_height" in stated else "discharge"
        reader.add_error(f"{path}.{key}", ErrorMessage("valves_turned"))
    elif valves.temperature and valves.discharge_temperature:
        most = valves.temperature * valves.discharge / valves.suction
        if not valves.temperature <= valves.discharge_temperature < most:
            low = valves.temperature
            reader.add_error(f"{path}.discharge_temperature", ErrorMessage("valves_temperature", low=low, high=most))
    is_liquid = {"compression_exponent", "discharge_temperature"}.isdisjoint(stated)
    for key in _OF_GAS if is_liquid and not reader.has_errors(f"{path}.compression_exponent") else ():
        if key in stated:
            advice = "compression_exponent = 1.3"
            reader.add_error(f"{path}.{key}", ErrorMessage("only_beside", key="compression_exponent", advice=advice))
    return valves


def _of_height(values: Values, path: str, end: str, reader: Reader) -> TracedValue:
    """Return the pressure that a height of liquid leaves before a pump, or adds behind it."""
    stated, ambient = values["valves"], values.but(pressures="absolute").si("ambient") or 0.0
    around = given("ambient_pressure", ambient, f"{path.rpartition('.')[0]}.ambient")
    density = given("liquid_density", stated.si("density") or 0.0, f"{path}.density")
    height = given(f"{end}_height", stated.si(f"{end}_height"), f"{path}.{end}_height")
    gravity = given("gravity", reader.gravity, "method.gravity")
    pressure: TracedValue = (suction_of_height if end == "suction" else discharge_of_height)(
        around, density, gravity, height
    )
    return pressure.named(f"{end}_pressure")


def _pipe(stated: Values, name: str) -> Pipe | None:
    """Return a pipe of a pump, None without it or after complaints."""
    if name not in stated or not {"length", "diameter"} <= set(stated[name]):
        return None
    pipe: Pipe = stated[name].made(Pipe)
    return pipe


class Diagram(NamedTuple):
    """The parts of an indicator diagram, as a cylinder and a chamber have them."""

    points: Mapping[str, DiagramPoint]
    pieces: tuple[Piece, ...]
    measured: MeasuredPressure | None
    angle_shift: float
    resample: float | None


def with_valves(diagram: Diagram, valves: Valves, *, has_clearance: bool) -> Diagram:
    """Return a diagram with the points and laws of valves."""
    points, pieces = valves.diagram(has_clearance=has_clearance)
    return diagram._replace(points=points, pieces=pieces)


def build_diagram(values: Values, path: str, reader: Reader, cycle: str | None = None) -> Diagram:
    """Return points and laws, or measured samples; report contradictions.

    `path`: of the diagram in the description; `cycle`: after which it repeats, as stated.
    """
    _check_points(values, path, reader)
    measured = read_measured(values["measured"], reader, path) if "measured" in values else None
    source, shift = values["measured"], math.degrees(values["measured"].si("shift"))
    pressures = pressures_of(values, measured)
    absolute = pressures == "absolute"
    if measured is not None:
        treatment = treatment_of(source, f"{path}.measured", reader, absolute=absolute)
        # chambers of a linkage count from where its crank starts
        is_counted = values.table.name != "gas"
        notices = list[NoticeData]()
        if measured.reference not in ("", pressures):
            notices.append(("measured_reference", {"reference": measured.reference, "stated": pressures}))
        elif measured.reference and "pressures" not in values:
            notices.append(("measured_reference_used", {"reference": pressures}))
        if measured.zero and not (treatment.is_placed or is_counted):
            shift = measured.zero
            notices.append(("measured_zero", {"name": f"{path}.measured", "shift": shift}))
        measured = replace(measured, treatment=treatment, notices=(*measured.notices, *notices))
    resample = source.si("resample")
    if absolute:
        stated = {f"{path}.points.{name}": point for name, point in values["points"].items()}
        for place, table in {**stated, path: values}.items():
            pressure = table and table.get("pressure")
            if isinstance(pressure, MeasuredValue) and pressure.value < 0:
                reader.add_error(f"{place}.pressure", ErrorMessage("point_vacuum"))
    points, pieces = dict[str, DiagramPoint](), tuple[Piece, ...]()
    if "strokes" in values and cycle is not None:
        points, pieces = _over_strokes(values["strokes"], f"{path}.strokes", cycle, reader, absolute=absolute)
    return Diagram(
        points=points
        or {
            name: point.made(DiagramPoint, angle=point.degrees("angle"))
            for name, point in values["points"].items()
            if point is not None
        },
        pieces=pieces
        or tuple(
            piece.made(Piece, points=tuple(name for name in piece["points"] if name))
            for piece in values["pieces"]
            if piece and {"law", "points"} <= set(piece)
        ),
        measured=measured,
        angle_shift=shift,
        resample=math.degrees(resample) if resample else None,
    )


def _check_strokes(table: Values, path: str, cycle: str, reader: Reader, *, absolute: bool) -> None:
    """Report mistakes of a table of pressures over the stroke."""
    shares = table["shares"]
    if {"largest", "unit"}.isdisjoint(table) and not reader.has_errors(f"{path}.largest", f"{path}.unit"):
        reader.add_error(f"{path}.largest", ErrorMessage("missing", advice=('largest = "4 MPa"', 'unit = "MPa"')))
    if shares and None not in shares and (shares != sorted({*shares}) or shares[0] or shares[-1] != 1):
        reader.add_error(f"{path}.shares", ErrorMessage("stroke_shares"))
    key = "period" if path.startswith("chambers.") else "cycle"
    foreign = {name: wanted for wanted, names in STROKES.items() if wanted != cycle for name in names if name in table}
    for name, wanted in foreign.items():
        reader.add_error(f"{path}.{name}", no_effect_message(key, cycle, (wanted,)))
    for name in STROKES[cycle]:
        if name not in table and not reader.has_errors(f"{path}.{name}"):
            reader.add_error(f"{path}.{name}", ErrorMessage("missing", advice=(f"{name} = [...]",)))
        elif name in table and shares and len(table[name]) != len(shares):
            message = ErrorMessage("load_at_count", count=len(table[name]), others=len(shares), column="shares")
            reader.add_error(f"{path}.{name}", message)
        for place, pressure in enumerate(table[name], start=1):
            if absolute and (pressure or 0.0) < 0:
                reader.add_error(f"{path}.{name}[{place}]", ErrorMessage("point_vacuum"))
            elif "largest" in table:
                Number(-1.0, 1.0).read(pressure, f"{path}.{name}[{place}]", reader)


def _over_strokes(
    table: Values, path: str, cycle: str, reader: Reader, *, absolute: bool
) -> tuple[dict[str, DiagramPoint], tuple[Piece, ...]]:
    """Return points and curves of a table of pressures over the stroke, numbered over the cycle; report mistakes."""
    shares, points, pieces = table["shares"], dict[str, DiagramPoint](), list[Piece]()
    _check_strokes(table, path, cycle, reader, absolute=absolute)
    if any(problem.key.startswith(path) for problem in reader.problems):
        return {}, ()
    key = "largest" if "largest" in table else "unit"
    unit = table.si("largest") if key == "largest" else UNITS[table["unit"]].factor
    scale = given("listed_pressure_unit", unit, f"{path}.{key}")
    for number, name in enumerate(STROKES[cycle]):
        passed, before = list[str](), points.get(str(len(points)))
        for k in range(len(shares))[:: -1 if number % 2 else 1]:
            share = given("travel_share", shares[k], f"{path}.shares[{k + 1}]")
            pressure = given("listed_pressure", table[name][k], f"{path}.{name}[{k + 1}]") * scale
            point = DiagramPoint(pressure=pressure.value, stroke=share.value, inputs=(share, pressure))
            # a stroke begins at the point where the one before ends, or with a jump
            passed.append(str(len(points) + (point != before)))
            points[passed[-1]] = point
        pieces.append(Piece(table["law"], tuple(passed)))
    last, end = str(len(points)), str(len(points) + 1)
    if points[last].pressure != points["1"].pressure:
        pieces.append(Piece("constant", (last, end)))
        points[end] = replace(points["1"], stroke=None, angle=float(cycle.partition(" ")[0]))
    return points, tuple(pieces)


def pressures_of(values: Values, measured: MeasuredPressure | None) -> str:
    """Return what pressures are counted from, where no table states it as the file with samples says."""
    stated: str = values["pressures"]
    return stated if measured is None or "pressures" in values else measured.reference or stated


def _check_points(values: Values, path: str, reader: Reader) -> None:
    """Report every point of a piece that is not in the table of points."""
    known = values.get("points")
    if known is None:
        return
    for number, piece in enumerate(values["pieces"], start=1):
        key = f"{path}.pieces[{number}]"
        names = [(f"{key}.points[{i}]", name) for i, name in enumerate((piece or {}).get("points", []), start=1)]
        names.append((f"{key}.reference", (piece or {}).get("reference")))
        for place, name in names:
            if name is not None and name not in known and not reader.has_errors(f"{path}.points"):
                nearest = nearest_name(name, known)
                near = ErrorMessage("no_point_near", name=name, nearest=nearest, path=path)
                reader.add_error(
                    place,
                    near if nearest else ErrorMessage("no_point", name=name, known=", ".join(known)[:120], path=path),
                )


def build_combustion(values: Values, reader: Reader, *, is_absolute: bool) -> BurningAnalysis | None:
    """Return what the analysis of combustion is told, None without it or after complaints."""
    stated, path = values.get("combustion"), "gas.combustion"
    if stated is None or not {"from", "to"} <= set(stated):
        return None
    if not is_absolute:
        reader.add_error(path, no_effect_message("pressures", "gauge", ("absolute",)))
    start, end, cycle = stated.degrees("from"), stated.degrees("to"), float(values["cycle"].split()[0])
    windows = [_pair(window) for window in stated["windows"] if window and None not in window]
    burning = _pair(stated["burning"]) if stated["burning"] and None not in stated["burning"] else None
    for key, first, last, low, high in (
        ("to", start, end, 0.0, cycle),
        *(("burning", *pair, start, end) for pair in ([burning] if burning else [])),
        *((f"windows[{number}]", *window, 0.0, cycle) for number, window in enumerate(windows, start=1)),
    ):
        if not low <= first < last <= high:
            reader.add_error(f"{path}.{key}", ErrorMessage("angles_between", low=f"{low:g}", high=f"{high:g}"))
    return BurningAnalysis(
        start,
        end,
        stated["adiabatic_exponent"],
        stated["exponent_slope"],
        stated.si("temperature"),
        stated.si("wall_temperature"),
        burning=burning,
        windows=tuple(windows),
    )


def _pair(angles: list[MeasuredValue]) -> tuple[float, float]:
    """Return two angles. [deg]"""
    first, last = (round(math.degrees(angle.value), 9) for angle in angles)
    return first, last
