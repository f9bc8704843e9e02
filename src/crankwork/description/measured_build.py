"""From the table of a measured pressure to its samples: which columns, in which units."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

import numpy as np

from crankwork.description.kinds import Choice, Reader
from crankwork.description.schema import Values, means_nothing
from crankwork.description.table_file import FileTable, read_table
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.measured import MeasuredPressure, NoticeData, Pegging, Preprocessing
from crankwork.locale import Refusal
from crankwork.units import UNITS

# words of headings, in the languages that test benches speak
_WORDS = {
    "angle": re.compile(r"ang|crank|phi|φ|alpha|α|theta|θ|deg|°|\bca\b|cad|winkel|угол|угла|пкв|góc", re.IGNORECASE),
    "pressure": re.compile(r"^p(?![a-z]{2}|ow)|press|druck|zyl|давл|р_?ц|áp", re.IGNORECASE),
}
_REFERENCES = {
    "absolute": re.compile(r"\b(?:abs(?:olut\w*)?|bara|psia)\b|\(a\)|абс", re.IGNORECASE),
    "gauge": re.compile(r"\b(?:gauge|barg|psig)\b|\(g\)|изб", re.IGNORECASE),
}
_RANGE = re.compile(r"(\d+)\s*\.\.\s*(\d+)")
# what stands behind an angle and is more than a remark: a number or a quotient
_SOME_UNIT = re.compile(r"\d|/")
_BEHIND = re.compile(r",(\d+)")
# what no pressure stays below in a machine that works [Pa]
_NEVER = 50e3
_MOST = 16_384
_FEWEST = 8
# degrees that are no cycle, and radians that are too many
_SHORT, _LONG = 60.0, 100.0


class _Columns(NamedTuple):
    """Where the angle and the pressures of a table stand, and in what units they are read."""

    angle: int
    pressures: tuple[int, ...]
    angle_unit: str
    pressure_unit: str
    told: tuple[NoticeData, ...]


def read_measured(values: Values, reader: Reader, path: str, folder: Path) -> MeasuredPressure | None:
    """Return the samples of a file, or None after a complaint; `path`: what of the description they belong to."""
    if "file" not in values:
        return None
    file = values["file"]
    try:
        table = read_table(folder / file, name=file, sheet=values["sheet"])
        found = _columns(table, values)
        samples = table.columns((found.angle, *found.pressures))
        _check_angles(samples[:, 0], found.angle_unit, table)
    except CrankworkError as error:
        reader.complain(f"{path}.measured.file", error.args[0])
        return None
    if not found.pressure_unit:
        key = "pressure_unit"
        written = table.written[found.pressures[0]]
        options = ", ".join(_options(values)[:3])
        asked = Refusal("missing", advice=(f'{key} = "{_options(values)[0]}"',))
        if written:
            column = table.told(found.pressures[0])
            asked = Refusal("measured_unit_unknown", unit=written[:20], column=column, name=key, options=options)
        if not reader.doubts(f"{path}.measured.{key}"):
            reader.complain(f"{path}.measured.{key}", asked)
        return None
    if not reader.decimal_comma and _are_thousands(table, samples[:, 1:] * UNITS[found.pressure_unit].factor):
        line = table.lines[0]
        reader.complain(
            f"{path}.measured.file", Refusal("in_file", file=file, mistake=Refusal("measured_thousands", line=line))
        )
        return None
    degrees = samples[:, 0] if found.angle_unit == "deg" else np.degrees(samples[:, 0])
    pressure = samples[:, 1:] * UNITS[found.pressure_unit].factor
    # the name in a note is the same whichever system wrote the folders before it
    name = PureWindowsPath(file).name
    at = found.pressures[0]
    spelled = f"{table.names[at]} {table.written[at]}"
    reference = next((one for one, words in _REFERENCES.items() if words.search(spelled)), "")
    return MeasuredPressure(degrees, pressure, table.lines, name, found.told, reference=reference)


def treatment_of(values: Values, path: str, reader: Reader, *, absolute: bool) -> Preprocessing:
    """Return what a description wants done to samples; `path`: where it says so."""
    peg, which, smooth, loss = values.get("peg"), values["cycle"], values.si("smooth"), values.si("loss_angle")
    pegging = None
    if peg is not None and "exponent" in peg and not absolute:
        reader.complain(f"{path}.peg.exponent", means_nothing("pressures", "gauge", ("absolute",)))
    elif peg is not None and {"angle", "pressure"} <= set(peg):
        pegging = Pegging(math.degrees(peg.si("angle")), peg.si("pressure"))
    elif peg is not None and {"exponent", "from", "to"} <= set(peg):
        start, end = (round(math.degrees(peg.si(one)), 9) for one in ("from", "to"))
        pegging = Pegging(exponent=peg["exponent"], start=start, end=start + (end - start) % 720.0)
    return Preprocessing(
        cycle=int(which) if isinstance(which, float) else which,
        rest=values.si("rest_pressure"),
        peg=pegging,
        smooth=None if smooth is None else math.degrees(smooth),
        loss_angle=None if loss is None else math.degrees(loss),
        absolute=absolute,
    )


def _columns(table: FileTable, values: Values) -> _Columns:
    """Return which columns are read, and their units; raise where the machine file must say it."""
    angle, *_ = _chosen(table, values, "angle", ())
    pressures = _chosen(table, values, "pressure", (angle,))
    told: list[NoticeData] = []
    more = f"..{table.told(pressures[-1])}" if len(pressures) > 1 else ""
    taken = table.told(pressures[0]) + more
    if len(table.names) > 2 and not {"angle_column", "pressure_column"} <= set(values):
        told.append(("measured_columns_taken", {"angle": table.told(angle), "pressure": taken}))
    units = [_unit(table, values, "angle", angle, told), _unit(table, values, "pressure", pressures[0], told)]
    of_file = [unit for unit, key in zip(units, ("angle_unit", "pressure_unit"), strict=True) if key not in values]
    if pressures and "pressure_unit" not in values and units[1]:
        told.append(("measured_units_of_file", {"units": ", ".join(of_file)}))
    return _Columns(angle, pressures, units[0], units[1], tuple(told))


def _chosen(table: FileTable, values: Values, kind: str, taken: Sequence[int]) -> tuple[int, ...]:
    """Return the columns of angle or pressure: as stated, or the only ones that they can be."""
    key = f"{kind}_column"
    stated = values.get(key)
    if stated is not None:
        return _stated(table, stated, key, taken)
    count, words = len(table.names), _WORDS[kind]
    free = [at for at in range(count) if at not in taken]
    dimensions = [UNITS[one].dimension if one else "" for one in table.units]
    able = [at for at in free if dimensions[at] == kind]
    able = able or [at for at in free if not dimensions[at] and words.search(table.names[at])]
    if count == 2 and not able:
        # of two columns the angle stands first, unless their units say otherwise
        able = free[:1]
        if dimensions[able[0]] not in ("", kind):
            raise table.refused("measured_foreign", line=table.heading, column=table.told(able[0]),
                                unit=table.units[able[0]], key=key)  # fmt: skip
    if len(able) == 1 or (count == 2 and able):
        return (able[0],)
    meant = (able or free)[0 if able or kind == "angle" else -1]
    name = table.names[meant]
    by_name = name and table.names.count(name) == 1 and '"' not in name and len(name) <= 60
    example = f'"{name}"' if by_name else str(meant + 1)
    if not any(table.names):
        raise table.refused("measured_no_heading", line=table.heading, count=str(count), key=key, example=example)
    columns = tuple(table.told(at) for at in (able or free)[:12])
    asked = {"line": table.heading, "columns": columns, "key": key, "example": example}
    if kind == "pressure" and able and able[-1] - able[0] == len(able) - 1:
        raise table.refused("measured_which_cycles", **asked, cycles=f"{able[0] + 1}..{able[-1] + 1}")
    raise table.refused("measured_which", **asked)


def _stated(table: FileTable, stated: str | float, key: str, taken: Sequence[int]) -> tuple[int, ...]:
    """Return the columns that a machine file names: one, or a range of pressures side by side."""
    ends = _RANGE.fullmatch(stated) if isinstance(stated, str) and stated not in table.names and taken else None
    found = [stated] if ends is None else [float(one) for one in range(int(ends[1]), min(int(ends[2]), _MOST) + 1)]
    positions = tuple(map(table.position, found or [stated]))
    if set(positions) & set(taken):
        raise table.refused("measured_same", column=table.told(taken[0]), key=key)
    return positions


def _unit(table: FileTable, values: Values, kind: str, at: int, told: list[NoticeData]) -> str:
    """Return the unit of angle or pressure: as stated, else as the file has it, empty for none."""
    key, own = f"{kind}_unit", table.units[at]
    if own and UNITS[own].dimension != kind:
        raise table.refused(
            "measured_foreign", line=table.heading, column=table.told(at), unit=own, key=f"{kind}_column"
        )
    written = table.written[at]
    if key not in values and not own and kind == "angle" and _SOME_UNIT.search(written):
        told_of = {"unit": written[:20], "column": table.told(at), "name": key}
        raise table.refused("measured_unit_unknown", **told_of, options="deg, rad")
    if key not in values:
        return own if own or kind == "pressure" else "deg"
    stated = str(values[key])
    if own and UNITS[own] != UNITS[stated]:
        told.append(("measured_other_unit", {"column": table.told(at), "unit": own, "stated": stated, "name": key}))
    return stated


def _are_thousands(table: FileTable, pressure: Array) -> bool:
    """Return whether commas may part thousands: three digits behind each, and no pressure that a machine works with."""
    if table.separator == "," or float(np.max(np.abs(pressure), initial=0.0)) > _NEVER:
        return False
    behind = [len(one) for row in table.rows for one in _BEHIND.findall(row)]
    return bool(behind) and set(behind) == {3}


def _options(values: Values) -> tuple[str, ...]:
    kind = values.table.keys["pressure_unit"].kind
    return tuple(str(one) for one in kind.options) if isinstance(kind, Choice) else ()


def _check_angles(angles: Array, unit: str, table: FileTable) -> None:
    """Complain of angles in degrees that run over whole turns in radians, and the other way round."""
    if len(angles) < _FEWEST:
        return
    span, step = float(np.ptp(angles)), float(np.median(np.abs(np.diff(angles))))
    turn, other = (2 * math.pi, "rad") if unit == "deg" else (360.0, "deg")
    # a cycle is recorded with its last angle, or without it
    near = abs(span - turn * round(span / turn)) <= 1.5 * step
    if near and (span < _SHORT if unit == "deg" else span > _LONG):
        raise table.refused("measured_angle_unit", span=span, unit=unit, other=other, line=table.lines[0])
