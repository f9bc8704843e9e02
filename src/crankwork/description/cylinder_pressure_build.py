"""From the values of a machine file to the pressure in a cylinder or chamber: its diagram, or measured samples."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from crankwork.description.measured_build import read_measured, treatment_of
from crankwork.description.schema import Values, nearest_name
from crankwork.description.value_types import Reader
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.loads.measured_pressure import MeasuredPressure, NoticeData
from crankwork.loads.valves import Pipe, Valves
from crankwork.locale import ErrorMessage
from crankwork.machine import Cylinder, Gas

_OF_GAS = ("expansion_exponent", "temperature")


def build_gas(values: Values | None, cylinder: Cylinder | None, reader: Reader) -> Gas | None:
    """Return the gas in a cylinder, or None after complaints."""
    if values is None:
        return None
    _check_gas(values, cylinder, reader)
    _check_rod(values, cylinder, reader)
    diagram = build_diagram(values, "gas", reader)
    if "cycle" not in values:
        return None
    is_absolute = pressures_of(values, diagram.measured) == "absolute"
    valves = build_valves(values, "gas", reader)
    if valves is not None:
        volumes = (cylinder.clearance_volume, cylinder.compression_ratio) if cylinder is not None else ()
        diagram = with_valves(diagram, valves, has_clearance=any(volumes))
    return Gas(
        cycle=float(values["cycle"].split()[0]),
        **diagram._asdict(),
        valves=valves,
        is_absolute=is_absolute,
        ambient=(values.but(pressures="absolute").si("ambient") or 0.0) if is_absolute else 0.0,
        names_ambient="ambient" in values,
        back_pressure=values.si("back_pressure") or 0.0,
    )


def _check_gas(values: Values, cylinder: Cylinder | None, reader: Reader) -> None:
    """Report missing keys of the gas."""
    if cylinder is None:
        if not reader.has_errors("cylinder.bore", "cylinder.displacement", "cylinder.stroke_bore_ratio"):
            reader.add_error("gas", ErrorMessage("gas_cylinder"))
    elif (
        {cylinder.clearance_volume, cylinder.compression_ratio} == {None}
        and any(piece and piece.get("law") == "polytropic" for table in _tables(values) for piece in table["pieces"])
        and not reader.has_errors("cylinder.clearance_volume", "cylinder.compression_ratio")
    ):
        reader.add_error("cylinder", ErrorMessage("gas_volume"))
    if has_diagram(values) or "cylinders" not in values:
        check_parts(values, "gas", reader)


def has_diagram(values: Values) -> bool:
    """Return whether a table has a diagram or a part of it."""
    return not {"points", "pieces", "measured", "valves"}.isdisjoint(values)


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
    for key in ("points", "pieces") if {"measured", "valves"}.isdisjoint(values) else ():
        if key not in values and not reader.has_errors(f"{path}.{key}", f"{path}.measured", f"{path}.valves"):
            reader.add_error(f"{path}.{key}", ErrorMessage(f"gas_{key}", path=path))


def build_valves(values: Values, path: str, reader: Reader) -> Valves | None:
    """Return the valves of a cylinder or chamber, None without; report contradictions."""
    if "valves" not in values or not {"suction", "discharge"} <= set(values["valves"]):
        return None
    stated, path = values["valves"], f"{path}.valves"
    pipes = {name: _pipe(stated, name) for name in ("suction_pipe", "discharge_pipe")}
    valves: Valves = stated.made(Valves, **pipes)
    if not valves.discharge > valves.suction:
        reader.add_error(f"{path}.discharge", ErrorMessage("valves_turned"))
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


def build_diagram(values: Values, path: str, reader: Reader) -> Diagram:
    """Return points and laws, or measured samples; report contradictions; `path`: of the diagram in the description."""
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
        for name, point in values["points"].items():
            pressure = None if point is None else point.si("pressure")
            if pressure is not None and pressure < 0:
                reader.add_error(f"{path}.points.{name}.pressure", ErrorMessage("point_vacuum"))
    return Diagram(
        points={
            name: point.made(DiagramPoint, angle=point.degrees("angle"))
            for name, point in values["points"].items()
            if point is not None
        },
        pieces=tuple(
            piece.made(Piece, points=tuple(name for name in piece["points"] if name))
            for piece in values["pieces"]
            if piece and {"law", "points"} <= set(piece)
        ),
        measured=measured,
        angle_shift=shift,
        resample=math.degrees(resample) if resample else None,
    )


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
