"""Reading measured pressure from a CSV file, whatever the separator and the decimal mark."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path, PureWindowsPath
from typing import Any

import numpy as np

from crankwork import files
from crankwork.description.kinds import Reader
from crankwork.description.schema import Values
from crankwork.errors import CrankworkError
from crankwork.loads.measured import MeasuredPressure
from crankwork.locale import Refusal
from crankwork.units import UNITS

_LARGEST = 1e12


def read_measured(values: Values, reader: Reader, path: str, folder: Path) -> MeasuredPressure | None:
    """Return the samples of a CSV file, or None after a complaint; `path`: what of the description they belong to."""
    if "file" not in values or "pressure_unit" not in values:
        return None
    key = f"{path}.measured.file"
    try:
        text = files.read_text(folder / values["file"], limit=files.MAX_DATA_FILE)
        samples = _samples(text, values)
    except CrankworkError as error:
        reader.complain(key, error.args[0])
        return None
    except ValueError as error:
        reader.complain(key, Refusal("in_file", file=values["file"], mistake=error.args[0]))
        return None
    numbers, angles, pressures = zip(*samples, strict=True)
    degrees = np.array(angles) if values["angle_unit"] == "deg" else np.degrees(angles)
    pressure = np.array(pressures) * UNITS[values["pressure_unit"]].factor
    # the name in a note is the same whichever system wrote the folders before it
    return MeasuredPressure(degrees, pressure, numbers, PureWindowsPath(values["file"]).name)


def _samples(text: str, values: Mapping[str, Any]) -> list[tuple[int, float, float]]:
    """Return line number, angle and pressure of every row of numbers."""
    rows = _rows(text)
    if not rows:
        raise ValueError(Refusal("measured_empty"))
    number, first = rows[0]
    angle, pressure = _columns(first, number, values)
    has_heading = any(_float(cell) is None for cell in first[:2])
    samples = []
    for number, row in rows[has_heading:]:
        if len(row) != len(first):
            raise ValueError(
                Refusal("measured_columns", line=number, count=len(row), first=rows[0][0], wanted=len(first))
            )
        samples.append((number, _number(row[angle], number), _number(row[pressure], number)))
    if not samples:
        raise ValueError(Refusal("measured_heading", line=number))
    return samples


def _rows(text: str) -> list[tuple[int, list[str]]]:
    """Return the cells of every row that is neither empty nor a comment, with its line number."""
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1)]
    lines = [(number, line) for number, line in lines if line.strip(" \t;,") and not line.lstrip().startswith("#")]
    sample = lines[0][1] if lines else ""
    separator = next((mark for mark in ";\t," if mark in sample), None)
    if separator is None:
        return [(number, line.split()) for number, line in lines]
    try:
        return [
            (number, next(csv.reader([line], delimiter=separator, skipinitialspace=True))) for number, line in lines
        ]
    except csv.Error:
        raise ValueError(Refusal("measured_cell")) from None


def _columns(heading: list[str], number: int, values: Mapping[str, Any]) -> tuple[int, int]:
    """Return the positions of the two columns, by heading if one is given."""
    names = [cell.strip() for cell in heading]
    if len(names) < 2:
        raise ValueError(Refusal("measured_one_column", line=number))
    if len(names) > 2 and all(_float(name) is not None for name in names):
        raise ValueError(Refusal("measured_no_heading", line=number, count=len(names)))
    positions = []
    for key, default in (("angle_column", 0), ("pressure_column", 1)):
        name = values.get(key)
        if name is not None and name not in names:
            raise ValueError(Refusal("measured_absent", line=number, name=name, known=", ".join(names)[:200]))
        positions.append(default if name is None else names.index(name))
    return positions[0], positions[1]


def _number(cell: str, number: int) -> float:
    value = _float(cell)
    if value is None or not abs(value) < _LARGEST:
        raise ValueError(Refusal("measured_no_number", line=number, cell=cell.strip()[:40]))
    return value


def _float(cell: str) -> float | None:
    try:
        return None if "_" in cell else float(cell.strip().replace(",", "."))
    except ValueError:
        return None
